// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/updated_lagrangian.h"

#include "core/error.h"
#include "core/stopwatch.h"
#include "sph/bounded_inverse.h"
#include "sph/kernel.h"
#include "sph/scales.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <utility>

namespace berm::sph
{
namespace
{
constexpr double smoothing_ratio = 1.2;   // h / dx
constexpr double skin_ratio = 0.25;       // of the Verlet list, over h
constexpr double longest_way_ratio = 0.5; // over h: after it the list is made again
constexpr double pushed_way_ratio = 0.1; // over h: after it the pore pressure's push is taken again
constexpr double least_slack = 0.25;     // over the skin: with less, another look does not pay
constexpr long rebuilds_between_sorts = 5;
} // namespace

UpdatedLagrangianSettings paper_settings()
{
  return {.gradient_correction = false,
          .pressure_correction = false,
          .artificial_stress = true,
          .viscosity_both_ways = false,
          .geostatic_base = false,
          .local_damping = 0.8,
          .courant_number = 0.8};
}

MovingBody moving_body(const Particles& particles, std::span<const Soil> soils,
                       std::vector<double> p_w, const meshes::Section& section,
                       const UpdatedLagrangianSettings& settings)
{
  MovingBody body;
  body.particles = particles;
  for (const Soil& soil : soils)
    body.elastic.push_back(elastic_moduli(soil.young_modulus, soil.poisson_ratio));
  body.pore_pressure = std::move(p_w);
  body.walls = moving_walls(section);
  body.settings = settings;
  const Scales scales = body_scales(particles, soils, section.y_max - section.y_min);
  body.T0 = scales.T0;
  body.d_ref = scales.d_ref;
  return body;
}

UpdatedLagrangian::UpdatedLagrangian(const MovingBody& body, std::vector<Cone> cones,
                                     const State& start, double time_step)
    : body_(body), set_(body.settings), cones_(std::move(cones)),
      n_(static_cast<Index>(body.particles.size())), h_(smoothing_ratio * body.particles.spacing),
      skin_(skin_ratio * h_), table_(h_, body.particles.spacing), self_(body.particles.size()),
      point_(body.particles.size())
{
  const Particles& particles = body.particles;
  double c_most = 0;
  for (std::size_t i = 0; i < self_.size(); ++i)
  {
    const double density = start.density.empty() ? particles.density[i] : start.density[i];
    const double x = start.x.empty() ? particles.x[i] + start.ux[i] : start.x[i];
    const double y = start.y.empty() ? particles.y[i] + start.uy[i] : start.y[i];
    const Elastic& e = body.elastic[static_cast<std::size_t>(particles.soil[i])];
    const double c = std::sqrt(e.M() / particles.density[i]);
    const double mass = particles.volume[i] * particles.density[i];
    c_most = std::max(c_most, c);
    point_[i] = {.motion = Lanes{x, y, start.vx[i], start.vy[i]},
                 .matter = Lanes{mass, density, 1 / density, c}};
    Self& self = self_[i];
    self.sig = start.stress[i];
    self.plastic_strain = start.plastic_strain[i];
    self.density = density;
    self.x_start = x - start.ux[i];
    self.y_start = y - start.uy[i];
    self.p_w = body.pore_pressure.empty() ? 0 : body.pore_pressure[i];
    self.original = static_cast<Index>(i);
    self.soil = particles.soil[i];
  }
  for (std::size_t k = 1; k < body.walls.base.size(); ++k)
  {
    const Vec2 edge = body.walls.base[k] - body.walls.base[k - 1];
    stretch_ = std::max(stretch_, 1 + 2 * std::abs(edge.y() / edge.x()));
  }
  dt_ = dt_before_ =
      time_step > 0 ? time_step : set_.courant_number * h_ / (c_most * (1 + 1.2 * set_.alpha));
  rebuild();
}

void UpdatedLagrangian::sort_particles()
{
  std::vector<double> x, y;
  for (std::size_t i = 0; i < self_.size(); ++i)
  {
    x.push_back(point_[i].motion[0]);
    y.push_back(point_[i].motion[1]);
  }
  std::vector<Self> self;
  std::vector<Point> point;
  self.reserve(self_.size());
  point.reserve(point_.size());
  for (const Index i : order_by_cell(x, y, 2 * h_ + skin_))
  {
    self.push_back(self_[static_cast<std::size_t>(i)]);
    point.push_back(point_[static_cast<std::size_t>(i)]);
  }
  self_.swap(self);
  point_.swap(point);
}

void UpdatedLagrangian::read_positions()
{
  x_.resize(point_.size());
  y_.resize(point_.size());
  for (std::size_t i = 0; i < x_.size(); ++i)
  {
    x_[i] = point_[i].motion[0];
    y_[i] = point_[i].motion[1];
  }
}

void UpdatedLagrangian::make_ghosts(double reach)
{
  const auto n = self_.size();
  read_positions();
  ghost_ = moving_ghosts(body_.walls, x_, y_, reach);
  ghost_begin_.assign(n + 1, 0);
  for (const MovingGhost& g : ghost_)
    ++ghost_begin_[static_cast<std::size_t>(g.source) + 1];
  for (std::size_t i = 0; i < n; ++i)
    ghost_begin_[i + 1] += ghost_begin_[i];

  point_.resize(n + ghost_.size());
  force_.resize(n + ghost_.size());
  repels_.resize(n + ghost_.size());
  for (std::size_t i = 0; i < n; ++i)
    store_ghost_motion(i);
}

double UpdatedLagrangian::longest_way() const
{
  return std::min(longest_way_ratio * h_, 1.2 * h_ / stretch_);
}

bool UpdatedLagrangian::push_holds() const
{
  const bool wet = body_.reread_pressure || !body_.pore_pressure.empty();
  return !wet || way_ - way_pushed_ <= pushed_way_ratio * h_;
}

bool UpdatedLagrangian::list_holds()
{
  // Whatever moves, two points come nearer by at most twice the longest way. When that no longer
  // says enough, the boxes of the cells are looked at.
  if (2 * stretch_ * (way_ - way_checked_) <= slack_)
    return true;
  const Stopwatch watch;
  read_positions();
  slack_ = std::min(skin_ - list_.closing(x_, y_), 2 * stretch_ * (longest_way() - way_));
  way_checked_ = way_;
  search_seconds_ += watch.elapsed().cpu;
  return slack_ > least_slack * skin_;
}

void UpdatedLagrangian::rebuild()
{
  const Stopwatch watch;
  check_finite();
  const auto n = self_.size();
  point_.resize(n);
  if (rebuilds_ % rebuilds_between_sorts == 0)
    sort_particles();
  make_ghosts(stretch_ * (2 * h_ + longest_way()));
  read_positions();
  list_.build(x_, y_, n_, 2 * h_ + skin_);
  for (std::size_t i = 0; i < n; ++i)
  {
    self_[i].x_list = x_[i];
    self_[i].y_list = y_[i];
  }
  way_ = way_checked_ = 0;
  slack_ = std::min(skin_, 2 * stretch_ * longest_way());
  ++rebuilds_;
  search_seconds_ += watch.elapsed().cpu;
  update_push();
}

void UpdatedLagrangian::update_push()
{
  way_pushed_ = way_;
  if (body_.pore_pressure.empty() && !body_.reread_pressure)
    return;
  const Stopwatch watch;
  const auto n = self_.size();
  if (body_.reread_pressure)
  {
    std::vector<double> x(n), y(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      const auto original = static_cast<std::size_t>(self_[i].original);
      x[original] = point_[i].motion[0];
      y[original] = point_[i].motion[1];
    }
    const std::vector<double> p_w = body_.reread_pressure(x, y);
    for (Self& self : self_)
      self.p_w = p_w[static_cast<std::size_t>(self.original)];
  }

  p_w_.resize(point_.size());
  for (std::size_t i = 0; i < n; ++i)
    p_w_[i] = self_[i].p_w;
  for (std::size_t k = 0; k < ghost_.size(); ++k)
  {
    const auto source = static_cast<std::size_t>(ghost_[k].source);
    double& p_w = p_w_[n + k] = p_w_[source];
    if (ghost_[k].sign_y < 0 && p_w > 0)
      p_w += water_unit_weight * (point_[source].motion[1] - point_[n + k].motion[1]);
  }

  // a_i = -(1/rho_i) sum_j V_j (p_j - p_i) grad_i W_ij: eq. (9.5). With the correction, over the
  // particles alone, as in eq. (3.6); without it, with the images, where the given field goes on
  // hydrostatically behind the base.
  const Index most = set_.pressure_correction ? n_ : static_cast<Index>(point_.size());
  const double norm = 10 / (7 * pi * h_ * h_ * h_), inv_h = 1 / h_;
#pragma omp parallel for schedule(static)
  for (Index ii = 0; ii < n_; ++ii)
  {
    const auto i = static_cast<std::size_t>(ii);
    const Lanes x_i = splat(point_[i].motion[0]), y_i = splat(point_[i].motion[1]);
    const Lanes p_i = splat(p_w_[i]), zero = splat(0);
    const VerletList::Row row = list_.row(ii);
    Lanes sx = zero, sy = zero, xx = zero, xy = zero, yy = zero;
    for (Index b = 0; b < row.blocks; ++b)
    {
      Lanes x_j, y_j, V_j, p_j;
      for (int l = 0; l < 4; ++l)
      {
        const Index j = row.index[4 * b + l];
        const Point& p = point_[static_cast<std::size_t>(j)];
        x_j[l] = p.motion[0];
        y_j[l] = p.motion[1];
        V_j[l] = j < most ? p.matter[0] * p.matter[2] : 0;
        p_j[l] = p_w_[static_cast<std::size_t>(j)];
      }
      const Lanes dx = x_i - x_j, dy = y_i - y_j;
      const Lanes r = sqrt(dx * dx + dy * dy + 1e-24 * h_ * h_), q = r * inv_h;
      const Lanes u = max(2 - q, zero), w = max(1 - q, zero);
      const Lanes g = V_j * norm * (3 * w * w - 0.75 * u * u) / r; // V_j W' / r: eq. (3.1)
      sx += (p_j - p_i) * g * dx;
      sy += (p_j - p_i) * g * dy;
      xx -= g * dx * dx;
      xy -= g * dx * dy;
      yy -= g * dy * dy;
    }
    const SymTensor B = set_.pressure_correction ? bounded_inverse(sum(xx), sum(xy), sum(yy))
                                                 : SymTensor{1, 1, 0, 0};
    self_[i].push_x = -(B.xx * sum(sx) + B.xy * sum(sy)) * point_[i].matter[2];
    self_[i].push_y = -(B.xy * sum(sx) + B.yy * sum(sy)) * point_[i].matter[2];
  }
  push_seconds_ += watch.elapsed().cpu;
}

double UpdatedLagrangian::v_rms() const
{
  double sum = 0, mass = 0;
  for (std::size_t i = 0; i < self_.size(); ++i)
  {
    const Lanes& p = point_[i].motion;
    sum += point_[i].matter[0] * (p[2] * p[2] + p[3] * p[3]);
    mass += point_[i].matter[0];
  }
  return std::sqrt(sum / mass);
}

double UpdatedLagrangian::max_displacement() const
{
  double largest2 = 0;
  for (std::size_t i = 0; i < self_.size(); ++i)
  {
    const double ux = point_[i].motion[0] - self_[i].x_start;
    const double uy = point_[i].motion[1] - self_[i].y_start;
    largest2 = std::max(largest2, ux * ux + uy * uy);
  }
  return std::sqrt(largest2);
}

void UpdatedLagrangian::check_finite() const
{
  for (std::size_t i = 0; i < self_.size(); ++i)
  {
    const Self& self = self_[i];
    const Lanes& p = point_[i].motion;
    const char* field = !std::isfinite(p[0] + p[1])                          ? "position"
                        : !std::isfinite(p[2] + p[3])                        ? "velocity"
                        : !std::isfinite(I1(self.sig) + self.sig.xy)         ? "stress"
                        : !(self.density > 0 && std::isfinite(self.density)) ? "density"
                                                                             : nullptr;
    if (field != nullptr)
      throw NumericalError(fmt::format(
          "{} of particle {} near ({:.6g}, {:.6g}) is not finite or not positive at t = {:.6g} s "
          "(step {})",
          field, self.original, self.x_list, self.y_list, time_, steps_));
  }
}

State UpdatedLagrangian::state() const
{
  const auto n = self_.size();
  State s;
  for (std::vector<double>* v :
       {&s.ux, &s.uy, &s.vx, &s.vy, &s.plastic_strain, &s.x, &s.y, &s.density})
    v->resize(n);
  s.stress.resize(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const Self& self = self_[i];
    const Lanes& p = point_[i].motion;
    const auto k = static_cast<std::size_t>(self.original);
    s.x[k] = p[0];
    s.y[k] = p[1];
    s.ux[k] = p[0] - self.x_start;
    s.uy[k] = p[1] - self.y_start;
    s.vx[k] = p[2];
    s.vy[k] = p[3];
    s.stress[k] = self.sig;
    s.plastic_strain[k] = self.plastic_strain;
    s.density[k] = self.density;
  }
  return s;
}

Energies UpdatedLagrangian::energies() const
{
  Energies e;
  for (std::size_t i = 0; i < self_.size(); ++i)
  {
    const Self& self = self_[i];
    const Lanes& p = point_[i].motion;
    const double mass = point_[i].matter[0];
    e.kinetic += 0.5 * mass * (p[2] * p[2] + p[3] * p[3]);
    e.potential += mass * set_.gravity * p[1];
    e.elastic += mass / self.density *
                 strain_energy(self.sig, body_.elastic[static_cast<std::size_t>(self.soil)]);
    e.water += self.water;
    e.plastic += self.plastic;
    e.viscous += self.viscous;
    e.damping += self.damping;
  }
  e.shake = shake_work_ + shake_ * (first_moment() - shaken_from_);
  return e;
}

double UpdatedLagrangian::first_moment() const
{
  double sum = 0;
  for (std::size_t i = 0; i < self_.size(); ++i)
    sum += point_[i].matter[0] * point_[i].motion[0];
  return sum;
}

void UpdatedLagrangian::set_shake(double acceleration)
{
  const double moment = first_moment();
  shake_work_ += shake_ * (moment - shaken_from_);
  shaken_from_ = moment;
  shake_ = acceleration;
}

std::vector<double> UpdatedLagrangian::pore_pressure() const
{
  std::vector<double> p_w(self_.size());
  for (const Self& self : self_)
    p_w[static_cast<std::size_t>(self.original)] = self.p_w;
  return p_w;
}

Vec2 UpdatedLagrangian::momentum() const
{
  Vec2 total = Vec2::Zero();
  for (std::size_t i = 0; i < self_.size(); ++i)
    total += point_[i].matter[0] * Vec2{point_[i].motion[2], point_[i].motion[3]};
  return total;
}

double UpdatedLagrangian::closest_pair()
{
  double least2 = std::numeric_limits<double>::max();
  for (Index i = 0; i < n_; ++i)
  {
    const VerletList::Row row = list_.row(i);
    const Lanes& a = point_[static_cast<std::size_t>(i)].motion;
    for (Index k = 0; k < 4 * row.blocks; ++k)
    {
      const Index j = row.index[k];
      if (j == i || j >= n_)
        continue;
      const Lanes& b = point_[static_cast<std::size_t>(j)].motion;
      least2 = std::min(least2, (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]));
    }
  }
  return std::sqrt(least2);
}

void UpdatedLagrangian::set_velocity(std::span<const double> vx, std::span<const double> vy)
{
  for (std::size_t i = 0; i < self_.size(); ++i)
  {
    const auto k = static_cast<std::size_t>(self_[i].original);
    point_[i].motion[2] = vx[k];
    point_[i].motion[3] = vy[k];
    store_ghost_motion(i);
  }
}
} // namespace berm::sph
