// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/section.h"
#include "seepage/seepage.h"
#include "tests/support/meshes.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

/// Sections that break solvers of steady unconfined flow: docs/hard_cases.md.
namespace berm::tests
{
/// A value that is known without solving, and how far a solution may be from it.
struct KnownDischarge
{
  double value = 0;    ///< [m2/s]
  double relative = 0; ///< bound [-]
};

struct HardSeepage
{
  std::string name; ///< letters and digits
  meshes::SectionInput section;
  std::vector<seepage::Conductivity> conductivity = {{1, 1, 0}};
  std::vector<seepage::Boundary> marked = {};
  std::optional<KnownDischarge> discharge = {};
  std::string refused = {}; ///< what the message must say if there is no answer
  /// How far a head may lie outside what the boundary allows, over that range [-]. The matrix is
  /// monotone but for rounding where soil is isotropic on Delaunay triangles; a balance to 1e-8
  /// moves heads by less than this.
  double out_of_bounds = 1e-7;
};

inline std::ostream& operator<<(std::ostream& out, const HardSeepage& hard)
{
  return out << hard.name;
}

inline seepage::Conductivity isotropic(double k)
{
  return {k, k, 0};
}

/// 1e-6 as "1em6", 0.02 as "2em2".
inline std::string power(double value)
{
  std::string text = fmt::format("{:.0e}", value);
  const auto at = text.find('e');
  const int exponent = std::stoi(text.substr(at + 1));
  return text.substr(0, at) + (exponent < 0 ? "em" : "e") + std::to_string(std::abs(exponent));
}

inline meshes::Zone box_zone(Index soil, double x0, double y0, double x1, double y1)
{
  return {soil, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
}

/// Vertical faces on an impervious base at y = 0.
inline meshes::SectionInput vertical_dam(double length, double height, double head,
                                         double tailwater)
{
  meshes::SectionInput input = rectangle_input(length, height);
  input.left_pool_level = head;
  if (tailwater > 0)
    input.right_pool_level = tailwater;
  return input;
}

/// The dam of 12 m of docs/verification.md S-5, times a factor.
inline meshes::SectionInput sloping_dam(double scale = 1, double head = 10)
{
  meshes::SectionInput input;
  input.ground = {{0, 0}, {24 * scale, 12 * scale}, {28 * scale, 12 * scale}, {52 * scale, 0}};
  input.base = {{0, 0}, {52 * scale, 0}};
  input.left_pool_level = head * scale;
  return input;
}
constexpr double sloping_dam_discharge = 1.5360; ///< k = 1, unscaled; tracked P2 code
constexpr KnownDischarge sloping{sloping_dam_discharge, 1.5e-3};

//------------------------------------------------------------------------------------------------
// Contrasts with exact discharge. Vertical zones: (H^2 - h^2) / (2 sum L_i / k_i), Charny. Layers:
// q L = int_0^H k (H - y) dy - int_0^h k (h - y) dy.
//------------------------------------------------------------------------------------------------

/// Widths and conductivities from left to right, 11 m high, 10 m of water, tailwater of 2 m.
inline HardSeepage vertical_zones(std::string name, const std::vector<Vec2>& width_and_k,
                                  double bound)
{
  double x = 0, resistance = 0;
  HardSeepage hard{.name = std::move(name), .section = {}, .conductivity = {}};
  std::vector<meshes::Zone> zones;
  for (const Vec2& zone : width_and_k)
  {
    zones.push_back(box_zone(static_cast<Index>(hard.conductivity.size()), x, 0, x + zone.x(), 11));
    hard.conductivity.push_back(isotropic(zone.y()));
    resistance += zone.x() / zone.y();
    x += zone.x();
  }
  hard.section = vertical_dam(x, 11, 10, 2);
  hard.section.zones = std::move(zones);
  hard.discharge = {(100 - 4) / 2. / resistance, bound};
  return hard;
}

/// Tops and conductivities from below, 8 m long, otherwise the same.
inline HardSeepage layers(std::string name, const std::vector<Vec2>& top_and_k, double bound)
{
  HardSeepage hard{
      .name = std::move(name), .section = vertical_dam(8, 11, 10, 2), .conductivity = {}};
  double y = 0, sum = 0;
  const auto below = [](double level, double y0, double y1) // int (level - y) dy of its wet part
  {
    const double a = std::max(level - y0, 0.), b = std::max(level - y1, 0.);
    return (a * a - b * b) / 2;
  };
  for (const Vec2& layer : top_and_k)
  {
    hard.section.zones.push_back(
        box_zone(static_cast<Index>(hard.conductivity.size()), 0, y, 8, layer.x()));
    hard.conductivity.push_back(isotropic(layer.y()));
    sum += layer.y() * (below(10, y, layer.x()) - below(2, y, layer.x()));
    y = layer.x();
  }
  hard.discharge = {sum / 8, bound};
  return hard;
}

inline void add_contrasts(std::vector<HardSeepage>& all)
{
  for (const double k : {1e-6, 1e-4, 1e-2, 1e2, 1e4, 1e6})
    all.push_back(vertical_zones("Core" + power(k), {{4, 1}, {2, k}, {4, 1}}, 2e-3));
  for (const double k : {1e-6, 1e-3})
    all.push_back(vertical_zones("Core" + power(k) + "Drain1e3", {{4, 1}, {2, k}, {4, 1e3}}, 2e-3));
  // Hardly more than one element across it, where the free surface falls.
  all.push_back(vertical_zones("ThinCore1em4", {{4, 1}, {0.055, 1e-4}, {4, 1}}, 1e-2));
  all.push_back(vertical_zones("ThinDrain1e4", {{4, 1}, {0.011, 1e4}, {4, 1}}, 5e-3));
  all.push_back(
      vertical_zones("FiveZones", {{2, 1}, {1, 1e-3}, {2, 1e3}, {1, 1e-2}, {3, 1}}, 2e-3));
  for (const double k : {1e-6, 1e-3, 1e3, 1e6})
    all.push_back(layers("UpperLayer" + power(k), {{5, 1}, {11, k}}, 5e-3));
  all.push_back(layers("ThinTightLayer", {{5, 1}, {5.011, 1e-4}, {11, 1}}, 5e-3));
  all.push_back(layers("ThinOpenLayer", {{5, 1}, {5.011, 1e3}, {11, 1}}, 5e-3));
  all.push_back(
      layers("ManyLayers", {{2, 1}, {3, 1e-3}, {5, 10}, {6, 1e-4}, {8, 1}, {11, 1e2}}, 5e-3));
}

//------------------------------------------------------------------------------------------------
// Cores and drains in the sloping dam. Unknown discharge.
//------------------------------------------------------------------------------------------------

inline HardSeepage zoned_slope(std::string name, std::vector<meshes::Zone> zones,
                               const std::vector<double>& k)
{
  HardSeepage hard{.name = std::move(name), .section = sloping_dam(), .conductivity = {}};
  hard.section.zones = std::move(zones);
  for (const double value : k)
    hard.conductivity.push_back(isotropic(value));
  return hard;
}

inline void add_cores_and_drains(std::vector<HardSeepage>& all)
{
  const meshes::Zone core{1, {{20, 0}, {32, 0}, {27, 11.9}, {25, 11.9}}};
  for (const double k : {1e-6, 1e-4, 1e-2, 1e2, 1e4, 1e6})
    all.push_back(zoned_slope("SlopingCore" + power(k), {core}, {1, k}));
  const meshes::Zone toe{1, {{42, 0}, {52, 0}, {46, 3}}};
  all.push_back(zoned_slope("ToeDrain1e3", {toe}, {1, 1e3}));
  all.push_back(zoned_slope("ToeDrain1e6", {toe}, {1, 1e6}));
  all.push_back(zoned_slope("TightToe1em3", {toe}, {1, 1e-3}));
  const meshes::Zone blanket = box_zone(1, 36, 0, 51, 0.5);
  all.push_back(zoned_slope("Blanket1e3", {blanket}, {1, 1e3}));
  all.push_back(zoned_slope("ThinBlanket1e4", {box_zone(1, 36, 0, 51.9, 0.012)}, {1, 1e4}));
  const meshes::Zone chimney{2, {{32, 0}, {33, 0}, {28, 11.5}, {27, 11.9}}};
  all.push_back(
      zoned_slope("CoreAndChimney", {core, chimney, box_zone(2, 32, 0, 51, 0.5)}, {1, 1e-4, 1e3}));
  HardSeepage drained{.name = "FreeHorizontalDrain", .section = sloping_dam()};
  drained.section.marked_lines = {{{40, 0}, {52, 0}}};
  drained.marked = {{seepage::BoundaryKind::head, 0}};
  all.push_back(std::move(drained));
}

//------------------------------------------------------------------------------------------------
// Anisotropy. Vertical faces and axes along x and y: kx (H^2 - h^2) / (2 L), Charny.
//------------------------------------------------------------------------------------------------

/// Isotropic triangles are obtuse where they are seen in axes in which the soil is isotropic: the
/// matrix is not monotone. To be 1e-7 like the others once meshes are stretched.
inline double not_monotone(double ratio)
{
  return ratio > 100 ? 0.1 : 1e-7;
}

/// In those axes they are coarse along the axis of least conductivity, by the root of the ratio.
inline double elements_across(double ratio)
{
  return ratio > 100 ? 3e-2 : 1e-2;
}

inline void add_anisotropy(std::vector<HardSeepage>& all)
{
  for (const double ratio : {10., 100., 1e4})
    for (const bool wide : {true, false})
    {
      const seepage::Conductivity k =
          wide ? seepage::Conductivity{ratio, 1, 0} : seepage::Conductivity{1, ratio, 0};
      all.push_back({.name = (wide ? "Wide" : "Tall") + power(ratio),
                     .section = vertical_dam(20, 11, 10, 2),
                     .conductivity = {k},
                     .discharge = KnownDischarge{k.kx * 96 / 40, elements_across(ratio)},
                     .out_of_bounds = not_monotone(ratio)});
    }
  for (const double ratio : {10., 1e4})
    for (const double degrees : {15., 45., 75., 120.})
      all.push_back({.name = "Turned" + power(ratio) + "By" + fmt::format("{:.0f}", degrees),
                     .section = sloping_dam(),
                     .conductivity = {{ratio, 1, degrees * pi / 180}},
                     .out_of_bounds = not_monotone(ratio)});
}

//------------------------------------------------------------------------------------------------
// Levels at vertices, at the crest, just above the base.
//------------------------------------------------------------------------------------------------

/// A dam with berms at 5 m on either side, 10 m high.
inline meshes::SectionInput bermed_dam(double left, double right)
{
  meshes::SectionInput input;
  input.ground = {{0, 0}, {10, 5}, {14, 5}, {24, 10}, {28, 10}, {38, 5}, {44, 5}, {54, 0}};
  input.base = {{0, 0}, {54, 0}};
  input.left_pool_level = left;
  if (right > 0)
    input.right_pool_level = right;
  return input;
}

inline void add_levels(std::vector<HardSeepage>& all)
{
  const auto add = [&](std::string name, double left, double right)
  { all.push_back({.name = std::move(name), .section = bermed_dam(left, right)}); };
  add("LevelAtVertex", 5, 0);
  for (const double hair : {1e-9, 1e-7, 1e-5, 1e-3, 0.02})
  {
    add("LevelAboveVertexBy" + power(hair), 5 + hair, 0);
    add("LevelBelowVertexBy" + power(hair), 5 - hair, 0);
  }
  add("BothAtVertex", 5, 5);
  add("TailwaterAtVertex", 9, 5);
  add("TailwaterAboveVertexBy1em4", 9, 5.0001);
  add("BothPoolsAtCrest", 10, 10);
  add("LevelAtCrest", 10, 0);
  add("NearlyFull", 9.999, 0);
  add("NearlyEmpty", 0.01, 0);
  add("HairAboveBase", 1e-4, 0);
  all.push_back({.name = "VerticalNearlyEmpty",
                 .section = vertical_dam(10, 10, 0.01, 0),
                 // Elements are longer than the water is deep: 0.013 m, 0.01 m.
                 .discharge = KnownDischarge{0.01 * 0.01 / 20, 0.2}});
  all.push_back({.name = "VerticalNearlyFull",
                 .section = vertical_dam(10, 10, 10, 9.99),
                 .discharge = KnownDischarge{(100 - 9.99 * 9.99) / 20, 2e-3}});
  all.push_back({.name = "VerticalFull",
                 .section = vertical_dam(10, 10, 10, 0),
                 .discharge = KnownDischarge{5, 2e-3}});
}

//------------------------------------------------------------------------------------------------
// Shapes.
//------------------------------------------------------------------------------------------------

inline meshes::SectionInput with_ground(Polyline ground, double left)
{
  meshes::SectionInput input;
  input.base = {{ground.front().x(), 0}, {ground.back().x(), 0}};
  input.ground = std::move(ground);
  input.left_pool_level = left;
  return input;
}

inline void add_shapes(std::vector<HardSeepage>& all)
{
  all.push_back(
      {.name = "Apron1in50",
       .section = with_ground({{0, 4}, {40, 4}, {52, 10}, {56, 10}, {71, 4}, {271, 0.01}}, 9)});
  all.push_back(
      {.name = "Apron1in200",
       .section = with_ground({{0, 2}, {20, 2}, {36, 10}, {40, 10}, {60, 2}, {460, 0}}, 9)});
  all.push_back(
      {.name = "UpwardApron",
       .section = with_ground({{0, 2}, {20, 2}, {36, 10}, {40, 10}, {60, 1}, {260, 5}}, 9)});
  all.push_back(
      {.name = "FaceLongerThanSlope",
       .section = with_ground({{0, 4}, {10, 4}, {22, 10}, {26, 10}, {29, 4}, {60, 4}}, 9.5)});
  all.push_back(
      {.name = "ReentrantCut",
       .section = with_ground(
           {{0, 0}, {24, 12}, {28, 12}, {34, 9}, {34, 3}, {38, 3}, {38, 7}, {52, 0}}, 10)});
  all.push_back(
      {.name = "Terraces",
       .section = with_ground(
           {{0, 0}, {0, 12}, {6, 12}, {6, 9}, {12, 9}, {12, 6}, {18, 6}, {18, 3}, {24, 3}, {24, 0}},
           11)});
  all.push_back({.name = "VerticalCutBelowAPlain",
                 .section = with_ground({{0, 8}, {40, 8}, {40, 2}, {60, 2}}, 8.5)});
  all.back().section.left_pool_level.reset();
  all.back().section.marked_lines = {{{0, 0}, {0, 8}}};
  all.back().marked = {{seepage::BoundaryKind::head, 7.5}};
  meshes::SectionInput overhang;
  overhang.outline = {{0, 0}, {20, 0}, {17, 3}, {22, 6}, {16, 12}, {10, 12}};
  overhang.left_pool_level = 10;
  all.push_back({.name = "Overhang", .section = overhang});
  // Three hills: the middle valley's water comes out and is not led away.
  all.push_back({.name = "ThreeHills",
                 .section = with_ground({{0, 0},
                                         {16, 8},
                                         {18, 8},
                                         {26, 2},
                                         {30, 2},
                                         {36, 6},
                                         {38, 6},
                                         {44, 1},
                                         {48, 1},
                                         {54, 5},
                                         {56, 5},
                                         {64, 0}},
                                        7.5)});
  // Water on both sides of a hill whose base drains in the middle: two pieces of free surface.
  HardSeepage pieces{.name = "TwoPieces", .section = sloping_dam()};
  pieces.section.right_pool_level = 8;
  pieces.section.marked_lines = {{{24, 0}, {28, 0}}};
  pieces.marked = {{seepage::BoundaryKind::head, 0}};
  all.push_back(std::move(pieces));
  // The free surface runs down to the base, where the drain begins at the waterline's foot.
  HardSeepage touching{.name = "FreeSurfaceMeetsTheBase", .section = vertical_dam(20, 11, 10, 0)};
  touching.section.marked_lines = {{{10, 0}, {20, 0}}};
  touching.marked = {{seepage::BoundaryKind::seepage_face, 0}};
  all.push_back(std::move(touching));
  HardSeepage inner{.name = "DrainAtTheUpstreamFoot", .section = vertical_dam(20, 11, 10, 0)};
  inner.section.marked_lines = {{{0.2, 0}, {20, 0}}};
  inner.marked = {{seepage::BoundaryKind::seepage_face, 0}};
  all.push_back(std::move(inner));
}

//------------------------------------------------------------------------------------------------
// Boundaries.
//------------------------------------------------------------------------------------------------

inline void add_boundaries(std::vector<HardSeepage>& all)
{
  const auto plain = [] // a slope with 6 m under its foot
  {
    return with_ground({{0, 6}, {20, 6}, {50, 18}, {90, 18}}, 0);
  };
  for (const double right : {17.9, 18.0, 12.0, 0.5})
  {
    HardSeepage hard{.name = "SideHead" + fmt::format("{:.0f}", 10 * right), .section = plain()};
    hard.section.left_pool_level = 7; // drawn down
    hard.section.marked_lines = {{{90, 0}, {90, 18}}};
    hard.marked = {{seepage::BoundaryKind::head, right}};
    all.push_back(std::move(hard));
  }
  for (const double k : {1e-8, 1.}) // inflow far up-slope, a thousandth of the conductivity
  {
    HardSeepage hard{
        .name = "SideInflow" + power(k), .section = plain(), .conductivity = {isotropic(k)}};
    hard.section.left_pool_level = 8;
    hard.section.marked_lines = {{{90, 0}, {90, 8}}};
    hard.marked = {{seepage::BoundaryKind::inflow, 0.05 * k}};
    all.push_back(std::move(hard));
  }
  all.push_back({.name = "BothPools", .section = sloping_dam()});
  all.back().section.right_pool_level = 7;
  all.push_back({.name = "BothPoolsNearlyEqual", .section = sloping_dam()});
  all.back().section.right_pool_level = 10 - 1e-6;
  // No way out: the downstream slope is sealed, the soil behind it fills up to the pool's level.
  HardSeepage undrained{.name = "UndrainedCorner", .section = sloping_dam()};
  undrained.section.marked_lines = {{{28, 12}, {52, 0}}};
  undrained.marked = {{seepage::BoundaryKind::impervious, 0}};
  undrained.discharge = KnownDischarge{0, 0};
  all.push_back(std::move(undrained));
  HardSeepage slit{.name = "SealedButForASlit", .section = sloping_dam()};
  slit.section.marked_lines = {{{28, 12}, {52, 0}}, {{51.9, 0.05}, {52, 0}}};
  slit.marked = {{seepage::BoundaryKind::impervious, 0}, {seepage::BoundaryKind::seepage_face, 0}};
  all.push_back(std::move(slit));
}

//------------------------------------------------------------------------------------------------
// Inflow on the ground, from a trifle to more than the soil takes. Ditches of 1 m on either side of
// a block of 20 m.
//------------------------------------------------------------------------------------------------

inline void add_inflow(std::vector<HardSeepage>& all)
{
  for (const double rate : {1e-6, 0.02, 0.5, 0.99, 1.01})
  {
    HardSeepage hard{.name = "GroundTakes" + fmt::format("{:.0f}", 1e6 * rate) + "PpmOfK",
                     .section = vertical_dam(20, 11, 1, 1)};
    hard.section.marked_lines = {{{0, 11}, {20, 11}}};
    hard.marked = {{seepage::BoundaryKind::inflow, rate}};
    hard.discharge = KnownDischarge{20 * rate, 1e-6}; // nothing else enters: equal ditches
    all.push_back(std::move(hard));
  }
  HardSeepage perched{.name = "PerchedOnATightLayer",
                      .section = vertical_dam(20, 11, 1, 1),
                      .conductivity = {isotropic(1), isotropic(1e-3)}};
  perched.section.zones = {box_zone(1, 4, 5, 16, 6)};
  perched.section.marked_lines = {{{0, 11}, {20, 11}}};
  perched.marked = {{seepage::BoundaryKind::inflow, 0.02}};
  perched.discharge = KnownDischarge{0.4, 1e-6};
  all.push_back(std::move(perched));
  HardSeepage drawn{.name = "MoreDrawnThanTheSoilYields", .section = vertical_dam(4, 3.5, 3, 0)};
  drawn.section.marked_lines = {{{0, 3.5}, {4, 3.5}}};
  drawn.marked = {{seepage::BoundaryKind::inflow, -0.5}};
  drawn.refused = "draws more water";
  all.push_back(std::move(drawn));
}

//------------------------------------------------------------------------------------------------
// Units: the same dam from 0.1 m to 10 km, k from 1e-12 to 1.
//------------------------------------------------------------------------------------------------

inline void add_scales(std::vector<HardSeepage>& all)
{
  for (const double height : {0.1, 12., 1e4})
    for (const double k : {1e-12, 1.})
    {
      const double scale = height / 12;
      all.push_back({.name = "Height" + power(height) + "K" + power(k),
                     .section = sloping_dam(scale),
                     .conductivity = {isotropic(k)},
                     .discharge = KnownDischarge{k * scale * sloping.value, sloping.relative}});
    }
}

/// Every case. Rain, walls and retention curves join as further add_...().
inline std::vector<HardSeepage> hard_seepage()
{
  std::vector<HardSeepage> all;
  add_contrasts(all);
  add_cores_and_drains(all);
  add_anisotropy(all);
  add_levels(all);
  add_shapes(all);
  add_boundaries(all);
  add_inflow(all);
  add_scales(all);
  return all;
}
} // namespace berm::tests
