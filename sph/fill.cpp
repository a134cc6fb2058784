// SPDX-License-Identifier: GPL-3.0-or-later
#include "sph/fill.h"

#include "core/error.h"
#include "sph/relax.h"
#include "sph/seeds.h"
#include "sph/voronoi.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numeric>
#include <utility>

namespace berm::sph
{
namespace
{
void add(Particles& particles, const meshes::Section& section, const Vec2& point, double volume)
{
  particles.x.push_back(point.x());
  particles.y.push_back(point.y());
  particles.volume.push_back(volume);
  particles.density.push_back(0);
  particles.soil.push_back(meshes::soil_at(section, point));
}

/// Area of the section inside a box [m2].
double clipped_area(const meshes::Section& section, const Vec2& lower, const Vec2& upper)
{
  return meshes::polygon_area(meshes::clip_to_box(section.outline, lower, upper));
}

/// Where column borders must fall: the ends of the section and the vertical steps between them.
std::vector<double> column_breaks(const meshes::Section& section)
{
  std::vector<double> breaks = {section.x_min, section.x_max};
  for (const Polyline* chain : {&section.ground, &section.base})
    for (std::size_t k = 1; k < chain->size(); ++k)
      if ((*chain)[k].x() == (*chain)[k - 1].x())
        breaks.push_back((*chain)[k].x());
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  return breaks;
}

void fill_columns(const meshes::Section& section, Particles& particles)
{
  const double dx = particles.spacing;
  const std::vector<double> breaks = column_breaks(section);
  for (std::size_t b = 1; b < breaks.size(); ++b)
  {
    const double length = breaks[b] - breaks[b - 1];
    const int columns = std::max(1, static_cast<int>(std::lround(length / dx)));
    const double width = length / columns;
    for (int c = 0; c < columns; ++c)
    {
      const double left = breaks[b - 1] + c * width, x = left + 0.5 * width;
      // The mean height over the column's width keeps the mass exact where the ground has a kink.
      const double height =
          clipped_area(section, {left, section.y_min}, {left + width, section.y_max}) / width;
      if (height < 0.5 * dx) // the feather edge of a toe
        continue;
      const int rows = std::max(1, static_cast<int>(std::lround(height / dx)));
      const double dy = height / rows, foot = meshes::base_level(section, x);
      for (int r = 0; r < rows; ++r)
        add(particles, section, {x, foot + (r + 0.5) * dy}, width * dy);
    }
  }
}

/// Passes of relaxation: a lattice only has to fit the outline, a disordered seeding all over.
constexpr int fitting_passes = 10, evening_passes = 20, unloading_passes = 100;

[[noreturn]] void refuse_spacing(double spacing, std::string problem, std::string hint)
{
  throw InputError({{.key = "sph.spacing_m",
                     .value = fmt::format("{}", spacing),
                     .problem = std::move(problem),
                     .allowed = {},
                     .hint = std::move(hint)}});
}

void check_spacing(const meshes::Section& section, double spacing)
{
  const double height = section.y_max - section.y_min;
  if (spacing > height / 5)
    refuse_spacing(
        spacing, fmt::format("too coarse: the section is {:.4g} m high", height),
        fmt::format("at least 5 particles over the height; {:.3g} m gives 40", height / 40));
  const double count = meshes::polygon_area(section.outline) / (spacing * spacing);
  if (count > 2e7)
    refuse_spacing(spacing, fmt::format("would need {:.2g} particles", count),
                   "at most 2e7; take a larger spacing");
}

/// The walls mirror the soil in a base that is a function of x.
void check_base(const meshes::Section& section)
{
  for (std::size_t k = 1; k < section.base.size(); ++k)
    if (section.base[k].x() < section.base[k - 1].x())
      throw InputError({{.key = "section.outline_m",
                         .value = {},
                         .problem = fmt::format("the base folds back under the soil at x = {:.6g}",
                                                section.base[k - 1].x()),
                         .allowed = {},
                         .hint = "particles need a base that is a function of x: draw it without "
                                 "the hollow"}});
}
} // namespace

double default_spacing(const meshes::Section& section)
{
  return (section.y_max - section.y_min) / 40;
}

Particles fill(const meshes::Section& section, double spacing, const std::string& packing)
{
  const std::string chosen =
      packing == "auto" ? (section.single_valued ? "columns" : "lattice") : packing;
  if (chosen == "columns" && !section.single_valued)
    throw InputError({{.key = "sph.packing",
                       .value = "columns",
                       .problem = "the section has an overhang, which columns cannot fill",
                       .allowed = "auto, lattice, hexagonal, mesh",
                       .hint = "leave sph.packing out"}});
  check_spacing(section, spacing);
  check_base(section);
  if (chosen == "columns")
  {
    Particles particles;
    particles.spacing = spacing;
    particles.packing = chosen;
    fill_columns(section, particles);
    return particles;
  }
  std::vector<Vec2> seeds =
      chosen == "hexagonal" ? hexagonal_seeds(section, spacing) : square_seeds(section, spacing);
  return fill_cells(section, relax(section, std::move(seeds), spacing, fitting_passes), spacing,
                    chosen);
}

Particles fill_from_seeds(const meshes::Section& section, std::vector<Vec2> seeds, double spacing,
                          const std::string& packing)
{
  check_spacing(section, spacing);
  check_base(section);
  std::vector<Vec2> points = relax(section, std::move(seeds), spacing, evening_passes);
  points = unload(section, std::move(points), spacing, unloading_passes);
  return fill_cells(section, points, spacing, packing);
}

Particles fill_cells(const meshes::Section& section, std::span<const Vec2> points, double spacing,
                     const std::string& packing)
{
  Particles particles;
  particles.spacing = spacing;
  particles.packing = packing;
  const std::vector<VoronoiCell> cells = voronoi_cells(section, points, spacing);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [&](std::size_t i) {
    return std::pair{std::floor((points[i].x() - section.x_min) / spacing), points[i].y()};
  };
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return place(i) < place(j); });
  for (const std::size_t i : order)
    if (cells[i].area > 0)
      add(particles, section, points[i], cells[i].area);
  return particles;
}
} // namespace berm::sph
