// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/field_files.h"

#include "case_text.h"
#include "small_run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <array>
#include <regex>

namespace berm::app::test
{
namespace
{
/// Reads what a test asks for; HDF5 closes its handles with the file.
class Reader
{
public:
  explicit Reader(const std::string& path)
      : file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT))
  {
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { H5Fclose(file_); }

  /// Empty if there is no such data set.
  [[nodiscard]] std::vector<hsize_t> shape(const std::string& path) const
  {
    const hid_t set = H5Dopen2(file_, path.c_str(), H5P_DEFAULT);
    if (set < 0)
      return {};
    const hid_t space = H5Dget_space(set);
    std::vector<hsize_t> sizes(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
    H5Sclose(space);
    H5Dclose(set);
    return sizes;
  }
  [[nodiscard]] std::vector<double> values(const std::string& path) const
  {
    std::size_t count = 1;
    for (const hsize_t n : shape(path))
      count *= n;
    std::vector<double> data(count);
    const hid_t set = H5Dopen2(file_, path.c_str(), H5P_DEFAULT);
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data());
    H5Dclose(set);
    return data;
  }
  [[nodiscard]] std::string text_attribute(const std::string& path, const char* name) const
  {
    const hid_t attribute = H5Aopen_by_name(file_, path.c_str(), name, H5P_DEFAULT, H5P_DEFAULT);
    if (attribute < 0)
      return {};
    const hid_t type = H5Aget_type(attribute);
    std::string text(H5Tget_size(type), '\0');
    H5Aread(attribute, type, text.data());
    H5Tclose(type);
    H5Aclose(attribute);
    return text.c_str(); // up to the closing zero
  }
  /// Paths of all data sets.
  [[nodiscard]] std::vector<std::string> data_sets() const
  {
    std::vector<std::string> paths;
    const auto visit = [](hid_t, const char* name, const auto* info, void* list) -> herr_t
    {
      if (info->type == H5O_TYPE_DATASET)
        static_cast<std::vector<std::string>*>(list)->push_back(std::string("/") + name);
      return 0;
    };
    H5Ovisit2(file_, H5_INDEX_NAME, H5_ITER_NATIVE, visit, &paths, H5O_INFO_BASIC);
    return paths;
  }

private:
  hid_t file_;
};

std::string written(const TemporaryDirectory& directory)
{
  std::string path = (directory.path() / "results.h5").string();
  write_fields(path, small_case(), small_analysis());
  return path;
}
} // namespace

TEST(FieldFiles, HoldWhatTheRunFound)
{
  const TemporaryDirectory directory;
  const Reader file(written(directory));
  EXPECT_EQ(file.values("/mesh/head"), (std::vector<double>{1, 0.5, 0.5, 1}));
  EXPECT_EQ(file.values("/mesh/triangles"), (std::vector<double>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(file.values("/mesh/stream_function"), (std::vector<double>{0, 0, 5e-7, 5e-7}));
  EXPECT_EQ(file.values("/mesh/flux"), (std::vector<double>{5e-7, 0, 0, 5e-7, 0, 0}));
  EXPECT_EQ(file.values("/particles/position"),
            (std::vector<double>{0.2, 0.5, 0.5, 0.5, 0.8, 0.5}));
  EXPECT_EQ(file.values("/particles/pore_pressure"), (std::vector<double>{4000, 2000, 0}));
  EXPECT_EQ(file.values("/particles/failing/displacement"),
            (std::vector<double>{0.25, 0, 0, 0.5, 0, 0, 0.75, 0, 0}));
  EXPECT_EQ(file.values("/particles/failing/plastic_strain"), (std::vector<double>{0.1, 0.2, 0.3}));
  EXPECT_EQ(file.values("/particles/settled/stress_yy"), (std::vector<double>{-2e3, -2e3, -2e3}));
  EXPECT_EQ(file.values("/slip_line"), (std::vector<double>{0, 1, 1, 0.5}));
  EXPECT_EQ(file.text_attribute("/", "title"), "a \"small\" case");
}

TEST(FieldFiles, EveryDataSetSaysItsUnitAndItsName)
{
  const TemporaryDirectory directory;
  const Reader file(written(directory));
  const std::vector<std::string> paths = file.data_sets();
  EXPECT_GT(paths.size(), 30u);
  for (const std::string& path : paths)
  {
    EXPECT_FALSE(file.text_attribute(path, "unit").empty()) << path;
    EXPECT_FALSE(file.text_attribute(path, "long_name").empty()) << path;
  }
}

TEST(FieldFiles, XdmfRefersToDataSetsOfTheRightShape)
{
  const TemporaryDirectory directory;
  const Reader file(written(directory));
  const coupling::Analysis analysis = small_analysis();
  const std::regex item("Dimensions=\"([0-9 ]+)\">results.h5:([^<]+)<");
  int items = 0;
  for (const std::string& text : {particles_xdmf(*analysis.stability, "results.h5"),
                                  mesh_xdmf(*analysis.seepage, "results.h5")})
    for (auto it = std::sregex_iterator(text.begin(), text.end(), item);
         it != std::sregex_iterator(); ++it)
    {
      const std::string shape = fmt::format("{}", fmt::join(file.shape((*it)[2]), " "));
      EXPECT_EQ((*it)[1], shape) << (*it)[2];
      ++items;
    }
  EXPECT_EQ(items, 3 * 11 + 7); // settled, standing, failing; and the mesh
}

TEST(FieldFiles, CannotBeWrittenWhereThereIsNoDirectory)
{
  EXPECT_THROW(write_fields("/nonexistent/results.h5", small_case(), small_analysis()), IoError);
}
} // namespace berm::app::test
