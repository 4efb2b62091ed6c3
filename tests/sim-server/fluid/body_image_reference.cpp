// SPDX-License-Identifier: MIT
#include "tests/sim-server/fluid/body_image_reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/fluid/set_up.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {
namespace {

Shape shape_of(const BodyShape& s) {
  Shape shape;
  shape.kind = static_cast<ShapeKind>(s.kind);
  shape.size = {2.0 * static_cast<double>(s.half_x), 2.0 * static_cast<double>(s.half_y),
                2.0 * static_cast<double>(s.half_z)};
  shape.rocker = static_cast<double>(s.rocker);
  shape.flat = static_cast<double>(s.flat);
  return shape;
}

/// With a curved underside: the height below it.
double outline_distance(const Shape& shape, const Vector3& x) {
  const double half = 0.5 * shape.size[2];
  if (shape.kind != ShapeKind::box || shape.rocker <= 0.0) return distance_to(shape, x);
  const double under = rocker_rise(shape, x[0]) - half - x[2];
  // A box whose underside is where that distance says.
  return distance_to(shape, {x[0], x[1], std::max(under, x[2] - half) + half});
}

struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  std::size_t owner = 0;
};

Nearest nearest(const FluidState& s, const Vector3& place) {
  Nearest found;
  for (std::size_t b = 0; b < s.shapes.size(); ++b) {
    const BodyStep& step = s.bodies[b];
    const Vector3 centre = {static_cast<double>(step.px), static_cast<double>(step.py),
                            static_cast<double>(step.pz)};
    const Quaternion turned = {static_cast<double>(step.qx), static_cast<double>(step.qy),
                               static_cast<double>(step.qz), static_cast<double>(step.qw)};
    const Vector3 own = rotate(inverse(turned), place - centre);
    const double d = s.shapes[b].kind == SPLASH_MESH ? s.fields[b].at(own)
                                                     : outline_distance(shape_of(s.shapes[b]), own);
    if (d < found.distance) found = {d, b};
  }
  return found;
}

double factor_at(const FluidParams& params, double distance) {
  const double support = static_cast<double>(params.support);
  const double spacing = static_cast<double>(params.spacing);
  const double d = std::max(distance, 0.0);
  const double kept = std::max(distance, 0.5 * spacing);
  double mirror = 0.0;
  double fixed = 0.0;
  for (double behind = 0.0; behind < 0.999 * support; behind += spacing) {
    const double z = 2.0 * kept + behind;
    mirror += plane_marginal(z, support);
    mirror += 4.0 * std::numbers::pi * z * kernel_value(z, support) * (kept - d);
    fixed += plane_marginal(d + 0.5 * spacing + behind, support);
  }
  return fixed > 0.0 ? mirror / fixed : 0.0;
}

}  // namespace

ReferenceImage reference_image(const FluidState& s, const Vector3& place) {
  ReferenceImage image;
  if (s.shapes.empty()) return image;
  const Nearest here = nearest(s, place);
  image.owner = here.owner;
  image.factor = factor_at(s.params, here.distance);
  const double step = 1.0e-5 * static_cast<double>(s.params.spacing);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vector3 more = place;
    Vector3 less = place;
    more[axis] += step;
    less[axis] -= step;
    image.gradient[axis] = (factor_at(s.params, nearest(s, more).distance) -
                            factor_at(s.params, nearest(s, less).distance)) /
                           (2.0 * step);
  }
  return image;
}

}  // namespace splash::sim
