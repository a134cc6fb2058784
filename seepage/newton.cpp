// SPDX-License-Identifier: GPL-2.0-or-later
#include "seepage/newton.h"

#include "core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace berm::seepage
{
namespace
{
constexpr double final_tolerance = 1e-8; ///< |F_free| / q_in of the answer [-]
constexpr double stage_tolerance = 1e-3; ///< the same in an intermediate stage
constexpr double rounding = 1e-13;  ///< flows below this share of the flow scale are rounding [-]
constexpr int steps_per_stage = 60; ///< Newton steps before a stage counts as failed
constexpr int smallest_step_halvings = 6; ///< backtracking stops at 2^-6
constexpr double stage_factor = 0.25;     ///< of eps from stage to stage, larger after a failed one
constexpr double largest_stage_factor = 0.9;

struct Totals
{
  double inflow = 0, outflow = 0; ///< through nodes with a condition, and prescribed
  double imbalance = 0;           ///< sum of |F| over the free nodes
};

class Iteration
{
public:
  Iteration(FlowOperator& flow, const NodeConditions& conditions, std::span<const double> eps_final,
            double flow_scale, Start start, Observer& observer)
      : flow_(flow), conditions_(conditions), eps_final_(eps_final),
        flow_floor_(rounding * flow_scale), p_(std::move(start.p)), active_(p_.size(), 0),
        fixed_(p_.size(), 0), observer_(observer)
  {
    for (std::size_t i = 0; i < p_.size(); ++i)
    {
      if (conditions_.kind[i] == NodeKind::head)
        p_[i] = conditions_.pressure_head[i];
      if (conditions_.kind[i] == NodeKind::face && p_[i] >= 0)
        activate(i);
      fixed_[i] = conditions_.kind[i] == NodeKind::head || active_[i];
    }
  }

  /// Newton steps at one smoothing until converged; false if they do not get there.
  bool stage(double eps, double tolerance)
  {
    set_smoothing(eps);
    evaluate();
    for (int step = 0; step < steps_per_stage; ++step)
    {
      if (observer_.stop_requested())
        throw NotConverged("seepage: interrupted\n" + log_);
      const int changes = update_active_set();
      if (changes > 0)
        evaluate();
      const Totals now = totals();
      const double flow = std::max(now.inflow, now.outflow);
      if (!std::isfinite(now.imbalance))
        return false;
      log_ += fmt::format(
          "  eps {:.3g} m, step {}: residual {:.2e}, q {:.6g}, {} changes of the face\n", eps, step,
          now.imbalance / std::max(flow, flow_floor_), now.inflow, changes);
      const bool small = now.imbalance < std::max(tolerance * flow, flow_floor_);
      if (small && changes == 0)
        return true;
      newton_step(changes > 0);
      ++history_.newton_steps;
    }
    return false;
  }

  [[nodiscard]] const std::vector<double>& p() const { return p_; }
  [[nodiscard]] const std::string& log() const { return log_; }

  /// Back to an earlier pressure; the active set follows from it.
  void restore(const std::vector<double>& p, const std::vector<std::uint8_t>& active)
  {
    p_ = p;
    active_ = active;
    for (std::size_t i = 0; i < p_.size(); ++i)
      fixed_[i] = conditions_.kind[i] == NodeKind::head || active_[i];
  }
  [[nodiscard]] const std::vector<std::uint8_t>& active() const { return active_; }

  Field finish()
  {
    const Totals now = totals();
    const double flow = std::max(now.inflow, now.outflow);
    history_.unknowns = static_cast<Index>(p_.size());
    history_.residual = flow > flow_floor_ ? now.imbalance / flow : 0;
    history_.discharge = now.inflow;
    Field field{.p = p_,
                .entering = F_,
                .active = active_,
                .inflow = now.inflow,
                .outflow = now.outflow,
                .history = history_};
    for (std::size_t i = 0; i < p_.size(); ++i)
      field.entering[i] += conditions_.load[i];
    return field;
  }

private:
  void activate(std::size_t i)
  {
    active_[i] = 1;
    fixed_[i] = 1;
    p_[i] = 0;
  }

  void set_smoothing(double eps)
  {
    eps_.assign(eps_final_.begin(), eps_final_.end());
    for (double& e : eps_)
      e = std::max(e, eps);
    flow_.set_smoothing(eps_);
  }

  /// F: water that enters at the nodes beyond what is prescribed there.
  void evaluate()
  {
    flow_.residual(p_, F_);
    for (std::size_t i = 0; i < F_.size(); ++i)
      F_[i] -= conditions_.load[i];
  }

  /// Primal-dual active set, docs/theory.md eq. (2.7). At an active node p = 0, at another the
  /// outflow is not defined before convergence and counts as none: the scale of the pressure term
  /// drops out.
  int update_active_set()
  {
    int changes = 0;
    for (std::size_t i = 0; i < p_.size(); ++i)
    {
      if (conditions_.kind[i] != NodeKind::face)
        continue;
      const double outflow = -F_[i];
      if (active_[i] && outflow < 0)
      {
        active_[i] = 0;
        fixed_[i] = 0;
        ++changes;
      }
      else if (!active_[i] && p_[i] > 0)
      {
        activate(i);
        ++changes;
      }
    }
    history_.active_set_changes += changes;
    return changes;
  }

  [[nodiscard]] Totals totals() const
  {
    Totals t;
    for (std::size_t i = 0; i < F_.size(); ++i)
    {
      const double reaction = fixed_[i] ? F_[i] : 0;
      if (!fixed_[i])
        t.imbalance += std::abs(F_[i]);
      t.inflow += std::max(reaction, 0.0) + std::max(conditions_.load[i], 0.0);
      t.outflow += std::max(-reaction, 0.0) + std::max(-conditions_.load[i], 0.0);
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

  /// p <- p - s J^-1 F with the largest s = 1, 1/2, ... that lowers |F|; s = 1 if the set just
  /// changed, for |F| before and after are then not of the same problem.
  void newton_step(bool set_changed)
  {
    const double before = residual_norm();
    flow_.correction(p_, fixed_, F_, d_);
    const std::vector<double> p_old = p_;
    double s = 1;
    for (int halving = 0;; ++halving, s /= 2)
    {
      for (std::size_t i = 0; i < p_.size(); ++i)
        p_[i] = p_old[i] - s * d_[i];
      evaluate();
      if (set_changed || residual_norm() <= (1 - 1e-4 * s) * before ||
          halving == smallest_step_halvings)
        return;
    }
  }

  FlowOperator& flow_;
  const NodeConditions& conditions_;
  std::span<const double> eps_final_;
  double flow_floor_;
  std::vector<double> p_, F_, d_, eps_;
  std::vector<std::uint8_t> active_, fixed_;
  SolveHistory history_;
  std::string log_;
  Observer& observer_;
};
} // namespace

Field solve_field(FlowOperator& flow, const NodeConditions& conditions,
                  std::span<const double> eps_final, double flow_scale, Start start,
                  Observer& observer)
{
  const double eps_end = *std::ranges::min_element(eps_final);
  const double eps_start = std::max(start.smoothing, eps_end);
  Iteration iteration(flow, conditions, eps_final, flow_scale, std::move(start), observer);

  // From eps_start down to eps_end. A stage that fails is tried again closer to the last good one.
  double good = eps_start, eps = eps_start, factor = stage_factor;
  bool any_good = false;
  std::vector<double> good_p = iteration.p();
  std::vector<std::uint8_t> good_active = iteration.active();
  for (;;)
  {
    const bool last = eps <= eps_end;
    observer.progress(std::log(eps_start / eps) / std::max(std::log(eps_start / eps_end), 1e-12),
                      fmt::format("smoothing {:.3g} m", eps));
    if (iteration.stage(eps, last ? final_tolerance : stage_tolerance))
    {
      if (last)
        return iteration.finish();
      any_good = true;
      good = eps;
      good_p = iteration.p();
      good_active = iteration.active();
    }
    else
    {
      factor = any_good ? std::sqrt(factor) : 2 * factor;
      if (!any_good || factor > largest_stage_factor)
        throw NotConverged("seepage: the Newton iteration did not converge; its history:\n" +
                           iteration.log());
      iteration.restore(good_p, good_active);
    }
    eps = std::max(factor * good, eps_end);
  }
}
} // namespace berm::seepage
