// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/limit_equilibrium.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace berm::coupling
{
namespace
{
struct Slice
{
  double alpha = 0;  ///< inclination of its base, positive where the base falls in the direction of
                     ///< sliding [rad]
  double length = 0; ///< of its base [m]
  double c = 0, tan_phi = 0;
  double u = 0;          ///< pore pressure on its base [Pa]
  double Ex = 0, Ey = 0; ///< weight and pool, x in the direction of sliding [N/m]
  bool held = false;     ///< its base lies outside the region in which the strength is reduced
};

/// What the strength on the base is divided by where that of the region is divided by F.
double divisor(const Slice& slice, double F)
{
  return slice.held ? std::min(F, 1.0) : F;
}

struct Slices
{
  std::vector<Slice> slice;
  double moment = 0; ///< of weight and pool about the centre, driving positive [N m/m]
  double radius = 0;
};

/// Levels of the ground at x: from the left and from the right (they differ at a vertical step).
double ground_beside(const meshes::Section& section, double x, double side)
{
  const double nudge = 1e-9 * (section.x_max - section.x_min);
  return meshes::ground_level(section, std::clamp(x + side * nudge, section.x_min, section.x_max));
}

/// Whether all soil is of one weight, wet or dry.
bool uniform_weight(const LimitEquilibriumModel& m)
{
  return m.section.zones.empty() &&
         std::ranges::all_of(m.soils, [&](const sph::Soil& soil)
                             { return soil.saturated_density == m.soils[0].density; });
}

/// Weight of a column of unit width [N/m2] between two levels.
double column_weight(const LimitEquilibriumModel& m, double x, double low, double high,
                     bool uniform)
{
  if (uniform)
    return m.soils[0].density * gravity * (high - low);
  if (m.weights != nullptr)
    return m.weights->between(x, low, high);
  constexpr int points = 40;
  std::vector<double> xs(points, x), ys(points);
  const double dy = (high - low) / points;
  for (int k = 0; k < points; ++k)
    ys[static_cast<std::size_t>(k)] = low + (k + 0.5) * dy;
  const std::vector<double> p_w = m.pore_pressure(xs, ys);
  double weight = 0;
  for (std::size_t k = 0; k < points; ++k)
  {
    const auto soil = static_cast<std::size_t>(meshes::soil_at(m.section, {x, ys[k]}));
    weight += (p_w[k] > 0 ? m.soils[soil].saturated_density : m.soils[soil].density) * gravity * dy;
  }
  return weight;
}

constexpr double shortest = 0.01; // arc over the section's width: a skin has none

using Ends = std::array<double, 2>;

/// Stretches of x over which the arc lies below the ground: each cuts off a mass of its own. Only
/// those whose ends lie below the centre; beyond, the arc would overhang.
std::vector<Ends> arc_stretches(const meshes::Section& section, const Vec2& centre, double radius)
{
  // f > 0 where the ground is inside the circle; look for its sign changes between kinks.
  const auto inside = [&](const Vec2& p) { return radius * radius - (p - centre).squaredNorm(); };
  const Polyline& g = section.ground;
  std::vector<Vec2> crossings; // from left to right
  for (std::size_t k = 1; k < g.size(); ++k)
  {
    const Vec2 d = g[k] - g[k - 1], from = g[k - 1] - centre;
    const double A = d.squaredNorm(), B = from.dot(d), C = -inside(g[k - 1]);
    const double discriminant = B * B - A * C;
    if (discriminant <= 0)
      continue;
    for (const double sign : {-1.0, 1.0})
    {
      const double t = (-B + sign * std::sqrt(discriminant)) / A;
      if (t >= 0 && t < 1)
        crossings.emplace_back(g[k - 1] + t * d);
    }
  }
  const double least = shortest * (section.x_max - section.x_min);
  std::vector<Ends> stretches;
  for (std::size_t k = 1; k < crossings.size(); ++k)
  {
    const Vec2 &a = crossings[k - 1], &b = crossings[k];
    const double middle = 0.5 * (a.x() + b.x());
    if (b.x() - a.x() > least && a.y() <= centre.y() && b.y() <= centre.y() &&
        inside({middle, meshes::ground_level(section, middle)}) > 0)
      stretches.push_back({a.x(), b.x()});
  }
  return stretches;
}

std::optional<Slices> cut(const LimitEquilibriumModel& m, const Vec2& centre, double radius,
                          double d, Ends ends, int count)
{
  const auto arc = [&](double x)
  {
    return centre.y() -
           std::sqrt(std::max(0.0, radius * radius - (x - centre.x()) * (x - centre.x())));
  };

  // Step 1: slice borders at the ends of the arc, at kinks of the ground, and evenly between.
  std::vector<double> borders = {ends[0], ends[1]};
  for (const Vec2& kink : m.section.ground)
    if (kink.x() > ends[0] && kink.x() < ends[1])
      borders.push_back(kink.x());
  for (int k = 1; k < count; ++k)
    borders.push_back(ends[0] + (ends[1] - ends[0]) * k / count);
  std::sort(borders.begin(), borders.end());
  const double least = 1e-9 * (ends[1] - ends[0]);
  borders.erase(std::unique(borders.begin(), borders.end(),
                            [least](double a, double b) { return b - a < least; }),
                borders.end());

  // Step 2: pressures, all at once: on slice bases, on the ground at both ends of every slice.
  std::vector<double> x, y;
  const std::size_t n = borders.size() - 1;
  for (std::size_t k = 0; k < n; ++k)
  {
    const double left = borders[k], right = borders[k + 1], middle = 0.5 * (left + right);
    if (arc(middle) < meshes::base_level(m.section, middle))
      return std::nullopt; // and the pore pressure is not known down there
    x.insert(x.end(), {middle, left, right});
    y.insert(y.end(),
             {arc(middle), ground_beside(m.section, left, 1), ground_beside(m.section, right, -1)});
  }
  std::vector<double> p = m.pore_pressure(x, y);
  // A pressure that is everywhere stresses nothing; left in, it would enter the forces between
  // slices, whose inclination Spencer's method supposes.
  double everywhere = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < n; ++k)
    everywhere = std::min({everywhere, p[3 * k + 1], p[3 * k + 2]});
  for (double& p_w : p)
    p_w -= everywhere;

  const bool uniform = uniform_weight(m);

  // Step 3: slices.
  Slices result;
  result.radius = radius;
  const auto load = [&](Slice* slice, double fx, double fy, double at_x, double at_y)
  {
    if (slice != nullptr)
    {
      slice->Ex += d * fx;
      slice->Ey += fy;
    }
    result.moment += d * ((at_x - centre.x()) * fy - (at_y - centre.y()) * fx);
  };
  for (std::size_t k = 0; k < n; ++k)
  {
    const double left = borders[k], right = borders[k + 1], b = right - left, xm = x[3 * k];
    const double foot = y[3 * k], g_left = y[3 * k + 1], g_right = y[3 * k + 2];
    const double high = 0.5 * (g_left + g_right);
    Slice slice;
    slice.alpha = std::asin(std::clamp(d * (centre.x() - xm) / radius, -1.0, 1.0));
    slice.length = b / std::cos(slice.alpha);
    const auto soil = static_cast<std::size_t>(meshes::soil_at(m.section, {xm, foot}));
    slice.c = m.soils[soil].cohesion;
    slice.tan_phi = std::tan(m.soils[soil].friction_angle);
    slice.u = p[3 * k];
    slice.held = m.region != nullptr && !m.region->contains({xm, foot});
    load(&slice, 0, -b * column_weight(m, xm, foot, std::max(high, foot), uniform), xm, high);
    // The pool's push on a straight piece of ground, its pressure linear: Simpson's rule is exact.
    const double p_left = p[3 * k + 1], p_right = p[3 * k + 2];
    const std::array<std::array<double, 3>, 3> simpson{
        {{p_left, left, g_left},
         {0.5 * (p_left + p_right), 0.5 * (left + right), high},
         {p_right, right, g_right}}};
    for (std::size_t s = 0; s < 3; ++s)
    {
      const double weight = (s == 1 ? 4 : 1) / 6.0, pressure = simpson[s][0];
      load(&slice, weight * pressure * (g_right - g_left), -weight * pressure * b, simpson[s][1],
           simpson[s][2]);
    }
    result.slice.push_back(slice);
    // A vertical face at the right border of this slice.
    if (k + 1 < n)
    {
      const double next_left = y[3 * (k + 1) + 1], p_next = p[3 * (k + 1) + 1];
      if (next_left != g_right)
      {
        const double push = 0.5 * (p_right + p_next) * (next_left - g_right);
        load(&result.slice.back(), push, 0, right, 0.5 * (g_right + next_left));
      }
    }
  }
  if (result.moment <= 0)
    return std::nullopt;
  return result;
}

/// Bishop's simplified method: N' from vertical equilibrium, F from moments. eq. (10.3)
std::optional<double> bishop(const Slices& s)
{
  double F = 1.5;
  for (int k = 0; k < 200; ++k)
  {
    double reduced = 0, held = 0; // strength on the bases, the latter at its full value
    for (const Slice& i : s.slice)
    {
      const double F_i = divisor(i, F);
      const double m_alpha = std::cos(i.alpha) + std::sin(i.alpha) * i.tan_phi / F_i;
      if (m_alpha < 0.2)
        return std::nullopt;
      const double N =
          (-i.Ey - i.u * i.length * std::cos(i.alpha) - i.c * i.length * std::sin(i.alpha) / F_i) /
          m_alpha;
      (i.held && F >= 1 ? held : reduced) += i.c * i.length + N * i.tan_phi;
    }
    const double next = reduced * s.radius / (s.moment - held * s.radius);
    if (!(next > 1e-3) || !std::isfinite(next))
      return std::nullopt;
    if (std::abs(next - F) < 1e-9 * F)
      return next;
    F = next;
  }
  return std::nullopt;
}

/// Sums over the slices for Spencer's method: of the interslice resultants Q, and of base shear S.
struct SpencerSums
{
  double Q = 0, S = 0;
};

SpencerSums spencer_sums(const Slices& s, double F, double theta)
{
  SpencerSums sums;
  for (const Slice& i : s.slice)
  {
    // t along the base in the direction of sliding, n away from the base, q along the resultant.
    const double ca = std::cos(i.alpha), sa = std::sin(i.alpha);
    const double E_t = i.Ex * ca - i.Ey * sa, E_n = i.Ex * sa + i.Ey * ca;
    const double q_t = std::cos(i.alpha - theta), q_n = std::sin(i.alpha - theta);
    const double F_i = divisor(i, F);
    const double Q = ((i.c * i.length - (E_n + i.u * i.length) * i.tan_phi) / F_i - E_t) /
                     (q_t + q_n * i.tan_phi / F_i);
    const double N = -E_n - Q * q_n - i.u * i.length;
    sums.Q += Q;
    sums.S += (i.c * i.length + N * i.tan_phi) / F_i;
  }
  return sums;
}

/// Root of f near x by the secant method; nothing if it strays or does not converge.
template <class Function>
std::optional<double> secant(Function&& f, double x0, double x1, double low, double high)
{
  double f0 = f(x0), f1 = f(x1);
  for (int k = 0; k < 60; ++k)
  {
    if (!std::isfinite(f1) || f1 == f0)
      return std::nullopt;
    const double x2 = std::clamp(x1 - f1 * (x1 - x0) / (f1 - f0), low, high);
    if (std::abs(x2 - x1) < 1e-10 * std::max(1.0, std::abs(x1)))
      return x2;
    x0 = x1;
    f0 = f1;
    x1 = x2;
    f1 = f(x1);
  }
  return std::nullopt;
}

/// Spencer's method: one inclination theta of all interslice forces that balances forces and
/// moments.
std::optional<double> spencer(const Slices& s, double start)
{
  const auto by_force = [&](double theta)
  {
    return secant([&](double F) { return spencer_sums(s, F, theta).Q; }, start, 1.01 * start,
                  0.2 * start, 5 * start);
  };
  double force = 0;
  for (const Slice& i : s.slice)
    force += std::abs(i.Ey);
  const auto imbalance = [&](double theta)
  {
    const auto F = by_force(theta);
    return F ? (spencer_sums(s, *F, theta).S * s.radius - s.moment) / (force * s.radius)
             : std::numeric_limits<double>::quiet_NaN();
  };
  const auto theta = secant(imbalance, -0.1, -0.2, -1.2, 1.2);
  if (!theta || std::abs(imbalance(*theta)) > 1e-7)
    return std::nullopt;
  return by_force(*theta);
}

/// An arc by the points of the ground that it joins and its sagitta over half its chord.
struct Arc
{
  double x_left, x_right, bulge;
};

struct CircleShape
{
  Vec2 centre;
  double radius;
  double depth; ///< largest distance below the chord [m]
};

CircleShape shape(const meshes::Section& section, const Arc& arc)
{
  const Vec2 a{arc.x_left, meshes::ground_level(section, arc.x_left)};
  const Vec2 b{arc.x_right, meshes::ground_level(section, arc.x_right)};
  const Vec2 chord = b - a;
  const double half = 0.5 * chord.norm(), sagitta = arc.bulge * half;
  const double radius = (half * half + sagitta * sagitta) / (2 * sagitta);
  const Vec2 up = Vec2{-chord.y(), chord.x()} / (2 * half);
  return {0.5 * (a + b) + (radius - sagitta) * up, radius, sagitta};
}

/// Bishop's factor of an arc; infinite if it is not admissible.
double factor_of(const LimitEquilibriumModel& m, const Arc& arc, bool moves_right, double min_depth,
                 int slices)
{
  constexpr double none = std::numeric_limits<double>::infinity();
  if (arc.x_left < m.section.x_min || arc.x_right > m.section.x_max || arc.bulge < 0.02 ||
      arc.bulge > 1 || arc.x_right - arc.x_left < shortest * (m.section.x_max - m.section.x_min))
    return none;
  const CircleShape c = shape(m.section, arc);
  if (c.depth < min_depth)
    return none;
  double least = none;
  for (const Ends& ends : arc_stretches(m.section, c.centre, c.radius))
    if (const auto s = cut(m, c.centre, c.radius, moves_right ? 1.0 : -1.0, ends, slices))
      least = std::min(least, bishop(*s).value_or(none));
  return least;
}
} // namespace

std::optional<SlipCircle> evaluate_circle(const LimitEquilibriumModel& model, const Vec2& centre,
                                          double radius, bool moves_right, int slices)
{
  std::optional<SlipCircle> weakest;
  for (const Ends& ends : arc_stretches(model.section, centre, radius))
  {
    const auto s = cut(model, centre, radius, moves_right ? 1.0 : -1.0, ends, slices);
    const auto F = s ? bishop(*s) : std::nullopt;
    if (F && (!weakest || *F < weakest->bishop))
      weakest = SlipCircle{.centre = centre,
                           .radius = radius,
                           .x_left = ends[0],
                           .x_right = ends[1],
                           .moves_right = moves_right,
                           .bishop = *F,
                           .spencer = spencer(*s, *F)};
  }
  return weakest;
}

std::optional<SlipCircle> critical_circle(const LimitEquilibriumModel& exact, bool moves_right,
                                          double min_depth)
{
  std::optional<ColumnWeights> table;
  LimitEquilibriumModel model = exact;
  if (!uniform_weight(exact))
    model.weights = &table.emplace(exact.section, exact.soils, exact.pore_pressure);
  struct Candidate
  {
    Arc arc;
    double F;
  };

  // Step 1: every pair of points of the ground, with a few sagittas.
  constexpr int points = 40, coarse_slices = 16, fine_slices = 60;
  const double x_min = model.section.x_min, width = model.section.x_max - x_min;
  std::vector<Candidate> best;
  for (int a = 0; a < points; ++a)
    for (int b = a + 2; b <= points; ++b)
      for (const double bulge : {0.08, 0.15, 0.25, 0.4, 0.6, 0.85})
      {
        // Off the ends of the section by a little, so that both ends of the arc lie on the ground.
        const Arc arc{x_min + width * (a + 0.01) / points, x_min + width * (b - 0.01) / points,
                      bulge};
        const double F = factor_of(model, arc, moves_right, min_depth, coarse_slices);
        if (std::isfinite(F))
          best.push_back({arc, F});
      }
  std::sort(best.begin(), best.end(),
            [](const Candidate& a, const Candidate& b) { return a.F < b.F; });
  if (best.size() > 8)
    best.resize(8);

  // Step 2: from each of the best, steps along the three parameters that shrink when none helps.
  const Candidate* critical = nullptr;
  for (Candidate& c : best)
  {
    c.F = factor_of(model, c.arc, moves_right, min_depth, fine_slices);
    std::array<double, 3> step = {width / points, width / points, 0.1};
    while (step[0] > 1e-4 * width)
    {
      bool improved = false;
      // All 26 directions: a circle that touches the base can only move along it.
      for (int direction = 0; direction < 27; ++direction)
      {
        const int left = direction % 3 - 1, right = direction / 3 % 3 - 1,
                  bulge = direction / 9 - 1;
        const Arc tried = {c.arc.x_left + left * step[0], c.arc.x_right + right * step[1],
                           c.arc.bulge + bulge * step[2]};
        const double F = factor_of(model, tried, moves_right, min_depth, fine_slices);
        if (F < c.F)
        {
          c = {tried, F};
          improved = true;
        }
      }
      if (!improved)
        for (double& s : step)
          s *= 0.5;
    }
    if (critical == nullptr || c.F < critical->F)
      critical = &c;
  }
  if (critical == nullptr || !std::isfinite(critical->F))
    return std::nullopt;
  const CircleShape c = shape(model.section, critical->arc);
  return evaluate_circle(exact, c.centre, c.radius, moves_right, fine_slices);
}
} // namespace berm::coupling
