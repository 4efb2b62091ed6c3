// SPDX-License-Identifier: MIT
#include "synth-server/figure/components.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "synth-server/figure/wav_reader.hpp"

namespace splash::synth {
namespace {

using Stems = std::array<WavSignal, 3>;

void require_equal_shape(const Stems& stems) {
  for (const WavSignal& stem : stems) {
    if (stem.sample_rate != stems[0].sample_rate ||
        stem.channels.size() != stems[0].channels.size()) {
      throw std::runtime_error(
          "the three components differ: " + std::to_string(stem.channels.size()) + " channels at " +
          std::to_string(stem.sample_rate) + " Hz against " +
          std::to_string(stems[0].channels.size()) + " at " + std::to_string(stems[0].sample_rate) +
          " Hz; render all three with the same rig");
    }
  }
}

double energy(const Stems& stems, std::size_t channel) {
  double total = 0.0;
  for (std::size_t i = 0; i < stems[0].frames(); ++i) {
    double sample = 0.0;
    for (const WavSignal& stem : stems) sample += static_cast<double>(stem.channels[channel][i]);
    total += sample * sample;
  }
  return total;
}

std::size_t loudest_channel(const Stems& stems) {
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t c = 0; c < stems[0].channels.size(); ++c) {
    const double here = energy(stems, c);
    if (here > most) {
      most = here;
      best = c;
    }
  }
  return best;
}

}  // namespace

std::vector<float> Components::sum() const {
  std::vector<float> total(impact.size());
  for (std::size_t i = 0; i < total.size(); ++i) total[i] = impact[i] + bubble[i] + cavity[i];
  return total;
}

Components read_components(const std::filesystem::path& impact, const std::filesystem::path& bubble,
                           const std::filesystem::path& cavity) {
  Stems stems = {read_wav(impact), read_wav(bubble), read_wav(cavity)};
  require_equal_shape(stems);
  std::size_t frames = 0;
  for (const WavSignal& stem : stems) frames = std::max(frames, stem.frames());
  if (frames == 0) throw std::runtime_error(impact.string() + ": the components hold no sample");
  for (WavSignal& stem : stems) {
    for (std::vector<float>& channel : stem.channels) channel.resize(frames, 0.0F);
  }
  const std::size_t channel = loudest_channel(stems);
  return {stems[0].sample_rate,          0.0,
          static_cast<int>(channel) + 1, stems[0].channels[channel],
          stems[1].channels[channel],    stems[2].channels[channel]};
}

Components cut(const Components& whole, double from, double to) {
  const auto frames = static_cast<double>(whole.impact.size());
  const double first =
      std::clamp(std::round((from - whole.start) * whole.sample_rate), 0.0, frames);
  const double last = std::clamp(std::round((to - whole.start) * whole.sample_rate), 0.0, frames);
  if (!(first < last)) {
    throw std::runtime_error("from " + std::to_string(from) + " s to " + std::to_string(to) +
                             " s holds no sample: the signal lasts " +
                             std::to_string(whole.duration()) + " s");
  }
  const auto part = [&](const std::vector<float>& samples) {
    return std::vector<float>(samples.begin() + static_cast<std::ptrdiff_t>(first),
                              samples.begin() + static_cast<std::ptrdiff_t>(last));
  };
  return {whole.sample_rate,  whole.start + first / whole.sample_rate,
          whole.channel,      part(whole.impact),
          part(whole.bubble), part(whole.cavity)};
}

}  // namespace splash::synth
