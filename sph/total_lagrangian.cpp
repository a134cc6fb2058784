// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/total_lagrangian.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <utility>

namespace berm::sph
{
TotalLagrangian::TotalLagrangian(const Discretisation& discretisation, std::vector<Cone> cones,
                                 double damping, const State& start)
    : d_(discretisation), cones_(std::move(cones)), damping_(damping),
      v_(static_cast<std::size_t>(d_.n) + d_.ghosts.size()), T_(v_.size()), sig_(start.stress),
      ux_(start.ux), uy_(start.uy), plastic_strain_(start.plastic_strain),
      viscous_(start.ux.size(), Vec2::Zero())
{
  for (std::size_t i = 0; i < ux_.size(); ++i)
  {
    store_velocity(i, start.vx[i], start.vy[i]);
    store_stress(i, sig_[i]);
  }
}

void TotalLagrangian::store_velocity(std::size_t i, double vx, double vy)
{
  v_[i] = Lanes{vx, vx, vy, vy};
  const auto n = static_cast<std::size_t>(d_.n);
  for (Index g = d_.ghost_begin[i]; g < d_.ghost_begin[i + 1]; ++g)
  {
    const Ghost& ghost = d_.ghosts[static_cast<std::size_t>(g)];
    const double gx = ghost.sign_vx * vx, gy = ghost.sign_vy * vy;
    v_[n + static_cast<std::size_t>(g)] = Lanes{gx, gx, gy, gy};
  }
}

void TotalLagrangian::store_stress(std::size_t i, const SymTensor& sig)
{
  sig_[i] = sig;
  const SymTensor& B = d_.B[i];
  const auto times_B = [&B](const SymTensor& s, double B_xy)
  {
    return Lanes{s.xx * B.xx + s.xy * B_xy, s.xx * B_xy + s.xy * B.yy, s.xy * B.xx + s.yy * B_xy,
                 s.xy * B_xy + s.yy * B.yy};
  };
  T_[i] = times_B(sig, B.xy);
  const auto n = static_cast<std::size_t>(d_.n);
  for (Index g = d_.ghost_begin[i]; g < d_.ghost_begin[i + 1]; ++g)
  {
    const Ghost& ghost = d_.ghosts[static_cast<std::size_t>(g)];
    SymTensor image = sig;
    image.xy *= ghost.sign_sxy;
    image.yy += ghost.depth_below * d_.density[i] * d_.by[i]; // geostatic gradient below the base
    T_[n + static_cast<std::size_t>(g)] = times_B(image, ghost.sign_Bxy * B.xy);
  }
}

void TotalLagrangian::update_stress(std::size_t i)
{
  // Step 1: sum_j (v_j - v_i) (x) G_ij, and the viscous acceleration sum_j s_ij ((v_j - v_i).G) G.
  const auto begin = static_cast<std::size_t>(d_.neighbours.begin[i]);
  const auto end = static_cast<std::size_t>(d_.neighbours.begin[i + 1]);
  const Lanes v_i = v_[i];
  Lanes L = {0, 0, 0, 0}, f = {0, 0, 0, 0};
  for (std::size_t k = begin; k < end; ++k)
  {
    const auto j = static_cast<std::size_t>(d_.neighbours.index[k]);
    const double gx = d_.G[k][0], gy = d_.G[k][1];
    const Lanes G = {gx, gy, gx, gy};
    const Lanes product = (v_[j] - v_i) * G;
    L += product;
    f += (d_.viscosity[k] * (product[0] + product[3])) * G;
  }
  viscous_[i] = {f[0], f[1]};

  // Step 2: velocity gradient (sum) B, rate of deformation and spin.
  const SymTensor& B = d_.B[i];
  const double v_xx = L[0] * B.xx + L[1] * B.xy, v_xy = L[0] * B.xy + L[1] * B.yy;
  const double v_yx = L[2] * B.xx + L[3] * B.xy, v_yy = L[2] * B.xy + L[3] * B.yy;
  const double D_xy = 0.5 * (v_xy + v_yx), omega = 0.5 * (v_xy - v_yx);

  // Step 3: elastic trial stress with the Jaumann rate.
  const auto soil = static_cast<std::size_t>(d_.soil[i]);
  const Elastic& e = d_.elastic[soil];
  const SymTensor& s = sig_[i];
  const double pressure_rate = (e.K - 2 * e.G / 3) * (v_xx + v_yy);
  const SymTensor trial = {s.xx + d_.dt * (pressure_rate + 2 * e.G * v_xx + 2 * omega * s.xy),
                           s.yy + d_.dt * (pressure_rate + 2 * e.G * v_yy - 2 * omega * s.xy),
                           s.zz + d_.dt * pressure_rate,
                           s.xy + d_.dt * (2 * e.G * D_xy + omega * (s.yy - s.xx))};

  // Step 4: return to the cone.
  if (cones_.empty())
  {
    store_stress(i, trial);
    return;
  }
  const Returned returned = return_to_cone(trial, cones_[soil], e);
  plastic_strain_[i] += returned.plastic_strain;
  store_stress(i, returned.sig);
}

void TotalLagrangian::update_motion(std::size_t i)
{
  // a_i = (1/rho_i) sum_j (T_i + T_j) G_ij + viscous + body: the adjoint of the strain operator.
  const auto begin = static_cast<std::size_t>(d_.neighbours.begin[i]);
  const auto end = static_cast<std::size_t>(d_.neighbours.begin[i + 1]);
  const Lanes T_i = T_[i];
  Lanes sum = {0, 0, 0, 0};
  for (std::size_t k = begin; k < end; ++k)
  {
    const double gx = d_.G[k][0], gy = d_.G[k][1];
    sum += (T_[static_cast<std::size_t>(d_.neighbours.index[k])] + T_i) * Lanes{gx, gy, gx, gy};
  }
  double ax = (sum[0] + sum[1]) / d_.density[i] + viscous_[i].x() + d_.bx[i];
  double ay = (sum[2] + sum[3]) / d_.density[i] + viscous_[i].y() + d_.by[i];

  // Cundall's local damping: a fraction of the net force against the motion.
  double vx = v_[i][0], vy = v_[i][2];
  ax -= damping_ * std::abs(ax) * static_cast<double>((vx > 0) - (vx < 0));
  ay -= damping_ * std::abs(ay) * static_cast<double>((vy > 0) - (vy < 0));

  vx += d_.dt * ax;
  vy += d_.dt * ay;
  ux_[i] += d_.dt * vx;
  uy_[i] += d_.dt * vy;
  store_velocity(i, vx, vy);
}

void TotalLagrangian::advance(long steps)
{
  const auto n = static_cast<Index>(d_.n);
#pragma omp parallel
  for (long step = 0; step < steps; ++step)
  {
#pragma omp for schedule(static)
    for (Index i = 0; i < n; ++i)
      update_stress(static_cast<std::size_t>(i));
#pragma omp for schedule(static)
    for (Index i = 0; i < n; ++i)
      update_motion(static_cast<std::size_t>(i));
  }
  steps_ += steps;
}

double TotalLagrangian::v_rms() const
{
  double sum = 0;
  for (std::size_t i = 0; i < ux_.size(); ++i)
    sum += v_[i][0] * v_[i][0] + v_[i][2] * v_[i][2];
  return std::sqrt(sum / static_cast<double>(ux_.size()));
}

double TotalLagrangian::max_displacement() const
{
  double largest = 0;
  for (std::size_t i = 0; i < ux_.size(); ++i)
    largest = std::max(largest, ux_[i] * ux_[i] + uy_[i] * uy_[i]);
  return std::sqrt(largest);
}

void TotalLagrangian::check_finite() const
{
  for (std::size_t i = 0; i < ux_.size(); ++i)
  {
    const char* field = !std::isfinite(ux_[i] + uy_[i])            ? "displacement"
                        : !std::isfinite(I1(sig_[i]) + sig_[i].xy) ? "stress"
                                                                   : nullptr;
    if (field != nullptr)
      throw NumericalError(fmt::format("{} of particle {} is not finite at t = {:.6g} s (step {})",
                                       field, i, time(), steps_));
  }
}

State TotalLagrangian::state() const
{
  State state{
      .ux = ux_, .uy = uy_, .vx = {}, .vy = {}, .stress = sig_, .plastic_strain = plastic_strain_};
  for (std::size_t i = 0; i < ux_.size(); ++i)
  {
    state.vx.push_back(v_[i][0]);
    state.vy.push_back(v_[i][2]);
  }
  return state;
}
} // namespace berm::sph
