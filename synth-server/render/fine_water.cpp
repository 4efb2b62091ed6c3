// SPDX-License-Identifier: MIT
#include "synth-server/render/fine_water.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "synth-server/voices/bubble_tone.hpp"
#include "synth-server/voices/resonator.hpp"

namespace splash::synth {
namespace {

constexpr double kLowest = 1000.0;  // edge of the first band [Hz]
constexpr double kHinze = 0.001;    // [m]
constexpr double kSilent = 1e-16;   // mean square: -160 dB of full scale

/// N(r), 1 at the Hinze scale.
double density(double radius) noexcept {
  return std::pow(radius / kHinze, radius < kHinze ? -1.5 : -10.0 / 3.0);
}

/// N_sim, in closed form.
double simulated() noexcept {
  const auto below = [](double radius) {
    return -3.0 / 7.0 * kHinze * std::pow(radius / kHinze, -7.0 / 3.0);
  };
  return below(0.030) - below(0.003);
}

}  // namespace

double fine_frequency(std::size_t band) noexcept {
  return kLowest * std::exp2((static_cast<double>(band) + 0.5) / 3.0);
}

double fine_energy(const ToneSound& bubble, std::size_t band) noexcept {
  constexpr int kSteps = 16;  // evenly in ln r
  const double middle = bubble.minnaert * bubble.pitch / fine_frequency(band);
  const double step = std::numbers::ln2 / 3.0 / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double r = middle * std::exp((i + 0.5 - 0.5 * kSteps) * step);
    sum += density(r) * r * r / (4.0 * bubble.damping * paper_damping(r, bubble)) * r * step;
  }
  return sum / simulated();
}

FineWater::FineWater(const Rig& rig, double sample_rate, std::uint64_t seed)
    : sample_rate_(sample_rate) {
  for (const Output& output : rig.outputs) {
    for (int c = 0; c < channel_count(output); ++c) {
      Channel channel;
      channel.reaches = output.band.high > kLowest;
      constexpr std::uint64_t kOthers = std::uint64_t{1} << 48U;  // no impact has such a number
      channel.noise = Noise(seed, kOthers + channels_.size());
      channels_.push_back(channel);
    }
  }
  const double q = 1.0 / (std::exp2(1.0 / 6.0) - std::exp2(-1.0 / 6.0));
  for (std::size_t b = 0; b < kFineBands; ++b) {
    const Resonator resonator(std::min(fine_frequency(b), 0.45 * sample_rate), q, sample_rate);
    a1_[b / 4][b % 4] = static_cast<float>(resonator.a1());
    a2_[b / 4][b % 4] = static_cast<float>(resonator.a2());
    gain_[b / 4][b % 4] = static_cast<float>(resonator.gain());
  }
}

void FineWater::tune(const Sound& sound) noexcept {
  fine_ = sound.fine;
  const ToneSound& b = sound.bubble;
  const bool same = power_ > 0.0 && b.minnaert == known_.minnaert && b.pitch == known_.pitch &&
                    b.radiation == known_.radiation && b.thermal == known_.thermal &&
                    b.damping == known_.damping;
  if (same) return;
  known_ = b;
  power_ = 0.0;
  for (std::size_t band = 0; band < kFineBands; ++band) {
    const bool plays = fine_frequency(band) < 0.45 * sample_rate_;
    const double energy = plays ? fine_energy(b, band) : 0.0;
    levels_[band / 4][band % 4] = static_cast<float>(std::sqrt(energy));
    power_ += energy;
  }
}

void FineWater::add(const Sound& sound, double epsilon, std::span<const Route> routes) noexcept {
  if (sound.fine.amount <= 0.0) return;
  tune(sound);
  const double amplitude = fine_.amount * std::pow(epsilon, sound.bubble.excitation);
  for (const Route& route : routes) {
    Channel& channel = channels_[static_cast<std::size_t>(route.channel)];
    if (!channel.reaches) continue;
    channel.added += route.gain * route.gain * amplitude * amplitude / fine_.release;
  }
}

float FineWater::Channel::next(const FineWater& of, float white) noexcept {
  Four sum{};
  for (std::size_t k = 0; k < of.gain_.size(); ++k) {  // the same as Resonator, side by side
    const Four in = of.gain_[k] * white;
    const Four band = in + first[k];
    first[k] = second[k] - of.a1_[k] * band;
    second[k] = -in - of.a2_[k] * band;
    sum += of.levels_[k] * band;
  }
  return sum[0] + sum[1] + sum[2] + sum[3];
}

void FineWater::mix(std::int64_t from, std::int64_t to, Mix& mix) noexcept {
  const double fall = std::exp(-1.0 / (fine_.release * sample_rate_));
  const double follow = -std::expm1(-1.0 / (fine_.attack * sample_rate_));
  const CellGain gain = mix.gains.of<protocol::Bubble>();
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    Channel& channel = channels_[c];
    if (!channel.sounds) continue;
    mix.touched[c] = 1;
    const auto first = static_cast<int>(from % kCell);
    double* const out = mix.samples.data() + c * kCell + static_cast<std::size_t>(first);
    Channel running = channel;  // out of memory meanwhile: each sample waits for the last
    std::array<float, 2> white{};
    for (int n = 0; n < static_cast<int>(to - from); ++n) {
      const auto now = static_cast<std::uint64_t>(from + n);
      if (n == 0 || now % 2 == 0) white = running.noise.two_at(now / 2);
      running.envelope += follow * (running.falling - running.envelope);
      running.falling *= fall;
      const auto sum = static_cast<double>(running.next(*this, white[now % 2]));
      out[n] += std::sqrt(running.envelope) * gain.at(first + n) * sum;
    }
    channel = running;
  }
}

void FineWater::end_cell() noexcept {
  for (Channel& channel : channels_) {
    channel.falling += channel.added;
    channel.added = 0.0;
    const bool sounds = std::max(channel.falling, channel.envelope) * power_ > kSilent;
    if (channel.sounds && !sounds) {
      channel.falling = channel.envelope = 0.0;
      channel.first = channel.second = {};
    }
    channel.sounds = sounds;
  }
}

void FineWater::clear() noexcept {
  for (Channel& channel : channels_) channel.falling = channel.added = 0.0;
}

}  // namespace splash::synth
