// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/mesher.h"

#include "core/error.h"
#include "meshes/boundary_walk.h"
#include "sections.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <omp.h>
#include <random>
#include <set>

namespace berm::meshes
{
namespace
{
using namespace berm::tests;
using Edge = std::array<Index, 2>;

const Vec2& node(const TriangleMesh& mesh, Index i)
{
  return mesh.nodes[static_cast<std::size_t>(i)];
}

double area_of(const TriangleMesh& mesh, const std::array<Index, 3>& t)
{
  return polygon_area({node(mesh, t[0]), node(mesh, t[1]), node(mesh, t[2])});
}

/// Area of each soil in the mesh [m2].
std::map<Index, double> soil_areas(const TriangleMesh& mesh)
{
  std::map<Index, double> areas;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    areas[mesh.triangle_soil[t]] += area_of(mesh, mesh.triangles[t]);
  return areas;
}

/// 4 sqrt(3) area / (sum of squared edges): 1 for an equilateral triangle, 0 for a flat one.
double worst_quality(const TriangleMesh& mesh)
{
  double worst = 1;
  for (const auto& t : mesh.triangles)
  {
    const Vec2 &a = node(mesh, t[0]), &b = node(mesh, t[1]), &c = node(mesh, t[2]);
    worst = std::min(worst,
                     4 * std::sqrt(3.0) * area_of(mesh, t) /
                         ((b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm()));
  }
  return worst;
}

/// What every mesh of a section in one piece has to be.
void expect_valid(const TriangleMesh& mesh, const Section& section)
{
  ASSERT_EQ(mesh.triangle_soil.size(), mesh.triangles.size());
  ASSERT_EQ(mesh.boundary_stretch.size(), mesh.boundary.size());
  double area = 0;
  std::vector<int> uses(mesh.nodes.size(), 0);
  std::map<Edge, int> edges; // directed
  for (const auto& t : mesh.triangles)
  {
    EXPECT_GT(area_of(mesh, t), 0);
    area += area_of(mesh, t);
    for (std::size_t k = 0; k < 3; ++k)
    {
      ++uses[static_cast<std::size_t>(t[k])];
      ++edges[{t[k], t[(k + 1) % 3]}];
    }
  }
  EXPECT_NEAR(area, polygon_area(section.outline), 1e-9 * area);
  EXPECT_EQ(std::count(uses.begin(), uses.end(), 0), 0) << "nodes without a triangle";

  // Conforming: each directed edge once; those without a partner are the boundary, soil on the
  // left.
  std::set<Edge> outer, boundary(mesh.boundary.begin(), mesh.boundary.end());
  std::size_t undirected = 0;
  for (const auto& [edge, count] : edges)
  {
    EXPECT_EQ(count, 1);
    const bool shared = edges.contains({edge[1], edge[0]});
    undirected += !shared || edge[0] < edge[1];
    if (!shared)
      outer.insert(edge);
  }
  EXPECT_EQ(outer, boundary);
  EXPECT_EQ(boundary.size(), mesh.boundary.size());
  // Each wall in the soil is a hole of the mesh, which would be a disk without.
  const std::size_t holes = boundary_loops(mesh).size() - 1;
  EXPECT_EQ(mesh.nodes.size() + mesh.triangles.size() + holes, undirected + 1)
      << "Euler characteristic";

  for (const Vec2& p : section.outline)
    EXPECT_TRUE(std::find(mesh.nodes.begin(), mesh.nodes.end(), p) != mesh.nodes.end())
        << "no node at " << p.transpose();
  std::map<std::string, double> lengths;
  for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
    lengths[section.stretches[static_cast<std::size_t>(mesh.boundary_stretch[e])].name] +=
        (node(mesh, mesh.boundary[e][1]) - node(mesh, mesh.boundary[e][0])).norm();
  std::map<std::string, double> wanted;
  for (const Stretch& stretch : section.stretches)
    wanted[stretch.name] = stretch_length(section, stretch.name);
  for (const InnerLine& line : section.inner_lines) // both sides
    for (std::size_t k = 1; k < line.points.size(); ++k)
      wanted[section.stretches[static_cast<std::size_t>(line.stretch)].name] +=
          2 * (line.points[k] - line.points[k - 1]).norm();
  for (const auto& [name, length] : wanted)
    EXPECT_NEAR(lengths[name], length, 1e-9 * area) << name;
}

/// Zone borders are never cut: the soil is the same near all corners of each triangle.
void expect_pure(const TriangleMesh& mesh, const Section& section)
{
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto& corners = mesh.triangles[t];
      const Vec2 p = 0.9 * node(mesh, corners[k]) + 0.05 * node(mesh, corners[(k + 1) % 3]) +
                     0.05 * node(mesh, corners[(k + 2) % 3]);
      EXPECT_EQ(soil_at(section, p), mesh.triangle_soil[t]) << p.transpose();
    }
}

SectionInput dam_with_core_and_filter()
{
  SectionInput input = trapezoidal_dam();
  input.zones = {{1, {{48, 0}, {52, 18}, {58, 18}, {62, 0}}},      // a core inside
                 {2, {{55, -1}, {70, -1}, {70, 2}, {55, 2}}},      // a filter over its foot
                 {3, {{70, -5}, {70, 30}, {120, 30}, {120, -5}}}}; // the toe, drawn too large
  return input;
}

//------------------------------------------------------------------------------------------------

TEST(Mesher, IsCutOpenAlongInnerLinesAcrossZonesAtEverySize)
{
  SectionInput input = dam_with_core_and_filter();
  input.marked_lines = {{{55, 20}, {55, 10}, {52, 4}}, // a wall from the crest through the core
                        {{40, 5}, {80, 5}},            // across everything, and the wall's zone
                        {{54, 8}, {56.5, 8}},          // over the wall, inside the core
                        {{60, 0.5}, {61, 0.5}}};       // short, in the filter
  const Section section = build_section(input);
  ASSERT_EQ(section.inner_lines.size(), 4U);
  for (const double size : {10.0, 2.0, 0.35}) // the last one halved
  {
    const TriangleMesh mesh = triangulate(section, size);
    expect_valid(mesh, section);
    expect_pure(mesh, section);
  }
}

TEST(Mesher, CoversEachSectionOnceWithItsBoundary)
{
  SectionInput embankment = two_sided_embankment();
  embankment.left_pool_level = 24.4;
  embankment.marked_lines = {{{191.4, 0}, {191.4, 7.3}}};
  SectionInput rectangle = rectangle_input(16, 24);
  rectangle.left_pool_level = 24;
  rectangle.right_pool_level = 4;
  SectionInput overhang;
  overhang.outline = {{0, 0}, {10, 0}, {10, 5}, {6, 5}, {7, 8}, {5, 8}, {4, 5}, {0, 5}};
  for (const SectionInput& input : {embankment, mirrored(embankment), rectangle, overhang,
                                    trapezoidal_dam(), dam_with_core_and_filter()})
  {
    const Section section = build_section(input);
    const TriangleMesh mesh = triangulate(section, 1.5);
    expect_valid(mesh, section);
    expect_pure(mesh, section);
    EXPECT_GT(worst_quality(mesh), 0.5);
  }
}

TEST(Mesher, StaysValidWhereItHalvesTheEdgesOfACoarserMesh)
{
  SectionInput input = dam_with_core_and_filter();
  input.left_pool_level = 18.5;
  const Section section = build_section(input);
  for (const double h : {0.3, 0.15}) // once and twice
  {
    const TriangleMesh mesh = triangulate(section, h);
    // Equilateral triangles: sqrt(3)/2 h^2 for each node.
    EXPECT_NEAR(static_cast<double>(mesh.nodes.size()), 1100 / (std::sqrt(0.75) * h * h),
                0.15 * 1100 / (std::sqrt(0.75) * h * h));
    expect_valid(mesh, section);
    EXPECT_GT(worst_quality(mesh), 0.5);
    const auto areas = soil_areas(mesh);
    EXPECT_NEAR(areas.at(3), 225, 1e-9);
  }
}

TEST(Mesher, GivesEachSoilItsArea)
{
  const auto areas = soil_areas(triangulate(build_section(dam_with_core_and_filter()), 2));
  // Core 18 (6 + 14) / 2, less what the filter covers: width 7 at the base, falling by 4/18 a
  // metre.
  const double under_filter = 2 * (7 + (7 - 2 * 4.0 / 18)) / 2;
  EXPECT_NEAR(areas.at(1), 180 - under_filter, 1e-9);
  EXPECT_NEAR(areas.at(2), 15 * 2, 1e-9);
  EXPECT_NEAR(areas.at(3), 0.5 * 30 * 15, 1e-9);
  EXPECT_NEAR(areas.at(0), 1100 - 180 + under_filter - 30 - 225, 1e-9);
}

TEST(Mesher, PutsANodeAtEveryVisibleZoneCorner)
{
  const Section section = build_section(dam_with_core_and_filter());
  const TriangleMesh mesh = triangulate(section, 5);
  for (const Vec2& p : {Vec2(52, 18), Vec2(58, 18), Vec2(55, 2), Vec2(70, 2), Vec2(70, 15),
                        Vec2(62 - 2 * 4.0 / 18, 2)})
    EXPECT_TRUE(std::any_of(mesh.nodes.begin(), mesh.nodes.end(),
                            [&](const Vec2& q) { return (p - q).norm() < 1e-9; }))
        << p.transpose();
}

TEST(Mesher, AcceptsZonesThatShareEdgesNestOrCoverAll)
{
  SectionInput input = rectangle_input(12, 6);
  input.zones = {{4, {{-1, -1}, {13, -1}, {13, 7}, {-1, 7}}}, // all of it
                 {1, {{0, 0}, {4, 0}, {4, 6}, {0, 6}}},       // flush with the outline
                 {2, {{4, 0}, {8, 0}, {8, 6}, {4, 3}}},       // a common part of an edge
                 {3, {{9, 1}, {11, 1}, {11, 3}, {9, 3}}},     // an island
                 {1, {{9.5, 1.5}, {10.5, 1.5}, {10.5, 2.5}, {9.5, 2.5}}}}; // and one in it
  const Section section = build_section(input);
  const TriangleMesh mesh = triangulate(section, 0.7);
  expect_valid(mesh, section);
  expect_pure(mesh, section);
  const auto areas = soil_areas(mesh);
  EXPECT_NEAR(areas.at(1), 24 + 1, 1e-10);
  EXPECT_NEAR(areas.at(2), 4 * (3 + 6) / 2.0, 1e-10);
  EXPECT_NEAR(areas.at(3), 4 - 1, 1e-10);
  EXPECT_FALSE(areas.contains(0));
}

TEST(Mesher, RefinesAlongAThinZone)
{
  SectionInput input = two_sided_embankment();
  input.zones = {{1, {{60, 0}, {60.5, 0}, {60.5, 12}, {60, 12}}}}; // a cut-off wall
  const Section section = build_section(input);
  const TriangleMesh mesh = triangulate(section, 4);
  expect_valid(mesh, section);
  EXPECT_NEAR(soil_areas(mesh).at(1), 0.5 * 12, 1e-10);
  EXPECT_GT(worst_quality(mesh), 0.5); // 0.09 where the elements are 4 m along the wall
  EXPECT_LT(mesh.nodes.size(), 1000U);
}

TEST(Mesher, MeshesAMembraneAFewMillimetresThick)
{
  SectionInput input = trapezoidal_dam();
  input.zones = {{1, {{55, 0}, {55.005, 0}, {55.005, 18}, {55, 18}}}};
  const Section section = build_section(input);
  const TriangleMesh mesh = triangulate(section, 2);
  expect_valid(mesh, section);
  EXPECT_NEAR(soil_areas(mesh).at(1), 0.005 * 18, 1e-10);
}

TEST(Mesher, ConformsToRandomOverlappingZones)
{
  std::mt19937 random(7);
  const auto uniform = [&](double a, double b)
  { return a + (b - a) * static_cast<double>(random()) / 4294967296.0; };
  for (int sample = 0; sample < 10; ++sample)
  {
    SectionInput input = trapezoidal_dam();
    for (Index z = 1; z <= 4; ++z)
    {
      Zone zone{z, {}};
      const Vec2 centre(uniform(20, 80), uniform(0, 12));
      for (int corner = 0; corner < 5; ++corner) // star-shaped, so simple
      {
        const double radius = uniform(4, 12), angle = 2 * pi * (corner + uniform(0, 0.5)) / 5;
        zone.polygon.emplace_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
      }
      input.zones.push_back(zone);
    }
    const Section section = build_section(input);
    const TriangleMesh mesh = triangulate(section, 3);
    expect_valid(mesh, section);
    expect_pure(mesh, section);
  }
}

//------------------------------------------------------------------------------------------------

TEST(Mesher, IsAsCoarseEverywhereAsAskedFor)
{
  const Section section = build_section(rectangle_input(20, 20));
  const TriangleMesh mesh = triangulate(section, 1);
  // The area over that of equilateral triangles; within 7 %, since gmsh fits rows to the sides.
  EXPECT_NEAR(static_cast<double>(mesh.triangles.size()), 400 / std::sqrt(3.0 / 16), 60);
  EXPECT_EQ(mesh.boundary.size(), 80U);
}

TEST(Mesher, GivesTheSameBitsTwice)
{
  const Section section = build_section(dam_with_core_and_filter());
  for (const double h : {2.0, 0.2})
  {
    const TriangleMesh one = triangulate(section, h), two = triangulate(section, h);
    EXPECT_EQ(one.nodes, two.nodes);
    EXPECT_EQ(one.triangles, two.triangles);
    EXPECT_EQ(one.triangle_soil, two.triangle_soil);
    EXPECT_EQ(one.boundary, two.boundary);
    EXPECT_EQ(one.boundary_stretch, two.boundary_stretch);
  }
}

TEST(Mesher, ScalesWithTheSection)
{
  SectionInput input = dam_with_core_and_filter();
  for (Polyline* line : {&input.ground, &input.base, &input.zones[0].polygon,
                         &input.zones[1].polygon, &input.zones[2].polygon})
    for (Vec2& p : *line)
      p *= 1e-3; // a model of 10 cm
  const Section section = build_section(input);
  const TriangleMesh mesh = triangulate(section, 2e-3);
  const TriangleMesh full = triangulate(build_section(dam_with_core_and_filter()), 2);
  EXPECT_NEAR(soil_areas(mesh).at(3), 225e-6, 1e-15);
  EXPECT_NEAR(static_cast<double>(mesh.nodes.size()), static_cast<double>(full.nodes.size()), 20);
}

TEST(Mesher, PrintsNothing)
{
  const Section section = build_section(dam_with_core_and_filter());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  (void)triangulate(section, 3);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Mesher, LeavesTheNumberOfThreadsAsItWas)
{
  const Section section = build_section(trapezoidal_dam());
  for (const int threads : {1, 3})
  {
    omp_set_num_threads(threads);
    (void)triangulate(section, 3);
    EXPECT_EQ(omp_get_max_threads(), threads);
  }
}

TEST(Mesher, RejectsAnEdgeLengthThatIsNone)
{
  const Section section = build_section(trapezoidal_dam());
  for (const double h : {0.0, -1.0, std::nan("")})
    EXPECT_THROW((void)triangulate(section, h), InputError);
}

TEST(RectangleMesh, IsAMeshOfItsSection)
{
  SectionInput input = rectangle_input(8, 6);
  input.left_pool_level = 5;
  input.right_pool_level = 2;
  input.zones = {{1, {{0, 0}, {8, 0}, {8, 3}, {0, 3}}}};
  const Section section = build_section(input);
  const TriangleMesh mesh = rectangle_mesh(section, 8, 12);
  expect_valid(mesh, section);
  EXPECT_NEAR(soil_areas(mesh).at(1), 24, 1e-12);
  EXPECT_EQ(rectangle_mesh(8, 6, 4, 3).triangles.size(), 24U);
}
} // namespace
} // namespace berm::meshes
