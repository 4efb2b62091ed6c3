// SPDX-License-Identifier: MIT
// Rigs, events and whole renderings for the engine's tests.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "synth-server/output/rig_reader.hpp"
#include "synth-server/render/engine.hpp"

namespace splash::synth {

inline constexpr double kRate = 48000.0;

/// One channel from 1 Hz to beyond Nyquist: what the voices give, hardly touched.
inline Rig open_rig() {
  Rig rig;
  rig.name = "open";
  Output output;
  output.name = "out";
  output.band = {1.0, 24000.0};
  output.ceiling = 1.0;
  rig.outputs = {output};
  return rig;
}

inline Rig floor_rig() {
  Rig rig;
  rig.name = "floor";
  Output output;
  output.name = "floor";
  output.kind = OutputKind::tiles;
  rig.outputs = {output};
  return rig;
}

/// configs/rigs/`name`.yaml.
inline Rig shipped_rig(const std::string& name) {
  return read_rig(SPLASH_SOURCE_DIR "/configs/rigs/" + name + ".yaml");
}

inline EngineSettings file_settings() {
  return {.sample_rate = kRate, .sound = {}, .start_ramp = 0.0};
}

inline protocol::Bubble bubble(float radius, float epsilon = 0.05F, protocol::Vec3 place = {}) {
  return {.radius = radius, .epsilon = epsilon, .position = place};
}

inline protocol::Impact impact(float speed, std::int32_t id = 0, protocol::Vec3 place = {}) {
  return {.id = id, .speed = speed, .approach = speed, .position = place};
}

inline protocol::Cavity cavity(float radius, protocol::Vec3 place = {}) {
  return {.radius = radius, .position = place};
}

using Channels = std::vector<std::vector<float>>;

/// Room for a block of two channels.
struct StereoBlock {
  explicit StereoBlock(int frames)
      : left(static_cast<std::size_t>(frames)), right(static_cast<std::size_t>(frames)) {}
  std::vector<float> left, right;
  std::array<float*, 2> pointers = {left.data(), right.data()};
};

/// Renders `frames` more samples of an engine in blocks of the given sizes, over and over.
inline Channels render(Engine& engine, int frames, const std::vector<int>& blocks = {512}) {
  Channels out(static_cast<std::size_t>(engine.channels()),
               std::vector<float>(static_cast<std::size_t>(frames)));
  std::vector<float*> pointers(out.size());
  int done = 0;
  for (std::size_t b = 0; done < frames; ++b) {
    const int take = std::min(blocks[b % blocks.size()], frames - done);
    for (std::size_t c = 0; c < out.size(); ++c) pointers[c] = out[c].data() + done;
    engine.render(pointers.data(), take);
    done += take;
  }
  return out;
}

/// A busy second of splashes on the floor: all kinds, all places, several at one sample.
inline std::vector<TimedEvent> splashes(int count, std::int64_t samples) {
  std::vector<TimedEvent> events;
  std::uint64_t state = 12345;
  const auto draw = [&] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<float>(state >> 40U) / 16777216.0F;
  };
  for (int i = 0; i < count; ++i) {
    const protocol::Vec3 place{draw() * 1.83F, draw() * 1.83F, 0.2F};
    const auto sample = static_cast<std::int64_t>(draw() * static_cast<float>(samples));
    const float kind = draw();
    if (kind < 0.1F) {
      events.push_back({impact(0.2F + draw(), i, place), sample});
    } else if (kind < 0.15F) {
      events.push_back({cavity(0.02F + 0.05F * draw(), place), sample});
    } else {
      events.push_back({bubble(0.002F + 0.01F * draw(), 0.01F + 0.09F * draw(), place), sample});
    }
  }
  return events;
}

/// The largest magnitude from sample `from` on.
inline double loudest(const std::vector<float>& signal, std::size_t from = 0) {
  double most = 0.0;
  for (std::size_t n = from; n < signal.size(); ++n) {
    most = std::max(most, std::abs(static_cast<double>(signal[n])));
  }
  return most;
}

/// The sum of the squares.
inline double energy(const std::vector<float>& signal) {
  double sum = 0.0;
  for (const float s : signal) sum += static_cast<double>(s) * static_cast<double>(s);
  return sum;
}

}  // namespace splash::synth
