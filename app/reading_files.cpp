// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/reading_files.h"

#include "app/case_lines.h"
#include "core/error.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <utility>

namespace berm::app
{
namespace
{
/// A table as CSV.
class Csv
{
public:
  Csv(std::filesystem::path path, std::vector<std::string> columns)
      : file_{std::move(path), ""}, columns_(std::move(columns))
  {
    for (const std::string& name : columns_)
      file_.text += (name == columns_.front() ? "" : ",") + name;
    file_.text += '\n';
  }
  /// @param[in] first  Cells of text before the numbers, each with its comma.
  void row(const std::string& first, const std::vector<double>& numbers)
  {
    ++rows_;
    file_.text += first;
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      if (!std::isfinite(numbers[i]))
        throw NumericalError(
            fmt::format("{}: {} = {} in row {}: results are not written", file_.path.string(),
                        columns_[columns_.size() - numbers.size() + i], numbers[i], rows_));
      fmt::format_to(std::back_inserter(file_.text), "{}{:.9g}", i == 0 ? "" : ",", numbers[i]);
    }
    file_.text += '\n';
  }
  [[nodiscard]] TextFile file() && { return std::move(file_); }

private:
  TextFile file_;
  std::vector<std::string> columns_;
  std::size_t rows_ = 0;
};

TextFile line_file(const coupling::OutputLine& line, const seepage::LineReading& reading)
{
  Csv csv(line_path(line), {"distance_m", "x_m", "y_m", "head_m", "pore_pressure_kPa", "flux_x_m_s",
                            "flux_y_m_s", "gradient"});
  for (const seepage::LineSample& s : reading.samples)
    csv.row("", {s.distance, s.at.x(), s.at.y(), s.head, s.pore_pressure / 1e3, s.flux.x(),
                 s.flux.y(), s.gradient});
  return std::move(csv).file();
}

TextFile phreatic_file(const seepage::Solution& solution)
{
  Csv csv("phreatic_lines.csv", {"line", "x_m", "y_m"});
  for (std::size_t i = 0; i < solution.phreatic_lines.size(); ++i)
    for (const Vec2& p : solution.phreatic_lines[i])
      csv.row(fmt::format("{},", i + 1), {p.x(), p.y()});
  return std::move(csv).file();
}

TextFile exit_file(const coupling::Analysis& analysis)
{
  Csv csv("exit_gradients.csv",
          {"outlet", "stretch", "counts", "distance_m", "x_m", "y_m", "head_m", "normal_gradient",
           "upward_gradient", "critical_gradient", "flux_m_s"});
  const std::vector<seepage::Outlet>& outlets = analysis.readings.outlets;
  for (std::size_t i = 0; i < outlets.size(); ++i)
    for (const seepage::ExitPoint& p : outlets[i].points)
    {
      const auto stretch = static_cast<std::size_t>(outlets[i].stretch);
      csv.row(fmt::format("{},{},{},", i + 1, analysis.section.stretches.at(stretch).name,
                          p.beside_singularity ? 0 : 1),
              {p.distance, p.at.x(), p.at.y(), p.head, p.normal, p.upward,
               analysis.readings.critical_gradient.at(static_cast<std::size_t>(p.soil)), p.flux});
    }
  return std::move(csv).file();
}
} // namespace

std::filesystem::path line_path(const coupling::OutputLine& line)
{
  return std::filesystem::path(lines_folder) / (file_name(line.name) + ".csv");
}

std::vector<TextFile> reading_files(const coupling::Case& input, const coupling::Analysis& analysis)
{
  std::vector<TextFile> files;
  if (!analysis.seepage)
    return files;
  files.push_back(phreatic_file(*analysis.seepage));
  files.push_back(exit_file(analysis));
  for (std::size_t i = 0; i < analysis.readings.lines.size(); ++i)
    files.push_back(line_file(input.output.lines.at(i), analysis.readings.lines[i]));
  return files;
}
} // namespace berm::app
