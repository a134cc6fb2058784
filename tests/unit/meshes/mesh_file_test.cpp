// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/mesh_file.h"

#include "core/error.h"
#include "meshes/section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

namespace berm::meshes
{
namespace
{
/// A file of gmsh that is gone after the test.
class GmshFile : public testing::Test
{
protected:
  std::filesystem::path written(const std::string& text, const char* name = "drawing.geo")
  {
    const char* test = testing::UnitTest::GetInstance()->current_test_info()->name();
    path_ = std::filesystem::path(testing::TempDir()) / (std::string(test) + "_" + name);
    std::ofstream(path_) << text << '\n';
    return path_;
  }
  ~GmshFile() override { std::filesystem::remove(path_); }

  /// What the message of the refusal says.
  std::string refusal(const std::string& text)
  {
    try
    {
      static_cast<void>(read_gmsh(written(text)));
    }
    catch (const InputError& e)
    {
      EXPECT_EQ(e.mistakes().front().key, "section.mesh_file");
      return e.what();
    }
    return "accepted";
  }

private:
  std::filesystem::path path_;
};

/// A rectangle 4 m x 2 m of two soils, the right one of 1 m; `right` its physical name.
std::string two_boxes(const std::string& more)
{
  return R"(
Point(1) = {0, 0, 0}; Point(2) = {3, 0, 0}; Point(3) = {4, 0, 0};
Point(4) = {4, 2, 0}; Point(5) = {3, 2, 0}; Point(6) = {0, 2, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4};
Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1}; Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6}; Curve Loop(2) = {2, 3, 4, -7};
Plane Surface(1) = {1}; Plane Surface(2) = {2};
)" + more;
}

const char* const both = "Physical Surface(\"clay\") = {1}; Physical Surface(\"sand\") = {2};";

TEST_F(GmshFile, OutlineAndRegionsOfAGeometry)
{
  const GmshDrawing drawing = read_gmsh(written(two_boxes(both)));
  EXPECT_EQ(drawing.outline.size(), 4u); // points of the mesh and of the inner border left out
  EXPECT_NEAR(polygon_area(drawing.outline), 8, 1e-12);
  ASSERT_EQ(drawing.regions.size(), 2u);
  EXPECT_EQ(drawing.regions[0].name, "clay"); // the larger one first
  EXPECT_NEAR(polygon_area(drawing.regions[0].polygon), 6, 1e-12);
  EXPECT_EQ(drawing.regions[1].name, "sand");
  EXPECT_NEAR(polygon_area(drawing.regions[1].polygon), 2, 1e-12);
  EXPECT_TRUE(drawing.curves.empty());
}

TEST_F(GmshFile, PhysicalCurvesAreLines)
{
  const GmshDrawing drawing =
      read_gmsh(written(two_boxes(std::string(both) + "Physical Curve(\"drain\") = {1, 2};"
                                                      "Physical Curve(\"side\") = {2, 3};")));
  ASSERT_EQ(drawing.curves.size(), 2u);
  EXPECT_EQ(drawing.curves[0].name, "drain");
  EXPECT_EQ(drawing.curves[0].line.size(), 2u); // straight through
  EXPECT_NEAR((drawing.curves[0].line[0] - drawing.curves[0].line[1]).norm(), 4, 1e-12);
  EXPECT_EQ(drawing.curves[1].line.size(), 3u);
}

TEST_F(GmshFile, ASoilAroundAnotherComesBeforeIt)
{
  const GmshDrawing drawing = read_gmsh(written(R"(
Point(1) = {0, 0, 0}; Point(2) = {6, 0, 0}; Point(3) = {6, 6, 0}; Point(4) = {0, 6, 0};
Point(5) = {2, 2, 0}; Point(6) = {4, 2, 0}; Point(7) = {4, 4, 0}; Point(8) = {2, 4, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Curve Loop(1) = {1:4}; Curve Loop(2) = {5:8};
Plane Surface(1) = {1, 2}; Plane Surface(2) = {2};
Physical Surface("lens") = {2}; Physical Surface("fill") = {1};)"));
  ASSERT_EQ(drawing.regions.size(), 2u);
  EXPECT_EQ(drawing.regions[0].name, "fill");
  EXPECT_NEAR(polygon_area(drawing.regions[0].polygon), 36, 1e-12); // its hole is the lens's
  EXPECT_NEAR(polygon_area(drawing.regions[1].polygon), 4, 1e-12);
}

TEST_F(GmshFile, CurvedBordersComeAsPolygons)
{
  const GmshDrawing drawing = read_gmsh(written(R"(
Point(1) = {0, 0, 0, 0.1}; Point(2) = {3, 0, 0, 0.1}; Point(3) = {-3, 0, 0, 0.1};
Circle(1) = {2, 1, 3}; Line(2) = {3, 2};
Curve Loop(1) = {1, 2}; Plane Surface(1) = {1};
Physical Surface("fill") = {1}; Mesh.CharacteristicLengthFromPoints = 1;)"));
  EXPECT_NEAR(polygon_area(drawing.outline), 4.5 * 3.14159265, 0.02);
  EXPECT_GT(drawing.outline.size(), 20u);
}

TEST_F(GmshFile, AMeshOfTwoSquaresThatTouchInAPointIsOnePieceOfTwoLoops)
{
  // Format 2.2: nodes, then triangles of the physical surface 1.
  const std::string mesh = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
2 1 "fill"
$EndPhysicalNames
$Nodes
7
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 2 1 0
6 2 2 0
7 1 2 0
$EndNodes
$Elements
4
1 2 2 1 1 1 2 3
2 2 2 1 1 1 3 4
3 2 2 1 1 3 5 6
4 2 2 1 1 7 6 3
$EndElements
)";
  try
  {
    static_cast<void>(read_gmsh(written(mesh, "touching.msh")));
    FAIL() << "two pieces were taken for one";
  }
  catch (const InputError& e)
  {
    EXPECT_NE(std::string(e.what()).find("2 pieces"), std::string::npos) << e.what();
  }
}

TEST_F(GmshFile, WhatCannotBeASectionIsRefused)
{
  EXPECT_NE(refusal(two_boxes("")).find("no physical surfaces"), std::string::npos);
  EXPECT_NE(refusal(two_boxes("Physical Surface(7) = {1, 2};")).find("7 has no name"),
            std::string::npos);
  EXPECT_NE(refusal("Point(1) = {0, 0").find("gmsh cannot read it"), std::string::npos);
  EXPECT_NE(refusal(two_boxes(std::string(both) + "Physical Curve(\"legs\") = {1, 3};"))
                .find("\"legs\" is not one line"),
            std::string::npos);
  const std::string tilted = two_boxes(both) + "Translate {0, 0, 1} { Surface{1, 2}; }";
  EXPECT_NE(refusal(tilted).find("z = 1 m"), std::string::npos);
}

TEST_F(GmshFile, AGeometryThatReachesOutsideIsRefusedUnread)
{
  const std::filesystem::path trace = std::filesystem::path(testing::TempDir()) / "berm_trace";
  std::filesystem::remove_all(trace);
  for (const std::string command : {"SystemCall \"touch ", "System \"touch ", "CreateDir \"",
                                    "NonBlockingSystemCall \"touch ", "Save \""})
  {
    const std::string text = command + trace.string() + "\";";
    const std::string word = command.substr(command.starts_with("NonB") ? 11 : 0);
    EXPECT_NE(refusal(two_boxes(std::string(both) + text)).find(word.substr(0, word.find(' '))),
              std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(trace)) << command;
  }
  EXPECT_THROW(static_cast<void>(read_gmsh("no/such/file.msh")), IoError);
}

TEST_F(GmshFile, AGeometryUnderTheNameOfAMeshIsNotRun)
{
  const std::filesystem::path trace = std::filesystem::path(testing::TempDir()) / "berm_trace_msh";
  std::filesystem::remove(trace);
  EXPECT_THROW(static_cast<void>(
                   read_gmsh(written("System \"touch " + trace.string() + "\";\n", "drawing.msh"))),
               InputError);
  EXPECT_FALSE(std::filesystem::exists(trace));
}

TEST_F(GmshFile, OptionsBesideAGeometryChangeNothingOutside)
{
  const std::filesystem::path trace = std::filesystem::path(testing::TempDir()) / "berm_trace_opt";
  std::filesystem::remove(trace);
  const std::filesystem::path geometry = written(two_boxes(std::string(both)));
  const std::filesystem::path options = geometry.string() + ".opt";
  std::ofstream(options) << "System \"touch " << trace.string() << "\";\n";
  EXPECT_THROW(static_cast<void>(read_gmsh(geometry)), InputError);
  EXPECT_FALSE(std::filesystem::exists(trace)); // gmsh runs them: the sandbox holds
  std::filesystem::remove(options);
}

TEST_F(GmshFile, AGeometryWithoutEndIsGivenUp)
{
  EXPECT_NE(refusal("For i In {1:2}\n i = 1;\nEndFor\n").find("takes longer than"),
            std::string::npos);
}
} // namespace
} // namespace berm::meshes
