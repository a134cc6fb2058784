// SPDX-License-Identifier: GPL-3.0-or-later
// What must not change, and what must hold in every solution: docs/verification.md S-7.
#include "meshes/refine.h"
#include "tests/support/measured.h"
#include "tests/verification/seepage_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace berm
{
namespace
{
using seepage::Boundary;
using seepage::BoundaryKind;
using seepage::Conductivity;
using seepage::Solution;

/// 16 m x 26 m with a core; stretches: 0 base, 1 right, 2 top, 3 left.
meshes::TriangleMesh cored_rectangle()
{
  meshes::TriangleMesh mesh = tests::rectangle_mesh(16, 26, 16, 26);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const Index i : mesh.triangles[t])
      if (const double x = mesh.nodes[static_cast<std::size_t>(i)].x(); x > 6 && x < 10)
        mesh.triangle_soil[t] = 1;
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
  {
    const Vec2 middle = (mesh.nodes[static_cast<std::size_t>(mesh.boundary[e][0])] +
                         mesh.nodes[static_cast<std::size_t>(mesh.boundary[e][1])]) /
                        2;
    mesh.boundary_stretch[e] = middle.y() == 0    ? 0
                               : middle.x() == 16 ? 1
                               : middle.y() == 26 ? 2
                                                  : 3;
  }
  return mesh;
}

const std::vector<Conductivity> soils{{1, 1, 0}, {0.1, 0.05, 0.3}};

std::vector<Boundary> conditions(double left, double right)
{
  return {{BoundaryKind::impervious, 0},
          {BoundaryKind::head, right},
          {BoundaryKind::seepage_face, 0},
          {BoundaryKind::head, left}};
}

Solution solved(const meshes::TriangleMesh& mesh, const std::vector<Conductivity>& conductivity,
                const std::vector<Boundary>& boundary)
{
  Observer observer;
  return seepage::solve_on_mesh(mesh, conductivity, boundary, observer);
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b, double shift)
{
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    worst = std::max(worst, std::abs(a[i] - b[i] - shift));
  return worst;
}

// Two solves of one problem whose rounding differs agree to the tolerance of the balance, 1e-8 of
// the discharge, which moves heads by less than 1e-7 of the drop.
constexpr double same_head = 20e-7, same_discharge = 1e-7;

TEST(SeepageInvariance, HeadsDoNotDependOnTheUnitOfConductivityDischargeIsLinearInIt)
{
  const meshes::TriangleMesh mesh = cored_rectangle();
  const Solution a = solved(mesh, soils, conditions(24, 4));
  for (const double factor : {1e-9, 3e4})
  {
    std::vector<Conductivity> scaled = soils;
    for (Conductivity& k : scaled)
    {
      k.kx *= factor;
      k.ky *= factor;
    }
    const Solution b = solved(mesh, scaled, conditions(24, 4));
    tests::expect_error("S-7 heads, another unit of k, largest difference [m]",
                        largest_difference(b.head, a.head, 0), same_head);
    EXPECT_NEAR(b.discharge / factor, a.discharge, same_discharge * a.discharge);
  }
}

TEST(SeepageInvariance, ADatumShiftShiftsTheHeads)
{
  const meshes::TriangleMesh mesh = cored_rectangle();
  const Solution a = solved(mesh, soils, conditions(24, 4));
  meshes::TriangleMesh lifted = mesh;
  for (Vec2& x : lifted.nodes)
    x.y() += 512; // exact in binary, as are the nodes
  const Solution b = solved(lifted, soils, conditions(512 + 24, 512 + 4));
  tests::expect_error("S-7 heads, datum shift, largest difference [m]",
                      largest_difference(b.head, a.head, 512), same_head);
  EXPECT_NEAR(b.discharge, a.discharge, same_discharge * a.discharge);
}

TEST(SeepageInvariance, AMirroredProblemHasMirroredHeads)
{
  const meshes::TriangleMesh mesh = cored_rectangle();
  const Solution a = solved(mesh, soils, conditions(24, 4));
  meshes::TriangleMesh mirrored = mesh; // the same numbering
  for (Vec2& x : mirrored.nodes)
    x.x() = 16 - x.x();
  for (auto& t : mirrored.triangles)
    std::swap(t[1], t[2]);
  for (auto& edge : mirrored.boundary)
    std::swap(edge[0], edge[1]);
  std::vector<Conductivity> turned = soils;
  for (Conductivity& k : turned)
    k.angle *= -1;
  const Solution b = solved(mirrored, turned, conditions(24, 4));
  tests::expect_error("S-7 heads, mirror image, largest difference [m]",
                      largest_difference(b.head, a.head, 0), same_head);
  EXPECT_NEAR(b.discharge, a.discharge, same_discharge * a.discharge);
  ASSERT_TRUE(a.exit_point && b.exit_point);
  EXPECT_NEAR(b.exit_point->x(), 16 - a.exit_point->x(), 1e-6);
  EXPECT_NEAR(b.exit_point->y(), a.exit_point->y(), 1e-6);
}

TEST(SeepageInvariance, AConstantHeadIsHydrostaticAndNothingFlows)
{
  const meshes::TriangleMesh mesh = cored_rectangle();
  for (const double level : {13.3, 24.0, 40.0}) // within the section, at a node, above it all
  {
    std::vector<Boundary> boundary = conditions(level, level);
    boundary[2] = {BoundaryKind::head, level};
    const Solution s = solved(mesh, soils, boundary);
    EXPECT_EQ(s.discharge, 0);
    EXPECT_EQ(s.inflow, 0);
    EXPECT_EQ(s.outflow, 0);
    EXPECT_EQ(s.balance, 0);
    tests::expect_error("S-7 constant head: heads, largest error [m]",
                        largest_difference(s.head, std::vector(s.head.size(), level), 0), 1e-10);
  }
}

TEST(SeepageInvariance, WhatEntersLeaves)
{
  const Solution s = solved(cored_rectangle(), soils, conditions(24, 4));
  tests::expect_error("S-7 water balance", s.balance, 1e-8);
  EXPECT_NEAR(std::accumulate(s.stretch_inflow.begin(), s.stretch_inflow.end(), 0.0), 0,
              1e-8 * s.discharge);
  EXPECT_NEAR(s.stretch_inflow[3], s.discharge, 1e-8 * s.discharge);
  EXPECT_EQ(s.stretch_inflow[0], 0);
}

TEST(SeepageInvariance, OnASeepageFacePressureIsNowherePositiveAndWaterOnlyComesOut)
{
  meshes::SectionInput input = tests::rectangular_dam(16, 24, 0);
  const meshes::Section section = meshes::build_section(input);
  Observer observer;
  const Solution s =
      seepage::solve(section, {{1, 1, 0}}, seepage::boundary_conditions(section, {}), {}, observer);
  for (std::size_t k = 0; k < section.stretches.size(); ++k)
    if (section.stretches[k].kind == meshes::StretchKind::ground)
    {
      EXPECT_NEAR(s.stretch_inflow[k], -s.discharge, 1e-8 * s.discharge);
      for (std::size_t e = 0; e < s.mesh.boundary.size(); ++e)
        for (const Index i : s.mesh.boundary[e])
          if (s.mesh.boundary_stretch[e] == static_cast<Index>(k))
          {
            EXPECT_LE(s.pore_pressure[static_cast<std::size_t>(i)], 0);
          }
    }
  ASSERT_TRUE(s.exit_point);
  for (std::size_t i = 0; i < s.mesh.nodes.size(); ++i) // wet below the exit, dry above it
    if (s.mesh.nodes[i].x() == 16 && std::abs(s.mesh.nodes[i].y() - s.exit_point->y()) > 0.15)
    {
      EXPECT_EQ(s.pore_pressure[i] == 0, s.mesh.nodes[i].y() < s.exit_point->y());
    }
}

TEST(SeepageInvariance, RainOnADryBankComesOutBelow)
{
  // Inflow through the top: both faces drain it by halves to equal tailwaters.
  const meshes::TriangleMesh coarse = cored_rectangle();
  const meshes::TriangleMesh mesh =
      meshes::refined(coarse, std::vector<std::uint8_t>(coarse.triangles.size(), 1)).mesh;
  std::vector<Boundary> boundary = conditions(4, 4);
  boundary[2] = {BoundaryKind::inflow, 0.02};
  const Solution s = solved(mesh, {{1, 1, 0}, {1, 1, 0}}, boundary);
  EXPECT_NEAR(s.discharge, 0.02 * 16, 1e-7);
  EXPECT_NEAR(s.stretch_inflow[2], 0.02 * 16, 1e-12);
  // The diagonals of the mesh are not symmetric.
  EXPECT_NEAR(s.stretch_inflow[1], s.stretch_inflow[3], 0.02 * 0.02 * 16);
  // Dupuit's mound, which neglects the vertical gradients: some percent of its height over the
  // tailwater.
  const double mound = std::sqrt(4 * 4 + 0.02 * 8 * 8);
  EXPECT_NEAR(seepage::phreatic_level(s, 8).value(), mound, 0.2 * (mound - 4));
}

//------------------------------------------------------------------------------------------------
// The free surface on structured meshes: size and rate, not of one lucky mesh.
//------------------------------------------------------------------------------------------------

TEST(SeepageConvergence, OfTheRectangularDamWithUniformElements)
{
  // H = 24, L = 16, tailwater 4: q = 17.5 exactly. Elements of H/24, H/48, H/96.
  std::vector<double> level_error;
  for (const auto& [n, bound] :
       {std::pair{24, 2e-3}, std::pair{48, 5e-4}, std::pair{96, 1.25e-4}}) // order 2
  {
    meshes::TriangleMesh mesh = tests::rectangle_mesh(16, 25, 2 * n / 3, n + n / 24);
    for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
    {
      const Vec2 middle = (mesh.nodes[static_cast<std::size_t>(mesh.boundary[e][0])] +
                           mesh.nodes[static_cast<std::size_t>(mesh.boundary[e][1])]) /
                          2;
      mesh.boundary_stretch[e] = middle.y() == 0    ? 0
                                 : middle.x() == 16 ? 1
                                 : middle.y() == 25 ? 2
                                                    : 3;
    }
    const Solution s = solved(mesh, {{1, 1, 0}}, conditions(24, 4));
    tests::expect_measured(fmt::format("S-1 uniform elements, H/{}: discharge / k [m]", n),
                           s.discharge, 17.5, bound * 17.5);
    level_error.push_back(tests::largest_level_error(s, {{2, 23.4109},
                                                         {4, 22.5911},
                                                         {6, 21.5972},
                                                         {8, 20.4304},
                                                         {10, 19.0715},
                                                         {12, 17.4754},
                                                         {14, 15.5338}}));
  }
  // First order: at every size a twentieth of an element, for the free surface cuts elements
  // anywhere.
  for (std::size_t k = 0; k < 3; ++k)
    tests::expect_error(
        fmt::format("S-1 uniform elements, H/{}: free surface, largest error [m]", 24 << k),
        level_error[k], 0.05 / std::pow(2, k));
}
} // namespace
} // namespace berm
