// SPDX-License-Identifier: MIT
// How far a place is from a triangle, and from a closed mesh of them.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "sim-server/scene/mesh/triangle_mesh.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

// The point of a triangle that is nearest to a place, and on which part of it that is (Ericson
// 2005, Real-Time Collision Detection, 5.1.5).

/// Corner k, the side from corner k to the next, or what lies between them.
enum class TrianglePart { corner_0, corner_1, corner_2, side_0, side_1, side_2, inside };

struct TrianglePoint {
  Vector3 place = {0.0, 0.0, 0.0};  ///< [m]
  TrianglePart part = TrianglePart::inside;
};

/// `corner`: of a triangle that has an area [m].
[[nodiscard]] TrianglePoint nearest_on(const std::array<Vector3, 3>& corner, const Vector3& place);

// The signed distance from a closed mesh, exact: the nearest triangle is found in a tree of boxes,
// and which side of the surface a place is on by the normal at the nearest point: that of the
// triangle, of an edge the sum of its two triangles', of a vertex the sum of all, each weighted by
// its angle there (Baerentzen & Aanaes 2005, "Signed Distance Computation Using the Angle Weighted
// Pseudonormal"; the nearest triangle's own normal is wrong before edges and vertices).

struct SurfacePlace {
  Vector3 place = {0.0, 0.0, 0.0};  ///< the nearest on the surface [m]
  double distance = 0.0;            ///< of it, negative inside [m]
};

class MeshDistance {
 public:
  MeshDistance() = default;
  /// Of a mesh that is sound (soundness.hpp).
  explicit MeshDistance(const TriangleMesh& mesh);

  /// `within`: the surface is known to be no farther away; makes it faster [m].
  [[nodiscard]] SurfacePlace nearest(const Vector3& place,
                                     double within = std::numeric_limits<double>::infinity()) const;

 private:
  /// Part of the triangles, and the box around them.
  struct Part {
    Vector3 lower = {0.0, 0.0, 0.0};  ///< [m]
    Vector3 upper = {0.0, 0.0, 0.0};
    std::size_t first = 0;  ///< of a leaf: its triangles; otherwise: where its two halves are
    std::size_t count = 0;  ///< of a leaf's triangles; 0: two halves, at `first` and behind it
  };
  struct Found {
    double square = 0.0;  ///< distance, squared [m2]
    std::size_t triangle = 0;
    TrianglePoint point;
  };
  struct Triangle {
    std::array<Vector3, 3> corner;  ///< [m]
    std::array<Vector3, 7> normal;  ///< of each TrianglePart; of any length
  };

  void split(std::size_t part, std::size_t first, std::size_t count);
  [[nodiscard]] static double square_distance(const Part& part, const Vector3& place);
  void search(std::size_t part, const Vector3& place, Found& found) const;

  std::vector<Triangle> triangles_;  ///< in the order of the leaves
  std::vector<Part> parts_;          ///< the first is the root
};

}  // namespace splash::sim
