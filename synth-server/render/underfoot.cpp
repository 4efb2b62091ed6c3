// SPDX-License-Identifier: MIT
#include "synth-server/render/underfoot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splash::synth {
namespace {

constexpr double kDensity = 998.0;    // of water [kg/m^3]
constexpr double kGravity = 9.81;     // [m/s^2]
constexpr double kSole = 0.05;        // radius of the disc [m]
constexpr double kWay = 0.1;          // of it, within which the blow rises [1]
constexpr double kUnit = 1000.0;      // [N/s]
constexpr double kSilent = 1e-16;     // mean square: -160 dB of full scale
constexpr double kWashAttack = 0.05;  // [s]

/// The resonator of impacts (voices/resonator.hpp), which keeps white noise's variance.
Biquad resonance_of(const FootSound& sound, double sample_rate) noexcept {
  const double w = 2.0 * std::numbers::pi * sound.frequency / sample_rate;
  const double alpha = std::sin(w) / (2.0 * sound.q);
  Biquad section;
  section.a1 = -2.0 * std::cos(w) / (1.0 + alpha);
  section.a2 = (1.0 - alpha) / (1.0 + alpha);
  section.b0 = std::sqrt((1.0 - section.a2) / 2.0);
  section.b2 = -section.b0;
  return section;
}

/// Another filter goes on where `running` is.
void recolour(Biquad& running, Biquad other) noexcept {
  other.first = running.first;
  other.second = running.second;
  running = other;
}

}  // namespace

double force_rate(const protocol::Impact& impact) noexcept {
  const auto momentum = static_cast<double>(impact.momentum);
  const auto rise = static_cast<double>(impact.rise);
  if (momentum > 0.0 && rise > 0.0) return 2.0 * momentum / (rise * rise);
  const auto speed = static_cast<double>(impact.approach);
  if (!(speed > 0.0)) return 0.0;
  const double mass = 4.0 / 3.0 * kDensity * kSole * kSole * kSole;
  const double time = kWay * kSole / speed;
  return 2.0 * mass * speed / (time * time);
}

double force_rate(const protocol::Bubble& bubble) noexcept {
  const auto radius = static_cast<double>(bubble.radius);
  const double mass = 4.0 / 3.0 * std::numbers::pi * kDensity * radius * radius * radius;
  const double speed = std::sqrt(kGravity * radius);
  const double time = radius / speed;
  return 2.0 * mass * speed / (time * time);
}

bool Underfoot::Envelope::end_cell() noexcept {
  falling = std::max(falling + added, held);
  added = held = 0.0;
  const bool lasts = std::max(falling, risen) > kSilent;
  if (!lasts) falling = risen = 0.0;
  return lasts;
}

Underfoot::Underfoot(const Rig& rig, double sample_rate, std::uint64_t seed)
    : sample_rate_(sample_rate) {
  for (const Output& output : rig.outputs) {
    for (int c = 0; c < channel_count(output); ++c) {
      Channel channel;
      channel.is_felt = output.threshold.sense != Sense::hearing;
      constexpr std::uint64_t kOthers = std::uint64_t{3} << 48U;  // of no impact and no fine water
      channel.noise = Noise(seed, kOthers + channels_.size());
      channels_.push_back(channel);
    }
  }
  tune(sound_);
}

void Underfoot::tune(const FootSound& sound) noexcept {
  const bool same = sound.frequency == sound_.frequency && sound.q == sound_.q &&
                    sound.wash_frequency == sound_.wash_frequency && swell_level_ != 1.0;
  sound_ = sound;
  if (same) return;
  const Biquad resonance = resonance_of(sound, sample_rate_);
  const Biquad swell = low_pass(sound.wash_frequency, std::numbers::sqrt2 / 2.0, sample_rate_);
  // Noise of variance 1 through a second-order Butterworth at f keeps 2 f / fs pi / (2 sqrt 2).
  swell_level_ =
      std::sqrt(std::numbers::sqrt2 * sample_rate_ / (std::numbers::pi * sound.wash_frequency));
  for (Channel& channel : channels_) {
    recolour(channel.resonance, resonance);
    recolour(channel.swell, swell);
  }
}

template <class Drive>
void Underfoot::drive(const FootSound& sound, double rate, std::span<const Route> routes,
                      const Drive& drive) noexcept {
  if ((sound.texture <= 0.0 && sound.wash <= 0.0) || rate <= 0.0) return;
  tune(sound);
  const double felt = std::pow(rate / kUnit, sound.power);
  for (const Route& route : routes) {
    Channel& channel = channels_[static_cast<std::size_t>(route.channel)];
    if (!channel.is_felt) continue;
    const double square = std::pow(route.gain * felt, 2.0);
    drive(channel.texture, sound.texture * sound.texture * square);
    drive(channel.wash, sound.wash * sound.wash * square);
  }
}

void Underfoot::add(const FootSound& sound, double rate, std::span<const Route> routes) noexcept {
  drive(sound, rate, routes, [](Envelope& envelope, double square) { envelope.added += square; });
}

void Underfoot::press(const FootSound& sound, double rate, std::span<const Route> routes) noexcept {
  drive(sound, rate - sound.least, routes,
        [](Envelope& envelope, double square) { envelope.held = std::max(envelope.held, square); });
}

void Underfoot::mix(std::int64_t from, std::int64_t to, Mix& mix) noexcept {
  const auto per_sample = [&](double seconds) { return std::exp(-1.0 / (seconds * sample_rate_)); };
  const double fall = per_sample(0.5 * sound_.release);  // of squares
  const double follow = 1.0 - per_sample(sound_.attack);
  const double wash_fall = per_sample(0.5 * sound_.wash_release);
  const double wash_follow = 1.0 - per_sample(kWashAttack);
  const auto first = static_cast<int>(from % kCell);
  const CellGain gain = mix.gains.of<protocol::Impact>();
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    if (!channels_[c].sounds) continue;
    Channel channel = channels_[c];  // out of memory meanwhile: each sample waits for the last
    mix.touched[c] = 1;
    double* const out = mix.samples.data() + c * kCell + static_cast<std::size_t>(first);
    for (int n = 0; n < static_cast<int>(to - from); ++n) {
      const double white = channel.noise.at(static_cast<std::uint64_t>(from + n));
      const double texture = std::sqrt(channel.texture.next(fall, follow));
      const double wash = std::sqrt(channel.wash.next(wash_fall, wash_follow));
      out[n] += gain.at(first + n) * (texture * channel.resonance.process(white) +
                                      wash * swell_level_ * channel.swell.process(white));
    }
    channels_[c] = channel;
  }
}

void Underfoot::end_cell() noexcept {
  for (Channel& channel : channels_) {
    const bool texture = channel.texture.end_cell();
    const bool wash = channel.wash.end_cell();
    channel.sounds = texture || wash;
  }
}

void Underfoot::clear() noexcept {
  for (Channel& channel : channels_) {
    channel.texture.falling = channel.texture.added = channel.texture.held = 0.0;
    channel.wash.falling = channel.wash.added = channel.wash.held = 0.0;
  }
}

}  // namespace splash::synth
