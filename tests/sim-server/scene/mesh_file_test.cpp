// SPDX-License-Identifier: MIT
// Meshes are read from each format alike; what is wrong with a file is told with its line.
#include "sim-server/scene/mesh/mesh_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program/config.hpp"
#include "sim-server/scene/mesh/mesh_mass.hpp"
#include "sim-server/scene/mesh/soundness.hpp"
#include "tests/sim-server/scene/mesh_forms.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A tetrahedron of volume 1/6, corners a unit from the origin along each axis.
const std::string kObj = R"(# a corner
o corner
v 0 0 0
v 1 0 0  # x
v 0 1 0
v 0 0 1
vn 0 0 1
usemtl none
f 1 3 2
f 1/1 2/2/2 4//1
f -4 -1 -2
f 2 3 4
)";

const std::string kStl = R"(solid corner
  facet normal 0 0 -1
    outer loop
      vertex 0 0 0
      vertex 0 1 0
      vertex 1 0 0
    endloop
  endfacet
  facet normal 0 -1 0
    outer loop
      vertex 0 0 0
      vertex 1 0 0
      vertex 0 0 1e0
    endloop
  endfacet
  facet normal 7 7 7
    outer loop
      vertex 0 0 0
      vertex 0 0 1
      vertex -0 1 0
    endloop
  endfacet
  facet normal 1 1 1
    outer loop
      vertex 1 0 0
      vertex 0 1 0
      vertex 0 0 1
    endloop
  endfacet
endsolid corner
)";

TEST(MeshFile, ReadsEachFormatAsTheSameSolid) {
  const TriangleMesh obj = parse_mesh(kObj, "corner.obj", 1.0);
  const TriangleMesh windows = parse_mesh("\r\n" + kObj, "corner.OBJ", 1.0);
  const TriangleMesh text = parse_mesh(kStl, "corner.stl", 1.0);
  const TriangleMesh binary = parse_mesh(stl_bytes(obj), "corner.STL", 1.0);
  for (const TriangleMesh& mesh : {obj, windows, text, binary}) {
    EXPECT_EQ(mesh.vertices.size(), 4U) << "corners at one place are one vertex";
    EXPECT_EQ(mesh.triangles.size(), 4U);
    EXPECT_NO_THROW(check_soundness(mesh));
    EXPECT_NEAR(signed_volume(mesh), 1.0 / 6.0, 1e-15);
  }
  EXPECT_EQ(obj.lines, (std::vector{9, 10, 11, 12}));
  EXPECT_EQ(windows.lines, (std::vector{10, 11, 12, 13}));
  EXPECT_EQ(text.lines, (std::vector{2, 9, 16, 23}));
}

TEST(MeshFile, CutsPolygonsIntoTriangles) {
  const TriangleMesh box = box_mesh({1.0, 2.0, 3.0});
  std::string text = obj_text(box);
  text.resize(text.find("f "));
  text += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  const TriangleMesh mesh = parse_mesh(text, "box.obj", 1.0);
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_NO_THROW(check_soundness(mesh));
  EXPECT_NEAR(signed_volume(mesh), 6.0, 1e-12);
}

TEST(MeshFile, ScalesLengths) {
  for (const auto& [bytes, file] : {std::pair<std::string, std::string>{kObj, "a.obj"},
                                    {kStl, "a.stl"},
                                    {stl_bytes(parse_mesh(kObj, "a.obj", 1.0)), "b.stl"}}) {
    EXPECT_NEAR(signed_volume(parse_mesh(bytes, file, 0.1)), 1.0e-3 / 6.0, 1e-15);
  }
}

TEST(MeshFile, LeavesOutVerticesOfNoTriangle) {
  const TriangleMesh mesh = parse_mesh("v 99 99 99\n" + kObj, "a.obj", 1.0);
  // Numbers that count from the first are now one off, those that count back are not.
  EXPECT_EQ(mesh.vertices.size(), 5U);
  EXPECT_EQ(parse_mesh(kObj + "v 99 99 99\n", "a.obj", 1.0).vertices.size(), 4U);
}

TEST(MeshFile, IsReadFromDisk) {
  const tests::TemporaryFolder folder;
  EXPECT_EQ(read_mesh(folder.write("corner.obj", kObj), 1.0).triangles.size(), 4U);
  EXPECT_THROW(static_cast<void>(read_mesh(folder / "none.obj", 1.0)), program::ConfigError);
}

struct Wrong {
  std::string name;
  std::string file;
  std::string bytes;
  std::string place;   ///< ":line:"
  std::string reason;  ///< part of it
};

std::string changed(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string lines(const std::string& line, std::size_t times) {
  std::string all;
  for (std::size_t k = 0; k < times; ++k) all += line;
  return all;
}

const std::string kCut = stl_bytes(box_mesh({1.0, 1.0, 1.0})).substr(0, 300);

const std::vector<Wrong> kWrong = {
    {"other_format", "a.ply", kObj, ":1:", ".obj or .stl"},
    {"no_ending", "mesh", kObj, ":1:", ".obj or .stl"},
    {"empty_obj", "a.obj", "", ":1:", "no triangles"},
    {"empty_stl", "a.stl", "", ":1:", "no STL file"},
    {"stl_without_facets", "a.stl", "solid\nendsolid\n", ":1:", "no triangles"},
    {"cut_binary", "a.stl", kCut, ":1:", "cut off"},
    {"obj_named_stl", "a.stl", kObj, ":1:", "no STL file"},
    {"stl_named_obj", "a.obj", kStl, ":1:", "'solid' is nothing"},
    {"curve", "a.obj", kObj + "curv 0 1 1 2\n", ":13:", "'curv' is nothing"},
    {"no_number", "a.obj", changed(kObj, "1 0 0", "1 O 0"), ":4:", "'O' is no number"},
    {"number_and_more", "a.obj", changed(kObj, "1 0 0", "1m 0 0"), ":4:", "'1m' is no number"},
    {"not_finite", "a.obj", changed(kObj, "1 0 0", "nan 0 0"), ":4:", "not finite"},
    {"infinite", "a.obj", changed(kObj, "1 0 0", "inf 0 0"), ":4:", "not finite"},
    {"overflow", "a.obj", changed(kObj, "1 0 0", "1e999 0 0"), ":4:", "no number"},
    {"far", "a.obj", changed(kObj, "1 0 0", "1000 0 0"), ":4:", "scale: 0.001"},
    {"two_coordinates", "a.obj", changed(kObj, "1 0 0", "1 0"), ":4:", "three coordinates"},
    {"vertex_0", "a.obj", changed(kObj, "f 1 3", "f 0 3"), ":9:", "no vertex 0 among the 4"},
    {"vertex_5", "a.obj", changed(kObj, "f 1 3", "f 5 3"), ":9:", "no vertex 5 among the 4"},
    {"far_back", "a.obj", changed(kObj, "f -4", "f -5"), ":11:", "no vertex -5 among the 4"},
    {"huge_number", "a.obj", changed(kObj, "f 1 3", "f 99999999999 3"), ":9:", "no number of"},
    {"no_vertex", "a.obj", changed(kObj, "f 1 3", "f /1 3"), ":9:", "'/1' is no number of"},
    {"two_corners", "a.obj", changed(kObj, "f 1 3 2", "f 1 3"), ":9:", "at least three corners"},
    {"many_triangles", "a.obj", kObj + lines("f 1 3 2\n", kTrianglesMax), ":20009:", "more than"},
    {"huge_polygon", "a.obj", kObj + "f" + lines(" 1", kTrianglesMax), ":13:", "more than 20000"},
    {"four_corners", "a.stl", changed(kStl, "    endloop", "      vertex 1 1 1"),
     ":7:", "three vertex lines"},
    {"corners_outside", "a.stl", changed(kStl, "  facet normal 0 0 -1\n", ""),
     ":3:", "three vertex lines"},
    {"facet_in_facet", "a.stl", changed(kStl, "  endfacet\n", ""), ":8:", "three vertex lines"},
    {"cut_text", "a.stl", kStl.substr(0, 70), ":4:", "ends within a facet"},
    {"no_stl_word", "a.stl", changed(kStl, "outer", "inner"), ":3:", "'inner' is nothing"},
    {"not_finite_stl", "a.stl", changed(kStl, "1e0", "inf"), ":13:", "not finite"},
};

class WrongMesh : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongMesh, IsRefusedWithPlaceAndReason) {
  const Wrong& wrong = GetParam();
  EXPECT_THAT(tests::refusal([&] { return parse_mesh(wrong.bytes, wrong.file, 1.0); }),
              AllOf(HasSubstr(wrong.file + wrong.place), HasSubstr(wrong.reason)));
}

INSTANTIATE_TEST_SUITE_P(All, WrongMesh, ::testing::ValuesIn(kWrong),
                         [](const auto& wrong) { return wrong.param.name; });

TEST(WrongBinaryMesh, NamesTheTriangle) {
  std::string bytes = stl_bytes(box_mesh({1.0, 1.0, 1.0}));
  bytes.replace(84 + 50 * 4 + 12, 4, std::string("\x00\x00\xc0\x7f", 4));
  EXPECT_THAT(tests::refusal([&] { return parse_mesh(bytes, "a.stl", 1.0); }),
              HasSubstr("triangle 5: a coordinate is not finite"));
}

TEST(MeshFile, MayBeginWithAByteOrderMark) {
  const TriangleMesh mesh = parse_mesh("\xEF\xBB\xBFv 0 0 0\n" + kObj, "a.obj", 1.0);
  EXPECT_EQ(mesh.triangles.size(), 4U);
}

TEST(MeshFile, OfObjMayContinueALineInTheNext) {
  const std::string text =
      "v 0 0 0\nv 1 \\\n0 0\nv 0 1 0\r\nv 0 0 \\\r\n1\n# no \\\nf 1 2 \\\n3\\\n\nf 1 2 4";
  const TriangleMesh mesh = parse_mesh(text, "a.obj", 1.0);
  EXPECT_EQ(mesh.triangles.size(), 2U);
  ASSERT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.vertices[3], (Vector3{0.0, 0.0, 1.0}));
  EXPECT_THAT(tests::refusal([] { return parse_mesh("v 0 0 0\nf 1 \\\n1 \\\nx\n", "a.obj", 1.0); }),
              HasSubstr("a.obj:2:"))
      << "where it begins";
}

}  // namespace
}  // namespace splash::sim
