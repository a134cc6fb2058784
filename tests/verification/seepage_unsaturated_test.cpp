// SPDX-License-Identifier: GPL-3.0-or-later
// Soils with a retention curve, against closed forms, quadrature and published discharges:
// docs/verification.md S-10.
#include "seepage/flow_operator.h"
#include "tests/support/measured.h"
#include "tests/verification/seepage_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

namespace berm
{
namespace
{
using seepage::BoundaryKind;
using seepage::Retention;
using seepage::RetentionModel;

Retention gardner(double alpha)
{
  return {RetentionModel::gardner, alpha, 0, 0.5, 0};
}

Retention van_genuchten(double alpha, double n, double air_entry)
{
  return {RetentionModel::van_genuchten, alpha, n, 0.5, air_entry};
}

//------------------------------------------------------------------------------------------------
// A column of height 4 m, k = 1, head 1 m at its base; rain of intensity r soaks in at the top, or
// evaporates if r < 0: dp/dy = -1 + r / k_r(p), so that p = 0 at y = 1 / (1 - r).
//------------------------------------------------------------------------------------------------

/// Pressure heads at the nodes of a column of so many rows, and the nodes' heights.
struct Column
{
  std::vector<double> y, p;
};

Column column(const Retention& retention, double rain, Index rows)
{
  meshes::SectionInput input;
  input.outline = {{0, 0}, {0.5, 0}, {0.5, 4}, {0, 4}};
  input.marked_lines = {
      {{0, 0}, {0.5, 0}}, {{0.5, 0}, {0.5, 4}}, {{0.5, 4}, {0, 4}}, {{0, 4}, {0, 0}}};
  const meshes::Section section = meshes::build_section(input);
  Observer observer;
  const seepage::Solution s =
      seepage::solve_on_mesh(tests::rectangle_mesh(section, 4, rows), {{1, 1, 0, retention}},
                             seepage::boundary_conditions(section, {{BoundaryKind::head, 1},
                                                                    {BoundaryKind::impervious, 0},
                                                                    {BoundaryKind::inflow, rain},
                                                                    {BoundaryKind::impervious, 0}}),
                             observer);
  Column result;
  for (std::size_t i = 0; i < s.head.size(); ++i)
  {
    result.y.push_back(s.mesh.nodes[i].y());
    result.p.push_back(s.pore_pressure[i] / water_unit_weight);
  }
  return result;
}

/// Gardner's soil: with e = exp(alpha p), de/dy = alpha (r - e).
double exact_pressure(double alpha, double rain, double y)
{
  const double level = 1 / (1 - rain);
  if (y <= level)
    return 1 - (1 - rain) * y;
  return std::log(rain + (1 - rain) * std::exp(-alpha * (y - level))) / alpha;
}

double largest_error(double alpha, double rain, Index rows)
{
  const Column c = column(gardner(alpha), rain, rows);
  double worst = 0;
  for (std::size_t i = 0; i < c.p.size(); ++i)
    worst = std::max(worst, std::abs(c.p[i] - exact_pressure(alpha, rain, c.y[i])));
  return worst;
}

TEST(GardnersColumn, HasItsExactSuctionUnderRainAndEvaporation)
{
  for (const double rain : {0.5, 0.05, -0.01})
  {
    const double coarse = largest_error(1, rain, 40), fine = largest_error(1, rain, 80);
    tests::expect_error("S-10 Gardner's column: suction, largest error [m]", fine,
                        2e-3); // (alpha h)^2 / 2 = 1.25e-3 of 1 / alpha
    // Second order but for the place of p = 0, where k_r has a kink inside an element, and for the
    // floor k_min = 1e-5, which counts 1e-5 / k_r <= 5e-4.
    EXPECT_GT(coarse / fine, 2) << rain;
  }
}

/// Mualem's conductivity of van Genuchten's saturation, 1 up to the air entry.
double mualem(const Retention& r, double suction)
{
  const auto curve = [&r](double s)
  {
    const double m = 1 - 1 / r.n, s_e = std::pow(1 + std::pow(r.alpha * s, r.n), -m);
    return std::pow(s_e, r.l) * std::pow(1 - std::pow(1 - std::pow(s_e, 1 / m), m), 2);
  };
  return suction <= r.air_entry ? 1 : curve(suction) / (r.air_entry > 0 ? curve(r.air_entry) : 1);
}

/// Height at which the suction is reached: dy = ds / (1 - r / k_r), Simpson's rule.
double height_of(const Retention& r, double rain, double suction)
{
  constexpr int n = 2000;
  double y = 1 / (1 - rain);
  const auto add = [&](double from, double to)
  {
    const double step = (to - from) / n;
    for (int k = 0; k <= n; ++k)
      y += (k == 0 || k == n ? 1
            : k % 2 == 1     ? 4
                             : 2) *
           step / 3 / (1 - rain / mualem(r, from + k * step));
  };
  add(0, std::min(suction, r.air_entry)); // the air entry is a kink
  if (suction > r.air_entry)
    add(r.air_entry, suction);
  return y;
}

TEST(VanGenuchtensColumn, HasTheSuctionThatQuadratureGives)
{
  for (const auto& [retention, rain] : {std::pair{van_genuchten(2, 2.68, 0), 0.05},
                                        {van_genuchten(0.5, 2.68, 0), -0.001},
                                        {van_genuchten(3.6, 1.56, 0.02), 0.01},
                                        {van_genuchten(0.5, 1.56, 0.1), -0.001},
                                        {van_genuchten(0.8, 1.09, 0.02), 0.01},
                                        {van_genuchten(0.5, 1.05, 0.02), 0.003}})
  {
    const Column c = column(retention, rain, 160);
    double worst = 0;
    for (std::size_t i = 0; i < c.p.size(); ++i)
    {
      // Where rain makes k_r uniform the height hardly depends on the suction: such nodes say
      // nothing.
      if (c.p[i] >= -0.03 || std::abs(1 - rain / mualem(retention, -c.p[i])) < 0.1)
        continue;
      worst = std::max(worst, std::abs(height_of(retention, rain, -c.p[i]) - c.y[i]));
    }
    // A fifth of an element: within one near the air entry k_r falls by up to a third.
    tests::expect_error("S-10 van Genuchten's columns: height of a suction, largest error [m]",
                        worst, 0.005);
  }
}

//------------------------------------------------------------------------------------------------
// In two dimensions Gardner's flow is linear in the matric flux potential phi = exp(alpha p) /
// alpha: div grad phi + alpha d phi / dy = 0. Solved by phi = A + exp(-(alpha / 2 + c) y) cos(b x),
// c^2 = alpha^2 / 4 + b^2.
//------------------------------------------------------------------------------------------------

double potential_error(Index cells)
{
  constexpr double alpha = 2, b = 3;
  const double c = std::sqrt(alpha * alpha / 4 + b * b);
  const auto exact = [&](const Vec2& x)
  {
    const double phi = 0.2 + 0.15 * std::exp(-(alpha / 2 + c) * x.y()) * std::cos(b * x.x());
    return std::log(alpha * phi) / alpha; // phi <= 0.35 < 1 / alpha: p < 0
  };
  const meshes::TriangleMesh mesh = tests::rectangle_mesh(1, 1, cells, cells);
  const std::size_t m = mesh.triangles.size(), n = mesh.nodes.size();
  seepage::FlowOperator flow(mesh, std::vector(m, seepage::ConductivityTensor{1, 0, 1}),
                             std::vector(n, 1.0));
  flow.set_relative_conductivity(
      std::vector(m, seepage::on_mesh(seepage::law_of(gardner(alpha)), 1.0 / cells, 0)));
  std::vector<double> p, residual, correction;
  std::vector<std::uint8_t> fixed;
  for (const Vec2& x : mesh.nodes)
  {
    p.push_back(exact(x));
    fixed.push_back(x.minCoeff() == 0 || x.maxCoeff() == 1);
  }
  for (int step = 0; step < 6; ++step)
  {
    flow.residual(p, residual);
    flow.correction(p, fixed, residual, correction);
    for (std::size_t i = 0; i < n; ++i)
      p[i] -= correction[i];
  }
  double worst = 0;
  for (std::size_t i = 0; i < n; ++i)
    worst = std::max(worst, std::abs(p[i] - exact(mesh.nodes[i])));
  return worst;
}

TEST(GardnersPotential, IsSecondOrderInTwoDimensions)
{
  const double coarse = potential_error(10), middle = potential_error(20),
               fine = potential_error(40);
  tests::expect_measured("S-10 Gardner's flow: order", std::log2(coarse / middle), 2,
                         0.2); // the largest of errors at nodes scatters
  tests::expect_measured("S-10 Gardner's flow: order", std::log2(middle / fine), 2, 0.2);
}

//------------------------------------------------------------------------------------------------
// Embankments
//------------------------------------------------------------------------------------------------

meshes::SectionInput two_sided_embankment()
{
  meshes::SectionInput input;
  input.ground = {{0, 7.3}, {33.5, 7.3}, {99.83, 28.6}, {107.13, 28.6}, {157.9, 7.3}, {191.4, 7.3}};
  input.base = {{0, 0}, {191.4, 0}};
  input.left_pool_level = 24.4;
  return input;
}

/// Of S-5, water 10 m deep.
meshes::SectionInput twelve_metre_dam()
{
  meshes::SectionInput input;
  input.ground = {{0, 0}, {24, 12}, {28, 12}, {52, 0}};
  input.base = {{0, 0}, {52, 0}};
  input.left_pool_level = 10;
  return input;
}

double discharge(const meshes::SectionInput& input, const Retention& retention)
{
  const seepage::Solution s = tests::solved(input, {{1, 1, 0, retention}});
  EXPECT_LT(s.balance, 1e-8);
  return s.discharge;
}

TEST(CapillaryFringe, WidensTheFlowAsAFrontOfTheSameTransmissivityDoes)
{
  // Independent program: q/k = 3.424 with k_r falling evenly to 0.01 at p = -1 m, which conducts
  // 0.505 m in the fringe; Gardner's does with alpha = 1 / 0.505 m. The shape of the fringe is
  // second to that: a sixth of what the fringe adds to 3.317.
  tests::expect_measured("S-10 embankment with a fringe: discharge / k [m]",
                         discharge(two_sided_embankment(), gardner(1 / 0.505)), 3.424, 0.107 / 6);
}

TEST(CapillaryFringe, FallsToTheSharpFreeSurfaceAsItGetsThinner)
{
  const double sharp = discharge(twelve_metre_dam(), {});
  double before = 1.777; // published analysis with a wide fringe
  for (const double alpha : {2.0, 5.0, 20.0, 200.0})
  {
    const double q = discharge(twelve_metre_dam(), gardner(alpha));
    EXPECT_LT(q, before);
    EXPECT_GT(q, sharp);
    before = q;
  }
  // 5 mm conduct about 0.005 / 10 of what 10 m of wet soil does, at most.
  tests::expect_measured("S-10 dam, thin fringe: discharge / k [m]", before, sharp, 1e-3 * sharp);
}

TEST(CapillaryFringe, OfOneZoneLiesBetweenThoseOfNoneAndAll)
{
  meshes::SectionInput input = tests::rectangular_dam(10, 10, 2);
  input.zones = {tests::box(1, 4, 0, 10, 11)};
  const auto q = [&](const Retention& left, const Retention& right) {
    return tests::solved(input, {{1, 1, 0, left}, {0.5, 0.5, 0, right}}).discharge;
  };
  const double none = q({}, {}), gardners = q({}, gardner(1)),
               both = q(van_genuchten(1, 1.5, 0.3), gardner(1)),
               van_genuchtens = q(van_genuchten(1, 1.5, 0.3), {});
  EXPECT_NEAR(none, 96 / 2. / (4 / 1. + 6 / 0.5), 2e-3 * none); // exact, S-2
  EXPECT_LT(1.002 * none, gardners); // by more than the error of the mesh
  EXPECT_LT(1.002 * none, van_genuchtens);
  EXPECT_LT(1.002 * gardners, both);
  EXPECT_LT(1.002 * van_genuchtens, both);
}

TEST(CapillaryFringe, BetweenEqualPoolsMovesNothing)
{
  meshes::SectionInput input;
  input.ground = {{0, 5}, {20, 5}, {28, 9}, {31, 9}, {39, 5}, {59, 5}};
  input.base = {{0, 0}, {59, 0}};
  input.left_pool_level = input.right_pool_level = 8;
  for (const Retention& r : {gardner(2), van_genuchten(2, 1.4, 0.02)})
  {
    const seepage::Solution s = tests::solved(input, {{1e-6, 1e-6, 0, r}});
    EXPECT_EQ(s.discharge, 0);
    for (const double head : s.head) // hydrostatic also above the water, to rounding [m]
      EXPECT_NEAR(head, 8, 1e-9);
  }
}

/// 30 m high, 3:1 and 2.5:1, water 27 m deep; a core of the second soil 6 m wide.
meshes::SectionInput thirty_metre_dam()
{
  meshes::SectionInput input;
  input.ground = {{0, 0}, {90, 30}, {98, 30}, {173, 0}};
  input.base = {{0, 0}, {173, 0}};
  input.left_pool_level = 27;
  input.zones = {tests::box(1, 91, 0, 97, 30)};
  return input;
}

// Catalogue values of Carsel and Parrish 1988 (sand, loam, clay) and the ends of what is allowed.
TEST(CapillaryFringe, OfEverySoilOfTheCatalogueConvergesOnAHighDam)
{
  const Retention sand = van_genuchten(14.5, 2.68, 0), loam = van_genuchten(3.6, 1.56, 0.02),
                  clay = van_genuchten(0.8, 1.09, 0.02);
  const Retention steep = van_genuchten(1000, 20, 1e-3), flat = van_genuchten(0.01, 1.05, 1e-3);
  for (const auto& [shell, core, k_core] : {std::tuple{sand, sand, 1e-5},
                                            {clay, clay, 1e-5},
                                            {sand, clay, 1e-8},
                                            {loam, sand, 1e-3},
                                            {steep, flat, 1e-5}})
  {
    const seepage::Solution s =
        tests::solved(thirty_metre_dam(), {{1e-5, 1e-5, 0, shell}, {k_core, k_core, 0, core}});
    EXPECT_LT(s.balance, 1e-6);
    EXPECT_GT(s.discharge, 0);
  }
}
} // namespace
} // namespace berm
