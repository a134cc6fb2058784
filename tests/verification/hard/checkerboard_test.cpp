// SPDX-License-Identifier: GPL-3.0-or-later
/// Stress that alternates from particle to particle: the mode that sums over neighbours cannot see.
#include "sph/fill.h"
#include "sph/soil_model.h"
#include "sph/trial.h"
#include "tests/support/moving_soil.h"
#include "tests/support/soundness.h"

#include <cmath>
#include <gtest/gtest.h>

namespace berm::sph
{
namespace
{
double checkerboard_when_settled(const SoilModel& model, const Particles& particles)
{
  Observer silent;
  const State s = settle(model, silent).state;
  const bool moved = !s.x.empty();
  return tests::checkerboard(moved ? s.x : particles.x, moved ? s.y : particles.y, s.stress,
                             particles.spacing);
}

struct Scene
{
  meshes::Section section;
  Particles particles;
  std::vector<Soil> soils{tests::embankment_soil()};

  Scene(meshes::Section s, double dx)
      : section(std::move(s)), particles(fill(section, dx, "columns"))
  {
    tests::set_density(particles, soils[0].density);
  }
  [[nodiscard]] double total_lagrangian() const
  {
    const Discretisation d =
        discretise(particles, soils, std::vector<double>(particles.size()), section);
    return checkerboard_when_settled(d, particles);
  }
  [[nodiscard]] double updated_lagrangian(bool geostatic_base) const
  {
    const MovingBody body = moving_body(particles, soils, {}, section,
                                        {.geostatic_base = geostatic_base, .local_damping = 0.8});
    return checkerboard_when_settled(body, particles);
  }
};
} // namespace

// The measure itself: nothing of a linear stress on disordered points, a / sqrt(m^2 + a^2) of +-a
// around m.
TEST(Checkerboard, MeasuresWhatAlternatesAndNothingElse)
{
  const meshes::Section section = tests::block(10, 10);
  const Particles disordered = tests::jittered_block(section, 0.5, 0.2, 2000);
  std::vector<SymTensor> stress;
  for (std::size_t i = 0; i < disordered.size(); ++i)
    stress.push_back({3 * disordered.x[i], -7 * disordered.y[i], 5, 1});
  EXPECT_LT(tests::checkerboard(disordered.x, disordered.y, stress, 0.5), 1e-12);

  const Particles lattice = fill(section, 0.5, "columns");
  stress.resize(lattice.size());
  for (std::size_t i = 0; i < lattice.size(); ++i)
  {
    const bool black = std::lround((lattice.x[i] + lattice.y[i]) / 0.5) % 2 == 0;
    stress[i] = {black ? 9. : 11., 0, 0, 0};
  }
  EXPECT_NEAR(tests::checkerboard(lattice.x, lattice.y, stress, 0.5), 1 / std::sqrt(101), 1e-12);
}

// A column in equilibrium has linear stress, so all that is measured is false. 0.005: five times
// what settling and the surface leave at H/20, an eighth of what a plain mirror at the base does.
TEST(Checkerboard, IsAbsentFromASettledColumn)
{
  const Scene column(tests::block(10, 20), 1);
  EXPECT_LT(column.total_lagrangian(), 0.005);
  EXPECT_LT(column.updated_lagrangian(true), 0.005);
  EXPECT_GT(column.updated_lagrangian(false), 0.02);
}

// The kinks of the ground bend the true stress too: 0.02 is the geometric mean of what the
// geostatic base (0.011, 0.008) and the plain mirror (0.041) leave.
TEST(Checkerboard, IsWeakInASettledEmbankment)
{
  const Scene embankment(meshes::build_section(tests::embankment()), 1);
  EXPECT_LT(embankment.total_lagrangian(), 0.02);
  EXPECT_LT(embankment.updated_lagrangian(true), 0.02);
  EXPECT_GT(embankment.updated_lagrangian(false), 0.02);
}
} // namespace berm::sph
