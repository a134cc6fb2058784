// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupling/analysis.h"

#include <filesystem>
#include <string>

namespace berm::app
{
/// Frames of a run-out as files of their own, run_out/frame_0000.h5 and so on: each is written
/// aside and then renamed, so that a run that is killed leaves all frames up to then readable, and
/// `berm run --resume` goes on from the last.
class FrameFiles final : public coupling::RunOutStore
{
public:
  /// @param[in] directory  Of the results.
  /// @param[in] resume     Go on from the frames there; else they are removed when a run-out opens.
  FrameFiles(std::filesystem::path directory, bool resume);

  void open(const sph::Particles& particles, double factor,
            const sph::RunOutSettings& settings) override;
  /// @throws IoError if the frames there are not of the same run-out, bit for bit.
  std::optional<Kept> kept(const sph::Frame& first) override;
  void keep(const sph::Frame& frame) override;

private:
  [[nodiscard]] std::filesystem::path path(Index number) const;
  [[nodiscard]] sph::Frame read(Index number) const;

  std::filesystem::path directory_;
  bool resume_;
  const sph::Particles* particles_ = nullptr;
  double factor_ = 0;
  sph::RunOutSettings settings_;
};

/// @brief Name of a frame's file, relative to the directory of the results.
[[nodiscard]] std::string frame_file(Index number);

/// @brief Remove the frames of an earlier run, and their folder if nothing else is in it.
void remove_frames(const std::filesystem::path& directory);

/// @brief XDMF text by which ParaView finds the frames: a time series.
[[nodiscard]] std::string run_out_xdmf(const coupling::RunOut& run_out, std::size_t particles);
} // namespace berm::app
