// SPDX-License-Identifier: MIT
#include "synth-server/figure/components.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "synth-server/figure/wav_reader.hpp"

namespace splash::synth {
namespace {

void require_equal_shape(const std::vector<WavSignal>& parts) {
  for (const WavSignal& part : parts) {
    if (part.sample_rate != parts[0].sample_rate ||
        part.channels.size() != parts[0].channels.size()) {
      throw std::runtime_error("the files differ: " + std::to_string(part.channels.size()) +
                               " channels at " + std::to_string(part.sample_rate) + " Hz against " +
                               std::to_string(parts[0].channels.size()) + " at " +
                               std::to_string(parts[0].sample_rate) +
                               " Hz; render all of them with the same rig and sample rate");
    }
  }
}

std::vector<float> sum(const Components& components) {
  std::vector<float> total(components.impact.size());
  for (std::size_t i = 0; i < total.size(); ++i) {
    total[i] = components.impact[i] + components.bubble[i] + components.cavity[i];
  }
  return total;
}

double energy(const std::vector<float>& signal) {
  double total = 0.0;
  for (const float sample : signal) {
    total += static_cast<double>(sample) * static_cast<double>(sample);
  }
  return total;
}

/// `parts`: impact, bubble, cavity, and what was played where that is known.
Components channel_of(const std::vector<WavSignal>& parts, std::size_t channel) {
  return {parts[0].sample_rate,
          0.0,
          static_cast<int>(channel) + 1,
          parts[0].channels[channel],
          parts[1].channels[channel],
          parts[2].channels[channel],
          parts.size() > 3 ? parts[3].channels[channel] : std::vector<float>()};
}

}  // namespace

std::vector<float> Components::signal() const {
  return played.empty() ? sum(*this) : played;
}

Components read_components(const ComponentFiles& files) {
  std::vector<WavSignal> parts = {read_wav(files.impact), read_wav(files.bubble),
                                  read_wav(files.cavity)};
  std::size_t frames = 0;
  for (const WavSignal& part : parts) frames = std::max(frames, part.frames());
  if (!files.played.empty()) {
    parts.push_back(read_wav(files.played));
    frames = parts.back().frames();
  }
  require_equal_shape(parts);
  if (frames == 0) throw std::runtime_error(files.impact.string() + ": the files hold no sample");
  Components loudest;
  double most = -1.0;
  for (WavSignal& part : parts) {
    for (std::vector<float>& channel : part.channels) channel.resize(frames, 0.0F);
  }
  for (std::size_t c = 0; c < parts[0].channels.size(); ++c) {
    Components here = channel_of(parts, c);
    const double strength = energy(here.signal());
    if (strength <= most) continue;
    most = strength;
    loudest = std::move(here);
  }
  return loudest;
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
    if (samples.empty()) return samples;
    return std::vector<float>(samples.begin() + static_cast<std::ptrdiff_t>(first),
                              samples.begin() + static_cast<std::ptrdiff_t>(last));
  };
  return {whole.sample_rate,  whole.start + first / whole.sample_rate,
          whole.channel,      part(whole.impact),
          part(whole.bubble), part(whole.cavity),
          part(whole.played)};
}

}  // namespace splash::synth
