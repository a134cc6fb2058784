// SPDX-License-Identifier: GPL-2.0-or-later
#include "sph/fill.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

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

void fill_lattice(const meshes::Section& section, Particles& particles)
{
  const double dx = particles.spacing;
  const int columns =
      std::max(1, static_cast<int>(std::lround((section.x_max - section.x_min) / dx)));
  const double width = (section.x_max - section.x_min) / columns;
  const int rows = static_cast<int>(std::ceil((section.y_max - section.y_min) / dx));
  for (int c = 0; c < columns; ++c)
  {
    double orphaned = 0; // slivers of cells whose centre lies outside go to the next particle below
    for (int r = rows - 1; r >= 0; --r)
    {
      const Vec2 lower{section.x_min + c * width, section.y_min + r * dx};
      const Vec2 upper = lower + Vec2{width, dx};
      const double area = clipped_area(section, lower, upper);
      if (area <= 0)
        continue;
      const Vec2 centre = 0.5 * (lower + upper);
      if (meshes::contains(section, centre) && area >= 0.4 * width * dx)
      {
        add(particles, section, centre, area + orphaned);
        orphaned = 0;
      }
      else
        orphaned += area;
    }
  }
  // From the base up in every column, as with fitted columns.
  std::size_t begin = 0;
  const auto reverse = [&](std::size_t first, std::size_t last)
  {
    const auto flip = [&](auto& v)
    {
      std::reverse(v.begin() + static_cast<std::ptrdiff_t>(first),
                   v.begin() + static_cast<std::ptrdiff_t>(last));
    };
    flip(particles.y);
    flip(particles.volume);
    flip(particles.soil);
  };
  for (std::size_t i = 1; i <= particles.size(); ++i)
    if (i == particles.size() || particles.x[i] != particles.x[begin])
    {
      reverse(begin, i);
      begin = i;
    }
}
} // namespace

double default_spacing(const meshes::Section& section)
{
  return (section.y_max - section.y_min) / 40;
}

Particles fill(const meshes::Section& section, double spacing, const std::string& packing)
{
  Particles particles;
  particles.spacing = spacing;
  particles.packing = packing == "auto" ? (section.single_valued ? "columns" : "lattice") : packing;
  const auto refuse = [&](std::string problem, std::string hint)
  {
    throw InputError({{.key = "sph.spacing_m",
                       .value = fmt::format("{}", spacing),
                       .problem = std::move(problem),
                       .allowed = {},
                       .hint = std::move(hint)}});
  };
  if (particles.packing == "columns" && !section.single_valued)
    throw InputError({{.key = "sph.packing",
                       .value = "columns",
                       .problem = "the section has an overhang, which columns cannot fill",
                       .allowed = "auto, lattice",
                       .hint = "leave sph.packing out"}});
  const double height = section.y_max - section.y_min;
  if (spacing > height / 5)
    refuse(fmt::format("too coarse: the section is {:.4g} m high", height),
           fmt::format("at least 5 particles over the height; {:.3g} m gives 40", height / 40));
  const double count = meshes::polygon_area(section.outline) / (spacing * spacing);
  if (count > 2e7)
    refuse(fmt::format("would need {:.2g} particles", count), "at most 2e7; take a larger spacing");

  if (particles.packing == "columns")
    fill_columns(section, particles);
  else
    fill_lattice(section, particles);
  return particles;
}
} // namespace berm::sph
