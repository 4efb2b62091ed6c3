// SPDX-License-Identifier: MIT
#include "synth-server/render/crowd.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "synth-server/voices/bubble_tone.hpp"
#include "synth-server/voices/resonator.hpp"

namespace splash::synth {
namespace {

constexpr double kLowest = 62.5;            // edge of the first band [Hz]
constexpr double kHighest = 0.47;           // edge of the last one, of the sample rate
constexpr float kSilent = 1e-16F;           // power: -160 dB of full scale
constexpr double kEdge = 1.12246204830937;  // 2^(1/6), from a band's middle to its edge
/// Two resonators in a row let as much white noise through as the third-octave band holds.
constexpr double kQ = std::numbers::pi / 4.0 / (kEdge - 1.0 / kEdge);

double middle(std::size_t band) noexcept {
  return kLowest * std::exp2((static_cast<double>(band) + 0.5) / 3.0);
}

/// Variance that two resonators in a row give white noise of variance 1.
double variance(double frequency, double sample_rate) {
  Resonator first(frequency, kQ, sample_rate);
  Resonator second = first;
  // The envelope falls as e^(-w n / 2 Q).
  const auto samples = static_cast<int>(20.0 * kQ * sample_rate / (std::numbers::pi * frequency));
  double sum = 0.0;
  for (int n = 0; n < samples; ++n) {
    const double out = second.process(first.process(n == 0 ? 1.0 : 0.0));
    sum += out * out;
  }
  return sum;
}

bool rings_alike(const ToneSound& a, const ToneSound& b) noexcept {
  return a.minnaert == b.minnaert && a.pitch == b.pitch && a.radiation == b.radiation &&
         a.thermal == b.thermal && a.damping == b.damping && a.physical == b.physical;
}

}  // namespace

Crowd::Crowd(const Rig& rig, double sample_rate, std::uint64_t seed)
    : sample_rate_(sample_rate),
      channels_(static_cast<std::size_t>(channel_count(rig))),
      noises_(std::min(kNoises, channels_.size())) {
  for (std::size_t k = 0; k < noises_.size(); ++k) {
    constexpr std::uint64_t kOthers = std::uint64_t{5} << 48U;  // of no other noise
    noises_[k].noise = Noise(seed, kOthers + k);
  }
  for (; bands_ < kBands && middle(bands_) * kEdge < kHighest * sample_rate; ++bands_) {
    const std::size_t b = bands_;
    const Resonator resonator(middle(b), kQ, sample_rate);
    a1_[b / 4][b % 4] = static_cast<float>(resonator.a1());
    a2_[b / 4][b % 4] = static_cast<float>(resonator.a2());
    gain_[b / 4][b % 4] = static_cast<float>(resonator.gain());
    unit_[b / 4][b % 4] = static_cast<float>(1.0 / std::sqrt(variance(middle(b), sample_rate)));
  }
  tune(known_);
}

void Crowd::tune(const ToneSound& sound) noexcept {
  known_ = sound;
  const double cell = kCell / sample_rate_;  // [s]
  for (std::size_t b = 0; b < bands_; ++b) {
    const double radius = sound.minnaert * sound.pitch / middle(b);
    const double fall = -std::expm1(-2.0 * bubble_tone(sound, radius, 1.0, 0.0).damping * cell);
    fall_[b / 4][b % 4] = static_cast<float>(1.0 - fall);
    rise_[b / 4][b % 4] = static_cast<float>(fall / cell);
  }
}

bool Crowd::join(const ToneSound& sound, const BubbleTone& tone, double seconds,
                 std::span<const Route> routes) noexcept {
  const double pitch = tone.frequency * (1.0 + tone.rise / tone.damping);
  const double place = 3.0 * std::log2(pitch / kLowest);  // 0: the first band's lower edge
  if (!(place >= 0.0 && place < static_cast<double>(bands_))) return false;
  if (!rings_alike(sound, known_)) tune(sound);
  const double energy = tone.amplitude * tone.amplitude / (4.0 * tone.damping) *
                        -std::expm1(-2.0 * tone.damping * seconds);
  const auto band = static_cast<std::size_t>(place);
  for (const Route& route : routes) {
    Channel& channel = channels_[static_cast<std::size_t>(route.channel)];
    channel.joined = true;
    channel.added[band / 4][band % 4] += static_cast<float>(route.gain * route.gain * energy);
  }
  return true;
}

void Crowd::play(Noises& noises, std::int64_t from, int count) const noexcept {
  for (std::size_t k = 0; k < kFours; ++k) {
    if (!noises.runs[k]) continue;
    std::array<Four, 2> first = {noises.first[0][k], noises.first[1][k]};
    std::array<Four, 2> second = {noises.second[0][k], noises.second[1][k]};
    for (int n = 0; n < count; ++n) {
      const std::uint64_t number = (static_cast<std::uint64_t>(from + n) * kFours + k) * 2;
      const auto [a, b] = noises.noise.two_at(number);
      const auto [c, d] = noises.noise.two_at(number + 1);
      Four sample = {a, b, c, d};
      for (std::size_t r = 0; r < first.size(); ++r) {  // as Resonator, side by side
        const Four in = gain_[k] * sample;
        sample = in + first[r];
        first[r] = second[r] - a1_[k] * sample;
        second[r] = -in - a2_[k] * sample;
      }
      noises.samples[k][static_cast<std::size_t>(n)] = sample;
    }
    for (std::size_t r = 0; r < first.size(); ++r) {
      noises.first[r][k] = first[r];
      noises.second[r][k] = second[r];
    }
  }
}

void Crowd::add(const Channel& channel, const Noises& noises, int first, int count,
                const CellGain& gain, double* out) const noexcept {
  std::array<Four, kCell> sums{};
  for (std::size_t k = 0; k < kFours; ++k) {
    if (!noises.runs[k]) continue;
    for (int n = 0; n < count; ++n) {
      const Four amplitude = channel.begin[k] + (channel.end[k] - channel.begin[k]) *
                                                    (static_cast<float>(first + n) / kCell);
      sums[static_cast<std::size_t>(n)] +=
          amplitude * noises.samples[k][static_cast<std::size_t>(n)];
    }
  }
  for (int n = 0; n < count; ++n) {
    const Four& sum = sums[static_cast<std::size_t>(n)];
    out[n] += gain.at(first + n) * static_cast<double>(sum[0] + sum[1] + sum[2] + sum[3]);
  }
}

void Crowd::mix(std::int64_t from, std::int64_t to, Mix& mix) noexcept {
  const auto first = static_cast<int>(from % kCell);
  const auto count = static_cast<int>(to - from);
  for (std::size_t k = 0; k < noises_.size(); ++k) {
    Noises& noises = noises_[k];
    if (std::none_of(noises.runs.begin(), noises.runs.end(), [](bool runs) { return runs; })) {
      continue;
    }
    play(noises, from, count);
    for (std::size_t c = k; c < channels_.size(); c += noises_.size()) {
      if (!channels_[c].sounds) continue;
      mix.touched[c] = 1;
      double* const out = mix.samples.data() + c * kCell + static_cast<std::size_t>(first);
      add(channels_[c], noises, first, count, mix.gains.of<protocol::Bubble>(), out);
    }
  }
}

void Crowd::end_cell(Channel& channel, Noises& noises) const noexcept {
  channel.sounds = channel.joined = false;
  for (std::size_t k = 0; k < kFours; ++k) {
    Four& power = channel.power[k];
    power = power * fall_[k] + channel.added[k] * rise_[k];
    channel.added[k] = Four{};
    channel.begin[k] = channel.end[k];
    bool runs = false;
    for (std::size_t i = 0; i < 4; ++i) {
      if (power[i] < kSilent) power[i] = 0.0F;
      channel.end[k][i] = std::sqrt(power[i]) * unit_[k][i];
      runs = runs || channel.begin[k][i] > 0.0F || power[i] > 0.0F;
    }
    noises.runs[k] = noises.runs[k] || runs;
    channel.sounds = channel.sounds || runs;
  }
}

void Crowd::end_cell() noexcept {
  for (std::size_t k = 0; k < noises_.size(); ++k) {
    Noises& noises = noises_[k];
    const std::array<bool, kFours> ran = std::exchange(noises.runs, {});
    for (std::size_t c = k; c < channels_.size(); c += noises_.size()) {
      if (channels_[c].sounds || channels_[c].joined) end_cell(channels_[c], noises);
    }
    for (std::size_t b = 0; b < kFours; ++b) {
      if (!ran[b] || noises.runs[b]) continue;
      for (auto* states : {&noises.first, &noises.second}) {
        for (Bands& state : *states) state[b] = Four{};
      }
    }
  }
}

void Crowd::clear() noexcept {
  for (Channel& channel : channels_) channel.added = {};
}

}  // namespace splash::synth
