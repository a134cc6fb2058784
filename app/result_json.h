// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupling/analysis.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace berm::app
{
using Json = nlohmann::ordered_json;

/// Head and pore pressure at one of the points that the case asks for.
struct Probe
{
  Vec2 at{0, 0};            ///< [m]
  double head = 0;          ///< [m]
  double pore_pressure = 0; ///< [Pa], negative above the phreatic line
};

/// @brief Values at the case's probes from the seepage solve; empty without one.
[[nodiscard]] std::vector<Probe> probes(const coupling::Case& input,
                                        const coupling::Analysis& analysis);

/// @brief Discharge over conductivity [m] if all soils have the same, isotropic one.
[[nodiscard]] std::optional<double> discharge_over_k(const coupling::Case& input,
                                                     const coupling::Analysis& analysis);

/// @brief Particle steps per second of processor time in the soil stages; nothing before there were
/// any.
[[nodiscard]] std::optional<double>
particle_steps_per_cpu_second(const coupling::Analysis& analysis);

/// @brief Whether every stage that was asked for came to its answer: a bracket as narrow as asked,
/// soil at rest.
[[nodiscard]] bool complete(const coupling::Case& input, const coupling::Analysis& analysis);

/// @brief How far the highest soil at the end of a run-out stands above the higher pool [m];
/// nothing without a pool.
[[nodiscard]] std::optional<double> freeboard(const coupling::RunOut& run_out,
                                              const meshes::Section& section);

/// @brief The contract for scripts: docs/output_format.md. Times are under "seconds" and in
/// "performance" only; all else is the same, bit for bit, when a run is repeated.
/// @param[in] warnings  What was warned of on the way.
/// @throws NumericalError naming the first value that is not finite.
[[nodiscard]] Json result_json(const coupling::Case& input, const coupling::Analysis& analysis,
                               std::span<const std::string> warnings = {});

/// @brief JSON with a line for each member, but points and lists of points on one line.
[[nodiscard]] std::string json_text(const Json& json, std::size_t indent = 0);

/// @brief Refuse NaN and infinity.
/// @throws NumericalError naming the path of the first value that is not finite.
void require_finite(const Json& json);
} // namespace berm::app
