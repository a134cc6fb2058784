// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/run_out.h"

#include "sph/fill.h"
#include "sph/soil_model.h"
#include "sph/trial.h"
#include "tests/support/sections.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace berm::sph
{
namespace
{
/// A column of weak soil, 2 m x 1 m at the left wall of an endless floor.
MovingBody weak_column(double dx)
{
  const meshes::Section section = tests::block(2, 1);
  Particles particles = fill(section, dx, "columns");
  Soil soil = tests::embankment_soil();
  soil.young_modulus = 1e7;
  const std::vector<Soil> soils{soil};
  tests::set_density(particles, soil.density);
  MovingBody body = moving_body(particles, soils, {}, section, {.gradient_correction = true});
  body.walls.right.reset();
  return body;
}

std::vector<Cone> cones_of(double cohesion, double friction_deg)
{
  return {fit_plane_strain(cohesion, friction_deg * pi / 180, 0)};
}

Frame at_start(const MovingBody& body)
{
  return first_frame(body, unstressed(static_cast<Index>(body.particles.size())));
}

/// Keeps all frames in memory; hands out those that it was given.
struct Memory : FrameStore
{
  std::vector<Frame> frames;
  std::optional<Kept> given;

  std::optional<Kept> kept() override { return given; }
  void keep(const Frame& frame) override { frames.push_back(frame); }
};

/// Asks to stop when asked often enough.
struct Impatient : Observer
{
  mutable int patience = 3;
  [[nodiscard]] bool stop_requested() const override { return --patience < 0; }
};

bool same(const Frame& a, const Frame& b)
{
  return a.number == b.number && a.time == b.time && a.state.x == b.state.x &&
         a.state.vy == b.state.vy && a.state.plastic_strain == b.state.plastic_strain &&
         a.energies.plastic == b.energies.plastic && a.energies.viscous == b.energies.viscous;
}
} // namespace

TEST(RunOut, GoesOnFromAnyFrameWithTheSameBits)
{
  const MovingBody body = weak_column(0.1);
  const RunOutSettings settings{.longest = 0.5, .frame_interval = 0.1};
  Observer silent;
  Memory all;
  const RunOut whole = run_out(body, cones_of(100, 15), at_start(body), 1, settings, all, silent);
  ASSERT_EQ(all.frames.size(), 6u);

  for (std::size_t from = 0; from < all.frames.size(); ++from) // the last one: nothing is left to do
  {
    SCOPED_TRACE(from);
    Memory rest;
    rest.given = FrameStore::Kept{.last = all.frames[from], .history = {}};
    for (std::size_t k = 0; k <= from; ++k)
      rest.given->history.push_back(moment_of(all.frames[k]));
    const RunOut second =
        run_out(body, cones_of(100, 15), at_start(body), 1, settings, rest, silent);
    // Those that were there are not kept again.
    ASSERT_EQ(rest.frames.size(), all.frames.size() - 1 - from);
    for (std::size_t k = 0; k < rest.frames.size(); ++k)
      EXPECT_TRUE(same(rest.frames[k], all.frames[from + 1 + k])) << k;
    EXPECT_TRUE(same(second.last, whole.last));
    EXPECT_EQ(second.history.size(), whole.history.size());
    EXPECT_EQ(second.steps, whole.steps);
    EXPECT_EQ(second.time, whole.time);
    EXPECT_EQ(second.at_rest, whole.at_rest);
    EXPECT_EQ(second.time_to_rest, whole.time_to_rest);
    EXPECT_EQ(second.closest_pair, whole.closest_pair);
  }
}

TEST(RunOut, ACollapseLosesOnlyWhatItDissipatesAndComesToRest)
{
  const MovingBody body = weak_column(0.05);
  Observer silent;
  Memory memory;
  const RunOut result = run_out(body, cones_of(100, 25), at_start(body), 1, {}, memory, silent);
  EXPECT_TRUE(result.at_rest);
  const Energies &first = result.history.front().energies, &last = result.history.back().energies;
  const double fallen = first.potential - last.potential;
  EXPECT_GT(fallen, 0.05 * first.potential);
  EXPECT_NEAR(last.total(), first.total(), 0.05 * fallen); // first order in dx: 0.04 at 0.1 m
  EXPECT_LT(last.kinetic, 1e-4 * fallen);
  EXPECT_GT(result.time_to_rest, std::sqrt(2 / gravity)); // no sooner than it could fall
}

TEST(RunOut, SoilThatStandsIsAtRestAndHasNoRunOut)
{
  MovingBody body = weak_column(0.1);
  body.settings.local_damping = 0.8;
  Observer silent;
  Memory memory;
  const std::vector<Soil> soils{tests::embankment_soil()};
  const Settled settled = settle(SoilModel(body), silent);
  body.settings.local_damping = 0;
  const RunOut result = run_out(body, reduced_cones(soils, 1, "fitted"),
                                first_frame(body, settled.state), 1, {}, memory, silent);
  EXPECT_TRUE(result.at_rest);
  EXPECT_EQ(result.time_to_rest, 0);
  const FinalShape shape = final_shape(body.particles, result.last.state, tests::block(2, 1));
  EXPECT_EQ(shape.moved_volume, 0);
  EXPECT_FALSE(shape.run_out);
  EXPECT_TRUE(shape.side.empty());
}

// Ground that shakes by a carries soil along that it holds: in the frame of the ground, a free
// block gains v = a t, and the shake's work is its kinetic energy.
TEST(RunOut, AShakeAcceleratesFreeSoilAndItsWorkIsAccountedFor)
{
  MovingBody body = weak_column(0.1);
  body.walls = {};
  body.settings.gravity = 0;
  const double mass = 2 * 1 * body.particles.density[0];
  UpdatedLagrangian soil(body, {}, unstressed(static_cast<Index>(body.particles.size())));
  soil.set_shake(-3);
  soil.advance_for(0.2);
  const double v = -3 * soil.time();
  EXPECT_NEAR(soil.momentum().x(), mass * v, 1e-9 * mass);
  EXPECT_NEAR(soil.energies().kinetic, 0.5 * mass * v * v, 1e-9 * mass);
  EXPECT_NEAR(soil.energies().shake, 0.5 * mass * v * v, 0.01 * mass * v * v); // one step's way
  soil.set_shake(0);
  const double work = soil.energies().shake;
  soil.advance_for(0.1);
  EXPECT_NEAR(soil.energies().shake, work, 1e-12 * work);
  EXPECT_NEAR(soil.momentum().x(), mass * v, 1e-9 * mass);
}

TEST(RunOut, SoilThatFallsIntoAPoolIsPushedByItsWater)
{
  MovingBody body = weak_column(0.1);
  body.walls = {};
  const double level = 0.95; // the upper row is dry at first
  body.reread_pressure = [level](std::span<const double> /*x*/, std::span<const double> y)
  {
    std::vector<double> p_w;
    for (const double at : y)
      p_w.push_back(water_unit_weight * std::max(level - at, 0.0));
    return p_w;
  };
  UpdatedLagrangian soil(body, {}, unstressed(static_cast<Index>(body.particles.size())));
  soil.advance_for(1); // by then it has sunk well below the level
  const Vec2 before = soil.momentum();
  const double start = soil.time();
  soil.advance_for(0.2);
  const double mass = 2 * 1 * body.particles.density[0];
  const double sinking =
      gravity - water_unit_weight / body.particles.density[0]; // (1 - rho_w/rho) g
  EXPECT_NEAR((soil.momentum().y() - before.y()) / mass / (soil.time() - start), -sinking,
              1e-3 * sinking);
}

TEST(RunOut, AWishToStopLeavesTheLastWholeFrame)
{
  const MovingBody body = weak_column(0.1);
  Impatient observer;
  Memory memory;
  const RunOut result = run_out(body, cones_of(100, 15), at_start(body), 1,
                                {.longest = 10, .frame_interval = 1}, memory, observer);
  EXPECT_TRUE(result.interrupted);
  EXPECT_FALSE(result.at_rest);
  EXPECT_EQ(result.last.number, memory.frames.back().number);
}

TEST(FinalShape, OfSoilAsDrawnIsTheGround)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  const Particles particles = fill(section, 1, "columns");
  State state = unstressed(static_cast<Index>(particles.size()));
  state.x = particles.x;
  state.y = particles.y;
  const FinalShape shape = final_shape(particles, state, section);
  for (const Vec2& p : shape.surface)
    EXPECT_NEAR(p.y(), meshes::ground_level(section, p.x()), 0.45) << p.x(); // kinks are rounded
  EXPECT_EQ(shape.crest_settlement, 0);
  EXPECT_FALSE(shape.tip);
}

// The right half of a block slides by 3 m: a step of full height at x = 13 m.
TEST(FinalShape, OfASlidBlockIsExact)
{
  meshes::SectionInput input;
  input.ground = {{0, 2}, {10, 2}, {10, 0.5}, {20, 0.5}};
  input.base = {{0, 0}, {20, 0}};
  const meshes::Section section = meshes::build_section(input);
  const double dx = 0.1;
  const Particles particles = fill(section, dx, "columns");
  State state = unstressed(static_cast<Index>(particles.size()));
  state.x = particles.x;
  state.y = particles.y;
  double volume = 0;
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (particles.x[i] > 5 && particles.x[i] < 10 && particles.y[i] > 0.5)
    {
      state.ux[i] = 3;
      state.x[i] += 3;
      volume += particles.volume[i];
    }
  const FinalShape shape = final_shape(particles, state, section);
  EXPECT_NEAR(shape.moved_volume, 7.5, 1e-9);
  EXPECT_NEAR(volume, 7.5, 1e-9);
  EXPECT_EQ(shape.side, "right");
  EXPECT_NEAR((shape.toe.value() - Vec2{10, 0.5}).norm(), 0, 1e-12);
  EXPECT_NEAR(shape.run_out.value(), 3, 2 * dx);
  EXPECT_NEAR(shape.crest_settlement, 0, 1e-9); // the left half still stands
  EXPECT_NEAR(shape.max_displacement, 3, 1e-12);
  double area = 0; // what the surface holds is what was there
  for (const Vec2& p : shape.surface)
    area += p.y() * dx;
  EXPECT_NEAR(area, 10 * 2 + 10 * 0.5, 1e-9);
}

// Under an overhang the toe lies behind the crest; on the left everything is mirrored.
TEST(FinalShape, TheToeIsTheFootOfTheSlopeOnTheSideOfTheMotion)
{
  for (const double side : {1.0, -1.0})
  {
    meshes::SectionInput input;
    input.outline = {{0, 0},         {side * 60, 0},  {side * 60, 5},
                     {side * 20, 5}, {side * 22, 15}, {0, 15}};
    const meshes::Section section = meshes::build_section(input);
    const Particles particles = fill(section, 1, "lattice");
    State state = unstressed(static_cast<Index>(particles.size()));
    state.x = particles.x;
    state.y = particles.y;
    for (std::size_t i = 0; i < particles.size(); ++i)
      if (std::abs(particles.x[i]) > 15 && particles.y[i] > 5)
      {
        state.ux[i] = side * 8;
        state.x[i] += side * 8;
      }
    const FinalShape shape = final_shape(particles, state, section);
    EXPECT_EQ(shape.side, side > 0 ? "right" : "left");
    EXPECT_NEAR((shape.toe.value() - Vec2{side * 20, 5}).norm(), 0, 1e-12);
    EXPECT_NEAR(shape.run_out.value(), 10, 2); // its front stood 2 m beyond the toe
  }
}
} // namespace berm::sph
