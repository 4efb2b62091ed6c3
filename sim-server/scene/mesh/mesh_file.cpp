// SPDX-License-Identifier: MIT
#include "sim-server/scene/mesh/mesh_file.hpp"

#include "program/text.hpp"
#include "sim-server/scene/mesh/mesh_text.hpp"

namespace splash::sim {
namespace {

TriangleMesh parse(const std::string& bytes, const std::string& file, double scale) {
  const std::string ending = program::lower(std::filesystem::path(file).extension().string());
  if (ending == ".stl" && is_binary_stl(bytes)) return parse_binary_stl(bytes, file, scale);
  if (ending == ".obj") return parse_obj(MeshText(bytes, file, scale, true));
  if (ending != ".stl") {
    throw program::ConfigError({.file = file}, "a mesh's file ends in .obj or .stl");
  }
  if (!bytes.starts_with("solid")) {
    throw program::ConfigError(
        {.file = file},
        "is no STL file: it neither begins with 'solid' nor is it as long as a binary one's count "
        "of triangles says; it may have been cut off");
  }
  return parse_stl(MeshText(bytes, file, scale));
}

}  // namespace

TriangleMesh parse_mesh(const std::string& bytes, const std::string& file, double scale) {
  TriangleMesh mesh = parse(bytes, file, scale);
  mesh.file = file;
  if (mesh.triangles.empty()) {
    throw program::ConfigError({.file = file}, "has no triangles");
  }
  join_equal_vertices(mesh);
  return mesh;
}

TriangleMesh read_mesh(const std::filesystem::path& path, double scale) {
  constexpr std::uintmax_t kLargest = 16;  // [MB]
  return parse_mesh(program::read_file(path, kLargest), path.string(), scale);
}

}  // namespace splash::sim
