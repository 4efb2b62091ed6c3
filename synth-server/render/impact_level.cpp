// SPDX-License-Identifier: MIT
#include "synth-server/render/impact_level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "synth-server/render/audibility.hpp"
#include "synth-server/voices/impact_voice.hpp"

namespace splash::synth {
namespace {

constexpr double kWindow = 0.125;  ///< over which a burst is averaged [s]

/// A hand on a transducer whose full scale is 52 dB over what it just feels at 250 Hz, as the
/// shipped rigs have it: what outputs for the ear play, and those that state no threshold.
constexpr double kHandDecibels = -52.0;

/// Integral of the squared envelope over the window [s]; the attack is shorter than that.
double energy(const ImpactSound& sound) noexcept {
  const double a = kFall / sound.attack;
  const double left = std::exp(-kFall);  // of the way to the top, when the attack ends
  const double top = 1.0 - left;
  const double rising =
      (sound.attack - 2.0 * top / a + 0.5 * (1.0 - left * left) / a) / (top * top);
  const double r = 2.0 * kFall / sound.release;
  return rising + (1.0 - std::exp(-r * (kWindow - sound.attack))) / r;
}

/// Part of the resonator's noise that lies under `frequency` [1], and a constant. With
/// u = f/f0 - f0/f, |H|^2 = 1 / (1 + Q^2 u^2), whose integral over f is elementary where Q > 1/2:
/// f0 / (2 Q) (atan(Q u) + 1/(2 k) ln((Q s - k) / (Q s + k))), s^2 = u^2 + 4, k^2 = 4 Q^2 - 1;
/// over all frequencies it is pi f0 / (2 Q).
double noise_below(const ImpactSound& sound, double frequency) noexcept {
  const double u = frequency / sound.frequency - sound.frequency / frequency;
  const double s = sound.q * std::sqrt(u * u + 4.0);
  const double k = std::sqrt(4.0 * sound.q * sound.q - 1.0);
  return (std::atan(sound.q * u) + 0.5 / k * std::log((s - k) / (s + k))) / std::numbers::pi;
}

}  // namespace

double wanted_level_db(const ImpactSound& sound, double speed) noexcept {
  return sound.slow_db + (sound.fast_db - sound.slow_db) * std::log(speed / sound.slow) /
                             std::log(sound.fast / sound.slow);
}

double felt_level_db(const ImpactSound& sound, const Output& output) noexcept {
  const bool is_felt = output.threshold.sense == Sense::touch;
  const double threshold_db = is_felt ? output.threshold.level_db : kHandDecibels;
  const double burst_db = 10.0 * std::log10(energy(sound) / kWindow);
  double level_db = -std::numeric_limits<double>::infinity();
  constexpr int kLowest = -17;  // thirds of octaves around 1 kHz: from 20 Hz
  constexpr int kHighest = 3;   // to 2 kHz
  for (int third = kLowest; third <= kHighest; ++third) {
    const double middle = 1000.0 * std::exp2(third / 3.0);
    const double edge = std::exp2(1.0 / 6.0);
    const double part = noise_below(sound, middle * edge) - noise_below(sound, middle / edge);
    const double over_db = 10.0 * std::log10(part) - cut_db(output.band, middle) -
                           touch_threshold_db(middle) - threshold_db;
    level_db = std::max(level_db, burst_db + over_db);
  }
  return level_db;
}

ImpactLevel::ImpactLevel(const Rig& rig)
    : outputs_(rig.outputs), unit_(outputs_.size()), parts_(outputs_.size()) {}

ImpactLevel::Amplitude ImpactLevel::at(const ImpactSound& sound, double speed) noexcept {
  if (sound.sensation <= 0.0) return {impact_amplitude(sound, speed), {}};
  if (!(speed > 0.0)) return {};
  constexpr double kPerDecibel = std::numbers::ln10 / 20.0;
  const bool same = fresh_ && sound.attack == known_.attack && sound.release == known_.release &&
                    sound.frequency == known_.frequency && sound.q == known_.q;
  for (std::size_t o = 0; o < outputs_.size() && !same; ++o) {
    unit_[o] = std::log(outputs_[o].full_scale) - kPerDecibel * felt_level_db(sound, outputs_[o]);
  }
  known_ = sound;
  fresh_ = true;
  const double power = std::log(impact_amplitude(sound, speed));
  const double wanted = kPerDecibel * wanted_level_db(sound, speed);
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t o = 0; o < outputs_.size(); ++o) {
    parts_[o] = power + sound.sensation * (unit_[o] + wanted - power);
    most = std::max(most, parts_[o]);
  }
  for (double& part : parts_) part = std::exp(part - most);
  return {std::exp(most), parts_};
}

}  // namespace splash::synth
