// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/slopes.h"

#include <cmath>
#include <string>
#include <vector>

/// The published slopes by which factors of safety are judged: rows F-1 to F-7 of
/// docs/verification.md, psi = 0, dry or hydrostatic.
namespace berm::tests
{
struct PublishedSlope
{
  std::string name;
  double height;    ///< of the slope [m]
  double reference; ///< F: strict finite-element reduction where there is one, else the middle
                    ///< between that printed and limit equilibrium, else exact
  coupling::Case at_one_metre; ///< set sph.spacing as you like
};

inline std::vector<PublishedSlope> published_slopes()
{
  const double foot = 0.3048, beta = 20 * pi / 180;
  const Polyline embankment = {{0, 7.3},       {33.5, 7.3},  {99.83, 28.6},
                               {107.13, 28.6}, {157.9, 7.3}, {191.4, 7.3}};
  const Polyline straight_line = {{0, 24.4}, {86.75, 24.4}, {157.9, 7.3}, {191.4, 7.3}};
  const Polyline griffiths_lane = {{0, 10}, {12, 10}, {32, 0}};
  const Polyline submerged = {
      {0, 15 * foot}, {30 * foot, 15 * foot}, {105 * foot, 45 * foot}, {140 * foot, 45 * foot}};
  const sph::Soil fill = soil(13.8, 37, 18.2), clayey = soil(10, 20, 20);
  const sph::Soil in_feet = soil(100 * 0.0478803, 20, 128 * 0.157087);
  return {
      {"F-1 dry", 21.3, 2.41, slope(embankment, 0, fill, 1)},
      {"F-1 straight line", 21.3, 1.85, slope(embankment, 0, fill, 1, straight_line)},
      {"F-2", 10, 1.355, slope(griffiths_lane, 0, clayey, 1)},
      {"F-3 L/H = 0", 10, 1.8365, slope(griffiths_lane, 0, clayey, 1, {{0, 10}, {32, 10}})},
      {"F-3 L/H = 1/2", 10, 1.351, slope(griffiths_lane, 0, clayey, 1, {{0, 5}, {32, 5}})},
      {"F-4", 10, 1.461, slope({{0, 20}, {20, 20}, {40, 10}, {80, 10}}, 0, soil(50, 0, 20), 1)},
      {"F-4 vertical cut", 10, 1,
       slope({{0, 10}, {20, 10}, {20, 20}, {40, 20}}, 0, soil(200 / 3.7765, 0, 20), 1)},
      {"F-5", 10, 0.99, slope({{20, 25}, {30, 25}, {50, 35}, {70, 35}}, 20, soil(3, 19.6, 20), 1)},
      {"F-6", 30 * foot, 1.60,
       slope(submerged, 0, in_feet, 1, {{0, 75 * foot}, {140 * foot, 75 * foot}})},
      {"F-7", 10, std::tan(35 * pi / 180) / std::tan(beta),
       slope({{0, 5}, {20, 5}, {20 + 10 / std::tan(beta), 15}, {70, 15}}, 0, soil(0, 35, 20), 1)},
  };
}
} // namespace berm::tests
