// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/outline.h"

#include "meshes/drawing.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace berm::meshes
{
namespace
{
Boundary join(Polyline ground, Polyline base)
{
  Boundary b;
  b.size = std::max(extent(ground), extent(base));
  const double tolerance = same_point * b.size;
  base.front().x() = ground.front().x();
  base.back().x() = ground.back().x();
  const bool left_side = (ground.front() - base.front()).norm() > tolerance;
  const bool right_side = (ground.back() - base.back()).norm() > tolerance;
  if (!left_side)
    base.front() = ground.front();
  if (!right_side)
    base.back() = ground.back();
  for (std::size_t i = 0; i + 1 < base.size(); ++i)
    b.add(base[i], StretchKind::base);
  if (right_side)
    b.add(base.back(), StretchKind::right_side);
  for (std::size_t i = ground.size() - 1; i > 0; --i)
    b.add(ground[i], StretchKind::ground);
  if (left_side)
    b.add(ground.front(), StretchKind::left_side);
  b.ground = std::move(ground);
  b.base = std::move(base);
  return b;
}
} // namespace

std::optional<Boundary> boundary_from_ground(const SectionInput& input,
                                             std::vector<Mistake>& mistakes)
{
  const std::string ground_key = "section.ground_m", base_key = "section.base_m";
  const std::size_t before = mistakes.size();
  Polyline base = input.base;
  const Polyline& ground = input.ground;
  const bool ground_usable = check_points(ground_key, ground, false, mistakes);
  const bool base_usable = check_points(base_key, base, false, mistakes);
  if (ground_usable)
  {
    check_left_to_right(ground_key, ground, mistakes);
    check_simple(ground_key, ground, false, mistakes);
  }
  if (base_usable)
  {
    check_left_to_right(base_key, base, mistakes);
    check_simple(base_key, base, false, mistakes);
  }
  if (mistakes.size() > before)
    return std::nullopt;

  const double tolerance = same_point * std::max(extent(ground), extent(base));
  const double left = ground.front().x(), right = ground.back().x();
  if (right - left <= tolerance)
  {
    mistakes.push_back({ground_key, text(ground.front(), ground.back()), "has no width", "", ""});
    return std::nullopt;
  }
  const bool covers = base.front().x() <= left + tolerance && base.back().x() >= right - tolerance;
  const bool fits = base.front().x() >= left - tolerance && base.back().x() <= right + tolerance;
  const bool level = base.size() == 2 && base.front().y() == base.back().y();
  if (!covers || (!fits && !level))
  {
    mistakes.push_back({base_key, text(base.front(), base.back()),
                        "the base does not end where the ground ends",
                        fmt::format("from x = {:.10g} to x = {:.10g}", left, right), ""});
    return std::nullopt;
  }
  base.front().x() = left; // a wider level is cut to the ground
  base.back().x() = right;

  // Where the base lies above the ground; steps that only overlap show up as touching edges below.
  double excess = tolerance, worst_x = 0;
  for (const bool of_ground : {true, false})
    for (const Vec2& p : of_ground ? ground : base)
    {
      const double above =
          of_ground ? level_of(base, p.x(), false) - p.y() : p.y() - level_of(ground, p.x(), true);
      if (above > excess)
      {
        excess = above;
        worst_x = p.x();
      }
    }
  if (excess > tolerance)
  {
    mistakes.push_back(
        {base_key, fmt::format("{:.10g}", level_of(base, worst_x, false)),
         fmt::format("the base is {:.4g} m above the ground at x = {:.10g}", excess, worst_x),
         "a base below the ground everywhere", ""});
    return std::nullopt;
  }
  Boundary b = join(ground, std::move(base));
  if (b.points.size() < 3 || std::abs(polygon_area(b.points)) <= tolerance * b.size)
    mistakes.push_back({ground_key, "", "there is no soil between ground and base", "", ""});
  else
    check_simple(ground_key, b.points, true, mistakes);
  if (mistakes.size() > before)
    return std::nullopt;
  return b;
}

std::optional<Boundary> boundary_from_outline(const SectionInput& input,
                                              std::vector<Mistake>& mistakes)
{
  const std::string key = "section.outline_m";
  const std::size_t before = mistakes.size();
  Polyline points = opened(input.outline);
  if (!check_points(key, points, true, mistakes))
    return std::nullopt;
  Boundary b;
  b.size = extent(points);
  const double tolerance = same_point * b.size;
  if (std::abs(polygon_area(points)) <= tolerance * b.size)
    mistakes.push_back({key, "", "encloses no area", "", ""});
  else
    check_simple(key, points, true, mistakes);
  if (mistakes.size() > before)
    return std::nullopt;
  points = counter_clockwise(std::move(points));

  // The four corners where base, right side, ground and left side meet, counter-clockwise.
  const auto by_x = [](const Vec2& p, const Vec2& q) { return p.x() < q.x(); };
  const double x_min = std::min_element(points.begin(), points.end(), by_x)->x();
  const double x_max = std::max_element(points.begin(), points.end(), by_x)->x();
  const auto corner = [&](double x, double sign)
  {
    auto best = points.end();
    for (auto p = points.begin(); p != points.end(); ++p)
      if (std::abs(p->x() - x) <= tolerance &&
          (best == points.end() || sign * p->y() > sign * best->y()))
        best = p;
    return best;
  };
  std::rotate(points.begin(), corner(x_min, -1), points.end());
  const auto right_low = corner(x_max, -1), right_high = corner(x_max, 1);
  const auto left_high = corner(x_min, 1) == points.begin() ? points.end() : corner(x_min, 1);
  for (auto p = points.begin(); p != points.end(); ++p)
    b.add(*p, p < right_low    ? StretchKind::base
              : p < right_high ? StretchKind::right_side
              : p < left_high  ? StretchKind::ground
                               : StretchKind::left_side);
  b.base.assign(points.begin(), right_low + 1);
  b.ground.assign(right_high, left_high);
  b.ground.push_back(left_high == points.end() ? points.front() : *left_high);
  std::reverse(b.ground.begin(), b.ground.end());
  for (const Polyline* chain : {&b.base, &b.ground})
    for (std::size_t i = 0; i + 1 < chain->size(); ++i)
      b.single_valued = b.single_valued && (*chain)[i + 1].x() >= (*chain)[i].x() - tolerance;
  for (std::size_t i = 0; i < b.points.size(); ++i) // a notch in the end of the section
    if (b.kind[i] == StretchKind::left_side || b.kind[i] == StretchKind::right_side)
      b.single_valued =
          b.single_valued &&
          std::abs(b.points[i].x() - b.points[next(i, b.points.size())].x()) <= tolerance;
  return b;
}
} // namespace berm::meshes
