// SPDX-License-Identifier: GPL-3.0-or-later
// Random sections: what holds of every one. The seeds are fixed.
#include "meshes/mesher.h"
#include "meshes/planar.h"
#include "meshes/section.h"
#include "sph/fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <utility>

namespace berm
{
namespace
{
using meshes::polygon_area;

/// Sum of x_i y_{i+1} - x_{i+1} y_i, halved: not how the program does it.
double shoelace(const Polyline& p)
{
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    const Vec2 &a = p[i], &b = p[(i + 1) % p.size()];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return twice / 2;
}

class RandomSections : public testing::Test
{
protected:
  double between(double low, double high)
  {
    return std::uniform_real_distribution(low, high)(dice_);
  }

  /// A polygon that a centre sees all of: angles increase, radii are as they come.
  Polyline star(const Vec2& centre, double least, double most)
  {
    const int corners = 5 + static_cast<int>(dice_() % 10);
    Polyline points;
    for (int k = 0; k < corners; ++k)
    {
      const double angle = 2 * pi * (k + between(0.1, 0.9)) / corners;
      points.push_back(centre + between(least, most) * Vec2(std::cos(angle), std::sin(angle)));
    }
    return points;
  }

  /// An outline with a zone within it.
  meshes::SectionInput star_with_core()
  {
    meshes::SectionInput input;
    input.outline = star({30, 20}, 12, 20);
    input.zones.push_back({1, star({30, 20}, 1, 4)});
    return input;
  }

  /// Ground and base as lines over x.
  meshes::SectionInput hill()
  {
    meshes::SectionInput input;
    double x = 0;
    for (int k = 0; k < 7; ++k)
    {
      input.ground.emplace_back(x, between(8, 16));
      x += between(3, 12);
    }
    const double right = input.ground.back().x();
    input.base = {
        {0, between(0, 3)}, {between(0.3, 0.7) * right, between(0, 3)}, {right, between(0, 3)}};
    return input;
  }

  /// One look at each of the sections.
  void for_each_seed(const std::function<void()>& look)
  {
    for (unsigned seed = 1; seed <= 40; ++seed)
    {
      SCOPED_TRACE(seed);
      dice_.seed(seed);
      look();
    }
  }

  std::mt19937_64 dice_;
};

/// Name of the stretch of each edge, by the edge's ends in their order.
std::map<std::array<double, 4>, std::string> labels(const meshes::Section& section)
{
  std::map<std::array<double, 4>, std::string> names;
  for (std::size_t k = 0; k < section.outline.size(); ++k)
  {
    const Vec2 &a = section.outline[k], &b = section.outline[(k + 1) % section.outline.size()];
    names[{a.x(), a.y(), b.x(), b.y()}] =
        section.stretches[static_cast<std::size_t>(section.edge_stretch[k])].name;
  }
  return names;
}

TEST_F(RandomSections, AreTheSameHoweverTheirCornersAreListed)
{
  for_each_seed(
      [this]
      {
        meshes::SectionInput input = star_with_core();
        const auto expected = labels(meshes::build_section(input));
        for (Polyline* list : {&input.outline, &input.zones.front().polygon})
          for (int turn = 0; turn < 3; ++turn)
          {
            std::ranges::rotate(*list,
                                list->begin() + 1 +
                                    static_cast<std::ptrdiff_t>(dice_() % (list->size() - 1)));
            std::ranges::reverse(*list);
            const meshes::Section section = meshes::build_section(input);
            EXPECT_EQ(labels(section), expected);
            EXPECT_GT(polygon_area(section.outline), 0);
            EXPECT_NEAR(polygon_area(section.outline), std::abs(shoelace(input.outline)), 1e-9);
          }
      });
}

TEST_F(RandomSections, AreFilledWithParticlesOfTheirArea)
{
  for_each_seed(
      [this]
      {
        const meshes::Section section = meshes::build_section(hill());
        const double area = shoelace(section.outline), density = 1800;
        for (const char* packing : {"columns", "lattice"})
        {
          const sph::Particles p = sph::fill(section, 0.8, packing);
          double mass = 0;
          for (const double volume : p.volume)
            mass += density * volume;
          // Columns are exact at their middles and cells at their borders: rounding of sums is
          // left.
          EXPECT_NEAR(mass / density, area, (packing[0] == 'c' ? 2e-3 : 1e-6) * area) << packing;
        }
      });
}

#ifdef BERM_WITH_SEEPAGE
TEST_F(RandomSections, AreCoveredByTrianglesOnceWithEveryBorderNamedOnce)
{
  for_each_seed(
      [this]
      {
        const meshes::SectionInput input = star_with_core();
        const meshes::Section section = meshes::build_section(input);
        const meshes::TriangleMesh mesh = meshes::triangulate(section, 2);
        const auto at = [&](Index i) { return mesh.nodes[static_cast<std::size_t>(i)]; };

        double area = 0, core = 0;
        std::map<std::pair<Index, Index>, int> border; // edges with a triangle on their left alone
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        {
          const auto& [a, b, c] = mesh.triangles[t];
          const double one = shoelace({at(a), at(b), at(c)});
          EXPECT_GT(one, 0);
          area += one;
          core += mesh.triangle_soil[t] == 1 ? one : 0;
          for (const auto& edge : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
            if (border.erase({edge.second, edge.first}) == 0)
              ++border[edge];
        }
        EXPECT_NEAR(area, std::abs(shoelace(input.outline)), 1e-9 * area);
        EXPECT_NEAR(core, std::abs(shoelace(input.zones.front().polygon)), 1e-9 * area);

        ASSERT_EQ(mesh.boundary.size(), border.size());
        for (std::size_t e = 0; e < mesh.boundary.size(); ++e)
        {
          const auto& [a, b] = mesh.boundary[e];
          EXPECT_EQ(border.erase({std::min(a, b), std::max(a, b)}) + // whichever way gmsh lists it
                        border.erase({std::max(a, b), std::min(a, b)}),
                    1U);
          const auto near = meshes::nearest_edge(section.outline, 0.5 * (at(a) + at(b)));
          EXPECT_LT(near.distance, 1e-6);
          EXPECT_EQ(mesh.boundary_stretch[e], section.edge_stretch[near.edge]);
        }
        EXPECT_TRUE(border.empty());
      });
}
#endif

} // namespace
} // namespace berm
