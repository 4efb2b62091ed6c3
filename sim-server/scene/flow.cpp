// SPDX-License-Identifier: MIT
#include "sim-server/scene/flow.hpp"

#include <cmath>
#include <numbers>

#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

namespace {

using std::numbers::pi;

Vector3 standing_wave(const Scene& scene, const Vector3& place) {
  const Vector3 size = scene.tank.upper - scene.tank.lower;
  const Vector3 x = place - scene.tank.lower;
  const Vector3& g = scene.fluid.gravity;
  const double k = scene.flow.mode * pi / size[0];
  const double depth = water_depth(scene);
  const double omega = std::sqrt(std::hypot(g[0], g[1], g[2]) * k * std::tanh(k * depth));
  // cosh(kz) / sinh(kH) and sinh(kz) / sinh(kH), of which a short wave in deep water overflows
  // both.
  const double scale = scene.flow.amplitude * omega * std::exp(k * (x[2] - depth)) /
                       (1.0 - std::exp(-2.0 * k * depth));
  const double below = std::exp(-2.0 * k * x[2]);
  return {-scale * (1.0 + below) * std::sin(k * x[0]), 0.0,
          scale * (1.0 - below) * std::cos(k * x[0])};
}

Vector3 vortex(const Scene& scene, const Vector3& place) {
  const Vector3 size = scene.tank.upper - scene.tank.lower;
  const Vector3 x = place - scene.tank.lower;
  const double kx = pi / size[0];
  const double ky = pi / size[1];
  return {scene.flow.speed * std::sin(kx * x[0]) * std::cos(ky * x[1]),
          -scene.flow.speed * kx / ky * std::cos(kx * x[0]) * std::sin(ky * x[1]), 0.0};
}

}  // namespace

Vector3 initial_velocity(const Scene& scene, const Vector3& place) {
  const Flow& flow = scene.flow;
  switch (flow.kind) {
    case FlowKind::uniform:
      return flow.velocity;
    case FlowKind::strain:
      return {flow.rate * (place[0] - flow.centre[0]), 0.0,
              -flow.rate * (place[2] - flow.centre[2])};
    case FlowKind::standing_wave:
      return standing_wave(scene, place);
    case FlowKind::vortex:
      return vortex(scene, place);
    case FlowKind::none:
      break;
  }
  return {0.0, 0.0, 0.0};
}

}  // namespace splash::sim
