// SPDX-License-Identifier: MIT
#include "sim-server/start/self_test.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "sim-server/device/device_error.hpp"
#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/params/smoothing.hpp"
#include "sim-server/fluid/set_up.hpp"
#include "sim-server/fluid/time_step.hpp"
#include "sim-server/scene/initial_fluid.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

constexpr int kEdge = 20;            ///< particles along an edge of the cube
constexpr double kSpacing = 0.02;    ///< [m]
constexpr std::size_t kSample = 61;  ///< of so many particles one is held against the host's sums
constexpr int kSteps = 10;           ///< that are timed, and done twice

/// Single precision, over some hundred neighbours.
constexpr double kTolerance = 1.0e-4;

Scene cube() {
  const double edge = kEdge * kSpacing;
  Scene scene;
  scene.fluid.spacing = kSpacing;
  scene.tank.upper = {edge, edge, edge};
  scene.water = {{{0.0, 0.0, 0.0}, {edge, edge, edge}}};
  return scene;
}

/// Off the lattice, so that the sort has to do and no sum vanishes by symmetry.
std::vector<Vector3> shaken(std::vector<Vector3> places) {
  std::uint32_t state = 1;
  for (Vector3& place : places) {
    for (double& x : place) {
      state = 1664525U * state + 1013904223U;  // Knuth's linear congruential generator
      x += 0.1 * kSpacing * (static_cast<double>(state >> 8U) / 8388608.0 - 1.0);
    }
  }
  std::reverse(places.begin(), places.end());
  return places;
}

FluidParams without_walls(FluidParams params) {
  params.wall_count = 0;
  return params;
}

void require(bool right, const char* what) {
  if (!right) throw DeviceError(std::string("it computes wrongly: ") + what);
}

class SelfTest {
 public:
  explicit SelfTest(Device& device)
      : device_(device),
        particles_(shaken(initial_particles(scene_))),
        params_(without_walls(make_params(scene_, particles_))),
        fluid_(device, params_, particles_, {}, {}) {
    fluid_.set_bodies({});
  }

  double run(const std::function<void()>& built) {
    const Snapshot start = fluid_.snapshot();
    fluid_.prepare(step_);
    const std::vector<float> places = read(fluid_.particles().position, 3);
    fluid_.advance(step_);
    static_cast<void>(fluid_.stats());
    built();
    check_sums(places);
    const Snapshot once = after_steps(start);
    const Snapshot twice = after_steps(start);
    require(
        once.position == twice.position && once.velocity == twice.velocity && once.id == twice.id,
        "the same steps gave other bits the second time");
    check_all(once);
    return seconds_ / kSteps;
  }

 private:
  [[nodiscard]] std::vector<float> read(const Buffer<float>& buffer, std::size_t parts) {
    return buffer.read(device_, parts * stride());
  }
  [[nodiscard]] std::size_t stride() const {
    return static_cast<std::size_t>(fluid_.particles().stride);
  }

  Snapshot after_steps(const Snapshot& start) {
    fluid_.restore(start);
    device_.queue().finish();
    const auto begin = std::chrono::steady_clock::now();
    for (int k = 0; k < kSteps; ++k) {
      fluid_.prepare(step_);
      fluid_.advance(step_);
    }
    device_.queue().finish();
    seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return fluid_.snapshot();
  }

  /// Density and acceleration by all pairs, from the places that the device had.
  void check_sums(const std::vector<float>& places) {
    const std::vector<float> density = read(fluid_.density(), 1);
    const std::vector<float> pressure = read(fluid_.pressure_term(), 1);
    const std::vector<float> acceleration = fluid_.acceleration().read(device_, 3 * stride());
    for (std::size_t i = 0; i < particles_.size(); i += kSample) {
      const Sums sums = sums_of(i, places, pressure);
      require(std::abs(static_cast<double>(density[i]) - sums.density) <= kTolerance * sums.density,
              "a density");
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto found = static_cast<double>(acceleration[axis * stride() + i]);
        require(std::abs(found - sums.acceleration[axis]) <= kTolerance * sums.size,
                "an acceleration");
      }
    }
  }

  struct Sums {
    double density = 0.0;       ///< [kg/m3]
    Vector3 acceleration = {};  ///< [m/s2]
    double size = 0.0;          ///< of the acceleration's summands [m/s2]
  };

  [[nodiscard]] Sums sums_of(std::size_t i, const std::vector<float>& places,
                             const std::vector<float>& pressure) const {
    const double support = scene_support(scene_);
    const auto mass = static_cast<double>(params_.mass);
    Sums sums = {.acceleration = scene_.fluid.gravity, .size = length(scene_.fluid.gravity)};
    for (std::size_t j = 0; j < particles_.size(); ++j) {
      Vector3 apart = {};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        apart[axis] = static_cast<double>(places[axis * stride() + i]) -
                      static_cast<double>(places[axis * stride() + j]);
      }
      const double r = length(apart);
      if (r >= support) continue;
      sums.density += mass * kernel_value(r, support);
      if (i == j) continue;
      const double push = mass *
                          (static_cast<double>(pressure[i]) + static_cast<double>(pressure[j])) *
                          kernel_gradient(r, support);
      sums.acceleration = sums.acceleration - push * apart;
      sums.size += std::abs(push) * r;
    }
    return sums;
  }

  /// All are there, and fall together.
  void check_all(const Snapshot& state) const {
    std::vector<int> ids = state.id;
    std::sort(ids.begin(), ids.end());
    std::vector<int> expected(ids.size());
    std::iota(expected.begin(), expected.end(), 0);
    require(ids == expected, "particles were lost");
    const double time = kSteps * step_.dt;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto first = state.velocity.begin() + static_cast<std::ptrdiff_t>(axis * stride());
      const double sum =
          std::accumulate(first, first + static_cast<std::ptrdiff_t>(ids.size()), 0.0);
      const double fallen = time * scene_.fluid.gravity[axis];
      require(std::abs(sum / static_cast<double>(ids.size()) - fallen) <=
                  kTolerance * static_cast<double>(params_.sound_speed),
              "momentum was lost");
    }
  }

  Device& device_;
  Scene scene_ = cube();
  std::vector<Vector3> particles_;
  FluidParams params_;
  Fluid fluid_;
  Step step_ = {.dt = largest_time_step(params_, 1.0, 10.0, 1.0)};
  double seconds_ = 0.0;
};

}  // namespace

double self_test(Device& device, const std::function<void()>& built) {
  return naming_opencl_errors([&] { return SelfTest(device).run(built); });
}

}  // namespace splash::sim
