// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/tensor.h"
#include "coupling/region.h"
#include "meshes/section.h"
#include "seepage/line_reading.h"
#include "seepage/seepage.h"
#include "sph/run_out.h"
#include "sph/soil.h"
#include "sph/strength_reduction.h"

#include <optional>
#include <string>
#include <vector>

namespace berm::coupling
{
enum class PorePressureKind
{
  none,
  hydrostatic,
  seepage
};

[[nodiscard]] const char* to_string(PorePressureKind kind);

/// A soil of the case: what the particles need, and what the seepage solve needs.
struct Soil
{
  std::string name;
  sph::Soil mechanical;
  std::optional<seepage::Conductivity> conductivity;
};

struct Water
{
  PorePressureKind pore_pressure = PorePressureKind::none;
  std::optional<double> left_level, right_level; ///< pools [m]
  Polyline free_surface; ///< hydrostatic: x increasing [m]; empty: the straight line of the pools
                         ///< and toe
};

struct SphSettings
{
  double spacing = 0;           ///< dx [m]; 0: chosen from the section
  std::string packing = "auto"; ///< "auto", "columns", "lattice", "hexagonal", "mesh"
  std::string cone = "fitted";  ///< "fitted": cone fitted to Mohr-Coulomb for psi; "paper": Bui et
                                ///< al. 2009 eq. (14)
  std::string formulation = "total_lagrangian"; ///< or "paper": docs/theory.md section 9
  int threads = 0;                              ///< 0: as many as OpenMP would take
};

/// Soil that fails and flows.
struct RunOutSettings
{
  std::optional<double> factor; ///< on strength, from the settled state; absent: go on from the
                                ///< failing trial
  sph::RunOutSettings motion;
};

/// A line along which to read the seepage solution.
struct OutputLine
{
  std::string name;
  seepage::Line line;
};

struct Output
{
  Polyline probes; ///< where to print head and pore pressure [m]
  std::vector<OutputLine> lines;
  bool figures = true;
  std::vector<std::string> figure_formats{"png"}; ///< png, svg
  bool msh = false;                               ///< the seepage mesh as a file of gmsh
  bool report = true;                             ///< whether to write report.html
};

/// A validated case: SI, radians, every field set. docs/case_reference.md lists the keys.
struct Case
{
  std::string title;
  std::string path;                   ///< as given
  std::string text;                   ///< the file, with the effect of --set not in it
  std::vector<std::string> overrides; ///< of --set
  meshes::SectionInput section;       ///< pools and marked lines already in it
  std::vector<Soil> soils;            ///< the first covers what no zone covers
  Water water;
  std::vector<seepage::Boundary> marked_boundaries; ///< one for each marked line
  double rain = 0;                                  ///< on open ground, seepage alone [m/s]
  seepage::Settings seepage;
  SphSettings sph;
  bool stability = true; ///< whether to look for the factor of safety
  sph::SearchSettings search;
  SearchScope scope;
  bool flow_rule_spread = false;         ///< whether to search with psi = 0 and psi = phi, too
  std::optional<RunOutSettings> run_out; ///< only where asked for
  Output output;
};
} // namespace berm::coupling
