// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/section.h"
#include "seepage/seepage.h"
#include "tests/support/meshes.h"

#include <algorithm>
#include <cmath>
#include <vector>

/// Sections with known seepage, and how far a solution is from what is known.
namespace berm::tests
{
/// A value at a point: x [m], y [m], value.
struct Known
{
  double x = 0, y = 0, value = 0;
};

/// Dam with vertical faces on an impervious base, one metre higher than its water.
inline meshes::SectionInput rectangular_dam(double length, double head, double tailwater)
{
  meshes::SectionInput input = rectangle_input(length, head + 1);
  input.left_pool_level = head;
  if (tailwater > 0)
    input.right_pool_level = tailwater;
  return input;
}

inline meshes::Zone box(Index soil, double x0, double y0, double x1, double y1)
{
  return {soil, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
}

/// Kozeny's dam, y0 = 1: drain on y = 0, x <= 0, base impervious for x > 0; upstream the
/// equipotential head = 4. Marked: that, then the drain.
inline meshes::SectionInput kozeny_dam()
{
  meshes::SectionInput input;
  Polyline upstream;
  for (int k = 0; k <= 60; ++k)
    upstream.emplace_back((16 - k * k / 3600.) / 2, 4 * k / 60.);
  const Polyline drain{{-2, 0}, {0, 0}};
  input.outline = drain;
  input.outline.insert(input.outline.end(), upstream.begin(), upstream.end());
  input.outline.insert(input.outline.end(), {{7.5, 4.5}, {-2, 4.5}});
  input.marked_lines = {upstream, drain};
  return input;
}

/// The solution, with default settings unless others are given.
inline seepage::Solution solved(const meshes::SectionInput& input,
                                const std::vector<seepage::Conductivity>& conductivity,
                                const std::vector<seepage::Boundary>& marked = {},
                                const seepage::Settings& settings = {})
{
  const meshes::Section section = meshes::build_section(input);
  Observer observer;
  return seepage::solve(section, conductivity, seepage::boundary_conditions(section, marked),
                        settings, observer);
}

inline double largest_head_error(const seepage::Solution& solution, const std::vector<Known>& known)
{
  double worst = 0;
  for (const Known& k : known)
    worst = std::max(
        worst,
        std::abs(seepage::value_at(solution, solution.head, {k.x, k.y}, 1e-6).value() - k.value));
  return worst;
}

inline double largest_level_error(const seepage::Solution& solution, const std::vector<Vec2>& known)
{
  double worst = 0;
  for (const Vec2& k : known)
    worst = std::max(worst, std::abs(seepage::phreatic_level(solution, k.x()).value() - k.y()));
  return worst;
}
} // namespace berm::tests
