// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/finite_elements.h"

#include "coupling/pore_pressure.h"
#include "meshes/section.h"
#include "sph/drucker_prager.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace berm::tests
{
struct ElementSlope::Motion
{
  std::vector<double> vx, vy, fx, fy;
  std::vector<Stress> stress;

  Motion(std::size_t nodes, std::vector<Stress> start)
      : vx(nodes, 0.0), vy(nodes, 0.0), fx(nodes), fy(nodes), stress(std::move(start))
  {
  }
};

namespace
{
constexpr double share = 0.5; // of each of the two pairs of triangles that cover an element
constexpr double dt = 0.9;    // in units of the critical step, which the masses make 1

/// Abscissas with a node at every corner of the ground.
std::vector<double> columns_of(const Polyline& ground, double size)
{
  std::vector<double> x = {ground.front().x()};
  for (std::size_t i = 0; i + 1 < ground.size(); ++i)
  {
    const double length = ground[i + 1].x() - ground[i].x();
    const auto parts = std::max(1L, std::lround(length / size));
    for (long k = 1; k <= parts; ++k)
      x.push_back(ground[i].x() + length * static_cast<double>(k) / static_cast<double>(parts));
  }
  return x;
}

double height_at(const Polyline& line, double x)
{
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    if (x <= line[i + 1].x())
      return line[i].y() +
             (line[i + 1].y() - line[i].y()) * (x - line[i].x()) / (line[i + 1].x() - line[i].x());
  return line.back().y();
}
} // namespace

ElementSlope::ElementSlope(const coupling::Case& input, double size)
{
  const sph::Soil& soil = input.soils.front().mechanical;
  const sph::Elastic e = sph::elastic_moduli(soil.young_modulus, soil.poisson_ratio);
  K_ = e.K;
  G_ = e.G;
  c_ = soil.cohesion;
  phi_ = soil.friction_angle;

  const Polyline& ground = input.section.ground;
  const double base = input.section.base.front().y();
  double top = base;
  for (const Vec2& p : ground)
    top = std::max(top, p.y());
  rows_ = static_cast<std::size_t>(std::lround((top - base) / size));
  const std::vector<double> columns = columns_of(ground, size);
  columns_ = columns.size() - 1;
  const double least = 0.04 * size; // where the ground meets the base
  for (const double x : columns)
    for (std::size_t j = 0; j <= rows_; ++j)
    {
      const double height = std::max(height_at(ground, x) - base, least);
      x_.push_back(x);
      y_.push_back(base + height * static_cast<double>(j) / static_cast<double>(rows_));
    }
  for (std::size_t i = 0; i < columns_; ++i)
    for (std::size_t j = 0; j < rows_; ++j)
    {
      const std::size_t a = i * (rows_ + 1) + j, b = a + rows_ + 1, c = b + 1, d = a + 1;
      for (const Triangle& t :
           {triangle(a, b, d), triangle(b, c, d), triangle(a, b, c), triangle(a, c, d)})
        triangles_.push_back(t);
    }
  const double gamma = soil.density * gravity;
  d_ref_ = gamma * (top - base) * (top - base) / soil.young_modulus;
  add_loads(input, gamma);
  add_masses();

  // Elastic equilibrium, from which every trial starts.
  Motion motion(x_.size(), std::vector<Stress>(triangles_.size()));
  for (int k = 0; k < 4000; ++k)
    for (std::size_t j = 0; j < rows_; ++j)
    {
      step(motion, 0, 0, true);
      if (k > 20 && j == 0 && measure(motion) < 1e-5)
      {
        elastic_ = motion.stress;
        return;
      }
    }
  throw std::runtime_error("finite elements: no elastic equilibrium");
}

ElementSlope::Triangle ElementSlope::triangle(std::size_t a, std::size_t b, std::size_t c) const
{
  Triangle t{.node = {a, b, c}, .bx = {}, .by = {}, .area = 0};
  const double twice = (x_[b] - x_[a]) * (y_[c] - y_[a]) - (x_[c] - x_[a]) * (y_[b] - y_[a]);
  t.area = 0.5 * twice;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const std::size_t p = t.node[(k + 1) % 3], q = t.node[(k + 2) % 3];
    t.bx[k] = (y_[p] - y_[q]) / twice;
    t.by[k] = (x_[q] - x_[p]) / twice;
  }
  return t;
}

void ElementSlope::add_loads(const coupling::Case& input, double gamma)
{
  fx_.assign(x_.size(), 0.0);
  fy_.assign(x_.size(), 0.0);
  std::vector<double> p_w(x_.size(), 0.0);
  if (!input.water.free_surface.empty())
    p_w = coupling::hydrostatic_pore_pressure(input.water.free_surface)(x_, y_);
  for (const Triangle& t : triangles_)
  {
    const double p = (p_w[t.node[0]] + p_w[t.node[1]] + p_w[t.node[2]]) / 3;
    for (std::size_t k = 0; k < 3; ++k)
    {
      fx_[t.node[k]] += share * t.area * p * t.bx[k];
      fy_[t.node[k]] += share * t.area * (p * t.by[k] - gamma / 3);
    }
  }
  for (std::size_t i = 0; i < columns_; ++i) // a pool presses on the ground
  {
    const std::size_t a = i * (rows_ + 1) + rows_, b = a + rows_ + 1;
    const double ex = x_[b] - x_[a], ey = y_[b] - y_[a];
    const double at_a = (2 * p_w[a] + p_w[b]) / 6, at_b = (p_w[a] + 2 * p_w[b]) / 6;
    fx_[a] += at_a * ey;
    fy_[a] -= at_a * ex;
    fx_[b] += at_b * ey;
    fy_[b] -= at_b * ex;
  }
}

void ElementSlope::add_masses()
{
  mass_.assign(x_.size(), 0.0);
  for (const Triangle& t : triangles_)
  {
    double longest2 = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::size_t p = t.node[k], q = t.node[(k + 1) % 3];
      longest2 =
          std::max(longest2, (x_[p] - x_[q]) * (x_[p] - x_[q]) + (y_[p] - y_[q]) * (y_[p] - y_[q]));
    }
    for (const std::size_t n : t.node)
      mass_[n] += share * (K_ + 4 * G_ / 3) * longest2 / (6 * t.area);
  }
}

void ElementSlope::step(Motion& m, double c, double phi, bool elastic) const
{
  const double sin_phi = std::sin(phi), k = c * std::cos(phi);
  m.fx = fx_;
  m.fy = fy_;
  for (std::size_t pair = 0; pair < triangles_.size(); pair += 2)
  {
    std::array<std::array<double, 3>, 2> rate{}; // xx, yy, xy
    for (std::size_t e = 0; e < 2; ++e)
      for (std::size_t n = 0; n < 3; ++n)
      {
        const Triangle& t = triangles_[pair + e];
        const double vx = m.vx[t.node[n]], vy = m.vy[t.node[n]];
        rate[e][0] += t.bx[n] * vx;
        rate[e][1] += t.by[n] * vy;
        rate[e][2] += 0.5 * (t.by[n] * vx + t.bx[n] * vy);
      }
    const double A0 = triangles_[pair].area, A1 = triangles_[pair + 1].area;
    const double volume =
        (A0 * (rate[0][0] + rate[0][1]) + A1 * (rate[1][0] + rate[1][1])) / (A0 + A1);
    for (std::size_t e = 0; e < 2; ++e)
    {
      const Triangle& t = triangles_[pair + e];
      Stress& s = m.stress[pair + e];
      const double shift = 0.5 * (volume - rate[e][0] - rate[e][1]);
      const double mean_part = (K_ - 2 * G_ / 3) * volume * dt;
      s.xx += mean_part + 2 * G_ * dt * (rate[e][0] + shift);
      s.yy += mean_part + 2 * G_ * dt * (rate[e][1] + shift);
      s.xy += 2 * G_ * dt * rate[e][2];
      const double p = 0.5 * (s.xx + s.yy), half = 0.5 * (s.xx - s.yy),
                   radius = std::hypot(half, s.xy);
      if (const double strength = k - sin_phi * p; !elastic && radius > strength)
      {
        const double part = std::max(strength, 0.0) / radius;
        const double mean = strength < 0 ? k / sin_phi : p; // the apex
        s = {mean + part * half, mean - part * half, part * s.xy};
      }
      for (std::size_t n = 0; n < 3; ++n)
      {
        m.fx[t.node[n]] -= share * t.area * (s.xx * t.bx[n] + s.xy * t.by[n]);
        m.fy[t.node[n]] -= share * t.area * (s.xy * t.bx[n] + s.yy * t.by[n]);
      }
    }
  }
  constexpr double damping = 0.8;
  const auto sign = [](double v) { return static_cast<double>((v > 0) - (v < 0)); };
  for (std::size_t i = 0; i <= columns_; ++i)
    for (std::size_t j = 1; j <= rows_; ++j) // the base does not move
    {
      const std::size_t n = i * (rows_ + 1) + j;
      const double fx = i == 0 || i == columns_ ? 0 : m.fx[n], fy = m.fy[n];
      m.vx[n] += dt * (fx - damping * std::abs(fx) * sign(m.vx[n])) / mass_[n];
      m.vy[n] += dt * (fy - damping * std::abs(fy) * sign(m.vy[n])) / mass_[n];
    }
}

/// Root mean square of the way in the time of a wave over ten heights, in units of d_ref.
double ElementSlope::measure(const Motion& m) const
{
  double sum = 0;
  for (std::size_t n = 0; n < x_.size(); ++n)
    sum += m.vx[n] * m.vx[n] + m.vy[n] * m.vy[n];
  return std::sqrt(sum / static_cast<double>(x_.size())) * 10 * static_cast<double>(rows_) / d_ref_;
}

sph::Outcome ElementSlope::trial(double factor) const
{
  // Windows of a wave over five heights. At rest: a fifth of the motion that counts for particles.
  constexpr double at_rest = 2e-4, moving = 2e-3, growth = 1.1;
  constexpr int rings_out = 20, longest = 4000;
  Motion motion(x_.size(), elastic_);
  double smallest = HUGE_VAL;
  for (int window = 1; window <= longest; ++window)
  {
    for (std::size_t k = 0; k < 5 * rows_; ++k)
      step(motion, c_ / factor, std::atan(std::tan(phi_) / factor), false);
    const double s = measure(motion);
    if (s < at_rest && window > 4)
      return sph::Outcome::stands;
    if (window < rings_out)
      continue;
    smallest = std::min(smallest, s);
    if (s > moving && s > growth * smallest)
      return sph::Outcome::fails;
  }
  return sph::Outcome::undecided;
}

sph::FactorOfSafety ElementSlope::factor(double tolerance) const
{
  const auto run = [this](double factor, Observer&)
  {
    sph::Trial t;
    t.factor = factor;
    t.outcome = trial(factor);
    return t;
  };
  Observer silent;
  return sph::reduce_strength(run, {.lower = 0.7, .upper = 2.7, .tolerance = tolerance}, silent);
}
} // namespace berm::tests
