// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/hdf5_file.h"
#include "core/tensor.h"
#include "sph/particles.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Fields on HDF5 files, and the XDMF text by which ParaView finds them.
namespace berm::app
{
/// Writes fields that live on one set of places: particles, nodes or triangles.
class FieldGroup
{
public:
  /// @param[in] place  Position of a row [m], for messages.
  FieldGroup(Hdf5File& file, std::function<Vec2(std::size_t)> place);

  /// @throws NumericalError naming field, index and place of the first value that is not finite;
  /// IoError.
  void scalar(const std::string& path, std::span<const double> values,
              const Hdf5File::Label& label);
  /// In the plane, with a zero for z: ParaView's vectors have three components.
  void vector(const std::string& path, std::span<const double> x, std::span<const double> y,
              const Hdf5File::Label& label);

private:
  Hdf5File& file_;
  std::function<Vec2(std::size_t)> place_;
};

/// @brief Displacement, velocity, plastic strain and stress, under `group`, which ends in "/".
void write_state(FieldGroup& fields, const std::string& group, const sph::State& state);

/// @brief Points as rows of x and y.
[[nodiscard]] std::vector<double> flat(const Polyline& points);

/// @brief XDMF for a data set of `rows` rows.
/// @param[in] whole  32-bit integers, not doubles.
[[nodiscard]] std::string data_item(const std::string& h5, const std::string& path,
                                    std::size_t rows, std::size_t columns, bool whole = false);
/// @param[in] centre  "Node" or "Cell".
[[nodiscard]] std::string attribute(const std::string& name, const char* centre,
                                    const std::string& item, bool is_vector);
/// @brief XDMF topology and geometry of n points.
[[nodiscard]] std::string point_cloud(std::size_t n, const std::string& index_item,
                                      const std::string& position_item);

inline constexpr std::string_view xdmf_head = "<?xml version=\"1.0\"?>\n"
                                              "<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
                                              "<Xdmf Version=\"3.0\">\n  <Domain>\n";
inline constexpr std::string_view xdmf_tail = "  </Domain>\n</Xdmf>\n";
} // namespace berm::app
