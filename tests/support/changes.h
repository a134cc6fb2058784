// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/published_slopes.h"
#include "tests/support/settled_slope.h"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace berm::tests
{
/// Something that a factor of safety must not depend on.
struct Change
{
  std::string name;
  Numerics numerics = {};
  std::function<void(coupling::Case&)> of_case = [](coupling::Case&) {};
  std::function<void(sph::State&)> of_settled_state = [](sph::State&) {};
};

inline std::vector<Change> changes_of_damping()
{
  std::vector<Change> all;
  for (const double damping : {0.2, 0.5, 0.7, 0.9})
    all.push_back({.name = "damping " + std::to_string(damping).substr(0, 3),
                   .numerics = {.damping = damping}});
  return all;
}

inline std::vector<Change> changes_of_time_step()
{
  return {{.name = "half the time step", .numerics = {.time_step_factor = 0.5}}};
}

inline std::vector<Change> changes_of_stiffness()
{
  const auto with = [](double E)
  { return [E](coupling::Case& c) { c.soils.front().mechanical.young_modulus = E; }; };
  return {{.name = "E = 10 MPa", .of_case = with(1e7)},
          {.name = "E = 1 GPa", .of_case = with(1e9)}};
}

inline std::vector<Change> changes_of_frame()
{
  const auto move = [](coupling::Case& c)
  {
    for (Polyline* line : {&c.section.ground, &c.section.base, &c.water.free_surface})
      for (Vec2& v : *line)
        v += Vec2{-1000, 350};
  };
  const auto mirror = [](coupling::Case& c)
  {
    const double ends = c.section.ground.front().x() + c.section.ground.back().x();
    for (Polyline* line : {&c.section.ground, &c.section.base, &c.water.free_surface})
    {
      std::reverse(line->begin(), line->end());
      for (Vec2& v : *line)
        v.x() = ends - v.x();
    }
  };
  return {{.name = "another origin", .of_case = move}, {.name = "mirror image", .of_case = mirror}};
}

inline std::vector<Change> changes_of_initial_stress()
{
  const auto at_rest = [](double K0)
  {
    return [K0](sph::State& state)
    {
      for (SymTensor& s : state.stress)
        s = {.xx = K0 * s.yy, .yy = s.yy, .zz = K0 * s.yy, .xy = 0};
    };
  };
  const auto mean = [](sph::State& state)
  {
    for (SymTensor& s : state.stress)
      s.zz = 0.5 * (s.xx + s.yy);
  };
  const auto vertical = [](sph::State& state)
  {
    for (SymTensor& s : state.stress)
      s.zz = s.yy;
  };
  return {{.name = "K0 = 0.5", .of_settled_state = at_rest(0.5)},
          {.name = "K0 = 1", .of_settled_state = at_rest(1)},
          {.name = "sigma_zz the mean in the plane", .of_settled_state = mean},
          {.name = "sigma_zz = sigma_yy", .of_settled_state = vertical}};
}

/// The middle of a bracket 0.004 wide. @throws std::bad_optional_access if there is none.
inline double narrow_factor(const PublishedSlope& row, double spacing,
                            const Change& change = {.name = "none"},
                            std::optional<double> guess = {})
{
  coupling::Case c = row.at_one_metre;
  c.sph.spacing = spacing;
  change.of_case(c);
  SettledSlope slope(c, change.numerics);
  change.of_settled_state(slope.state);
  return slope
      .factor_of_safety({.lower = 0.8 * row.reference,
                         .upper = 1.2 * row.reference,
                         .tolerance = 0.002, // 0.2 % of F and less: 0.5 % is to be seen
                         .guess = guess})
      .factor()
      .value();
}
} // namespace berm::tests
