// SPDX-License-Identifier: MIT
#include "tests/supercollider/comparison.hpp"

#include <algorithm>
#include <cmath>

#include "synth-server/output/output_guard.hpp"
#include "synth-server/replay/replay.hpp"
#include "tests/supercollider/score.hpp"

namespace splash::supercollider {
namespace {

constexpr double kRate = 48000.0;
constexpr double kSoft = 0.1;  ///< a gain at which no scene comes near the ceiling [1/m]
/// Sweep gives its first sample the time of the second: what scsynth plays is one sample early.
constexpr std::size_t kEarly = 1;

synth::Output transducer(double gain) {
  synth::Output output;
  output.name = "hand";
  output.full_scale = 1.0 / gain;
  output.ceiling = 1.0;
  return output;
}

std::vector<float> render_with_engine(const std::vector<protocol::LogEntry>& log,
                                      std::int64_t frames, double gain) {
  synth::Rig rig;
  rig.name = "comparison";
  rig.outputs = {transducer(gain)};
  synth::ReplaySettings settings;
  settings.engine.sample_rate = kRate;
  settings.engine.max_voices = 8192;
  settings.engine.components = synth::kBubbles | synth::kCavities;
  settings.tail = static_cast<double>(frames) / kRate;
  std::vector<float> channel;
  synth::replay(log, rig, settings, [&](const float* const* blocks, int count) {
    channel.insert(channel.end(), blocks[0], blocks[0] + count);
  });
  channel.resize(static_cast<std::size_t>(frames));
  return channel;
}

std::vector<float> guarded(const std::vector<float>& raw, double gain) {
  std::vector<double> in(raw.size(), 0.0);
  for (std::size_t i = kEarly; i < raw.size(); ++i) in[i] = static_cast<double>(raw[i - kEarly]);
  const std::vector<double> open(raw.size(), 1.0);
  std::vector<float> out(raw.size());
  synth::OutputGuard guard(transducer(gain), kRate);
  guard.process(in.data(), open.data(), out.data(), static_cast<int>(raw.size()));
  return out;
}

}  // namespace

std::vector<protocol::LogEntry> scene_log(const std::string& scene) {
  return protocol::read_log(std::filesystem::path(SPLASH_SOURCE_DIR) / "tests/data" /
                            (scene + ".osc"));
}

Pair render_both(const std::vector<protocol::LogEntry>& log, std::int64_t frames, double gain) {
  const ScoreSettings score{kRate, gain, transducer(gain).band.high, frames};
  return {render_with_engine(log, frames, gain), guarded(render_with_scsynth(log, score), gain)};
}

double loud_gain(const std::vector<protocol::LogEntry>& log, std::int64_t frames) {
  float peak = 0.0F;
  for (const float sample : render_with_engine(log, frames, kSoft)) {
    peak = std::max(peak, std::abs(sample));
  }
  return peak > 0.0F ? 0.5 * kSoft / static_cast<double>(peak) : kSoft;
}

}  // namespace splash::supercollider
