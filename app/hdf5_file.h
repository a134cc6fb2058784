// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace berm::app
{
/// A new HDF5 file, written by one process (HDF5 is used here only), at once when it is closed: it
/// is in memory until then. Groups in a path are made as needed. Every data set says its unit and
/// its long name.
class Hdf5File
{
public:
  /// @throws IoError if HDF5 cannot make one.
  explicit Hdf5File(const std::string& path);
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  ~Hdf5File();

  struct Label
  {
    const char* unit;      ///< "m", "Pa", "-"
    const char* long_name; ///< what it is, with its sign convention if it has one
  };
  /// @brief Write rows of `columns` values each; shape (n) if `columns` is 1, else (n, columns).
  void write(const std::string& path, std::span<const double> values, std::size_t columns,
             const Label& label);
  void write(const std::string& path, std::span<const std::int32_t> values, std::size_t columns,
             const Label& label);

  /// @brief Write texts, UTF-8, each as long as the longest.
  void write(const std::string& path, const std::vector<std::string>& texts, const Label& label);

  /// @brief Attach a number or a text to a group or, with path "/", to the file.
  void attribute(const std::string& path, const char* name, double value);
  void attribute(const std::string& path, const char* name, const std::string& value);

  /// @brief Write everything out; called last.
  /// @throws IoError if that fails, e.g. on a full disk.
  void close();

private:
  void write_any(const std::string& path, const void* values, std::size_t count,
                 std::size_t columns, std::int64_t stored, std::int64_t in_memory,
                 const Label& label);
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  std::int64_t file_ = -1; ///< hid_t
};

/// An HDF5 file to read.
class Hdf5Reader
{
public:
  /// @throws IoError if there is no such file, or if it is not HDF5.
  explicit Hdf5Reader(const std::string& path);
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;
  ~Hdf5Reader();

  /// All values of a data set, row by row.
  [[nodiscard]] std::vector<double> values(const std::string& path) const;
  /// Of the file itself, or of a group.
  [[nodiscard]] double attribute(const char* name, const std::string& path = "/") const;
  [[nodiscard]] bool has(const std::string& path) const; ///< such a group or data set

private:
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  std::int64_t file_ = -1; ///< hid_t
};
} // namespace berm::app
