// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"

#include <string>
#include <vector>

namespace berm::meshes
{
/// What a physical surface covers.
struct DrawnRegion
{
  std::string name;
  Polyline
      polygon; ///< outer border, counter-clockwise; what lies in its holes belongs to others [m]
};

/// A physical curve.
struct DrawnCurve
{
  std::string name;
  Polyline line; ///< a closed one ends where it begins [m]
};

/// A section as a file of gmsh draws it.
struct GmshDrawing
{
  Polyline outline;                 ///< of all regions together, counter-clockwise [m]
  std::vector<DrawnRegion> regions; ///< largest first, so that a later one covers an earlier one; a
                                    ///< surface in several pieces comes several times
  std::vector<DrawnCurve> curves;
};
} // namespace berm::meshes
