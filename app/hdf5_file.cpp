// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/hdf5_file.h"

#include "core/error.h"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <type_traits>

namespace berm::app
{
static_assert(std::is_same_v<hid_t, std::int64_t>, "Hdf5File keeps HDF5's handles as int64");

namespace
{
constexpr std::size_t growth = 1 << 20; ///< of a file in memory [bytes]

/// A handle that closes itself.
class Handle
{
public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle()
  {
    if (id_ >= 0)
      close_(id_);
  }
  [[nodiscard]] hid_t id() const { return id_; }
  [[nodiscard]] bool ok() const { return id_ >= 0; }

private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

bool attach(hid_t object, const char* name, hid_t type, const void* value)
{
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name, type, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  return attribute.ok() && H5Awrite(attribute.id(), type, value) >= 0;
}

bool attach_text(hid_t object, const char* name, const std::string& text)
{
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  // Length 0 is not a type; one more than the text is.
  H5Tset_size(type.id(), text.size() + 1);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return attach(object, name, type.id(), text.c_str());
}
} // namespace

Hdf5File::Hdf5File(const std::string& path) : path_(path)
{
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // failures are told by exceptions
  // In memory first: HDF5 crashes at the end of the process if it could not write all of a file.
  const Handle in_memory(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(in_memory.id(), growth, 0);
  file_ = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, in_memory.id());
  if (file_ < 0)
    fail("cannot be made");
}

Hdf5File::~Hdf5File()
{
  if (file_ >= 0)
    H5Fclose(file_);
}

void Hdf5File::close()
{
  const bool flushed = H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0;
  const ssize_t size = flushed ? H5Fget_file_image(file_, nullptr, 0) : -1;
  std::string image(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  const bool good = size > 0 && H5Fget_file_image(file_, image.data(), image.size()) == size;
  H5Fclose(file_);
  file_ = -1;
  if (!good)
    fail("cannot be made");
  std::ofstream file(path_, std::ios::binary);
  file << image;
  file.close();
  if (!file)
    fail("cannot be written; is the disk full?");
}

void Hdf5File::write(const std::string& path, std::span<const double> values, std::size_t columns,
                     const Label& label)
{
  write_any(path, values.data(), values.size(), columns, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, label);
}

void Hdf5File::write(const std::string& path, std::span<const std::int32_t> values,
                     std::size_t columns, const Label& label)
{
  write_any(path, values.data(), values.size(), columns, H5T_STD_I32LE, H5T_NATIVE_INT32, label);
}

void Hdf5File::write(const std::string& path, const std::vector<std::string>& texts,
                     const Label& label)
{
  std::size_t length = 1;
  for (const std::string& text : texts)
    length = std::max(length, text.size());
  std::string block;
  for (std::string text : texts)
  {
    text.resize(length);
    block += text;
  }
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), length);
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  write_any(path, block.data(), texts.size(), 1, type.id(), type.id(), label);
}

void Hdf5File::write_any(const std::string& path, const void* values, std::size_t count,
                         std::size_t columns, std::int64_t stored, std::int64_t in_memory,
                         const Label& label)
{
  const std::array<hsize_t, 2> shape{count / columns, columns};
  const Handle space(H5Screate_simple(columns == 1 ? 1 : 2, shape.data(), nullptr), H5Sclose);
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links.id(), 1);
  const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(layout.id(), false); // equal runs give equal files
  const Handle set(
      H5Dcreate2(file_, path.c_str(), stored, space.id(), links.id(), layout.id(), H5P_DEFAULT),
      H5Dclose);
  const bool written = set.ok() && (count == 0 || H5Dwrite(set.id(), in_memory, H5S_ALL, H5S_ALL,
                                                           H5P_DEFAULT, values) >= 0);
  if (!written || !attach_text(set.id(), "unit", label.unit) ||
      !attach_text(set.id(), "long_name", label.long_name))
    fail("data set " + path + " cannot be written");
}

void Hdf5File::attribute(const std::string& path, const char* name, double value)
{
  const Handle object(H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose);
  if (!object.ok() || !attach(object.id(), name, H5T_NATIVE_DOUBLE, &value))
    fail("attribute " + path + ":" + name + " cannot be written");
}

void Hdf5File::attribute(const std::string& path, const char* name, const std::string& value)
{
  const Handle object(H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose);
  if (!object.ok() || !attach_text(object.id(), name, value))
    fail("attribute " + path + ":" + name + " cannot be written");
}

void Hdf5File::fail(const std::string& what) const
{
  throw IoError(path_ + ": " + what);
}

Hdf5Reader::Hdf5Reader(const std::string& path) : path_(path)
{
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0)
    fail("cannot be read as HDF5");
}

Hdf5Reader::~Hdf5Reader()
{
  if (file_ >= 0)
    H5Fclose(file_);
}

std::vector<double> Hdf5Reader::values(const std::string& path) const
{
  const Handle set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle space(set.ok() ? H5Dget_space(set.id()) : -1, H5Sclose);
  const hssize_t count = space.ok() ? H5Sget_simple_extent_npoints(space.id()) : -1;
  // What berm writes is neither compressed nor left out: a set takes four bytes a value or more.
  if (count > 0 && H5Dget_storage_size(set.id()) / 4 < static_cast<hsize_t>(count))
    fail("data set " + path + " is not as berm writes it");
  std::vector<double> values(count > 0 ? static_cast<std::size_t>(count) : 0);
  if (count < 0 || (count > 0 && H5Dread(set.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                                         values.data()) < 0))
    fail("data set " + path + " cannot be read");
  return values;
}

bool Hdf5Reader::has(const std::string& path) const
{
  return Handle(H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose).ok();
}

double Hdf5Reader::attribute(const char* name, const std::string& path) const
{
  double value = 0;
  const Handle attribute(H5Aopen_by_name(file_, path.c_str(), name, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  if (!attribute.ok() || H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value) < 0)
    fail(std::string("attribute ") + name + " cannot be read");
  return value;
}

void Hdf5Reader::fail(const std::string& what) const
{
  throw IoError(path_ + ": " + what);
}
} // namespace berm::app
