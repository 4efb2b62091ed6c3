// SPDX-License-Identifier: MIT
#include "sim-server/scene/tank_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim-server/scene/rotation.hpp"

namespace splash::sim {
namespace {

constexpr double kTick = 1.0e-3;  ///< in which turns are summed [s]

double omega_of(const TankMotionSettings& s) {
  return 2.0 * std::numbers::pi / s.period;
}

/// How much of the swing there is, and its first two derivatives in time: smooth in all of them.
struct Growth {
  double share = 1.0, rate = 0.0, bend = 0.0;
};

Growth growth_at(double seconds, double ramp) {
  if (seconds >= ramp) return {};
  const double s = std::max(seconds, 0.0) / ramp;
  return {s * s * s * (10.0 + s * (-15.0 + 6.0 * s)), 30.0 * s * s * (1.0 + s * (s - 2.0)) / ramp,
          60.0 * s * (1.0 + s * (2.0 * s - 3.0)) / (ramp * ramp)};
}

Vector3 radians(const Vector3& degrees) {
  return (std::numbers::pi / 180.0) * degrees;
}

/// Length of the longest way from the pivot to a corner of the tank [m].
double reach_of(const Scene& scene) {
  Vector3 far = {0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const double pivot = scene.tank_motion.pivot[i];
    far[i] = std::max(std::abs(scene.tank.lower[i] - pivot), std::abs(scene.tank.upper[i] - pivot));
  }
  return length(far);
}

void add_sample(const TankMotionSettings& settings, double seconds, TankState& state) {
  const std::vector<TankSample>& all = settings.samples;
  if (all.empty()) return;
  const auto after = std::upper_bound(all.begin(), all.end(), seconds,
                                      [](double t, const TankSample& s) { return t < s.time; });
  const bool between = after != all.begin() && after != all.end();
  const TankSample& next = after == all.end() ? all.back() : *after;
  const TankSample& last = after == all.begin() ? all.front() : *(after - 1);
  const double part = between ? (seconds - last.time) / (next.time - last.time) : 1.0;
  state.gravity = state.gravity - (1.0 - part) * last.acceleration - part * next.acceleration;
  state.spin = state.spin + (1.0 - part) * last.spin + part * next.spin;
  if (between) {
    state.spin_rate = state.spin_rate + (1.0 / (next.time - last.time)) * (next.spin - last.spin);
  }
}

}  // namespace

TankState TankMotion::driven(double seconds) const {
  const double omega = omega_of(settings_);
  const Growth g = growth_at(seconds, settings_.ramp);
  const double sine = std::sin(omega * seconds), cosine = std::cos(omega * seconds);
  // Derivatives of share sin(omega t).
  const double first = g.rate * sine + g.share * omega * cosine;
  const double second =
      g.bend * sine + 2.0 * g.rate * omega * cosine - g.share * omega * omega * sine;
  const Vector3 roll = radians(settings_.roll);
  TankState state = {-second * settings_.sway, first * roll, second * roll};
  add_sample(settings_, seconds, state);
  return state;
}

TankState TankMotion::at(double seconds) {
  const double now = std::max(seconds, 0.0);
  const long ticks = static_cast<long>(now / kTick);
  if (ticks < known_) {
    known_ = 0;
    turned_ = {0.0, 0.0, 0.0, 1.0};
  }
  if (turns(settings_)) {
    for (; known_ < ticks; ++known_) {
      const Vector3 spin = driven((static_cast<double>(known_) + 0.5) * kTick).spin;
      turned_ = unit(compose(turned_, from_turn(kTick * spin)));
    }
  }
  TankState state = driven(now);
  const double rest = now - static_cast<double>(ticks) * kTick;
  const Quaternion rotation = compose(turned_, from_turn(rest * driven(now - 0.5 * rest).spin));
  state.gravity = state.gravity + rotate(inverse(rotation), gravity_);
  return state;
}

bool turns(const TankMotionSettings& settings) {
  return length(settings.roll) > 0.0 ||
         std::any_of(settings.samples.begin(), settings.samples.end(),
                     [](const TankSample& s) { return length(s.spin) > 0.0; });
}

TankBounds bounds_of(const TankMotionSettings& settings) {
  TankBounds most;
  if (!settings.present) return most;
  const double omega = omega_of(settings);
  // The largest first and second derivatives of the growth are 1.875 and 5.774 over the ramp.
  const double rate = settings.ramp > 0.0 ? 1.875 / settings.ramp : 0.0;
  const double bend = settings.ramp > 0.0 ? 5.774 / (settings.ramp * settings.ramp) : 0.0;
  const double second = bend + 2.0 * rate * omega + omega * omega;
  const Vector3 roll = radians(settings.roll);
  most = {second * length(settings.sway), (rate + omega) * length(roll), second * length(roll)};
  TankBounds sampled;
  const TankSample* last = nullptr;
  for (const TankSample& sample : settings.samples) {
    sampled.acceleration = std::max(sampled.acceleration, length(sample.acceleration));
    sampled.spin = std::max(sampled.spin, length(sample.spin));
    if (last != nullptr) {
      sampled.spin_rate = std::max(sampled.spin_rate,
                                   length(sample.spin - last->spin) / (sample.time - last->time));
    }
    last = &sample;
  }
  return {most.acceleration + sampled.acceleration, most.spin + sampled.spin,
          most.spin_rate + sampled.spin_rate};
}

double strongest_field(const Scene& scene) {
  const TankBounds most = bounds_of(scene.tank_motion);
  return length(scene.fluid.gravity) + most.acceleration +
         (most.spin_rate + most.spin * most.spin) * reach_of(scene);
}

double fastest_wall(const Scene& scene) {
  return bounds_of(scene.tank_motion).spin * reach_of(scene);
}

}  // namespace splash::sim
