// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/total_lagrangian.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <map>

namespace berm::sph
{
namespace
{
constexpr long passes_at_a_time = 8; // measured: docs/performance.md

std::variant<ListSums, PanelSums> pair_sums(const Discretisation& d)
{
  if (d.panels.block.empty())
    return ListSums(d);
  return PanelSums(d);
}
} // namespace

TotalLagrangian::TotalLagrangian(const Discretisation& discretisation,
                                 const std::vector<Cone>& cones, double damping, const State& start,
                                 const TotalLagrangianTerms& terms)
    : d_(discretisation), elastic_(cones.empty()), damping_(damping), viscosity_(terms.viscosity),
      sums_(pair_sums(d_)),
      lane_(std::visit([this](const auto& sums) { return sums.lanes(d_.n); }, sums_)),
      wavefront_(std::visit([](const auto& sums)
                            { return Wavefront(sums.blocks(), sums.reach(), passes_at_a_time); },
                            sums_))
{
  make_blocks(cones);
  make_images(cones, terms.body_forces);
  if (!terms.body_forces)
    for (Block& block : blocks_)
      block.bx = block.by = Wide{};
  restart(start);
}

void TotalLagrangian::make_blocks(const std::vector<Cone>& cones)
{
  blocks_.resize(
      static_cast<std::size_t>(std::visit([](const auto& sums) { return sums.blocks(); }, sums_)));
  std::vector<std::array<Index, wide_lanes>> soil(
      blocks_.size()); // free lanes: soil 0, whatever it is
  for (std::size_t i = 0; i < lane_.size(); ++i)
  {
    const std::size_t b = static_cast<std::size_t>(lane_[i]) / wide_lanes,
                      l = static_cast<std::size_t>(lane_[i]) % wide_lanes;
    Block& block = blocks_[b];
    block.Bxx[l] = d_.B[i].xx;
    block.Byy[l] = d_.B[i].yy;
    block.Bxy[l] = d_.B[i].xy;
    block.specific_volume[l] = 1 / d_.density[i];
    block.bx[l] = d_.bx[i];
    block.by[l] = d_.by[i];
    soil[b][l] = d_.soil[i];
  }
  std::map<std::array<Index, wide_lanes>, std::size_t> known;
  for (std::size_t b = 0; b < blocks_.size(); ++b)
  {
    const auto [entry, is_new] = known.try_emplace(soil[b], soils_.size());
    blocks_[b].soil = entry->second;
    if (!is_new)
      continue;
    WideSoil& mixture = soils_.emplace_back();
    for (std::size_t l = 0; l < wide_lanes; ++l)
    {
      const auto s = static_cast<std::size_t>(soil[b][l]);
      mixture.set(l, d_.elastic[s], elastic_ ? Cone{} : cones[s]);
    }
  }
}

void TotalLagrangian::make_images(const std::vector<Cone>& cones, bool body_forces)
{
  for (const Ghost& ghost : d_.ghosts) // ordered by source, as the blocks are
  {
    const auto i = static_cast<std::size_t>(ghost.source);
    const std::size_t b = static_cast<std::size_t>(lane_[i]) / wide_lanes;
    const Index point =
        std::visit([&](const auto& sums)
                   { return sums.point(static_cast<std::size_t>(d_.n) + images_.size()); },
                   sums_);
    if (blocks_[b].images_end == 0)
      blocks_[b].images_begin = images_.size();
    images_.push_back({.lane = static_cast<std::size_t>(lane_[i]) % wide_lanes,
                       .point = point,
                       .sign_vx = ghost.sign_vx,
                       .sign_vy = ghost.sign_vy,
                       .sign_sxy = ghost.sign_sxy,
                       .sign_Bxy = ghost.sign_Bxy,
                       .lift = body_forces ? ghost.depth_below * d_.density[i] * d_.by[i] : 0});
    if (!elastic_)
    {
      const Cone& cone = cones[static_cast<std::size_t>(d_.soil[i])];
      images_.back().k = cone.k;
      images_.back().friction = 3 * cone.alpha;
    }
    blocks_[b].images_end = images_.size();
  }
}

void TotalLagrangian::restart(const State& start)
{
  std::vector<BlockVector> v(blocks_.size());
  for (std::size_t i = 0; i < lane_.size(); ++i)
  {
    const std::size_t b = static_cast<std::size_t>(lane_[i]) / wide_lanes,
                      l = static_cast<std::size_t>(lane_[i]) % wide_lanes;
    Block& block = blocks_[b];
    block.sig.xx[l] = start.stress[i].xx;
    block.sig.yy[l] = start.stress[i].yy;
    block.sig.zz[l] = start.stress[i].zz;
    block.sig.xy[l] = start.stress[i].xy;
    block.plastic_strain[l] = start.plastic_strain[i];
    block.ux[l] = start.ux[i];
    block.uy[l] = start.uy[i];
    v[b].x[l] = start.vx[i];
    v[b].y[l] = start.vy[i];
  }
  std::visit(
      [&](auto& sums)
      {
        for (std::size_t b = 0; b < blocks_.size(); ++b)
        {
          store_velocity(sums, b, v[b]);
          store_stress(sums, b);
        }
      },
      sums_);
}

template <class Sums>
void TotalLagrangian::store_velocity(Sums& sums, std::size_t b, const BlockVector& v) const
{
  sums.set_velocity(b, v);
  for (std::size_t k = blocks_[b].images_begin; k < blocks_[b].images_end; ++k)
  {
    const Image& image = images_[k];
    sums.set_velocity_of_point(image.point, image.sign_vx * v.x[image.lane],
                               image.sign_vy * v.y[image.lane]);
  }
}

template <class Sums>
void TotalLagrangian::store_stress(Sums& sums, std::size_t b) const
{
  const Block& block = blocks_[b];
  const WideStress& s = block.sig;
  sums.set_T(b, {s.xx * block.Bxx + s.xy * block.Bxy, s.xx * block.Bxy + s.xy * block.Byy,
                 s.xy * block.Bxx + s.yy * block.Bxy, s.xy * block.Bxy + s.yy * block.Byy});
  for (std::size_t k = block.images_begin; k < block.images_end; ++k)
  {
    const Image& image = images_[k];
    const std::size_t l = image.lane;
    // The shear stress grows with the strength: soil slides on its base at the base's, eq. (5.2).
    const double xx = s.xx[l], yy = s.yy[l] + image.lift;
    const double here = image.k - image.friction * s.yy[l], there = image.k - image.friction * yy;
    const double ratio = here > 0 ? std::clamp(there / here, 0.5, 2.0) : 1;
    const double xy = image.sign_sxy * ratio * s.xy[l];
    const double B_xx = block.Bxx[l], B_yy = block.Byy[l], B_xy = image.sign_Bxy * block.Bxy[l];
    sums.set_T_of_point(image.point, xx * B_xx + xy * B_xy, xx * B_xy + xy * B_yy,
                        xy * B_xx + yy * B_xy, xy * B_xy + yy * B_yy);
  }
}

template <class Sums>
void TotalLagrangian::update_stress(Sums& sums, std::size_t b)
{
  // Step 1: the sums over pairs.
  Block& block = blocks_[b];
  const BlockGradient L = sums.gradient(b);
  block.fx = L.fx;
  block.fy = L.fy;

  // Step 2: velocity gradient (sum) B, rate of deformation and spin.
  const Wide v_xx = L.xx * block.Bxx + L.xy * block.Bxy, v_xy = L.xx * block.Bxy + L.xy * block.Byy;
  const Wide v_yx = L.yx * block.Bxx + L.yy * block.Bxy, v_yy = L.yx * block.Bxy + L.yy * block.Byy;
  const Wide twice_D_xy = v_xy + v_yx, twice_omega = v_xy - v_yx;

  // Step 3: elastic trial stress with the Jaumann rate.
  const WideSoil& soil = soils_[block.soil];
  WideStress& s = block.sig;
  const Wide pressure_rate = soil.lambda * (v_xx + v_yy);
  const Wide turn_x = twice_omega * s.xy, turn_xy = 0.5 * twice_omega * (s.yy - s.xx);
  s.xx += d_.dt * (pressure_rate + 2 * soil.G * v_xx + turn_x);
  s.yy += d_.dt * (pressure_rate + 2 * soil.G * v_yy - turn_x);
  s.zz += d_.dt * pressure_rate;
  s.xy += d_.dt * (soil.G * twice_D_xy + turn_xy);

  // Step 4: return to the cone.
  if (!elastic_)
    block.plastic_strain += return_to_cone(s, soil);
  store_stress(sums, b);
}

template <class Sums>
void TotalLagrangian::update_motion(Sums& sums, std::size_t b)
{
  // a_i = (1/rho_i) sum_j (T_i + T_j) G_ij + viscous + body: the adjoint of the strain operator.
  Block& block = blocks_[b];
  const BlockVector force = sums.divergence(b);
  Wide ax = force.x * block.specific_volume + viscosity_ * block.fx + block.bx;
  Wide ay = force.y * block.specific_volume + viscosity_ * block.fy + block.by;

  // Cundall's local damping: a fraction of the net force against the motion.
  BlockVector v = sums.velocity(b);
  ax -= damping_ * abs(ax) * sign(v.x);
  ay -= damping_ * abs(ay) * sign(v.y);

  v.x += d_.dt * ax;
  v.y += d_.dt * ay;
  block.ux += d_.dt * v.x;
  block.uy += d_.dt * v.y;
  store_velocity(sums, b, v);
}

void TotalLagrangian::advance(long steps)
{
  std::visit(
      [&](auto& sums)
      {
        wavefront_.run(2 * steps,
                       [&](long pass, std::size_t begin, std::size_t end)
                       {
                         for (std::size_t b = begin; b < end; ++b)
                           if (pass % 2 == 0)
                             update_stress(sums, b);
                           else
                             update_motion(sums, b);
                       });
      },
      sums_);
  steps_ += steps;
}

double TotalLagrangian::v_rms() const
{
  Wide squares = {};
  std::visit(
      [&](const auto& sums)
      {
        for (std::size_t b = 0; b < blocks_.size(); ++b)
        {
          const BlockVector v = sums.velocity(b);
          squares += v.x * v.x + v.y * v.y;
        }
      },
      sums_);
  return std::sqrt(sum_of_lanes(squares) / static_cast<double>(lane_.size()));
}

double TotalLagrangian::max_displacement() const
{
  Wide largest = {};
  for (const Block& block : blocks_)
  {
    const Wide squares = block.ux * block.ux + block.uy * block.uy;
    largest = squares > largest ? squares : largest;
  }
  double most = 0;
  for (std::size_t l = 0; l < wide_lanes; ++l)
    most = std::max(most, largest[l]);
  return std::sqrt(most);
}

void TotalLagrangian::check_finite() const
{
  const State now = state();
  for (std::size_t i = 0; i < lane_.size(); ++i)
  {
    const char* field = !std::isfinite(now.ux[i] + now.uy[i])                  ? "displacement"
                        : !std::isfinite(I1(now.stress[i]) + now.stress[i].xy) ? "stress"
                                                                               : nullptr;
    if (field != nullptr)
      throw NumericalError(fmt::format("{} of particle {} is not finite at t = {:.6g} s (step {})",
                                       field, i, time(), steps_));
  }
}

State TotalLagrangian::state() const
{
  const std::size_t n = lane_.size();
  State state;
  state.ux = state.uy = state.vx = state.vy = state.plastic_strain = std::vector<double>(n);
  state.stress.resize(n);
  std::vector<BlockVector> v(blocks_.size());
  std::visit(
      [&](const auto& sums)
      {
        for (std::size_t b = 0; b < v.size(); ++b)
          v[b] = sums.velocity(b);
      },
      sums_);
  for (std::size_t i = 0; i < n; ++i)
  {
    const std::size_t b = static_cast<std::size_t>(lane_[i]) / wide_lanes,
                      l = static_cast<std::size_t>(lane_[i]) % wide_lanes;
    const Block& block = blocks_[b];
    state.ux[i] = block.ux[l];
    state.uy[i] = block.uy[l];
    state.vx[i] = v[b].x[l];
    state.vy[i] = v[b].y[l];
    state.stress[i] = {block.sig.xx[l], block.sig.yy[l], block.sig.zz[l], block.sig.xy[l]};
    state.plastic_strain[i] = block.plastic_strain[l];
  }
  return state;
}
} // namespace berm::sph
