// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/frame_files.h"

#include "app/field_group.h"
#include "core/error.h"

#include <fmt/format.h>

#include <array>
#include <numeric>
#include <utility>

namespace berm::app
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* frames_folder = "run_out";

std::string frame_name(Index number)
{
  return fmt::format("frame_{:04d}.h5", number);
}

/// What a frame holds besides fields, by its name on file.
template <class Frame, class Visit>
void visit_numbers(Frame& frame, const Visit& visit)
{
  visit("time_s", frame.time);
  visit("time_step_s", frame.time_step);
  visit("still_since_s", frame.still_since);
  auto& e = frame.energies;
  visit("kinetic_J_m", e.kinetic);
  visit("potential_J_m", e.potential);
  visit("elastic_J_m", e.elastic);
  visit("water_work_J_m", e.water);
  visit("shake_work_J_m", e.shake);
  visit("plastic_J_m", e.plastic);
  visit("viscous_J_m", e.viscous);
  visit("damping_J_m", e.damping);
}

/// Which run-out a frame is of.
std::array<std::pair<const char*, double>, 4> identity(double factor, const sph::RunOutSettings& s)
{
  return {{{"factor", factor},
           {"frame_interval_s", s.frame_interval},
           {"shake_m_s2", s.shake},
           {"shake_duration_s", s.shake_duration}}};
}

/// Columns x and y of rows (x, y) or (x, y, 0).
std::pair<std::vector<double>, std::vector<double>> columns(const std::vector<double>& rows,
                                                            std::size_t width)
{
  std::vector<double> x, y;
  for (std::size_t i = 0; i < rows.size(); i += width)
  {
    x.push_back(rows[i]);
    y.push_back(rows[i + 1]);
  }
  return {x, y};
}
} // namespace

std::string frame_file(Index number)
{
  return fmt::format("{}/{}", frames_folder, frame_name(number));
}

void remove_frames(const fs::path& directory)
{
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(directory / frames_folder, ignored))
    if (entry.path().filename().string().starts_with("frame_"))
      fs::remove(entry.path(), ignored);
  fs::remove(directory / frames_folder, ignored); // only if empty
}

void publish_frames(const fs::path& folder, const fs::path& directory)
{
  remove_frames(directory);
  std::error_code error;
  fs::create_directories(directory / frames_folder, error);
  for (const auto& entry : fs::directory_iterator(folder, error))
  {
    const fs::path frame = directory / frames_folder / entry.path().filename();
    if (entry.path().extension() != ".h5")
      continue; // half a frame
    fs::create_hard_link(entry.path(), frame, error);
    if (error) // this file system has none
      fs::copy_file(entry.path(), frame, fs::copy_options::overwrite_existing, error);
    if (error)
      throw IoError(frame.string() + ": " + error.message());
  }
  if (error)
    throw IoError((directory / frames_folder).string() + ": " + error.message());
}

fs::path FrameFiles::path(Index number) const
{
  return folder_ / frame_name(number);
}

void FrameFiles::open(const sph::Particles& particles, double factor,
                      const sph::RunOutSettings& settings)
{
  particles_ = &particles;
  factor_ = factor;
  settings_ = settings;
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error)
    throw IoError(folder_.string() + ": cannot be made a directory");
}

void FrameFiles::keep(const sph::Frame& frame)
{
  const fs::path aside = path(frame.number).string() + ".part";
  Hdf5File file(aside.string());
  Polyline position;
  for (std::size_t i = 0; i < frame.state.x.size(); ++i)
    position.emplace_back(frame.state.x[i], frame.state.y[i]);
  std::vector<std::int32_t> index(position.size());
  std::iota(index.begin(), index.end(), 0);

  FieldGroup fields(file, [&](std::size_t i) { return position[i]; });
  file.write("/position", flat(position), 2, {"m", "position (x, y)"});
  file.write("/index", index, 1, {"-", "number of the particle"});
  file.write("/soil", particles_->soil, 1,
             {"-", "number of the soil, from 0, in the case file's order"});
  write_state(fields, "/", frame.state);
  fields.scalar("/density", frame.state.density, {"kg/m3", "density"});
  fields.scalar("/pore_pressure", frame.pore_pressure,
                {"Pa", "pore pressure, compression positive"});
  file.attribute("/", "steps", static_cast<double>(frame.steps));
  visit_numbers(frame,
                [&file](const char* name, double value) { file.attribute("/", name, value); });
  for (const auto& [name, value] : identity(factor_, settings_))
    file.attribute("/", name, value);
  file.close();
  std::error_code error;
  fs::rename(aside, path(frame.number), error);
  if (error)
    throw IoError(path(frame.number).string() + ": " + error.message());
}

sph::Frame FrameFiles::read(Index number) const
{
  const Hdf5Reader file(path(number).string());
  sph::Frame frame;
  frame.number = number;
  sph::State& s = frame.state;
  std::tie(s.x, s.y) = columns(file.values("/position"), 2);
  std::tie(s.ux, s.uy) = columns(file.values("/displacement"), 3);
  std::tie(s.vx, s.vy) = columns(file.values("/velocity"), 3);
  s.plastic_strain = file.values("/plastic_strain");
  s.density = file.values("/density");
  frame.pore_pressure = file.values("/pore_pressure");
  s.stress.resize(s.x.size());
  for (const auto& [name, which] :
       {std::pair{"/stress_xx", &SymTensor::xx}, std::pair{"/stress_yy", &SymTensor::yy},
        std::pair{"/stress_zz", &SymTensor::zz}, std::pair{"/stress_xy", &SymTensor::xy}})
  {
    const std::vector<double> values = file.values(name);
    for (std::size_t i = 0; i < values.size() && i < s.stress.size(); ++i)
      s.stress[i].*which = values[i];
  }
  frame.steps = static_cast<long>(file.attribute("steps"));
  visit_numbers(frame, [&file](const char* name, double& value) { value = file.attribute(name); });
  return frame;
}

std::optional<FrameFiles::Kept> FrameFiles::kept()
{
  if (!fs::exists(path(0)))
    return std::nullopt;
  Kept kept{.last = read(0), .history = {}};
  kept.history.push_back(sph::moment_of(kept.last));
  for (Index number = 1; fs::exists(path(number)); ++number)
  {
    kept.last = read(number);
    kept.history.push_back(sph::moment_of(kept.last));
  }
  return kept;
}

std::string run_out_xdmf(const coupling::RunOut& run_out, std::size_t particles)
{
  std::string text(xdmf_head);
  text += "    <Grid Name=\"run-out\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  Index number = 0;
  for (const sph::Moment& moment : run_out.motion.history)
  {
    const std::string h5 = frame_file(number++);
    const auto item = [&](const char* name, std::size_t columns, bool whole = false)
    { return data_item(h5, std::string("/") + name, particles, columns, whole); };
    text += fmt::format("      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time "
                        "Value=\"{:.9g}\"/>\n",
                        h5, moment.time);
    text += point_cloud(particles, item("index", 1, true), item("position", 2));
    text += attribute("soil", "Node", item("soil", 1, true), false);
    for (const char* name : {"displacement", "velocity"})
      text += attribute(name, "Node", item(name, 3), true);
    for (const char* name : {"plastic_strain", "stress_xx", "stress_yy", "stress_zz", "stress_xy",
                             "density", "pore_pressure"})
      text += attribute(name, "Node", item(name, 1), false);
    text += "      </Grid>\n";
  }
  text += "    </Grid>\n";
  return text += xdmf_tail;
}
} // namespace berm::app
