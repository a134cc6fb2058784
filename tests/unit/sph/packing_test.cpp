// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.h"
#include "sph/fill.h"
#include "sph/packing_check.h"
#include "sph/relax.h"
#include "sph/seeds.h"
#include "sph/voronoi.h"
#include "tests/support/meshes.h"
#include "tests/support/sections.h"

#include <gtest/gtest.h>
#include <omp.h>

namespace berm::sph
{
namespace
{
/// A cliff with an overhang of 2 m on a foundation.
meshes::Section overhang()
{
  meshes::SectionInput input;
  input.outline = {{0, 0}, {20, 0}, {20, 5}, {12, 5}, {14, 9}, {6, 9}, {6, 5}, {0, 5}};
  return meshes::build_section(input);
}

double area_of(const meshes::Section& section)
{
  return meshes::polygon_area(section.outline);
}

double area_of(const std::vector<VoronoiCell>& cells)
{
  double sum = 0;
  for (const VoronoiCell& cell : cells)
    sum += cell.area;
  return sum;
}

double min_distance(const Particles& p)
{
  double least2 = 1e300;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      least2 = std::min(least2, (Vec2{p.x[i], p.y[i]} - Vec2{p.x[j], p.y[j]}).squaredNorm());
  return std::sqrt(least2) / p.spacing;
}

Discretisation discretise_dry(Particles& p, const meshes::Section& section)
{
  const Soil soil = tests::embankment_soil();
  tests::set_density(p, soil.density);
  const std::vector<Soil> soils = {soil};
  return discretise(p, soils, std::vector<double>(p.size(), 0.0), section);
}

void require_sound(Particles& p, const meshes::Section& section)
{
  const Discretisation d = discretise_dry(p, section);
  require_sound_packing(measure_packing(p, d, section), p);
}

/// What the message of the refusal names; empty if nothing is refused.
std::string refusal(Particles p, const meshes::Section& section)
{
  try
  {
    require_sound(p, section);
  }
  catch (const InputError& error)
  {
    return error.what();
  }
  return {};
}
} // namespace

TEST(Voronoi, CellsOfALatticeAreItsSquares)
{
  const meshes::Section section = tests::block(6, 3);
  const std::vector<Vec2> points = square_seeds(section, 0.5);
  ASSERT_EQ(points.size(), 72u);
  for (const VoronoiCell& cell : voronoi_cells(section, points, 0.5))
    EXPECT_NEAR(cell.area, 0.25, 1e-12);
}

TEST(Voronoi, CellOfASinglePointIsTheSection)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  const std::vector<Vec2> points = {{50, 10}};
  const std::vector<VoronoiCell> cells = voronoi_cells(section, points, 1);
  EXPECT_NEAR(cells[0].area / area_of(section), 1, 1e-12);
}

TEST(Voronoi, CellsSumToTheSectionForAnyPoints)
{
  for (const meshes::Section& section : {overhang(), meshes::build_section(tests::embankment())})
    for (const double width : {0.0, 0.5, 2.0})
    {
      const std::vector<Vec2> points = jittered(section, square_seeds(section, 1), width, 7);
      EXPECT_NEAR(area_of(voronoi_cells(section, points, 1)) / area_of(section), 1, 1e-12);
    }
}

TEST(Voronoi, CellsMatchARaster)
{
  const meshes::Section section = overhang();
  const std::vector<Vec2> points = jittered(section, square_seeds(section, 1), 1, 3);
  std::vector<double> raster(points.size(), 0.0);
  const double step = 0.02;
  for (double x = section.x_min + step / 2; x < section.x_max; x += step)
    for (double y = section.y_min + step / 2; y < section.y_max; y += step)
    {
      const Vec2 p{x, y};
      if (!meshes::polygon_contains(section.outline, p))
        continue;
      std::size_t best = 0;
      for (std::size_t i = 1; i < points.size(); ++i)
        if ((points[i] - p).squaredNorm() < (points[best] - p).squaredNorm())
          best = i;
      raster[best] += step * step;
    }
  const std::vector<VoronoiCell> cells = voronoi_cells(section, points, 1);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(cells[i].area, raster[i], 0.02) << "point " << i;
}

TEST(Relax, KeepsPointsInsideAndApart)
{
  for (const meshes::Section& section : {overhang(), meshes::build_section(tests::embankment())})
  {
    const double dx = (section.y_max - section.y_min) / 12;
    for (const double width : {0.0, 0.3, 1.0})
    {
      const Particles p = fill_from_seeds(
          section, jittered(section, square_seeds(section, dx), width * dx, 5), dx, "jittered");
      for (std::size_t i = 0; i < p.size(); ++i)
        EXPECT_TRUE(meshes::polygon_contains(section.outline, {p.x[i], p.y[i]}));
      EXPECT_GT(min_distance(p), 0.65) << "jitter " << width;
      EXPECT_NEAR(tests::total(p.volume) / area_of(section), 1, 1e-12);
      EXPECT_GT(*std::min_element(p.volume.begin(), p.volume.end()), 0.5 * dx * dx);
      EXPECT_LT(*std::max_element(p.volume.begin(), p.volume.end()), 1.6 * dx * dx);
    }
  }
}

TEST(Relax, LeavesAPerfectLatticeAlone)
{
  const meshes::Section section = tests::block(10, 5);
  const std::vector<Vec2> points = square_seeds(section, 0.5);
  const std::vector<Vec2> relaxed = relax(section, points, 0.5, 10);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR((relaxed[i] - points[i]).norm(), 0, 1e-9);
}

TEST(Relax, GivesTheSameBitsForAnyNumberOfThreads)
{
  const meshes::Section section = overhang();
  const std::vector<Vec2> seeds = jittered(section, square_seeds(section, 0.4), 0.2, 11);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const std::vector<Vec2> one = relax(section, seeds, 0.4, 20);
  omp_set_num_threads(3);
  const std::vector<Vec2> three = relax(section, seeds, 0.4, 20);
  omp_set_num_threads(before);
  EXPECT_EQ(one, three);
}

TEST(Seeds, StandForOneSquareOfTheSpacingEach)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  for (const auto& seeds : {square_seeds(section, 0.7), hexagonal_seeds(section, 0.7)})
    EXPECT_NEAR(static_cast<double>(seeds.size()) * 0.49 / area_of(section), 1, 0.03);
}

TEST(Seeds, OfAMeshAreItsInnerNodes)
{
  const meshes::Section section = tests::block(8, 4);
  const std::vector<Vec2> seeds = mesh_seeds(tests::rectangle_mesh(section, 8, 4));
  ASSERT_EQ(seeds.size(), 7u * 3u);
  for (const Vec2& p : seeds)
    EXPECT_TRUE(p.x() > 0.5 && p.x() < 7.5 && p.y() > 0.5 && p.y() < 3.5);
}

TEST(PackingCheck, AcceptsColumnsLatticesAndRelaxedDisorder)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  for (const char* packing : {"columns", "lattice", "hexagonal"})
  {
    Particles p = fill(section, 1, packing);
    EXPECT_NO_THROW(require_sound(p, section)) << packing;
  }
  for (const double width : {0.1, 0.3})
  {
    Particles p = fill_from_seeds(section, jittered(section, square_seeds(section, 1), width, 2), 1,
                                  "jittered");
    EXPECT_NO_THROW(require_sound(p, section)) << "jitter " << width;
    // A fifth of what is refused: no grains whose borders carry no even stress.
    EXPECT_LT(measure_packing(p, discretise_dry(p, section), section).residual, 0.0032);
  }
}

TEST(PackingCheck, RefusesDisorderThatWouldLie)
{
  const meshes::Section section = meshes::build_section(tests::embankment());
  for (const double width : {0.1, 0.2, 0.3})
  {
    const std::string text = refusal(
        fill_cells(section, jittered(section, square_seeds(section, 1), width, 2), 1, "raw"),
        section);
    EXPECT_NE(text.find("sph.packing = raw"), std::string::npos) << "jitter " << width;
    EXPECT_NE(text.find("residual force"), std::string::npos);
  }
}

TEST(PackingCheck, RefusesPairsOfParticles)
{
  const meshes::Section section = tests::block(10, 5);
  std::vector<Vec2> points = square_seeds(section, 0.5);
  points[50] = points[51] + Vec2{0.05, 0};
  const std::string text = refusal(fill_cells(section, points, 0.5, "raw"), section);
  EXPECT_NE(text.find("only 0.1 spacings apart"), std::string::npos) << text;
}

TEST(PackingCheck, RefusesASettlementThatElasticSoilDoesNotHave)
{
  const meshes::Section section = tests::block(10, 5);
  Particles p = fill(section, 0.5, "columns");
  const Discretisation d = discretise_dry(p, section);
  EXPECT_NO_THROW(require_sound_settlement(0.4 * d.d_ref, d, p));
  EXPECT_THROW(require_sound_settlement(4 * d.d_ref, d, p), InputError);
}

TEST(Fill, RefusesABaseThatFoldsBack)
{
  meshes::SectionInput input;
  input.outline = {{0, 0}, {8, 0}, {5, 3}, {15, 3}, {12, 0}, {20, 0}, {20, 8}, {0, 8}};
  const meshes::Section section = meshes::build_section(input);
  EXPECT_THROW((void)fill(section, 0.5, "auto"), InputError);
}
} // namespace berm::sph
