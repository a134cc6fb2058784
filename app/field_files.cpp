// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/field_files.h"

#include "app/field_group.h"
#include "app/version.h"
#include "core/error.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace berm::app
{
namespace
{
/// The states that a run kept, in the order of the time series.
struct NamedState
{
  std::string name;
  const sph::State* state;
  const sph::Trial* trial; ///< null for the settled state
};

std::vector<NamedState> states(const coupling::Stability& stability)
{
  std::vector<NamedState> all;
  const auto add = [&](const char* name, const sph::State* state, const sph::Trial* trial)
  {
    if (state->ux.size() == stability.particles.size())
      all.push_back({name, state, trial});
  };
  add("settled", &stability.settled, nullptr);
  if (stability.searches.empty())
    return all;
  const sph::FactorOfSafety& factor = stability.governing().F;
  if (const sph::Trial* trial = factor.standing_trial())
    add("standing", &trial->state, trial);
  if (const sph::Trial* trial = factor.failing_trial())
    add("failing", &trial->state, trial);
  return all;
}

void write_particles(Hdf5File& file, const coupling::Stability& stability)
{
  const sph::Particles& p = stability.particles;
  FieldGroup fields(file, [&p](std::size_t i) { return Vec2{p.x[i], p.y[i]}; });
  Polyline positions;
  for (std::size_t i = 0; i < p.size(); ++i)
    positions.emplace_back(p.x[i], p.y[i]);
  std::vector<std::int32_t> index(p.size());
  std::iota(index.begin(), index.end(), 0);
  file.write("/particles/position", flat(positions), 2, {"m", "reference position (x, y)"});
  file.write("/particles/index", index, 1, {"-", "number of the particle"});
  file.write("/particles/soil", p.soil, 1,
             {"-", "number of the soil, from 0, in the case file's order"});
  fields.scalar("/particles/volume", p.volume,
                {"m2", "area of the section that the particle stands for"});
  fields.scalar("/particles/density", p.density,
                {"kg/m3", "density of the soil with the water in it"});
  fields.scalar("/particles/pore_pressure", stability.pore_pressure,
                {"Pa", "pore pressure, compression positive"});
  for (const NamedState& s : states(stability))
  {
    const std::string group = "/particles/" + s.name + "/";
    write_state(fields, group, *s.state);
    file.attribute(group, "factor", s.trial ? s.trial->factor : 1.0);
    file.attribute(group, "time_s", s.trial ? s.trial->time : 0.0);
  }
}

void write_mesh(Hdf5File& file, const seepage::Solution& solution)
{
  const auto& mesh = solution.mesh;
  std::vector<std::int32_t> triangles;
  for (const auto& t : mesh.triangles)
    triangles.insert(triangles.end(), t.begin(), t.end());
  std::vector<double> qx, qy;
  for (const Vec2& q : solution.flux)
  {
    qx.push_back(q.x());
    qy.push_back(q.y());
  }
  FieldGroup nodal(file, [&mesh](std::size_t i) { return mesh.nodes[i]; });
  FieldGroup cells(file,
                   [&mesh](std::size_t i)
                   {
                     const auto& t = mesh.triangles[i];
                     const auto node = [&](std::size_t a)
                     { return mesh.nodes[static_cast<std::size_t>(t[a])]; };
                     return Vec2((node(0) + node(1) + node(2)) / 3);
                   });
  file.write("/mesh/nodes", flat(mesh.nodes), 2, {"m", "position of the nodes (x, y)"});
  file.write("/mesh/triangles", triangles, 3,
             {"-", "nodes of each triangle, counter-clockwise, from 0"});
  file.write("/mesh/triangle_soil", mesh.triangle_soil, 1,
             {"-", "number of the soil, from 0, in the case file's order"});
  nodal.scalar("/mesh/head", solution.head, {"m", "hydraulic head above y = 0"});
  nodal.scalar("/mesh/pore_pressure", solution.pore_pressure,
               {"Pa", "pore pressure, compression positive, negative above the phreatic line"});
  if (!solution.stream_function.empty())
    nodal.scalar("/mesh/stream_function", solution.stream_function,
                 {"m2/s",
                  "stream function: the water between two stream lines, larger on the left of "
                  "the flow"});
  cells.vector("/mesh/flux", qx, qy, {"m/s", "Darcy flux (x, y, 0)"});
}

} // namespace

void write_fields(const std::string& path, const coupling::Case& input,
                  const coupling::Analysis& analysis)
{
  Hdf5File file(path);
  file.attribute("/", "title", input.title);
  file.attribute("/", "berm", version());
  file.write("/section/outline", flat(analysis.section.outline), 2,
             {"m", "outline, counter-clockwise (x, y)"});
  file.write("/section/ground", flat(analysis.section.ground), 2,
             {"m", "ground, left to right (x, y)"});
  if (analysis.seepage)
  {
    write_mesh(file, *analysis.seepage);
    if (!analysis.seepage->phreatic_lines.empty())
      file.write("/phreatic_line", flat(analysis.seepage->phreatic_lines.front()), 2,
                 {"m", "phreatic line, left to right (x, y)"});
  }
  if (analysis.stability)
  {
    write_particles(file, *analysis.stability);
    if (!analysis.stability->searches.empty() && analysis.stability->governing().mechanism)
      file.write("/slip_line", flat(analysis.stability->governing().mechanism->slip_line), 2,
                 {"m", "slip line, from uphill to downhill (x, y)"});
  }
  file.close();
}

std::string particles_xdmf(const coupling::Stability& stability, const std::string& h5_name)
{
  const std::size_t n = stability.particles.size();
  const auto item = [&](const std::string& path, std::size_t columns, bool whole = false)
  { return data_item(h5_name, "/particles/" + path, n, columns, whole); };
  std::string text(xdmf_head);
  text += "    <Grid Name=\"particles\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  int time = 0;
  for (const NamedState& s : states(stability))
  {
    text +=
        fmt::format("      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time Value=\"{}\"/>\n",
                    s.name, time++);
    text += point_cloud(n, item("index", 1, true), item("position", 2));
    text += attribute("soil", "Node", item("soil", 1, true), false);
    text += attribute("pore_pressure", "Node", item("pore_pressure", 1), false);
    for (const char* name : {"displacement", "velocity"})
      text += attribute(name, "Node", item(s.name + "/" + name, 3), true);
    for (const char* name : {"plastic_strain", "stress_xx", "stress_yy", "stress_zz", "stress_xy"})
      text += attribute(name, "Node", item(s.name + "/" + name, 1), false);
    text += "      </Grid>\n";
  }
  text += "    </Grid>\n";
  return text += xdmf_tail;
}

std::string mesh_xdmf(const seepage::Solution& solution, const std::string& h5_name)
{
  const std::size_t nodes = solution.mesh.nodes.size(), triangles = solution.mesh.triangles.size();
  std::string text(xdmf_head);
  text += "      <Grid Name=\"seepage\" GridType=\"Uniform\">\n";
  text += fmt::format(
      "        <Topology TopologyType=\"Triangle\" NumberOfElements=\"{}\">\n          {}\n"
      "        </Topology>\n"
      "        <Geometry GeometryType=\"XY\">\n          {}\n        </Geometry>\n",
      triangles, data_item(h5_name, "/mesh/triangles", triangles, 3, true),
      data_item(h5_name, "/mesh/nodes", nodes, 2));
  text += attribute("head", "Node", data_item(h5_name, "/mesh/head", nodes, 1), false);
  text += attribute("pore_pressure", "Node", data_item(h5_name, "/mesh/pore_pressure", nodes, 1),
                    false);
  if (!solution.stream_function.empty())
    text += attribute("stream_function", "Node",
                      data_item(h5_name, "/mesh/stream_function", nodes, 1), false);
  text += attribute("flux", "Cell", data_item(h5_name, "/mesh/flux", triangles, 3), true);
  text += attribute("soil", "Cell", data_item(h5_name, "/mesh/triangle_soil", triangles, 1, true),
                    false);
  text += "      </Grid>\n";
  return text += xdmf_tail;
}
} // namespace berm::app
