// SPDX-License-Identifier: MIT
#include "sim-server/fluid/air/images.hpp"

namespace splash::sim {

namespace {

/// Appends the images of all points near the plane where `axis` is `wall`; the water is on the side
/// of `sign`.
void mirror(std::vector<Vector3>& points, std::size_t first, std::size_t last, std::size_t axis,
            double wall, double reach, double sign) {
  for (std::size_t i = first; i < last; ++i) {
    const double distance = sign * (points[i][axis] - wall);
    if (distance < 0.0 || distance >= reach) continue;
    Vector3 image = points[i];
    image[axis] = wall - sign * distance;
    points.push_back(image);
  }
}

}  // namespace

std::vector<Vector3> with_images(std::vector<Vector3> points, const Tank& tank, double reach) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t count = points.size();
    mirror(points, 0, count, axis, tank.lower[axis], reach, 1.0);
    if (axis < 2) mirror(points, 0, count, axis, tank.upper[axis], reach, -1.0);
  }
  return points;
}

}  // namespace splash::sim
