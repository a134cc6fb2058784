// SPDX-License-Identifier: GPL-3.0-or-later
// Dams with exact solutions: docs/verification.md S-1, S-2, S-3. All with default settings.
#include "tests/support/measured.h"
#include "tests/verification/seepage_cases.h"

#include <gtest/gtest.h>

namespace berm
{
namespace
{
using tests::box;
using tests::largest_head_error;
using tests::largest_level_error;
using tests::rectangular_dam;
using tests::solved;

//------------------------------------------------------------------------------------------------
// S-1: homogeneous rectangular dam. Discharge: Charny, k (H^2 - h^2) / (2 L). Exit height and free
// surface: Polubarinova-Kochina.
//------------------------------------------------------------------------------------------------

struct Dam
{
  double head, length, tailwater, discharge, exit;
  std::vector<Vec2> free_surface;
};

const Dam square{
    10, 10,      0,
    5,  3.68238, {{1.25, 9.6529}, {2.5, 9.1809}, {5, 7.9680}, {7.5, 6.3432}, {8.75, 5.2766}}};

class RectangularDam : public testing::TestWithParam<Dam>
{
};

TEST_P(RectangularDam, HasItsExactDischargeFreeSurfaceAndExit)
{
  const Dam& dam = GetParam();
  const seepage::Solution s =
      solved(rectangular_dam(dam.length, dam.head, dam.tailwater), {{1, 1, 0}});
  // What users are promised of the meshes that the default tolerance chooses.
  tests::expect_measured("S-1 discharge / k [m]", s.discharge, dam.discharge, 2e-4 * dam.discharge);
  tests::expect_error("S-1 free surface, largest error [m]",
                      largest_level_error(s, dam.free_surface), 5e-4 * dam.head);
  ASSERT_TRUE(s.exit_point);
  EXPECT_NEAR(s.exit_point->x(), dam.length, 1e-9);
  tests::expect_measured("S-1 exit height [m]", s.exit_point->y(), dam.exit,
                         5e-3 * dam.head); // vertical tangent: the slowest of all
  EXPECT_TRUE(s.error.within_tolerance);
  EXPECT_LT(s.balance, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(
    PolubarinovaKochina, RectangularDam,
    testing::Values(
        Dam{24,
            16,
            4,
            17.5,
            12.70591,
            {{2, 23.4109},
             {4, 22.5911},
             {6, 21.5972},
             {8, 20.4304},
             {10, 19.0715},
             {12, 17.4754},
             {14, 15.5338}}},
        Dam{10,
            5,
            0,
            10,
            6.31762,
            {{0.625, 9.8124}, {1.25, 9.5491}, {2.5, 8.8483}, {3.75, 7.8799}, {4.375, 7.2412}}},
        square));

TEST(AnisotropicDam, IsTheIsotropicOneStretched)
{
  // x stretched by sqrt(kx/ky) = 2: the same heights, discharge sqrt(kx ky) times.
  std::vector<Vec2> stretched = square.free_surface;
  for (Vec2& x : stretched)
    x.x() *= 2;
  const meshes::SectionInput input = rectangular_dam(20, 10, 0);
  for (const seepage::Conductivity& k :
       {seepage::Conductivity{4, 1, 0}, seepage::Conductivity{1, 4, pi / 2}})
  {
    const seepage::Solution s = solved(input, {k}, {}, {.tolerance = 1e-4}); // half of the bound
    tests::expect_measured("S-1 anisotropic: discharge / k [m]", s.discharge, 4 * 100 / 40.,
                           2e-4 * 10);
    tests::expect_error("S-1 anisotropic: free surface, largest error [m]",
                        largest_level_error(s, stretched), 5e-4 * 10);
  }
}

//------------------------------------------------------------------------------------------------
// S-2: zones. Discharge exact: (H^2 - h^2) / (2 sum L_i / k_i) and the integral for layers.
//------------------------------------------------------------------------------------------------

/// Relative error of the discharge with H = 10, h = 2 over 4 m of shell, 2 m of core, 4 m of drain.
double cored_dam_error(double k_core, double k_drain)
{
  meshes::SectionInput input = rectangular_dam(10, 10, 2);
  input.zones = {box(1, 4, 0, 6, 11), box(2, 6, 0, 10, 11)};
  const seepage::Solution s =
      solved(input, {{1, 1, 0}, {k_core, k_core, 0}, {k_drain, k_drain, 0}});
  EXPECT_LT(s.balance, 1e-8);
  return s.discharge / (96 / 2. / (4 + 2 / k_core + 4 / k_drain)) - 1;
}

// Free surfaces that jump at the zones: twice the default tolerance.
TEST(ZonedDam, OfModerateContrastHasItsExactDischarge)
{
  tests::expect_measured("S-2 cores: discharge, relative error", cored_dam_error(0.1, 1), 0, 1e-3);
}
TEST(ZonedDam, WithATightCoreHasItsExactDischarge)
{
  tests::expect_measured("S-2 cores: discharge, relative error", cored_dam_error(1e-3, 1), 0, 1e-3);
}
TEST(ZonedDam, WithATightCoreAndADrainHasItsExactDischarge)
{
  tests::expect_measured("S-2 cores: discharge, relative error", cored_dam_error(1e-3, 100), 0,
                         1e-3);
}

TEST(ZonedDam, OfHorizontalLayersHasItsExactDischarge)
{
  meshes::SectionInput input = rectangular_dam(8, 10, 2);
  input.zones = {box(1, 0, 5, 8, 11)};
  tests::expect_measured("S-2 horizontal layers: discharge / k [m]",
                         solved(input, {{1, 1, 0}, {2, 2, 0}}).discharge, 7.5625, 1e-3 * 7.5625);
}

//------------------------------------------------------------------------------------------------
// S-3: Kozeny's dam. Drain on y = 0, x <= 0; base impervious for x > 0. With y0 = 1:
// head = Re sqrt(2 (x + i y)), q = k, free surface y^2 = 1 + 2 x. Upstream the equipotential head
// = 4.
//------------------------------------------------------------------------------------------------

TEST(KozenyDam, HasItsExactDischargeHeadsAndFreeSurface)
{
  const meshes::SectionInput input = tests::kozeny_dam();
  const seepage::Solution s = solved(
      input, {{1, 1, 0}}, {{seepage::BoundaryKind::head, 4}, {seepage::BoundaryKind::head, 0}});
  tests::expect_measured("S-3 discharge / k [m]", s.discharge, 1,
                         2e-3); // the flow converges on the drain's tip like r^(-1/2)
  const auto head = [](double x, double y) { return std::sqrt(std::hypot(x, y) + x); };
  EXPECT_NEAR(head(1, 0.5), 1.45535, 1e-5); // the closed form against the table
  tests::expect_error(
      "S-3 heads, largest error [m]",
      largest_head_error(
          s,
          {{1, 0.5, head(1, 0.5)}, {2, 1, head(2, 1)}, {3, 0.2, head(3, 0.2)}, {5, 2, head(5, 2)}}),
      2e-3 * 1.45535); // 0.2 % of the smallest of them
  tests::expect_error("S-3 free surface, largest error [m]",
                      largest_level_error(s, {{0, 1}, {1.5, 2}, {4, 3}}), 0.01);
  ASSERT_TRUE(s.exit_point);
  tests::expect_measured("S-3 exit on the drain, x [m]", s.exit_point->x(), -0.5,
                         0.08); // meets the drain at a right angle: a few of its edges
  EXPECT_EQ(s.exit_point->y(), 0);
}
} // namespace
} // namespace berm
