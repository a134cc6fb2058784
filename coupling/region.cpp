// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/region.h"

#include "core/error.h"
#include "meshes/planar.h"
#include "sph/trial.h"

#include <fmt/core.h>

#include <algorithm>

namespace berm::coupling
{
namespace
{
constexpr double crest_share = 0.05; // of the relief, below the highest ground

bool any_contains(const std::vector<Polyline>& polygons, const Vec2& point)
{
  return std::any_of(polygons.begin(), polygons.end(),
                     [&](const Polyline& polygon)
                     { return meshes::polygon_contains(polygon, point); });
}

/// From the left end of the ground to the last of its crest, in this direction along it.
struct BehindTheCrest
{
  double x = 0;       ///< of the crest's far end [m]
  bool slope = false; ///< the ground falls on this side
};

/// @param[in] ground  From the end on the side in question, [m].
BehindTheCrest far_end_of_crest(const Polyline& ground)
{
  const auto lower = [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); };
  const auto [lowest, highest] = std::minmax_element(ground.begin(), ground.end(), lower);
  const double level = highest->y() - crest_share * (highest->y() - lowest->y());
  std::size_t last = ground.size() - 1;
  while (ground[last].y() < level)
    --last;
  BehindTheCrest result{.x = ground[last].x()};
  if (last + 1 < ground.size())
  {
    const Vec2 &a = ground[last], &b = ground[last + 1];
    result.x = a.x() + (b.x() - a.x()) * (a.y() - level) / (a.y() - b.y());
  }
  result.slope = std::any_of(ground.begin(), ground.begin() + static_cast<std::ptrdiff_t>(last),
                             [level](const Vec2& p) { return p.y() < level; });
  return result;
}

/// Cuts a region down to one side.
Region on_side(Region region, Side side, const meshes::Section& section)
{
  if (side == Side::any)
    return region;
  const bool left = side == Side::left;
  Polyline ground = section.ground;
  if (!left)
    std::reverse(ground.begin(), ground.end());
  const BehindTheCrest crest = far_end_of_crest(ground);
  const char* word = left ? "left" : "right";
  if (!crest.slope)
    throw InputError({{.key = "stability.side",
                       .value = {},
                       .problem = fmt::format("there is no slope on the {} side: the ground does "
                                              "not fall from its highest part to the {}",
                                              word, word),
                       .allowed = {},
                       .hint = fmt::format("\"{}\", or \"any\"", left ? "right" : "left")}});
  region.side = side;
  (left ? region.x_right : region.x_left) = crest.x;
  return region;
}

/// "search region, left side, below 2 m"; "everywhere" if nothing restricts it.
std::string name_of(const Region& region)
{
  std::string name;
  const auto add = [&](const std::string& part) { name += (name.empty() ? "" : ", ") + part; };
  if (!region.inside.empty() || !region.outside.empty())
    add("search region");
  if (region.side != Side::any)
    add(region.side == Side::left ? "left side" : "right side");
  if (region.min_depth > 0)
    add(fmt::format("below {:g} m", region.min_depth));
  return name.empty() ? "everywhere" : name;
}
} // namespace

bool Region::contains(const Vec2& point) const
{
  if (point.x() < x_left || point.x() > x_right)
    return false;
  if ((!inside.empty() && !any_contains(inside, point)) || any_contains(outside, point))
    return false;
  return meshes::distance(point, ground) >= min_depth;
}

Region allowed_region(const SearchScope& scope, const meshes::Section& section)
{
  Region region;
  region.inside = scope.inside;
  region.outside = scope.outside;
  if (scope.side != Side::both)
    region = on_side(std::move(region), scope.side, section);
  region.name = name_of(region);
  return region;
}

std::vector<Region> regions(const SearchScope& scope, const meshes::Section& section)
{
  std::vector<Region> list;
  for (const Side side :
       scope.side == Side::both ? std::vector{Side::left, Side::right} : std::vector{scope.side})
  {
    SearchScope one_side = scope;
    one_side.side = side;
    Region region = allowed_region(one_side, section);
    list.push_back(region);
    if (scope.min_depth <= 0)
      continue;
    region.min_depth = scope.min_depth;
    region.ground = section.ground;
    region.name = name_of(region);
    list.push_back(std::move(region));
  }
  return list;
}

bool holds_soil(const Region& region, const meshes::Section& section)
{
  constexpr int points = 200;
  Vec2 lower{section.x_min, section.y_min}, upper{section.x_max, section.y_max};
  if (!region.inside.empty())
  {
    Vec2 first = upper, last = lower; // of the polygons
    for (const Polyline& polygon : region.inside)
      for (const Vec2& p : polygon)
      {
        first = first.cwiseMin(p);
        last = last.cwiseMax(p);
      }
    lower = lower.cwiseMax(first);
    upper = upper.cwiseMin(last);
  }
  if (upper.x() <= lower.x() || upper.y() <= lower.y())
    return false;
  for (int k = 0; k < points * points; ++k)
  {
    const int row = k / points, column = k % points;
    const Vec2 share{(column + 0.5) / points, (row + 0.5) / points};
    const Vec2 p = lower + share.cwiseProduct(upper - lower);
    if (meshes::polygon_contains(section.outline, p) && region.contains(p))
      return true;
  }
  return false;
}

std::vector<Index> strength_index(const Region& region, const sph::Particles& particles,
                                  std::size_t soils)
{
  std::vector<Index> index = particles.soil;
  for (std::size_t i = 0; i < index.size(); ++i)
    if (!region.contains({particles.x[i], particles.y[i]}))
      index[i] += static_cast<Index>(soils);
  return index;
}

bool holds_particles(const Region& region, const sph::Particles& particles)
{
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (region.contains({particles.x[i], particles.y[i]}))
      return true;
  return false;
}

void require_particles(const Region& region, const sph::Particles& particles)
{
  if (holds_particles(region, particles))
    return;
  throw InputError({{.key = "stability.search_region_m",
                     .value = {},
                     .problem = fmt::format("no particle lies in it: {}", region.name),
                     .allowed = {},
                     .hint = "a wider region, or a smaller sph.spacing_m"}});
}

std::vector<sph::Cone> cones_in_region(std::span<const sph::Soil> soils, double factor,
                                       const std::string& cone)
{
  std::vector<sph::Cone> cones = sph::reduced_cones(soils, factor, cone);
  const std::vector<sph::Cone> held = sph::reduced_cones(soils, std::min(factor, 1.0), cone);
  cones.insert(cones.end(), held.begin(), held.end());
  return cones;
}
} // namespace berm::coupling
