// SPDX-License-Identifier: MIT
#include <bit>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>

#include "sim-server/scene/mesh/mesh_file.hpp"

namespace splash::sim {
namespace {

constexpr std::size_t kHeader = 84;    // bytes: 80 of any, then the number of triangles
constexpr std::size_t kTriangle = 50;  // bytes: a normal, three corners, two of any

/// Four bytes, the lowest first.
std::uint32_t word_at(std::string_view bytes, std::size_t first) {
  std::uint32_t word = 0;
  for (std::size_t k = 4; k-- > 0;) {
    word = (word << 8U) | static_cast<unsigned char>(bytes[first + k]);
  }
  return word;
}

void add_triangle(TriangleMesh& mesh, int line) {
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  mesh.triangles.push_back({last - 2, last - 1, last});
  mesh.lines.push_back(line);
}

/// One facet of a text file, from line to line.
class Facet {
 public:
  explicit Facet(const MeshText& text) : text_(text) {}

  void take(const MeshLine& line, TriangleMesh& mesh) {
    const std::string_view word = line.words[0];
    if (word == "vertex") {
      if (++corners_ > 3 || !open_) throw wrong(line);
      mesh.vertices.push_back(text_.place(line, 1));
    } else if (word == "facet") {
      if (open_) throw wrong(line);
      open_ = true;
      corners_ = 0;
      line_ = line.number;
    } else if (word == "endfacet") {
      if (!open_ || corners_ != 3) throw wrong(line);
      open_ = false;
      add_triangle(mesh, line_);
    } else if (word != "solid" && word != "endsolid" && word != "outer" && word != "endloop") {
      throw text_.error(line, quoted(word) + " is nothing that an STL file says");
    }
  }
  [[nodiscard]] bool open() const noexcept { return open_; }

 private:
  [[nodiscard]] program::ConfigError wrong(const MeshLine& line) const {
    return text_.error(line, "a facet has three vertex lines between 'facet' and 'endfacet'");
  }

  const MeshText& text_;
  bool open_ = false;
  int corners_ = 0;
  int line_ = 1;
};

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= kHeader && bytes.size() == kHeader + kTriangle * word_at(bytes, 80);
}

TriangleMesh parse_binary_stl(std::string_view bytes, const std::string& file, double scale) {
  TriangleMesh mesh;
  const std::size_t count = (bytes.size() - kHeader) / kTriangle;
  if (count > kTrianglesMax) throw program::ConfigError({.file = file}, too_many_triangles());
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t corner = 1; corner <= 3; ++corner) {
      Vector3 place = {};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto bits = word_at(bytes, kHeader + kTriangle * t + 12 * corner + 4 * axis);
        try {
          place[axis] = checked_length(scale * static_cast<double>(std::bit_cast<float>(bits)));
        } catch (const std::invalid_argument& problem) {
          throw program::ConfigError({.file = file},
                                     "triangle " + std::to_string(t + 1) + ": " + problem.what());
        }
      }
      mesh.vertices.push_back(place);
    }
    add_triangle(mesh, 1);
  }
  return mesh;
}

TriangleMesh parse_stl(MeshText text) {
  TriangleMesh mesh;
  Facet facet(text);
  MeshLine last;
  while (auto line = text.next()) {
    facet.take(*line, mesh);
    if (mesh.triangles.size() > kTrianglesMax) throw text.error(*line, too_many_triangles());
    last = *std::move(line);
  }
  if (facet.open()) throw text.error(last, "the file ends within a facet");
  return mesh;
}

}  // namespace splash::sim
