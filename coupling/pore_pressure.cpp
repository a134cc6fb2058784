// SPDX-License-Identifier: GPL-3.0-or-later
#include "coupling/pore_pressure.h"

#include "core/error.h"
#include "meshes/triangle_locator.h"

#include <algorithm>
#include <fmt/core.h>
#include <memory>
#include <utility>

namespace berm::coupling
{
double level_at(const Polyline& line, double x)
{
  const auto right =
      std::find_if(line.begin(), line.end(), [x](const Vec2& point) { return point.x() > x; });
  if (right == line.begin())
    return line.front().y();
  if (right == line.end())
    return line.back().y();
  const Vec2& a = *(right - 1);
  const Vec2& b = *right;
  return a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x());
}

namespace
{
/// Where a pool's surface meets the ground, seen from its end; where it runs over if it does so;
/// the far end of the ground if it never meets it.
Vec2 waterline(const Polyline& ground_from_pool, double level,
               const std::optional<meshes::Overflow>& overflow)
{
  if (overflow && level > overflow->crest.y())
    return {overflow->crest.x(), level};
  for (std::size_t k = 1; k < ground_from_pool.size(); ++k)
  {
    const Vec2 &a = ground_from_pool[k - 1], &b = ground_from_pool[k];
    if (b.y() > level)
      return a.y() >= level ? a : Vec2{a + (b - a) * (level - a.y()) / (b.y() - a.y())};
  }
  return {ground_from_pool.back().x(), level};
}

/// Foot of the slope at the far end: where the ground, walked back from its end, starts to rise.
Vec2 toe(const Polyline& ground_from_far_end)
{
  std::size_t k = 0;
  while (k + 1 < ground_from_far_end.size() &&
         ground_from_far_end[k + 1].y() <= ground_from_far_end[k].y())
    ++k;
  return ground_from_far_end[k];
}
} // namespace

PorePressure no_pore_pressure()
{
  return [](std::span<const double> x, std::span<const double>)
  { return std::vector<double>(x.size(), 0.0); };
}

PorePressure hydrostatic_pore_pressure(Polyline free_surface)
{
  return [line = std::move(free_surface)](std::span<const double> x, std::span<const double> y)
  {
    std::vector<double> p_w;
    p_w.reserve(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      p_w.push_back(water_unit_weight * std::max(level_at(line, x[i]) - y[i], 0.0));
    return p_w;
  };
}

PorePressure seepage_pore_pressure(const seepage::Solution& solution, double max_shift)
{
  struct Field
  {
    meshes::TriangleMesh mesh;
    std::vector<double> pressure;
    meshes::TriangleLocator locator{mesh};
  };
  const auto field =
      std::shared_ptr<Field>(new Field{.mesh = solution.mesh, .pressure = solution.pore_pressure});
  return [field, max_shift](std::span<const double> x, std::span<const double> y)
  {
    std::vector<double> p_w;
    p_w.reserve(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      const auto at = field->locator.locate({x[i], y[i]}, max_shift);
      if (at.triangle < 0)
        throw InputError({{.key = "section",
                           .value = fmt::format("({:.6g}, {:.6g})", x[i], y[i]),
                           .problem = fmt::format("this particle lies more than {:.3g} m outside "
                                                  "the seepage mesh",
                                                  max_shift),
                           .allowed = {},
                           .hint = "the mesh and the section disagree"}});
      p_w.push_back(std::max(meshes::interpolated(field->mesh, field->pressure, at), 0.0));
    }
    return p_w;
  };
}

PorePressure pore_pressure_in_space(PorePressure inside, const meshes::Section& section)
{
  const auto crest = std::max_element(section.ground.begin(), section.ground.end(),
                                      [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); });
  return [inside = std::move(inside), section, x_crest = crest->x()](std::span<const double> x,
                                                                     std::span<const double> y)
  {
    std::vector<double> p_w(x.size()), x_in, y_in;
    std::vector<std::size_t> which;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      const auto& level = x[i] < x_crest ? section.left_pool_level : section.right_pool_level;
      if (meshes::contains(section, {x[i], y[i]}))
      {
        which.push_back(i);
        x_in.push_back(x[i]);
        y_in.push_back(y[i]);
      }
      else if (level)
        p_w[i] = water_unit_weight * std::max(*level - y[i], 0.0);
    }
    const std::vector<double> in_soil = inside(x_in, y_in);
    for (std::size_t k = 0; k < which.size(); ++k)
      p_w[which[k]] = in_soil[k];
    return p_w;
  };
}

Polyline straight_free_surface(const meshes::Section& section)
{
  if (!section.left_pool_level && !section.right_pool_level)
    return {};
  const Polyline& ground = section.ground;
  const Polyline reversed(ground.rbegin(), ground.rend());
  const Vec2 left = section.left_pool_level
                        ? waterline(ground, *section.left_pool_level, section.overflow)
                        : toe(ground);
  const Vec2 right = section.right_pool_level
                         ? waterline(reversed, *section.right_pool_level, section.overflow)
                         : toe(reversed);
  if (left.x() >= right.x()) // one pool covers all of the ground
    return {{section.x_min, std::max(left.y(), right.y())},
            {section.x_max, std::max(left.y(), right.y())}};
  return {left, right};
}
} // namespace berm::coupling
