// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/pools.h"

#include "meshes/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace berm::meshes
{
namespace
{
enum class Reach
{
  absent,       ///< no water on the ground
  partial,      ///< up to `end`
  whole,        ///< over all the ground
  below_ground, ///< the level is below the ground at the pool's own end
};

struct Pool
{
  Reach reach = Reach::absent;
  Vec2 end = Vec2::Zero(); ///< the waterline
};

/// Follow the ground from the pool's end until it comes up to the level.
Pool pool_on(const Polyline& ground, double level, double tolerance)
{
  if (ground.front().y() > level + tolerance)
    return {Reach::below_ground};
  bool wet = false;
  for (std::size_t i = 0; i < ground.size(); ++i)
  {
    const Vec2& p = ground[i];
    if (p.y() < level - tolerance)
      wet = true;
    else if (!wet && p.y() > level + tolerance)
      return {Reach::absent};
    else if (wet && p.y() <= level + tolerance)
      return {Reach::partial, p};
    else if (wet)
    {
      const Vec2& below = ground[i - 1];
      const double t = (level - below.y()) / (p.y() - below.y());
      return {Reach::partial, Vec2(below.x() + t * (p.x() - below.x()), level)};
    }
  }
  return {wet ? Reach::whole : Reach::absent};
}

/// The first of the highest points, seen from the pool.
Polyline::const_iterator crest_of(const Polyline& ground, double tolerance)
{
  const double highest =
      std::max_element(ground.begin(), ground.end(),
                       [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); })
          ->y();
  return std::find_if(ground.begin(), ground.end(),
                      [&](const Vec2& p) { return p.y() >= highest - tolerance; });
}

/// Whether the highest ground lies between lower ends.
bool has_crest(const Polyline& ground, double tolerance)
{
  const double crest = crest_of(ground, tolerance)->y() - tolerance;
  return ground.front().y() < crest && ground.back().y() < crest;
}

/// The ground beyond the crest, with a point where the falling water is down to a film.
Polyline run_off_way(const Polyline& ground, const Overflow& overflow, double tolerance)
{
  Polyline way;
  for (auto p = crest_of(ground, tolerance); p != ground.end(); ++p)
  {
    if (!way.empty())
    {
      const double before = std::abs(way.back().x() - overflow.crest.x()),
                   here = std::abs(p->x() - overflow.crest.x());
      if (before < overflow.depth - tolerance && here > overflow.depth + tolerance)
        way.emplace_back(way.back() +
                         (overflow.depth - before) / (here - before) * (*p - way.back()));
    }
    way.push_back(*p);
  }
  return way;
}

/// Where the falling water is down to the far pool's level; the end of the ground if it stays
/// above.
Vec2 end_of_overflow(const Polyline& way, const Overflow& overflow, double level)
{
  const auto surface = [&](const Vec2& p)
  { return p.y() + std::max(0.0, overflow.depth - std::abs(p.x() - overflow.crest.x())); };
  for (std::size_t k = 1; k < way.size(); ++k)
  {
    const double a = surface(way[k - 1]), b = surface(way[k]);
    if (a > level && b <= level)
      return way[k - 1] + (a - level) / (a - b) * (way[k] - way[k - 1]);
  }
  return way.back();
}

std::string pool_name(std::size_t side)
{
  return side == 0 ? "left" : "right";
}

struct Flood
{
  std::array<Pool, 2> pools;
  std::array<std::optional<double>, 2> levels;
  std::array<Polyline, 2> ground; ///< seen from each pool
  double tolerance = 0;           ///< [m]
};

/// The pool of this side runs over the crest and down to the other one. `flood.pools` then end
/// where they do.
void overtop(std::size_t side, Boundary& b, Flood& flood, Section& section)
{
  const Polyline& ground = flood.ground[side];
  const double level = flood.levels[side].value();
  const Vec2 crest = *crest_of(ground, flood.tolerance);
  section.overflow = Overflow{crest, level - crest.y()};
  const Polyline way = run_off_way(ground, *section.overflow, flood.tolerance);
  const bool far_pool = flood.pools[1 - side].reach != Reach::absent;
  const Vec2 end = far_pool
                       ? end_of_overflow(way, *section.overflow, flood.levels[1 - side].value())
                       : way.back();
  for (const Vec2& p : way) // keeps the bend at the foot of the falling water
    b.vertex_at(p, flood.tolerance);
  flood.pools[side] = {Reach::partial, crest};
  flood.pools[1 - side] = {};
  if ((end - way.back()).norm() > flood.tolerance)
    flood.pools[1 - side] = {Reach::partial, end};
  section.warnings.push_back(fmt::format(
      "the {} pool, {:.6g} m, stands above the crest, {:.6g} m, at {}: overtopping; the ground "
      "beyond it is taken to be under a film of running water",
      pool_name(side), level, crest.y(), text(crest)));
}

/// Outline edges of kind ground that lie under the pools, and those under what runs over.
void mark_wet_ground(Boundary& b, std::array<Pool, 2> pools, const Section& section,
                     double tolerance)
{
  for (Pool& pool : pools)
    if (pool.reach == Reach::partial)
      pool.end = b.vertex_at(pool.end, tolerance);
  // The outline runs along the ground from right to left.
  const std::size_t n = b.points.size();
  bool in_pool = pools[1].reach != Reach::absent;
  for (std::size_t i = 0; i < n && in_pool; ++i)
  {
    if (b.kind[i] != StretchKind::ground)
      continue;
    in_pool = pools[1].reach == Reach::whole || b.points[i] != pools[1].end;
    if (in_pool)
      b.kind[i] = StretchKind::right_pool;
  }
  in_pool = pools[0].reach != Reach::absent;
  for (std::size_t i = n; i-- > 0 && in_pool;)
  {
    if (b.kind[i] != StretchKind::ground)
      continue;
    in_pool = pools[0].reach == Reach::whole || b.points[next(i, n)] != pools[0].end;
    if (in_pool)
      b.kind[i] = StretchKind::left_pool;
  }
  if (section.overflow)
    std::replace(b.kind.begin(), b.kind.end(), StretchKind::ground, StretchKind::overflow);
}
} // namespace

void flood(Boundary& b, const SectionInput& input, Section& section, std::vector<Mistake>& mistakes)
{
  const std::string keys[] = {"water.left_level_m", "water.right_level_m"};
  Flood flood{.pools = {},
              .levels = {input.left_pool_level, input.right_pool_level},
              .ground = {b.ground, Polyline(b.ground.rbegin(), b.ground.rend())},
              .tolerance = same_point * b.size};
  const auto& levels = flood.levels;
  const std::size_t before = mistakes.size();
  for (std::size_t side = 0; side < 2; ++side)
  {
    if (!levels[side])
      continue;
    const std::string value = fmt::format("{:.10g}", *levels[side]);
    if (!std::isfinite(*levels[side]))
    {
      mistakes.push_back({keys[side], value, "is not a number", "a finite level", ""});
      continue;
    }
    flood.pools[side] = pool_on(flood.ground[side], *levels[side], flood.tolerance);
    if (flood.pools[side].reach == Reach::below_ground)
      mistakes.push_back({keys[side], value,
                          fmt::format("the pool is below the ground at its end of the section, {}",
                                      text(flood.ground[side].front())),
                          fmt::format("at least {:.10g}", flood.ground[side].front().y()),
                          "a water table inside the soil is a head on the side: "
                          "[[seepage.boundary]]"});
  }
  const bool same_level =
      levels[0] && levels[1] && std::abs(*levels[0] - *levels[1]) <= flood.tolerance;
  const bool dammed = has_crest(b.ground, flood.tolerance);
  std::optional<std::size_t> over;
  for (std::size_t side = 0; side < 2; ++side)
  {
    if (flood.pools[side].reach != Reach::whole || same_level)
      continue;
    if (dammed && (!over || *levels[side] > *levels[*over]))
      over = side;
    else if (!dammed && levels[1 - side] && *levels[side] > *levels[1 - side])
      mistakes.push_back({keys[side], fmt::format("{:.10g}", *levels[side]),
                          fmt::format("the pool covers all the ground, which has no crest to hold "
                                      "it, and {} = {:.10g} is another level",
                                      keys[1 - side], *levels[1 - side]),
                          "a level below the highest ground, or the same level on both sides", ""});
  }
  if (mistakes.size() > before)
    return;
  if (over)
    overtop(*over, b, flood, section);
  else if (flood.pools[0].reach == Reach::whole)
    flood.pools[1] = {}; // all of it is the left pool

  if (flood.pools[0].reach != Reach::absent)
    section.left_pool_level = levels[0];
  if (flood.pools[1].reach != Reach::absent)
    section.right_pool_level = levels[1];
  mark_wet_ground(b, flood.pools, section, flood.tolerance);
}
} // namespace berm::meshes
