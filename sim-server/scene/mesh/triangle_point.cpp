// SPDX-License-Identifier: MIT
#include "sim-server/scene/mesh/triangle_point.hpp"

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

TrianglePoint nearest_on(const std::array<Vector3, 3>& corner, const Vector3& place) {
  const auto& [a, b, c] = corner;
  const Vector3 ab = b - a;
  const Vector3 ac = c - a;
  const double a1 = dot(ab, place - a);
  const double a2 = dot(ac, place - a);
  if (a1 <= 0.0 && a2 <= 0.0) return {a, TrianglePart::corner_0};
  const double b1 = dot(ab, place - b);
  const double b2 = dot(ac, place - b);
  if (b1 >= 0.0 && b2 <= b1) return {b, TrianglePart::corner_1};
  const double over_c = a1 * b2 - b1 * a2;  // signed area of a, b and the place, and so on
  if (over_c <= 0.0 && a1 >= 0.0 && b1 <= 0.0) {
    return {a + (a1 / (a1 - b1)) * ab, TrianglePart::side_0};
  }
  const double c1 = dot(ab, place - c);
  const double c2 = dot(ac, place - c);
  if (c2 >= 0.0 && c1 <= c2) return {c, TrianglePart::corner_2};
  const double over_b = c1 * a2 - a1 * c2;
  if (over_b <= 0.0 && a2 >= 0.0 && c2 <= 0.0) {
    return {a + (a2 / (a2 - c2)) * ac, TrianglePart::side_2};
  }
  const double over_a = b1 * c2 - c1 * b2;
  if (over_a <= 0.0 && b2 - b1 >= 0.0 && c1 - c2 >= 0.0) {
    return {b + ((b2 - b1) / ((b2 - b1) + (c1 - c2))) * (c - b), TrianglePart::side_1};
  }
  const double all = over_a + over_b + over_c;
  return {a + (over_b / all) * ab + (over_c / all) * ac, TrianglePart::inside};
}

}  // namespace splash::sim
