// SPDX-License-Identifier: MIT
#include <charconv>
#include <set>

#include "sim-server/scene/mesh/mesh_file.hpp"

namespace splash::sim {
namespace {

bool is_passed_over(std::string_view keyword) {
  static const std::set<std::string_view> kOthers = {"vt", "vn",     "vp",     "g", "o",
                                                     "s",  "usemtl", "mtllib", "l", "p"};
  return kOthers.contains(keyword);
}

/// The vertex of a corner as "7", "7/1", "7//1", "7/1/1", or counted back from the last, "-1".
int vertex_of(const MeshText& text, const MeshLine& line, std::string_view corner, int vertices) {
  const std::string_view digits = corner.substr(0, corner.find('/'));
  int number = 0;
  const auto [rest, failure] =
      std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (failure != std::errc() || rest != digits.data() + digits.size()) {
    throw text.error(line, quoted(corner) + " is no number of a vertex");
  }
  const int index = number < 0 ? vertices + number : number - 1;
  if (index < 0 || index >= vertices) {
    throw text.error(line, "there is no vertex " + std::to_string(number) + " among the " +
                               std::to_string(vertices) + " before this line");
  }
  return index;
}

/// A polygon as a fan around its first corner: right where it is convex.
void add_polygon(const MeshText& text, const MeshLine& line, TriangleMesh& mesh) {
  if (line.words.size() < 4) throw text.error(line, "a face has at least three corners");
  if (mesh.triangles.size() + line.words.size() - 3 > kTrianglesMax) {
    throw text.error(line, too_many_triangles());
  }
  std::vector<int> polygon;
  for (std::size_t k = 1; k < line.words.size(); ++k) {
    polygon.push_back(vertex_of(text, line, line.words[k], static_cast<int>(mesh.vertices.size())));
  }
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    mesh.triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
    mesh.lines.push_back(line.number);
  }
}

}  // namespace

TriangleMesh parse_obj(MeshText text) {
  TriangleMesh mesh;
  while (const std::optional<MeshLine> next = text.next()) {
    const MeshLine& line = *next;
    const std::string_view keyword = line.words[0];
    if (keyword == "v") {
      mesh.vertices.push_back(text.place(line, 1));
    } else if (keyword == "f") {
      add_polygon(text, line, mesh);
    } else if (!is_passed_over(keyword)) {
      throw text.error(line, quoted(keyword) + " is nothing that an OBJ file of polygons says; " +
                                 "export the surface as triangles");
    }
  }
  return mesh;
}

}  // namespace splash::sim
