// SPDX-License-Identifier: GPL-3.0-or-later
#include "seepage/newton.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace berm::seepage
{
namespace
{
constexpr double final_tolerance = 1e-8; ///< sum |F_free| / q of the answer [-]
constexpr double stage_tolerance = 1e-3; ///< the same at an intermediate level
// Rounding may keep a zoned section from the first: flows of its most conductive soil cancel to
// those of the least. With this residual, and steps that move the pressure head by no more than
// this share of the height anywhere, an iterate is converged all the same.
constexpr double rounded_tolerance = 1e-6, rounded_move = 1e-9;
// Nor can a residual get far below the rounding of the sums in F: that is as good as it gets, if
// the discharge is still known to this.
constexpr double largest_rounding = 1e-3; ///< of F over q [-]
constexpr double lost_outflow = 1e-12;    ///< over q: less through a node is rounding [-]

// Backtracking, to 2^-6 of a step, only stops one that makes the residual ten times larger: with
// the steps of eq. (2.9) the way to the solution often leads over a larger one. Near the end, and
// after so many steps that did not halve the residual, it allows no growth: k_r has a kink that
// iterates may cycle about.
constexpr int smallest_step_halvings = 6;
constexpr double growth_allowed = 10, strict_below = 1e-5;
constexpr int strict_after = 4;

// A stage has failed that is not done by so many steps, or that has not halved its residual (or got
// it down to half of `nearly_there`) by so many, or whose residual grows by the factor
// `divergence`: beside a core of 1e-6 a drain's residual may be 1e4 of what flows, and still go.
constexpr int steps_per_stage = 40, steps_to_halve = 12;
constexpr double nearly_there = 0.05, divergence = 1e9;
// The set may cycle where the matrix is not monotone, as in very anisotropic soil. The last try of
// the first stage is a patient one: steps that move the seepage face are counted apart, and once
// the number of changes has not fallen for so many steps, one node changes at a time, the first of
// them, with which no set comes twice (Murty 1974) as far as the problem is linear.
// A start at the last level may hang on a node at the kink of k_r, from where another one goes on.
constexpr int stalled_at_once = 7;
constexpr int block_changes = 5, face_steps = 160;

constexpr double stage_factor = 0.25;      ///< of eps from level to level
constexpr double first_k_min = 1e-4;       ///< until eps is final [-]
constexpr double stage_factor_k_min = 0.1; ///< of k_min from level to level after that
constexpr int reported_steps = 40;         ///< of the history in an error
constexpr int bisections = 4;              ///< how often the way to a level that failed is halved
constexpr double first_growth = 4;         ///< of the first eps if the first stage fails
constexpr int first_tries = 4;

/// How far the continuation has come: lower bounds of eps and k_min.
struct Level
{
  double eps = 0, k_min = 0;
};

Level between(const Level& a, const Level& b)
{
  return {.eps = std::sqrt(a.eps * b.eps), .k_min = std::sqrt(a.k_min * b.k_min)};
}

struct Totals
{
  double inflow = 0, outflow = 0; ///< through nodes with a condition, and prescribed
  double imbalance = 0;           ///< sum of |F| over the free nodes
  double rounding = 0;            ///< what rounding may make of a flow of zero

  [[nodiscard]] double flow() const { return std::max(inflow, outflow); }
};

class Iteration
{
public:
  Iteration(FlowOperator& flow, const meshes::TriangleMesh& mesh, const NodeConditions& conditions,
            std::span<const RelativeConductivity> laws, const Scales& scales, Start start,
            SolveHistory& history, Observer& observer)
      : flow_(flow), mesh_(mesh), conditions_(conditions), laws_(laws),
        conductivity_(scales.conductivity), height_(scales.height), p_(std::move(start.p)),
        active_(p_.size(), 0), fixed_(p_.size(), 0), most_steps_(start.most_steps),
        history_(history), observer_(observer)
  {
    const double p_zero = -1e-9 * start.smoothing; // rounding of an interpolated zero
    for (std::size_t i = 0; i < p_.size(); ++i)
    {
      if (conditions_.kind[i] == NodeKind::head)
        p_[i] = conditions_.pressure_head[i];
      if (conditions_.kind[i] == NodeKind::face && p_[i] >= p_zero)
        activate(i);
      fixed_[i] = conditions_.kind[i] == NodeKind::head || active_[i];
    }
    history_.unknowns = static_cast<Index>(p_.size());
  }

  /// At the last level from the start.
  bool at_once(const Level& end) { return stage(end, final_tolerance, stalled_at_once); }

  /// From one level, at which the iterate is converged, to the next; halfway first if that fails.
  bool advance(const Level& from, const Level& to, double tolerance, int halvings)
  {
    const std::vector<double> p = p_;
    const std::vector<std::uint8_t> active = active_, fixed = fixed_;
    if (stage(to, tolerance))
      return true;
    if (halvings == 0)
      return false;
    p_ = p;
    active_ = active;
    fixed_ = fixed;
    const Level middle = between(from, to);
    return advance(from, middle, stage_tolerance, halvings - 1) &&
           advance(middle, to, tolerance, halvings - 1);
  }

  /// The first stage; if it fails, from a larger smoothing, where the problem is almost linear; at
  /// last patiently.
  bool start(Level& level)
  {
    const std::vector<double> p = p_;
    const std::vector<std::uint8_t> active = active_, fixed = fixed_;
    const Level first = level;
    for (int attempt = 0; attempt <= first_tries; ++attempt, level.eps *= first_growth)
    {
      patient_ = attempt == first_tries;
      if (patient_)
        level = first;
      const bool good = stage(level, stage_tolerance);
      patient_ = false;
      if (good)
        return true;
      p_ = p;
      active_ = active;
      fixed_ = fixed;
    }
    return false;
  }

  Field finish()
  {
    const Totals now = totals();
    const bool flows = now.flow() > now.rounding;
    history_.residual = flows ? now.imbalance / now.flow() : 0;
    history_.discharge = flows ? now.inflow : 0;
    for (std::size_t i = 0; i < F_.size(); ++i)
      F_[i] += conditions_.rain[i];
    return {.p = std::move(p_),
            .entering = std::move(F_),
            .active = std::move(active_),
            .inflow = flows ? now.inflow : 0,
            .outflow = flows ? now.outflow : 0,
            .history = history_};
  }

  [[nodiscard]] std::string failure() const
  {
    return "seepage: no convergence" + cause() + " in " + history();
  }

  /// What the last iterate shows of why there is none; empty if it shows nothing.
  [[nodiscard]] std::string cause() const
  {
    const Totals now = totals();
    if (now.rounding > largest_rounding * now.flow())
      return fmt::format(
          ", rounding hides the flow: {:.2g} m2/s of rounding beside {:.2g} m2/s (heads "
          "that hardly differ, or conductivities too far apart)",
          now.rounding, now.flow());
    std::size_t driest = p_.size();
    for (std::size_t i = 0; i < p_.size(); ++i)
      if (conditions_.load[i] < 0 && p_[i] < 0 && (driest == p_.size() || p_[i] < p_[driest]))
        driest = i;
    if (driest < p_.size())
      return fmt::format(", a boundary draws more water out than the soil yields: it is dry at "
                         "({:.6g}, {:.6g}) m,",
                         mesh_.nodes[driest].x(), mesh_.nodes[driest].y());
    return "";
  }

  /// The last Newton steps, a line each.
  [[nodiscard]] std::string history() const
  {
    std::size_t from = log_.size();
    for (int lines = 0; from > 0 && lines <= reported_steps; ++lines)
      from = log_.rfind('\n', from - 1) == std::string::npos ? 0 : log_.rfind('\n', from - 1);
    return fmt::format("{} Newton steps, the last of them:\n{}", history_.newton_steps,
                       log_.substr(from > 0 ? from + 1 : 0));
  }

private:
  /// Newton steps at one level until converged; false if they do not get there.
  bool stage(const Level& level, double tolerance, int longest_stall = steps_per_stage)
  {
    set_level(level);
    evaluate();
    double first = 0, best = 0;
    int stalled = 0, moved = 0;
    largest_move_ = height_;
    fewest_changes_ = std::numeric_limits<int>::max();
    since_fewest_ = 0;
    for (int step = 0; step < steps_per_stage + moved && moved < face_steps; ++step)
    {
      if (observer_.stop_requested())
        throw NotConverged("seepage: interrupted after " + history());
      const int changes = update_active_set();
      if (changes > 0)
        evaluate();
      const Totals now = totals();
      const double residual = now.imbalance / std::max(now.flow(), now.rounding);
      const std::string line = fmt::format(
          "  eps {:.3g} m, k_min {:.1e}, step {}: residual {:.2e}, q {:.6g} m2/s, {} changes "
          "of the seepage face",
          level.eps, level.k_min, step, residual, now.inflow, changes);
      log_ += line + '\n';
      observer_.detail(line);
      const bool nothing_flows = now.flow() <= now.rounding && now.imbalance <= now.rounding;
      if (step == 0)
        first = best = residual;
      stalled = changes > 0 || residual < 0.5 * best ? 0 : stalled + 1;
      best = std::min(best, residual);
      moved += patient_ && changes > 0 ? 1 : 0;
      const bool only_rounding_moves =
          residual < rounded_tolerance && largest_move_ < rounded_move * height_;
      const bool rounding_is_left = stalled >= strict_after && now.imbalance < now.rounding;
      const bool hides_flow = now.rounding > largest_rounding * now.flow();
      const bool small = now.imbalance < tolerance * now.flow() || nothing_flows ||
                         only_rounding_moves || (rounding_is_left && !hides_flow);
      if (small && changes == 0)
        return true;
      if (rounding_is_left && hides_flow && changes == 0)
        throw RoundingHidesFlow(failure());
      if (!(residual < divergence * std::max(first, 1.0)) ||
          (step >= steps_to_halve + moved && residual > 0.5 * std::max(first, nearly_there)))
        return false;
      if (stalled >= longest_stall || history_.newton_steps >= most_steps_)
        return false;
      newton_step(residual < strict_below || stalled >= strict_after ? 1 : growth_allowed);
      ++history_.newton_steps;
    }
    return false;
  }

  void activate(std::size_t i)
  {
    active_[i] = 1;
    fixed_[i] = 1;
    p_[i] = 0;
  }

  void set_level(const Level& level)
  {
    level_.assign(laws_.begin(), laws_.end());
    node_law_.assign(p_.size(), {.eps = 0, .k_min = 0, .fringe = 0, .tau = 1, .curve = {}});
    for (std::size_t t = 0; t < level_.size(); ++t)
    {
      RelativeConductivity& law = level_[t];
      law.eps = std::max(law.eps, level.eps);
      law.k_min = std::max(law.k_min, level.k_min);
      for (const Index node : mesh_.triangles[t])
      {
        RelativeConductivity& there = node_law_[static_cast<std::size_t>(node)];
        const double k_min = std::max(there.k_min, law.k_min);
        if (law.eps > there.eps)
          there = law;
        there.k_min = k_min;
      }
    }
    flow_.set_relative_conductivity(level_);
  }

  /// F: water that enters at the nodes beyond what is prescribed there.
  void evaluate()
  {
    flow_.residual(p_, F_);
    for (std::size_t i = 0; i < F_.size(); ++i)
      F_[i] -= conditions_.load[i];
  }

  /// Primal-dual active set, docs/theory.md eq. (2.8). An active node has p = 0; the outflow of
  /// another is a residual, not a flow, and counts as none: the scale of the pressure term drops
  /// out.
  int update_active_set()
  {
    // Far down a wet plain outflow falls below rounding: such a node stays active.
    const Totals now = totals();
    const double least =
        -(lost_outflow * now.flow() + now.rounding / static_cast<double>(p_.size()));
    std::vector<std::size_t> changing;
    for (std::size_t i = 0; i < p_.size(); ++i)
      if (conditions_.kind[i] == NodeKind::face && (active_[i] ? -F_[i] < least : p_[i] > 0))
        changing.push_back(i);
    const int changes = static_cast<int>(changing.size());
    since_fewest_ = changes < fewest_changes_ ? 0 : since_fewest_ + 1;
    fewest_changes_ = std::min(fewest_changes_, changes);
    if (patient_ && changes > 1 && since_fewest_ > block_changes)
      changing.resize(1);
    for (const std::size_t i : changing)
      if (active_[i])
        active_[i] = fixed_[i] = 0;
      else
        activate(i);
    history_.active_set_changes += static_cast<int>(changing.size());
    return static_cast<int>(changing.size());
  }

  [[nodiscard]] Totals totals() const
  {
    Totals t;
    for (std::size_t i = 0; i < F_.size(); ++i)
    {
      // Rain that runs off does not pass: what counts is the net of both.
      const double passes = (fixed_[i] ? F_[i] : 0) + conditions_.rain[i];
      const double prescribed = conditions_.load[i] - conditions_.rain[i];
      if (!fixed_[i])
        t.imbalance += std::abs(F_[i]);
      t.inflow += std::max(passes, 0.0) + std::max(prescribed, 0.0);
      t.outflow += std::max(-passes, 0.0) + std::max(-prescribed, 0.0);
    }
    // F sums products of conductivity and pressure head that cancel where the head is constant.
    for (std::size_t k = 0; k < mesh_.triangles.size(); ++k)
    {
      double highest = -std::numeric_limits<double>::infinity(), largest = 0;
      for (const Index node : mesh_.triangles[k])
      {
        const double p = p_[static_cast<std::size_t>(node)];
        highest = std::max(highest, p);
        largest = std::max(largest, std::abs(p));
      }
      t.rounding += std::numeric_limits<double>::epsilon() * conductivity_[k] * largest *
                    relative_conductivity(level_[k], highest, 1);
    }
    return t;
  }

  [[nodiscard]] double residual_norm() const
  {
    double sum = 0;
    for (std::size_t i = 0; i < F_.size(); ++i)
      if (!fixed_[i])
        sum += F_[i] * F_[i];
    return std::sqrt(sum);
  }

  /// p <- p - s J^-1 F with the largest s = 1, 1/2, ... that keeps |F| in bounds, the set held
  /// fixed.
  void newton_step(double growth)
  {
    const double before = residual_norm();
    flow_.correction(p_, fixed_, F_, correction_);
    const std::vector<double> p = p_;
    double s = 1;
    for (int halving = 0;; ++halving, s /= 2)
    {
      for (std::size_t i = 0; i < p_.size(); ++i)
        if (!fixed_[i])
          p_[i] = moved_pressure(node_law_[i], p[i], -s * correction_[i]);
      largest_move_ = 0;
      for (std::size_t i = 0; i < p_.size(); ++i)
        largest_move_ = std::max(largest_move_, std::abs(p_[i] - p[i]));
      evaluate();
      if (residual_norm() <= growth * before || halving == smallest_step_halvings)
        return;
    }
  }

  FlowOperator& flow_;
  const meshes::TriangleMesh& mesh_;
  const NodeConditions& conditions_;
  std::span<const RelativeConductivity> laws_; ///< of the answer
  std::span<const double> conductivity_;       ///< of each triangle [m/s]
  double height_;                              ///< [m]
  double largest_move_ = 0;                    ///< of a pressure head in the last step [m]
  bool patient_ = false;                       ///< with a seepage face that cycles
  int fewest_changes_ = 0;                     ///< of the seepage face in a step of this stage
  int since_fewest_ = 0;                       ///< steps without fewer
  std::vector<double> p_, F_, correction_;
  std::vector<RelativeConductivity> level_; ///< of the present level
  std::vector<RelativeConductivity>
      node_law_; ///< the same, of the largest eps and k_min around a node
  std::vector<std::uint8_t> active_, fixed_;
  int most_steps_ = 0;
  SolveHistory& history_;
  std::string log_;
  Observer& observer_;
};
} // namespace

Field solve_field(FlowOperator& flow, const meshes::TriangleMesh& mesh,
                  const NodeConditions& conditions, std::span<const RelativeConductivity> laws,
                  const Scales& scales, Start start, SolveHistory& history, Observer& observer)
{
  const Level end{.eps = std::ranges::min(laws, {}, &RelativeConductivity::eps).eps,
                  .k_min = std::ranges::min(laws, {}, &RelativeConductivity::k_min).k_min};
  Level level{.eps = std::max(start.smoothing, end.eps), .k_min = std::max(first_k_min, end.k_min)};
  const double way = std::log(level.eps / end.eps) + std::log(level.k_min / end.k_min) + 1e-12;
  const bool at_once = start.smoothing == 0;
  Iteration iteration(flow, mesh, conditions, laws, scales, std::move(start), history, observer);

  // eps first, then k_min, each in steps; the last one to the tolerance of the answer.
  bool good = at_once ? iteration.at_once(end) : iteration.start(level);
  for (bool last = at_once; good && !last;)
  {
    Level next = level;
    if (level.eps > end.eps)
      next.eps = std::max(stage_factor * level.eps, end.eps);
    else
      next.k_min = std::max(stage_factor_k_min * level.k_min, end.k_min);
    last = next.eps == end.eps && next.k_min == end.k_min;
    observer.progress(1 - (std::log(next.eps / end.eps) + std::log(next.k_min / end.k_min)) / way,
                      fmt::format("free surface smoothed over {:.3g} m", next.eps));
    good = iteration.advance(level, next, last ? final_tolerance : stage_tolerance, bisections);
    level = next;
  }
  if (!good)
    throw NotConverged(iteration.failure());
  if (at_once)
    observer.progress(1, "converged at the final smoothing");
  return iteration.finish();
}
} // namespace berm::seepage
