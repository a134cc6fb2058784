// SPDX-License-Identifier: GPL-3.0-or-later
// The two passes of a time step of the updated-Lagrangian solver: docs/theory.md section 9.
#include "sph/bounded_inverse.h"
#include "sph/updated_lagrangian.h"

#include <algorithm>
#include <cmath>

namespace berm::sph
{
namespace
{
constexpr double closest_to_wall = 0.22; // [dx]: nearer than this, soil stops as on a hard wall
constexpr double core_ratio = 0.4;       // [dx]: nearer than this, particles repel each other

double sign(double v)
{
  return static_cast<double>((v > 0) - (v < 0));
}
} // namespace

void UpdatedLagrangian::store_force(std::size_t i, const SymTensor& B)
{
  const Self& self = self_[i];
  // With the correction, eq. (9.4) has 1 / (rho_i rho_j), which the sums over pairs bring along.
  const double inv_rho2 = set_.gradient_correction ? 1 : 1 / (self.density * self.density);
  const auto store =
      [&](std::size_t to, SymTensor s, const SymTensor& R, double sign_B, double sign_R)
  {
    const double B_xy = sign_B * B.xy;
    force_[to].stress = inv_rho2 * Lanes{s.xx * B.xx + s.xy * B_xy, s.xx * B_xy + s.xy * B.yy,
                                         s.xy * B.xx + s.yy * B_xy, s.xy * B_xy + s.yy * B.yy};
    force_[to].repulsion = inv_rho2 * Lanes{R.xx, sign_R * R.xy, sign_R * R.xy, R.yy};
  };
  const SymTensor R = set_.artificial_stress ? tensile_repulsion(self.sig, set_.eps0) : SymTensor{};
  const char repels = R.xx != 0 || R.yy != 0 || R.xy != 0;
  store(i, self.sig, R, 1, 1);
  repels_[i] = repels;
  for (Index k = ghost_begin_[i]; k < ghost_begin_[i + 1]; ++k)
  {
    const MovingGhost& ghost = ghost_[static_cast<std::size_t>(k)];
    const auto to = static_cast<std::size_t>(n_ + k);
    SymTensor image = self.sig;
    image.xy *= ghost.sign_sxy;
    if (set_.geostatic_base && ghost.sign_y < 0)
      image.yy += (point_[i].motion[1] - point_[to].motion[1]) * self.density *
                  (self.push_y - set_.gravity);
    store(to, image, R, ghost.sign_Bxy, ghost.sign_sxy);
    repels_[to] = repels;
  }
}

void UpdatedLagrangian::store_ghost_motion(std::size_t i)
{
  const Point& p = point_[i];
  for (Index k = ghost_begin_[i]; k < ghost_begin_[i + 1]; ++k)
  {
    const MovingGhost& g = ghost_[static_cast<std::size_t>(k)];
    point_[static_cast<std::size_t>(n_ + k)] = {
        .motion = Lanes{g.x(p.motion[0]), g.y(p.motion[0], p.motion[1]), g.sign_vx * p.motion[2],
                        g.sign_vy * p.motion[3]},
        .matter = p.matter};
  }
}

template <bool corrected>
double UpdatedLagrangian::update_stress(Index ii)
{
  // Step 1: sums over pairs, four at a time; gradients are kept for the force pass.
  const auto i = static_cast<std::size_t>(ii);
  const VerletList::Row row = list_.row(ii);
  const Lanes motion = point_[i].motion, matter = point_[i].matter;
  const Lanes x_i = splat(motion[0]), y_i = splat(motion[1]);
  const Lanes vx_i = splat(motion[2]), vy_i = splat(motion[3]);
  const Lanes rho_i = splat(matter[1]), c_i = splat(matter[3]);
  const Lanes zero = splat(0), one = splat(1), two = splat(2);
  const Lanes inv_h = splat(1 / h_), h = splat(h_), small = splat(0.01 * h_ * h_);
  const Lanes tiny = splat(1e-24 * h_ * h_);
  const Lanes norm = splat(10 / (7 * pi * h_ * h_ * h_));
  const Lanes alpha_c = splat(0.5 * set_.alpha), beta = splat(set_.beta);
  const Lanes core = splat(core_ratio * body_.particles.spacing);
  const Lanes recession = splat(set_.viscosity_both_ways ? 1 : 0);
  Lanes L_xx = zero, L_xy = zero, L_yx = zero, L_yy = zero, f_x = zero, f_y = zero;
  Lanes M_xx = zero, M_xy = zero, M_yy = zero, mu_most = zero;
  for (Index b = 0; b < row.blocks; ++b)
  {
    const Index* j = row.index + 4 * b;
    const Point &p0 = point_[static_cast<std::size_t>(j[0])],
                &p1 = point_[static_cast<std::size_t>(j[1])],
                &p2 = point_[static_cast<std::size_t>(j[2])],
                &p3 = point_[static_cast<std::size_t>(j[3])];
    const auto [x_j, y_j, vx_j, vy_j] =
        transpose(p0.motion, p1.motion, p2.motion, p3.motion).component;
    const auto [m_j, rho_j, inv_rho_j, c_j] =
        transpose(p0.matter, p1.matter, p2.matter, p3.matter).component;
    const Lanes dx = x_i - x_j, dy = y_i - y_j, dvx = vx_j - vx_i, dvy = vy_j - vy_i;
    const Lanes r2 = dx * dx + dy * dy;
    const Lanes r = sqrt(r2 + tiny), q = r * inv_h;
    // W' = 10 / (7 pi h^3) (3 (1 - q)+^2 - 3/4 (2 - q)+^2): eq. (3.1)
    const Lanes u = max(two - q, zero), w = max(one - q, zero);
    const Lanes g = m_j * norm * (3 * w * w - 0.75 * u * u) / r;
    const Lanes gx = g * dx, gy = g * dy;
    const Lanes Vgx = inv_rho_j * gx, Vgy = inv_rho_j * gy;
    if constexpr (corrected)
      row.pairs[b] = {Vgx, Vgy, q};
    else
      row.pairs[b] = {gx, gy, q};
    L_xx += dvx * Vgx;
    L_xy += dvx * Vgy;
    L_yx += dvy * Vgx;
    L_yy += dvy * Vgy;
    if constexpr (corrected)
    {
      M_xx -= dx * Vgx;
      M_xy -= dx * Vgy;
      M_yy -= dy * Vgy;
    }

    // Eq. (9.6); mu > 0 on approach.
    const Lanes mu = h * (dvx * dx + dvy * dy) / (r2 + small);
    const Lanes approach = max(mu, zero), felt = mu > zero ? mu : recession * mu;
    const Lanes crowded = max(core / r - one, zero) * c_i * c_j;
    const Lanes Pi =
        2 * (alpha_c * (c_i + c_j) * felt + beta * approach * approach + crowded) / (rho_i + rho_j);
    f_x -= Pi * gx;
    f_y -= Pi * gy;
    mu_most = max(mu_most, u > zero ? approach : zero);
  }

  // Step 2: velocity gradient, corrected if asked for; density by eq. (9.1).
  Self& self = self_[i];
  VelocityGradient L{sum(L_xx), sum(L_xy), sum(L_yx), sum(L_yy)};
  SymTensor B{1, 1, 0, 0};
  if constexpr (corrected)
  {
    B = bounded_inverse(sum(M_xx), sum(M_xy), sum(M_yy));
    L = {L.xx * B.xx + L.xy * B.xy, L.xx * B.xy + L.xy * B.yy, L.yx * B.xx + L.yy * B.xy,
         L.yx * B.xy + L.yy * B.yy};
  }
  L = at_middle(L, dt_before_);
  self.viscous_x = sum(f_x);
  self.viscous_y = sum(f_y);
  double expansion = dt_before_ * (L.xx + L.yy);

  // Step 3: trial stress, return to the cone, and the energy that it dissipates.
  const auto soil = static_cast<std::size_t>(self.soil);
  const Elastic& e = body_.elastic[soil];
  const SymTensor turned = turned_by(self.sig, L, dt_before_);
  const SymTensor trial = turned + strained_by(L, dt_before_, e);
  self.sig = trial;
  if (!cones_.empty())
  {
    const Returned returned = return_to_cone(trial, cones_[soil], e);
    self.sig = returned.sig;
    self.plastic_strain += returned.plastic_strain;
    expansion -= returned.gap; // a gap is no looser soil
    // Work of the mean stress on the plastic strain: what the forces of both ends of the step lose.
    const SymTensor plastic_stress = trial + (-1.0) * returned.sig;
    self.plastic += 0.5 * matter[0] / matter[1] *
                    strain_energy_product(turned + returned.sig, plastic_stress, e);
  }
  // To second order, so that soil that shakes keeps its density.
  self.density = matter[1] * (1 - 0.5 * expansion) / (1 + 0.5 * expansion);
  store_force(i, B);

  const double speed = std::sqrt(motion[2] * motion[2] + motion[3] * motion[3]);
  return matter[3] * (1 + 1.2 * set_.alpha) + 1.2 * set_.beta * largest(mu_most) + speed;
}

void UpdatedLagrangian::stop_at_walls(std::size_t i, double& x, double& y, double& vx,
                                      double& vy) const
{
  const double least = closest_to_wall * body_.particles.spacing;
  const MovingWalls& walls = body_.walls;
  for (Index k = ghost_begin_[i]; k < ghost_begin_[i + 1]; ++k)
  {
    const MovingGhost& g = ghost_[static_cast<std::size_t>(k)];
    if (g.sign_y > 0 || g.sign_x < 0) // once for the base, by its plain image
      continue;
    const BaseLine base = base_line(walls, x); // not the image's: it may have passed a kink
    if (y < base.at(x) + least)
    {
      // The soil rubs on the base: the impulse along it is at most that across it times friction.
      y = base.at(x) + least;
      const double across = std::max(base.slope * vx - vy, 0.0);
      const auto soil = static_cast<std::size_t>(self_[i].soil);
      const double friction = cones_.empty() ? 0 : 3 * cones_[soil].alpha; // sin(phi) if psi = 0
      vx -= sign(vx) * std::min(std::abs(vx), friction * across);
      vy = std::max(vy, base.slope * vx);
    }
  }
  if (walls.left && x < *walls.left + least)
  {
    x = *walls.left + least;
    vx = std::max(vx, 0.0);
  }
  if (walls.right && x > *walls.right - least)
  {
    x = *walls.right - least;
    vx = std::min(vx, 0.0);
  }
}

template <bool with_repulsion>
double UpdatedLagrangian::update_motion(Index ii)
{
  // Step 1: a_i = sum_j m_j (S_i + S_j + f_ij (R_i + R_j)) grad_i W_ij: eq. (9.4).
  const auto i = static_cast<std::size_t>(ii);
  const VerletList::Row row = list_.row(ii);
  const Lanes S = force_[i].stress, R = force_[i].repulsion;
  const Lanes S_xx = splat(S[0]), S_xy = splat(S[1]), S_yx = splat(S[2]), S_yy = splat(S[3]);
  Lanes a_x = splat(0), a_y = splat(0);
  double r_x = 0, r_y = 0;
  for (Index b = 0; b < row.blocks; ++b)
  {
    const Index* jj = row.index + 4 * b;
    const std::size_t j[4] = {static_cast<std::size_t>(jj[0]), static_cast<std::size_t>(jj[1]),
                              static_cast<std::size_t>(jj[2]), static_cast<std::size_t>(jj[3])};
    const auto [T_xx, T_xy, T_yx, T_yy] = transpose(force_[j[0]].stress, force_[j[1]].stress,
                                                    force_[j[2]].stress, force_[j[3]].stress)
                                              .component;
    const PairBlock& pair = row.pairs[b];
    a_x += (S_xx + T_xx) * pair.gx + (S_xy + T_xy) * pair.gy;
    a_y += (S_yx + T_yx) * pair.gx + (S_yy + T_yy) * pair.gy;
    if constexpr (with_repulsion)
    {
      for (int l = 0; l < 4; ++l)
        if ((repels_[i] | repels_[j[l]]) != 0 && pair.q[l] < 2)
        {
          const double f = table_(pair.q[l]);
          const Lanes both = f * (R + force_[j[l]].repulsion);
          r_x += both[0] * pair.gx[l] + both[1] * pair.gy[l];
          r_y += both[2] * pair.gx[l] + both[3] * pair.gy[l];
        }
    }
  }

  Self& self = self_[i];
  Point& p = point_[i];
  const double inv_rho = set_.gradient_correction ? p.matter[2] : 1;
  double ax = inv_rho * (sum(a_x) + r_x) + self.viscous_x + self.push_x + shake_;
  double ay = inv_rho * (sum(a_y) + r_y) + self.viscous_y + self.push_y - set_.gravity;

  // Step 2: local damping, eq. (3.8).
  double x = p.motion[0], y = p.motion[1], vx = p.motion[2], vy = p.motion[3];
  const double damped_x = -set_.local_damping * std::abs(ax) * sign(vx);
  const double damped_y = -set_.local_damping * std::abs(ay) * sign(vy);
  ax += damped_x;
  ay += damped_y;

  // Step 3: leapfrog. Work is taken with the mean of old and new velocity: exact for the kick.
  const double way_x = dt_ * (vx + 0.5 * dt_ * ax), way_y = dt_ * (vy + 0.5 * dt_ * ay);
  const double mass = p.matter[0];
  self.viscous -= mass * (self.viscous_x * way_x + self.viscous_y * way_y);
  self.water += mass * (self.push_x * way_x + self.push_y * way_y);
  self.damping -= mass * (damped_x * way_x + damped_y * way_y);
  vx += dt_ * ax;
  vy += dt_ * ay;
  x += dt_ * vx;
  y += dt_ * vy;
  const double free_x = vx, free_y = vy;
  stop_at_walls(i, x, y, vx, vy);
  self.damping +=
      0.5 * mass * ((free_x - vx) * (p.motion[2] + vx) + (free_y - vy) * (p.motion[3] + vy));

  const double step_x = x - p.motion[0], step_y = y - p.motion[1];
  p.motion = Lanes{x, y, vx, vy};
  p.matter = Lanes{mass, self.density, 1 / self.density, p.matter[3]};
  store_ghost_motion(i);
  return step_x * step_x + step_y * step_y;
}

void UpdatedLagrangian::step()
{
  if (!list_holds())
    rebuild();
  else if (!push_holds())
    update_push();
  double rate = 0, way2 = 0;
#pragma omp parallel
  {
#pragma omp for schedule(static) reduction(max : rate)
    for (Index i = 0; i < n_; ++i)
      rate = std::max(rate,
                      set_.gradient_correction ? update_stress<true>(i) : update_stress<false>(i));
#pragma omp single
    dt_ = set_.courant_number * h_ / rate;
#pragma omp for schedule(static) reduction(max : way2)
    for (Index i = 0; i < n_; ++i)
      way2 =
          std::max(way2, set_.artificial_stress ? update_motion<true>(i) : update_motion<false>(i));
  }
  way_ += std::sqrt(way2);
  dt_before_ = dt_;
  time_ += dt_;
  ++steps_;
}

void UpdatedLagrangian::advance(long steps)
{
  for (long k = 0; k < steps; ++k)
    step();
}

void UpdatedLagrangian::advance_for(double duration)
{
  const double end = time_ + duration;
  while (time_ < end)
    step();
}
} // namespace berm::sph
