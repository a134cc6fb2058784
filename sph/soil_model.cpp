// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/soil_model.h"

#include "sph/total_lagrangian.h"

#include <utility>

namespace berm::sph
{
namespace
{
constexpr double local_damping = 0.8; // F does not depend on it between 0.7 and 0.8
} // namespace

SoilModel::SoilModel(const Discretisation& d)
    : n(d.n), T0(d.T0), d_ref(d.d_ref),
      solver([&d](const std::vector<Cone>& cones, const State& start)
             { return std::make_unique<TotalLagrangian>(d, cones, local_damping, start); })
{
}

SoilModel::SoilModel(const MovingBody& body)
    : n(static_cast<Index>(body.particles.size())), T0(body.T0), d_ref(body.d_ref),
      solver([&body](std::vector<Cone> cones, const State& start)
             { return std::make_unique<UpdatedLagrangian>(body, std::move(cones), start); })
{
}

State unstressed(Index n)
{
  const auto size = static_cast<std::size_t>(n);
  State state;
  state.ux = state.uy = state.vx = state.vy = state.plastic_strain = std::vector(size, 0.0);
  state.stress.resize(size);
  return state;
}
} // namespace berm::sph
