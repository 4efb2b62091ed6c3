// SPDX-License-Identifier: MIT
#include "synth-server/render/masking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splash::synth {
namespace {

constexpr double kLowest = 8.0;        // [Hz]
constexpr double kThirdOctave = 1.26;  // 2^(1/3)
constexpr double kInfinite = std::numeric_limits<double>::infinity();

}  // namespace

Masking::Masking(int channels, double sample_rate)
    : sample_rate_(sample_rate), maskers_(static_cast<std::size_t>(channels) * kBands) {}

int Masking::band_of(double frequency) noexcept {
  return std::clamp(static_cast<int>(3.0 * std::log2(frequency / kLowest)), 0, kBands - 1);
}

Masking::Masker& Masking::at(int channel, int band) noexcept {
  return maskers_[static_cast<std::size_t>(channel) * kBands + static_cast<std::size_t>(band)];
}

double Masking::ratio(const Masker& masker, double log_level, std::int64_t sample,
                      const Ranking& ranking) const noexcept {
  if (masker.place == Ranking::kNone || !ranking.sounds(masker.place, masker.since, sample)) {
    return kInfinite;
  }
  return std::exp(2.0 * (log_level - ranking.level(masker.place, sample) - masker.log_gain));
}

bool Masking::covers(const BubbleTone& tone, std::span<const Route> routes, std::int64_t sample,
                     const Ranking& ranking) noexcept {
  const int band = band_of(tone.frequency);
  const double log_amplitude = std::log(tone.amplitude);
  for (const Route& route : routes) {
    const Masker& masker = at(route.channel, band);
    const double power = ratio(masker, log_amplitude + std::log(route.gain), sample, ranking);
    if (!(masker.left_out + power <= kMostPower)) return false;
    if (ranking.decay(masker.place) * sample_rate_ > tone.damping) return false;
    const double t = static_cast<double>(sample - masker.since) / sample_rate_;
    const double pitch = masker.frequency * (1.0 + 2.0 * masker.rise * t);
    if (pitch > kThirdOctave * tone.frequency || tone.frequency > kThirdOctave * pitch)
      return false;
  }
  for (const Route& route : routes) {
    Masker& masker = at(route.channel, band);
    masker.left_out += ratio(masker, log_amplitude + std::log(route.gain), sample, ranking);
  }
  return true;
}

void Masking::note(const BubbleTone& tone, std::span<const Route> routes, std::int64_t sample,
                   std::uint32_t place, const Ranking& ranking) noexcept {
  const int band = band_of(tone.frequency);
  const double log_amplitude = std::log(tone.amplitude);
  for (const Route& route : routes) {
    Masker& masker = at(route.channel, band);
    const double log_gain = std::log(route.gain);
    const double power = ratio(masker, log_amplitude + log_gain, sample, ranking);
    if (power <= 1.0) continue;  // the old one is stronger
    const double left_out = power < kInfinite ? masker.left_out / power : 0.0;
    masker = {place, sample, log_gain, tone.frequency, tone.rise, left_out};
  }
}

}  // namespace splash::synth
