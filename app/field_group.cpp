// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/field_group.h"

#include "core/error.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace berm::app
{
namespace
{
using Label = Hdf5File::Label;

/// Refuse NaN and infinity, telling which value of which field, and where.
/// @param[in] place  Position of a row [m].
void require_finite(const std::string& field, std::span<const double> values, std::size_t columns,
                    const std::function<Vec2(std::size_t)>& place)
{
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
    {
      const Vec2 at = place(i / columns);
      throw NumericalError(fmt::format("{}[{}] = {} at ({:.6g}, {:.6g}) m: results are not written",
                                       field, i / columns, values[i], at.x(), at.y()));
    }
}

std::vector<double> component(const std::vector<SymTensor>& tensors, double SymTensor::*which)
{
  std::vector<double> values;
  for (const SymTensor& t : tensors)
    values.push_back(t.*which);
  return values;
}
} // namespace

FieldGroup::FieldGroup(Hdf5File& file, std::function<Vec2(std::size_t)> place)
    : file_(file), place_(std::move(place))
{
}

void FieldGroup::scalar(const std::string& path, std::span<const double> values, const Label& label)
{
  require_finite(path, values, 1, place_);
  file_.write(path, values, 1, label);
}

void FieldGroup::vector(const std::string& path, std::span<const double> x,
                        std::span<const double> y, const Label& label)
{
  std::vector<double> rows;
  for (std::size_t i = 0; i < x.size(); ++i)
    rows.insert(rows.end(), {x[i], y[i], 0});
  require_finite(path, rows, 3, place_);
  file_.write(path, rows, 3, label);
}

void write_state(FieldGroup& fields, const std::string& group, const sph::State& state)
{
  constexpr const char* sign = "effective stress, tension positive";
  fields.vector(group + "displacement", state.ux, state.uy,
                {"m", "displacement since the settled state (x, y, 0)"});
  fields.vector(group + "velocity", state.vx, state.vy, {"m/s", "velocity (x, y, 0)"});
  fields.scalar(group + "plastic_strain", state.plastic_strain,
                {"-", "accumulated equivalent deviatoric plastic strain"});
  for (const auto& [name, which] :
       {std::pair{"stress_xx", &SymTensor::xx}, std::pair{"stress_yy", &SymTensor::yy},
        std::pair{"stress_zz", &SymTensor::zz}, std::pair{"stress_xy", &SymTensor::xy}})
    fields.scalar(group + name, component(state.stress, which), {"Pa", sign});
}

std::vector<double> flat(const Polyline& points)
{
  std::vector<double> rows;
  for (const Vec2& p : points)
    rows.insert(rows.end(), {p.x(), p.y()});
  return rows;
}

std::string data_item(const std::string& h5, const std::string& path, std::size_t rows,
                      std::size_t columns, bool whole)
{
  return fmt::format(
      "<DataItem Format=\"HDF\" NumberType=\"{}\" Precision=\"{}\" Dimensions=\"{}{}\">"
      "{}:{}</DataItem>",
      whole ? "Int" : "Float", whole ? 4 : 8, rows, columns == 1 ? "" : fmt::format(" {}", columns),
      h5, path);
}

std::string attribute(const std::string& name, const char* centre, const std::string& item,
                      bool is_vector)
{
  return fmt::format(
      "        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">\n          {}\n"
      "        </Attribute>\n",
      name, is_vector ? "Vector" : "Scalar", centre, item);
}

std::string point_cloud(std::size_t n, const std::string& index_item,
                        const std::string& position_item)
{
  return fmt::format("        <Topology TopologyType=\"Polyvertex\" NodesPerElement=\"1\" "
                     "NumberOfElements=\"{}\">\n"
                     "          {}\n        </Topology>\n"
                     "        <Geometry GeometryType=\"XY\">\n          {}\n        </Geometry>\n",
                     n, index_item, position_item);
}
} // namespace berm::app
