// SPDX-License-Identifier: MIT
#include "synth-server/voices/place_pitch.hpp"

#include <algorithm>
#include <cmath>

#include "synth-server/voices/physical_bubble.hpp"

namespace splash::synth {
namespace {

/// x: at most a half, where it touches.
double nearness(double radius, double distance) noexcept {
  return 0.5 * radius / std::max(radius, distance);
}

double rising_speed(double radius) noexcept {
  const Water water;
  const double across = 2.0 * radius;
  return std::sqrt(2.14 * water.surface_tension / (water.density * across) +
                   0.505 * water.gravity * across);
}

}  // namespace

double pitch_under_surface(double radius, double depth) noexcept {
  const double x = nearness(radius, depth);
  return 1.0 / std::sqrt(1.0 - x - x * x * x * x);
}

double pitch_over_floor(double radius, double height) noexcept {
  return 1.0 / std::sqrt(1.0 + nearness(radius, height));
}

double rise_under_surface(double radius, double depth) noexcept {
  const double x = nearness(radius, depth);
  const double slope = 0.5 * (1.0 + 4.0 * x * x * x) / (1.0 - x - x * x * x * x);  // d ln f / dx
  return slope * x * rising_speed(radius) / std::max(radius, depth);
}

BubbleTone in_place(const ToneSound& sound, BubbleTone tone, double radius,
                    const Place& place) noexcept {
  if (sound.place <= 0.0) return tone;
  const double pitch =
      pitch_under_surface(radius, place.depth) * pitch_over_floor(radius, place.height);
  tone.frequency *= std::pow(pitch, sound.place);
  tone.rise += sound.place * (0.5 * rise_under_surface(radius, place.depth) - tone.rise);
  return tone;
}

}  // namespace splash::synth
