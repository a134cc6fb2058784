// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "coupling/analysis.h"

#include <filesystem>
#include <string>
#include <utility>

namespace berm::app
{
/// Frames of a run-out as files of their own, frame_0000.h5 and so on, each written aside and then
/// renamed. They are kept beside the finished work of a run until its results are written, so that
/// an earlier run's stay as they are, and `berm run --resume` goes on from the last.
class FrameFiles final : public coupling::RunOutStore
{
public:
  /// @param[in] folder  Of the frames of a run that goes on; made when a run-out begins.
  explicit FrameFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void open(const sph::Particles& particles, double factor,
            const sph::RunOutSettings& settings) override;
  std::optional<Kept> kept() override;
  void keep(const sph::Frame& frame) override;

private:
  [[nodiscard]] std::filesystem::path path(Index number) const;
  [[nodiscard]] sph::Frame read(Index number) const;

  std::filesystem::path folder_;
  const sph::Particles* particles_ = nullptr;
  double factor_ = 0;
  sph::RunOutSettings settings_;
};

/// @brief Name of a frame's file, relative to the directory of the results.
[[nodiscard]] std::string frame_file(Index number);

/// @brief Remove the frames of an earlier run, and their folder if nothing else is in it.
void remove_frames(const std::filesystem::path& directory);

/// @brief The frames of a run that is written, in place of an earlier one's.
/// @param[in] folder  As for FrameFiles.
/// @throws IoError.
void publish_frames(const std::filesystem::path& folder, const std::filesystem::path& directory);

/// @brief XDMF text by which ParaView finds the frames: a time series.
[[nodiscard]] std::string run_out_xdmf(const coupling::RunOut& run_out, std::size_t particles);
} // namespace berm::app
