// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupling/analysis.h"

#include <string>

namespace berm::app
{
/// @brief Write every field of a run as HDF5; docs/output_format.md lists the data sets.
/// @throws NumericalError naming field, index and place of the first value that is not finite;
/// IoError.
void write_fields(const std::string& path, const coupling::Case& input,
                  const coupling::Analysis& analysis);

/// @brief XDMF text by which ParaView finds the particle fields in `h5_name`: a time series of the
/// states settled, standing and failing, as far as they are there.
[[nodiscard]] std::string particles_xdmf(const coupling::Stability& stability,
                                         const std::string& h5_name);

/// @brief XDMF text for the seepage mesh: head and pore pressure at nodes, flux in triangles.
[[nodiscard]] std::string mesh_xdmf(const seepage::Solution& solution, const std::string& h5_name);
} // namespace berm::app
