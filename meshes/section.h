// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace berm::meshes
{
/// A region of the section with a soil of its own.
struct Zone
{
  Index soil = 0; ///< index into the case's list of soils
  Polyline
      polygon; ///< simple polygon [m], either orientation; parts outside the section are ignored
};

/// The section as the user drew it. Either `ground` and `base`, or `outline`.
struct SectionInput
{
  Polyline ground;  ///< left to right, x never decreasing (vertical steps allowed) [m]
  Polyline base;    ///< left to right, over the same x range; two points for a level [m]
  Polyline outline; ///< closed simple polygon [m], either orientation, used if ground is empty
  std::vector<Zone> zones; ///< a later zone covers an earlier one; uncovered parts are soil 0
  std::optional<double> left_pool_level, right_pool_level; ///< [m]
  std::vector<Polyline> marked_lines; ///< lines on the outline or through the soil that become
                                      ///< stretches of their own [m]
};

enum class StretchKind
{
  ground,     ///< dry ground: air above
  left_pool,  ///< ground under the left pool
  right_pool, ///< ground under the right pool
  overflow,   ///< ground that a pool above the crest runs down
  base,
  left_side,  ///< vertical end of the section at its smallest x, below the ground
  right_side, ///< the same at its largest x
  marked      ///< on one of the user's marked lines
};

/// A named part of the outline, or a line inside it.
struct Stretch
{
  StretchKind kind = StretchKind::ground;
  Index marked_line = -1; ///< which of SectionInput::marked_lines, for StretchKind::marked
  std::string name;       ///< "ground", "left_pool", "right_pool", "overflow", "base", "left_side",
                          ///< "right_side", "marked_1", ...
};

/// A wall, drain or well of no thickness inside the section: the mesh is cut open along it.
struct InnerLine
{
  Polyline points;   ///< inside the outline; its first and last point may be vertices of it [m]
  Index stretch = 0; ///< index into Section::stretches
};

/// A pool that stands above the crest and runs over it. From the crest on the depth of the water
/// falls by one metre a metre, to that of a film: docs/theory.md eq. (2.36).
struct Overflow
{
  Vec2 crest = Vec2::Zero(); ///< the highest ground, at the end that faces the pool [m]
  double depth = 0;          ///< of the water over it [m]
};

/// A validated section. The ground is the upper chain of the outline from its smallest to its
/// largest x; the base is the lower chain; vertical edges that join them at the ends are the sides.
struct Section
{
  Polyline outline; ///< closed, counter-clockwise; has vertices at waterlines, at the
                    ///< ends of marked lines and where zone borders meet the outline [m]
  std::vector<Index>
      edge_stretch; ///< edge k joins outline[k] and outline[k+1]; index into stretches
  std::vector<Stretch> stretches;                          ///< those that occur
  std::vector<InnerLine> inner_lines;                      ///< marked lines through the soil
  std::vector<Zone> zones;                                 ///< counter-clockwise
  Polyline ground;                                         ///< left to right [m]
  Polyline base;                                           ///< left to right [m]
  std::optional<double> left_pool_level, right_pool_level; ///< only if the pool touches the ground
  double x_min = 0, x_max = 0, y_min = 0, y_max = 0;       ///< [m]
  double left_side_top = 0,
         right_side_top = 0; ///< upper end of the sides; equal to the base's end if none [m]
  bool single_valued = true; ///< ground and base are functions of x (vertical steps allowed)
  std::optional<Overflow> overflow;
  std::vector<std::string> warnings; ///< doubtful but legal, a sentence each
};

/// @brief Check the drawing and derive outline, stretches and waterline vertices.
/// A pool covers the ground from its end of the section to the first point that rises above its
/// level. A pool level at the ground's end is no pool. A level above all the ground covers all of
/// it if both levels are equal, or if the other one is not given and the highest ground lies at an
/// end of the section: nothing dams the water. If there is a crest between lower ends, the pool
/// overtops it: it covers the ground up to the crest, the ground beyond is of kind overflow, down
/// to where the other pool stands as high.
/// A marked line takes precedence over everything else, a later one over an earlier one. One with a
/// point inside the section is an inner line, and so is one of two points on the outline which the
/// outline between them leaves by more than a tenth of their distance. Inner lines may cross and
/// touch each other, but the outline only at their ends. A level base that is wider than the ground
/// is cut to it.
/// Tolerances, relative to the larger extent of the section: points within 1e-9 are one; zone
/// corners within 1e-5 of the outline or of an earlier zone are moved onto it (less for thin
/// zones); marked lines may lie 1e-4 off. Keys in messages count zones and boundaries from 1:
/// section.zone[1].polygon_m, seepage.boundary[1].line_m.
/// @throws InputError with every mistake found: crossing edges, wrong order, base above ground,
/// zero
///         area, zones that are not simple or lie outside, a pool below the ground at its end, a
///         pool above all ground beside a different level with no crest between them, a marked line
///         that lies outside, is part on the outline and part inside, or on another inner line.
[[nodiscard]] Section build_section(const SectionInput& input);

/// @brief Level of the ground (highest, at a vertical step) or of the base (lowest) at x [m].
/// Pre: the ground or base is a function of x, as both are if section.single_valued;
/// x_min <= x <= x_max.
[[nodiscard]] double ground_level(const Section& section, double x);
[[nodiscard]] double base_level(const Section& section, double x);

/// @brief Whether the point lies inside or on the outline.
[[nodiscard]] bool contains(const Section& section, const Vec2& point);

/// @brief Soil index at a point inside the section: the last zone that covers it, else 0.
[[nodiscard]] Index soil_at(const Section& section, const Vec2& point);

/// @brief Signed area of a polygon [m2], positive counter-clockwise.
[[nodiscard]] double polygon_area(const Polyline& polygon);

/// @brief Whether a point lies inside a polygon (even-odd rule). On its border either may come out.
[[nodiscard]] bool polygon_contains(const Polyline& polygon, const Vec2& point);

/// @brief The part of a polygon inside an axis-parallel box (Sutherland-Hodgman).
/// Zero-width bridges may remain where the part is in pieces; the area is right. Empty if outside.
[[nodiscard]] Polyline clip_to_box(const Polyline& polygon, const Vec2& lower, const Vec2& upper);
} // namespace berm::meshes
