// SPDX-License-Identifier: MIT
#include "tests/sim-server/scene/mesh_forms.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

void number_lines(TriangleMesh& mesh) {
  mesh.file = "formula";
  mesh.lines.assign(mesh.triangles.size(), 1);
}

void append_word(std::string& bytes, std::uint32_t word) {
  for (int k = 0; k < 4; ++k) bytes.push_back(static_cast<char>(word >> (8 * k) & 0xffU));
}

Vector3 on_sphere(const Vector3& x, double radius) {
  return (radius / length(x)) * x;
}

TriangleMesh icosahedron(double radius) {
  const double golden = (1.0 + std::sqrt(5.0)) / 2.0;
  TriangleMesh mesh;
  for (const double one : {-1.0, 1.0}) {
    for (const double other : {-golden, golden}) {
      mesh.vertices.push_back({one, other, 0.0});
      mesh.vertices.push_back({0.0, one, other});
      mesh.vertices.push_back({other, 0.0, one});
    }
  }
  // Three vertices that are an edge's length apart from each other are a face.
  for (int a = 0; a < 12; ++a) {
    for (int b = a + 1; b < 12; ++b) {
      for (int c = b + 1; c < 12; ++c) {
        const auto at = [&](int k) { return mesh.vertices[static_cast<std::size_t>(k)]; };
        const auto is_edge = [&](int one, int other) {
          return std::abs(length(at(one) - at(other)) - 2.0) < 1.0e-9;
        };
        if (!is_edge(a, b) || !is_edge(b, c) || !is_edge(a, c)) continue;
        const bool outward = dot(at(a), cross(at(b), at(c))) > 0.0;
        mesh.triangles.push_back(outward ? std::array{a, b, c} : std::array{a, c, b});
      }
    }
  }
  for (Vector3& x : mesh.vertices) x = on_sphere(x, radius);
  return mesh;
}

TriangleMesh cut_in_four(const TriangleMesh& mesh, double radius) {
  TriangleMesh finer;
  finer.vertices = mesh.vertices;
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [found, is_new] =
        middles.emplace(std::minmax(a, b), static_cast<int>(finer.vertices.size()));
    if (is_new) {
      const auto& x = mesh.vertices;
      finer.vertices.push_back(
          on_sphere(x[static_cast<std::size_t>(a)] + x[static_cast<std::size_t>(b)], radius));
    }
    return found->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const int ab = middle(a, b);
    const int bc = middle(b, c);
    const int ca = middle(c, a);
    for (const auto& part : {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) {
      finer.triangles.push_back(part);
    }
  }
  return finer;
}

}  // namespace

TriangleMesh box_mesh(const Vector3& size) {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k) {
    mesh.vertices.push_back({(k & 1 ? 0.5 : -0.5) * size[0], (k & 2 ? 0.5 : -0.5) * size[1],
                             (k & 4 ? 0.5 : -0.5) * size[2]});
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  number_lines(mesh);
  return mesh;
}

TriangleMesh tray_mesh(const Vector3& size, double wall) {
  TriangleMesh mesh;
  // Four rings of corners, each counterclockwise from above: under it, its rim without and within,
  // its floor within.
  const auto ring = [&](double inset, double z) {
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      mesh.vertices.push_back({x * (0.5 * size[0] - inset), y * (0.5 * size[1] - inset), z});
    }
  };
  ring(0.0, -0.5 * size[2]);
  ring(0.0, 0.5 * size[2]);
  ring(wall, 0.5 * size[2]);
  ring(wall, -0.5 * size[2] + wall);
  const auto quad = [&](int a, int b, int c, int d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  quad(0, 3, 2, 1);
  for (int low = 0; low < 12; low += 4) {
    for (int i = 0; i < 4; ++i) {
      const int j = (i + 1) % 4;
      quad(low + i, low + j, low + 4 + j, low + 4 + i);
    }
  }
  quad(12, 13, 14, 15);
  number_lines(mesh);
  return mesh;
}

TriangleMesh sphere_mesh(double radius, int levels) {
  TriangleMesh mesh = icosahedron(radius);
  for (int level = 0; level < levels; ++level) mesh = cut_in_four(mesh, radius);
  number_lines(mesh);
  return mesh;
}

TriangleMesh placed(TriangleMesh mesh, const Quaternion& turn, const Vector3& way) {
  for (Vector3& x : mesh.vertices) x = rotate(turn, x) + way;
  return mesh;
}

std::string obj_text(const TriangleMesh& mesh) {
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  for (const Vector3& x : mesh.vertices) text << "v " << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
  for (const auto& [a, b, c] : mesh.triangles) {
    text << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  }
  return text.str();
}

std::string stl_bytes(const TriangleMesh& mesh) {
  std::string bytes(80, ' ');
  append_word(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) append_word(bytes, 0);  // the normal, which nobody reads
    for (const Vector3& x : corners(mesh, t)) {
      for (const double part : x) {
        append_word(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(part)));
      }
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace splash::sim
