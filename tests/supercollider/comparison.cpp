// SPDX-License-Identifier: MIT
#include "tests/supercollider/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "protocol/event_log.hpp"
#include "synth-server/output/output_guard.hpp"
#include "synth-server/replay/replay.hpp"
#include "tests/pd-patches/rendering.hpp"
#include "tests/supercollider/score.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::supercollider {
namespace {

struct ScoreSettings {
  double sample_rate = 48000.0;  ///< [Hz]
  double gain = 1.0;             ///< from metres to full scale [1/m]
  double highest = 750.0;        ///< bubbles born above this are left out [Hz]
  std::int64_t frames = 48000;   ///< rendered
};

/// "bubble" with the parameters amp, f0 [Hz], d [1/s], length [s], breaks [s]: on bus 0, from the
/// sample its bundle names,
///   amp exp(-d t) sin(2 pi f0 t (1 + 0.1 d t)),   paper section 5.2,
/// with t from Sweep and the phase's whole cycles taken away before the sine; from `breaks` on it
/// fades within 50 ms as synth-server's voices do.
std::string bubble_synthdef() {
  constexpr int kAmp = 0;
  constexpr int kFrequency = 1;
  constexpr int kDamping = 2;
  constexpr int kLength = 3;
  constexpr int kBreaks = 4;
  constexpr float kFreeSelf = 2.0F;  // what Line does when it is through
  Definition def;
  const Wire nil = def.constant(0.0F);
  const Wire one = def.constant(1.0F);
  def.parameters({"amp", "f0", "d", "length", "breaks"});
  const Wire amp = Definition::parameter(kAmp);
  const Wire f0 = Definition::parameter(kFrequency);
  const Wire d = Definition::parameter(kDamping);
  const Wire length = Definition::parameter(kLength);
  const Wire breaks = Definition::parameter(kBreaks);
  def.add("Line", kControl, {nil, one, length, def.constant(kFreeSelf)});
  const Wire t = def.add("Sweep", kAudio, {nil, one});
  const Wire decay = def.binary(kTimes, d, t);
  const Wire chirp = def.binary(kAdd, one, def.binary(kTimes, def.constant(0.1F), decay));
  const Wire cycles = def.binary(kTimes, def.binary(kTimes, f0, t), chirp);
  const Wire angle = def.binary(kTimes, def.constant(2.0F * std::numbers::pi_v<float>),
                                def.unary(kFraction, cycles));
  const Wire envelope = def.unary(kExponential, def.unary(kNegate, decay));
  const Wire tone = def.binary(kTimes, def.unary(kSine, angle), def.binary(kTimes, amp, envelope));
  // From `breaks` on it fades within 50 ms: left^2 (3 - 2 left).
  const Wire since = def.binary(kMinus, t, breaks);
  const Wire falling = def.binary(kMinus, one, def.binary(kTimes, def.constant(20.0F), since));
  const Wire left = def.binary(kMaximum, def.binary(kMinimum, falling, one), nil);
  const Wire bend =
      def.binary(kMinus, def.constant(3.0F), def.binary(kTimes, def.constant(2.0F), left));
  const Wire fade = def.binary(kTimes, def.binary(kTimes, left, left), bend);
  def.add("OffsetOut", kAudio, {nil, def.binary(kTimes, tone, fade)}, 0);
  return def.compiled("bubble");
}

constexpr double kTimeout = 120.0;  ///< for one rendering on a busy machine [s]
constexpr double kNever = 1e6;      ///< [s]
constexpr double kFaintest = 1e-8;  ///< a voice ends at this [full scale]
/// Of a sample: scsynth rounds to the nearest, but what lies on a block's edge it puts into the
/// last sample of the block before.
constexpr double kWithin = 0.25;

struct Tone {
  double radius = 0.0;   ///< [m]
  double epsilon = 0.0;  ///< [1]
  double life = 0.0;     ///< until it breaks, 0: never [s]
};

std::optional<Tone> tone_of(const protocol::Event& event) {
  if (const auto* b = std::get_if<protocol::Bubble>(&event)) {
    return Tone{static_cast<double>(b->radius), static_cast<double>(b->epsilon)};
  }
  if (const auto* c = std::get_if<protocol::Cavity>(&event)) {
    return Tone{static_cast<double>(c->radius), static_cast<double>(c->epsilon),
                static_cast<double>(c->life)};
  }
  return std::nullopt;
}

float offset_of(const protocol::Event& event) {
  return std::visit([](const auto& e) { return e.offset_ms; }, event);
}

/// By their samples, in the log's order.
std::multimap<std::int64_t, Tone> tones(const std::vector<protocol::LogEntry>& log,
                                        const ScoreSettings& settings) {
  std::multimap<std::int64_t, Tone> found;
  for (const auto& entry : log) {
    for (const auto& message : entry.messages) {
      const auto event = protocol::to_event(message);
      const auto tone = event ? tone_of(*event) : std::nullopt;
      if (!tone || 3.0 / tone->radius > settings.highest) continue;
      const double seconds = entry.seconds + 1e-3 * static_cast<double>(offset_of(*event));
      found.emplace(std::llround(seconds * settings.sample_rate), *tone);
    }
  }
  return found;
}

/// f0 r = 3 m/s and d = 0.13 / r + 0.0072 r^-1.5: paper, section 5.2.
std::string new_bubble(const Tone& tone, double gain, double sample_rate) {
  const double damping = 0.13 / tone.radius + 0.0072 * std::pow(tone.radius, -1.5);
  const double amplitude = tone.epsilon * tone.radius * gain;
  Packet message;
  message.text("/s_new");
  message.text(",siiisfsfsfsfsf");
  message.text("bubble");
  message.whole(-1);  // a number of scsynth's own
  message.whole(1);   // at the end
  message.whole(0);   // of the root group
  const auto set = [&](const char* name, double value) {
    message.text(name);
    message.real(value);
  };
  set("amp", amplitude);
  set("f0", 3.0 / tone.radius);
  set("d", damping);
  set("length", std::max(1e-3, std::log(amplitude / kFaintest) / damping));
  set("breaks", tone.life > 0.0 ? std::round(tone.life * sample_rate) / sample_rate : kNever);
  return message.bytes();
}

/// Writes each bubble and cavity of the log as /s_new at its sample; impacts are noise, which no
/// two engines draw alike, and left out. The framing is the log's own: bundles, each behind its
/// size, their time tags counting seconds from the start; only the messages change.
void write_score(const std::vector<protocol::LogEntry>& log, const ScoreSettings& settings,
                 const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::binary);
  write_definition(file, bubble_synthdef());
  for (const auto& [sample, tone] : tones(log, settings)) {
    write_bundle(file, (static_cast<double>(sample) + kWithin) / settings.sample_rate,
                 new_bubble(tone, settings.gain, settings.sample_rate));
  }
  write_end(file, static_cast<double>(settings.frames) / settings.sample_rate);
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

/// Renders it with the real scsynth: one channel. Throws std::runtime_error with what it printed.
std::vector<float> render_with_scsynth(const std::vector<protocol::LogEntry>& log,
                                       const ScoreSettings& settings) {
  const tests::TemporaryFolder folder;
  const auto score = folder / "score.osc";
  const auto wav = folder / "out.wav";
  write_score(log, settings, score);
  tests::ChildProcess scsynth({"scsynth", "-V", "-1", "-N", score.string(), "_", wav.string(),
                               std::to_string(std::llround(settings.sample_rate)), "WAV", "float",
                               "-o", "1", "-i", "0", "-n", "65536", "-m", "262144"});
  const auto status = scsynth.wait(kTimeout);
  if (status != 0) {
    throw std::runtime_error("scsynth ended with " + std::to_string(status.value_or(-1)) +
                             (status == 127 ? " (apt-get install supercollider-server)" : "") +
                             ": " + scsynth.output());
  }
  auto channel = tests::read_recording(wav.string()).channels.at(0);
  channel.resize(static_cast<std::size_t>(settings.frames));
  return channel;
}

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
