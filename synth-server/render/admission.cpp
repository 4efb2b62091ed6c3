// SPDX-License-Identifier: MIT
#include "synth-server/render/admission.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace splash::synth {
namespace {

/// Ranges of the address table: what passes the decoder passes here.
constexpr double kLeastRadius = 1.0e-4;  // [m]
constexpr double kMostRadius = 1.0;      // [m]
constexpr double kMostSpeed = 100.0;     // [m/s]
constexpr double kMostPlace = 1.0e6;     // [m]

void require(bool good, const std::string& name, double value, const std::string& limits) {
  if (good) return;
  throw std::invalid_argument("engine: " + name + " = " + std::to_string(value) + ": must be " +
                              limits);
}

/// Written so that NaN fails.
bool within(double value, double low, double high) noexcept {
  return value >= low && value <= high;
}

bool renderable(const protocol::Vec3& place) noexcept {
  return within(static_cast<double>(place.x), -kMostPlace, kMostPlace) &&
         within(static_cast<double>(place.y), -kMostPlace, kMostPlace) &&
         within(static_cast<double>(place.z), -kMostPlace, kMostPlace);
}

bool renderable(const protocol::Impact& impact) noexcept {
  return within(static_cast<double>(impact.approach), 0.0, kMostSpeed) &&
         within(static_cast<double>(impact.speed), 0.0, kMostSpeed) && renderable(impact.position);
}

template <class BubbleOrCavity>
bool renderable(const BubbleOrCavity& bubble) noexcept {
  return within(static_cast<double>(bubble.radius), 0.999 * kLeastRadius, kMostRadius) &&
         within(static_cast<double>(bubble.epsilon), 0.0, 1.0) && renderable(bubble.position);
}

}  // namespace

const EngineSettings& checked(const EngineSettings& s) {
  require(s.sample_rate >= 8000.0 && s.sample_rate <= 384000.0, "sample_rate", s.sample_rate,
          "8000 to 384000 Hz");
  require(s.max_block >= 1 && s.max_block <= 65536, "max_block", s.max_block, "1 to 65536 frames");
  require(s.max_voices >= 1 && s.max_voices <= 131072, "max_voices", s.max_voices, "1 to 131072");
  require(s.max_impacts >= 1 && s.max_impacts <= 4096, "max_impacts", s.max_impacts, "1 to 4096");
  require(s.water_level <= kMostPlace, "water_level", s.water_level, "at most 1000000 m");
  require(s.floor_level <= kMostPlace, "floor_level", s.floor_level, "at most 1000000 m");
  require(s.max_scheduled >= 1 && s.max_scheduled <= (1 << 20), "max_scheduled", s.max_scheduled,
          "1 to 1048576");
  for (const double number : numbers_of(s.sound)) {
    require(std::isfinite(number), "number of the sound", number, "finite");
  }
  require(s.sound.impact.frequency < 0.5 * s.sample_rate, "sound.impact.frequency",
          s.sound.impact.frequency, "under half the sample rate");
  require(s.start_ramp >= 0.0 && s.start_ramp <= 60.0, "start_ramp", s.start_ramp, "0 to 60 s");
  return s;
}

bool renderable(const protocol::Event& event) noexcept {
  return std::visit([](const auto& kind) { return renderable(kind); }, event);
}

}  // namespace splash::synth
