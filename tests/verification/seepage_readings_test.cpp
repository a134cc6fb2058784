// SPDX-License-Identifier: GPL-3.0-or-later
// What is read of a solution, against closed forms: docs/verification.md S-13. Default settings.
#include "seepage/exit_gradient.h"
#include "seepage/heave.h"
#include "seepage/line_reading.h"
#include "tests/support/measured.h"
#include "tests/support/sections.h"
#include "tests/verification/seepage_cases.h"

#include <gtest/gtest.h>

#include <cmath>

namespace berm
{
namespace
{
using seepage::Boundary;
using seepage::BoundaryKind;
using seepage::ExitPoint;
using seepage::Outlet;

constexpr double layer = 20; ///< thickness of the pervious layer [m]
constexpr double drop = 10;  ///< of the head [m]
constexpr double buoyant_weight = 10e3;
constexpr double critical = buoyant_weight / water_unit_weight;

/// A solution in soil of conductivity 1, and where its water leaves.
struct Flow
{
  seepage::Solution solution;
  std::vector<Outlet> outlets;

  Flow(const meshes::SectionInput& input, const std::vector<Boundary>& marked)
  {
    solution = tests::solved(input, {{1, 1, 0}}, marked);
    outlets = seepage::outlets(solution,
                               seepage::boundary_conditions(meshes::build_section(input), marked),
                               std::vector<seepage::Conductivity>{{1, 1, 0}});
  }

  [[nodiscard]] seepage::Heave heave() const
  {
    return seepage::heave(solution, outlets, std::vector<double>{buoyant_weight});
  }
  [[nodiscard]] seepage::LineReading line(const Polyline& points) const
  {
    return seepage::read_lines(solution, {{points, 101}}).front();
  }
};

/// The gradient along the normal on an outlet whose points have falling x, interpolated.
double normal_gradient(const Outlet& outlet, double x)
{
  for (std::size_t k = 1; k < outlet.points.size(); ++k)
  {
    const ExitPoint &a = outlet.points[k - 1], &b = outlet.points[k];
    if (a.at.x() >= x && b.at.x() <= x && a.at.x() > b.at.x())
      return b.normal + (x - b.at.x()) / (a.at.x() - b.at.x()) * (a.normal - b.normal);
  }
  ADD_FAILURE() << "no outlet at x = " << x;
  return NAN;
}

/// Downstream half of a sheet pile half as deep as the layer.
Flow sheet_pile()
{
  meshes::SectionInput input;
  input.outline = {{0, 0}, {3 * layer, 0}, {3 * layer, layer}, {0, layer}};
  input.marked_lines = {{{0, 0}, {0, layer / 2}}, {{0, layer}, {3 * layer, layer}}};
  return {input, {{BoundaryKind::head, layer + drop / 2}, {BoundaryKind::head, layer}}};
}

TEST(SheetPileReadings, ExitGradientIsExactAtTheWallAndBesideIt)
{
  const Flow flow = sheet_pile();
  ASSERT_EQ(flow.outlets.size(), 1u);
  const Outlet& ground = flow.outlets[0];
  for (const auto& [x, gradient] :
       {std::pair{0.0, 0.29954}, std::pair{5.0, 0.26026}, std::pair{10.0, 0.18910}})
    tests::expect_measured(fmt::format("S-13 sheet pile: exit gradient at {} m", x),
                           normal_gradient(ground, x), gradient,
                           0.01 * gradient); // half of the promise
  ASSERT_TRUE(ground.steepest);
  EXPECT_LT(ground.points[*ground.steepest].at.x(), 1); // it is flat there, down by 0.6 %
  EXPECT_NEAR(ground.outflow, flow.solution.outflow, 1e-9 * flow.solution.outflow);
}

// Along the wall the gradient grows towards its tip, where half of the head is left, and below that
// the head is the same all the way: the column of the wall's depth is the worst.
TEST(SheetPileReadings, HeaveIsWorstForTheColumnBesideTheWall)
{
  const seepage::Heave heave = sheet_pile().heave();
  ASSERT_TRUE(heave.surface && heave.column);
  tests::expect_measured("S-13 sheet pile: factor against heave, surface", heave.surface->factor,
                         critical / 0.29954, 0.01 * critical / 0.29954);
  tests::expect_measured("S-13 sheet pile: factor against heave, column", heave.column->factor,
                         critical * (layer / 2) / (drop / 2), 1e-9);
  EXPECT_NEAR(heave.column->depth, layer / 2, 1e-9);
  EXPECT_NEAR(heave.column->at.x(), 0, 1e-9);
  EXPECT_EQ(*heave.factor(), heave.column->factor);
}

//------------------------------------------------------------------------------------------------
// Flat-bottomed dam of half width b on a layer T. With z = tanh(pi x / 2T), a = tanh(pi b / 2T):
// head on the base H/2 (1 - F(asin(z/a), a) / K(a)); on the ground the gradient is
// H / (2 K(a)) dz/dx / sqrt((z^2 - a^2) (1 - z^2)).
//------------------------------------------------------------------------------------------------

constexpr double half_width = 10, far = 4 * layer;

double strip(double x)
{
  return std::tanh(pi * x / (2 * layer));
}

double exact_gradient(double x)
{
  const double a = strip(half_width), z = strip(x);
  return drop / (2 * std::comp_ellint_1(a)) * pi / (2 * layer) *
         std::sqrt((1 - z * z) / (z * z - a * a));
}

double exact_base_head(double x)
{
  const double a = strip(half_width);
  return drop / 2 * (1 - std::ellint_1(a, std::asin(strip(x) / a)) / std::comp_ellint_1(a));
}

Flow flat_bottomed_dam()
{
  meshes::SectionInput input;
  input.outline = {{-far, 0}, {far, 0}, {far, layer}, {-far, layer}};
  input.marked_lines = {{{-far, layer}, {-half_width, layer}},
                        {{half_width, layer}, {far, layer}},
                        {{-half_width, layer}, {half_width, layer}}};
  return {input,
          {{BoundaryKind::head, layer + drop},
           {BoundaryKind::head, layer},
           {BoundaryKind::impervious, 0}}};
}

TEST(FlatBottomedDamReadings, ClosedFormsMeetTheTable)
{
  EXPECT_NEAR(exact_base_head(-5), 6.72924, 1e-5);
  EXPECT_NEAR(exact_base_head(5), 3.27076, 1e-5);
}

TEST(FlatBottomedDamReadings, UpliftAndItsPlaceAreExact)
{
  const Flow flow = flat_bottomed_dam();
  const seepage::WaterForce uplift = flow.line({{-half_width, layer}, {half_width, layer}}).water;
  // The head is H/2 and an odd function about the middle. The place: midpoint rule, 2000 points;
  // its error at the ends' square roots is below 1e-4 m.
  double moment = 0, sum = 0;
  for (int k = 0; k < 2000; ++k)
  {
    const double s = (k + 0.5) * half_width / 1000;
    sum += exact_base_head(s - half_width);
    moment += s * exact_base_head(s - half_width);
  }
  const double exact = water_unit_weight * drop / 2 * 2 * half_width;
  EXPECT_NEAR(uplift.force.x(), 0, 1e-6 * exact);
  tests::expect_measured("S-13 flat-bottomed dam: uplift [N/m]", uplift.force.y(), exact,
                         1e-3 * exact); // a tenth of the drop's error in the heads
  tests::expect_measured("S-13 flat-bottomed dam: place of the uplift [m]", uplift.distance,
                         moment / sum, 0.02); // 0.1 % of the base
  EXPECT_NEAR(uplift.moment, uplift.distance * uplift.force.y(), 1e-6 * exact);
}

TEST(FlatBottomedDamReadings, DischargeThroughALineIsThatUnderTheDam)
{
  const Flow flow = flat_bottomed_dam();
  const seepage::LineReading line = flow.line({{0, 0}, {0, layer}});
  EXPECT_TRUE(line.by_stream_function);
  EXPECT_NEAR(line.discharge, -flow.solution.discharge, 1e-9); // to the right of a line upwards
  tests::expect_measured("S-13 discharge through a line / k [m]", line.discharge, -5.33180,
                         5e-3 * 5.33180);
  Flow without = flow;
  without.solution.stream_function.clear();
  const seepage::LineReading by_flux = without.line({{0, 0}, {0, layer}});
  EXPECT_FALSE(by_flux.by_stream_function);
  tests::expect_measured("S-13 discharge through a line by the flux / k [m]", by_flux.discharge,
                         -5.33180, 0.02 * 5.33180); // flux of linear elements
}

// The gradient has no bound at the edge of the base; 0.4 m, a fiftieth of the layer, away from it
// it begins to count.
TEST(FlatBottomedDamReadings, ExitGradientIsExactAwayFromTheEdgeOfTheBase)
{
  const Flow flow = flat_bottomed_dam();
  ASSERT_EQ(flow.outlets.size(), 1u);
  const Outlet& ground = flow.outlets[0];
  for (const double x : {11.0, 12.0, 15.0, 20.0, 30.0})
    tests::expect_measured(fmt::format("S-13 flat-bottomed dam: exit gradient at {} m", x),
                           normal_gradient(ground, x), exact_gradient(x), 0.02 * exact_gradient(x));
  for (const ExitPoint& p : ground.points)
    EXPECT_EQ(p.beside_singularity.has_value(), p.at.x() < half_width + 0.4 - 1e-9);
  ASSERT_TRUE(ground.steepest);
  const ExitPoint& steepest = ground.points[*ground.steepest];
  EXPECT_NEAR(steepest.at.x(), half_width + 0.4, 1e-9);
  // Five edges from where the gradient is r^(-1/2).
  tests::expect_measured("S-13 flat-bottomed dam: largest exit gradient that counts",
                         steepest.normal, exact_gradient(10.4), 0.04 * exact_gradient(10.4));
}

//------------------------------------------------------------------------------------------------
// Kozeny's dam, y0 = 1: on the drain, -1/2 < x < 0, the gradient downwards is 1 / sqrt(-2 x).
//------------------------------------------------------------------------------------------------

TEST(KozenyReadings, GradientIntoTheDrainIsExact)
{
  const Flow flow(tests::kozeny_dam(), {{BoundaryKind::head, 4}, {BoundaryKind::head, 0}});
  ASSERT_EQ(flow.outlets.size(), 1u);
  const Outlet& drain = flow.outlets[0];
  EXPECT_NEAR(drain.outflow, 1, 2e-3);
  // Soil on the left, the drain below: points have rising x. From the tip, where the gradient has
  // no bound, to half way to where the smoothed free surface comes down.
  for (const ExitPoint& p : drain.points)
    if (!p.beside_singularity && p.at.x() < 0 && p.at.x() > -0.25)
    {
      const double exact = 1 / std::sqrt(-2 * p.at.x());
      tests::expect_measured("S-13 Kozeny's drain: gradient into it", p.normal, exact,
                             0.05 * exact); // edges of 0.02 m, 0.09 m and more from the tip
      EXPECT_NEAR(p.upward, -p.normal, 1e-12);
      EXPECT_FALSE(p.faces_up);
    }
  EXPECT_FALSE(flow.heave().factor()) << "a drain below lifts nothing";
}

//------------------------------------------------------------------------------------------------
// Two-sided embankment: water leaves through a seepage face that ends at a toe of 203 degrees.
//------------------------------------------------------------------------------------------------

TEST(EmbankmentReadings, AllWaterPassesBelowTheCrestAndOutOfTheFace)
{
  meshes::SectionInput input = tests::embankment();
  input.left_pool_level = 24.4;
  const Flow flow(input, {});
  const double q = flow.solution.discharge;
  // Dry soil passes a share of 1e-5 at most; 0.1 % for the triangles that the free surface cuts.
  tests::expect_measured("S-13 embankment: discharge below the crest [m2/s]",
                         flow.line({{103, 0}, {103, 28.6}}).discharge, -q, 1e-3 * q);
  ASSERT_EQ(flow.outlets.size(), 1u);
  const Outlet& face = flow.outlets[0];
  tests::expect_measured("S-13 embankment: discharge out of the face [m2/s]", face.outflow, q,
                         1e-3 * q);
  EXPECT_NEAR(face.points.back().at.y(), flow.solution.exit_point->y(), 0.2);
  // On the slope the head falls as the ground does: that along the normal and down the slope make
  // the upward one.
  const Vec2 slope = Vec2(157.9 - 107.13, 7.3 - 28.6).normalized();
  for (const ExitPoint& p : face.points)
    if (p.at.y() > 7.3 + 1e-6)
    {
      EXPECT_NEAR(p.upward, p.normal * slope.x() - slope.y() * slope.y(), 1e-6);
    }
  for (const ExitPoint& p : face.points)
    EXPECT_EQ(p.beside_singularity.has_value(), (p.at - Vec2(157.9, 7.3)).norm() < 0.572 - 1e-9);
}
} // namespace
} // namespace berm
