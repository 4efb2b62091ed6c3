// SPDX-License-Identifier: MIT
// The geometry of bodies: all that the host knows of them that depends on their form. What kernels
// know of it is in fluid/boundary/outline.h.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// What scene files and viewers call them.
[[nodiscard]] const char* name_of(ShapeKind kind);

/// Of those that a scene file may name: all but meshes, which are files.
[[nodiscard]] std::vector<std::string> shape_names();
/// One of these.
[[nodiscard]] ShapeKind shape_kind(const std::string& name);

/// What the sizes of each form are: "box: edges x y z; sphere: ...".
[[nodiscard]] std::string size_meanings();
/// Why the sizes are none of its form; empty: they are.
[[nodiscard]] std::string wrong_size(const Shape& shape);

/// Height of a box's underside above its flat middle at `x` of the body's frame [m]: nothing over
/// the flat share of its length, then a parabola that reaches the rocker at either end.
[[nodiscard]] double rocker_rise(const Shape& shape, double x);

/// Distance from a body's surface [m], negative inside. `point` in the body's frame. A rocker
/// counts as if it were filled; a mesh's is that of its field (scene/mesh/distance_field.hpp).
[[nodiscard]] double distance_to(const Shape& shape, const Vector3& point);

/// Whether a place in body axes is inside the shape, a rocker left out [m].
[[nodiscard]] bool is_inside(const Shape& shape, const Vector3& place);

/// A place on the surface of the cube from -1 to 1, carried to that of the shape [m]; not of a
/// mesh.
[[nodiscard]] Vector3 from_cube(const Shape& shape, const Vector3& cube);

/// A place of the lattice that fills the box around a shape, in the body's axes.
struct LatticePlace {
  Vector3 place = {0.0, 0.0, 0.0};      ///< [m]
  double spacing = 0.0;                 ///< of the lattice along x [m]
  std::array<int, 3> side = {0, 0, 0};  ///< along each axis: in the first layer -1, in the last 1
};
/// Such a place inside the shape, carried outwards to its surface if it is in the outermost layer
/// [m].
[[nodiscard]] Vector3 carried_to_skin(const Shape& shape, const LatticePlace& point);

/// Whether it has edges or corners that could hit another body's surface.
[[nodiscard]] bool has_edges(const Shape& shape);

/// Volume of the shape, without a rocker's [m3].
[[nodiscard]] double volume_of(const Shape& shape);

/// Moments of inertia of a homogeneous body of `mass` [kg] about its own axes through its centre
/// [kg m2]: box m (b^2 + c^2) / 12, sphere m d^2 / 10, cylinder m d^2 / 8 along and
/// m (3/4 d^2 + l^2) / 12 across its axis. A box's curved sole is not looked at. A mesh's are about
/// its principal axes, and its centre of mass has to be its origin.
[[nodiscard]] Vector3 inertia_of(const Shape& shape, double mass);

/// Turns a body's own axes to those about which its moments of inertia are told.
[[nodiscard]] Quaternion principal_axes(const Shape& shape);

/// The point of its surface that lies farthest along `direction`; both in the body's axes [m].
[[nodiscard]] Vector3 outermost(const Shape& shape, const Vector3& direction);

/// How far it reaches from its origin along its own axes, either way [m].
[[nodiscard]] Vector3 farthest_of(const Shape& shape);

/// The shape of a mesh.
[[nodiscard]] Shape mesh_shape(std::shared_ptr<const MeshSolid> solid);

}  // namespace splash::sim
