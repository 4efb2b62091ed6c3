// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <fstream>
#include <utility>
#include <vector>

#include "synth-server/voices/bubble_tone.hpp"
#include "tests/bench/synth_peers.hpp"
#include "tests/bench/synth_timing.hpp"
#include "tests/supercollider/score.hpp"

namespace splash::bench {
namespace {

constexpr double kRate = 44100.0;
constexpr int kVoices = 3000;
constexpr int kRuns = 3;
constexpr const char* kPackage = "supercollider-server";

/// Out.ar(0, SinOsc.ar(Line.kr(f0, f1, dur)) * XLine.kr(amp, end, dur, doneAction: 2))
std::string synthdef() {
  using namespace supercollider;
  Definition def;
  const Wire nil = def.constant(0.0F);
  const Wire two = def.constant(2.0F);
  def.parameters({"amp", "f0", "f1", "dur", "end"});
  const Wire amp = Definition::parameter(0), f0 = Definition::parameter(1),
             f1 = Definition::parameter(2), duration = Definition::parameter(3),
             end = Definition::parameter(4);
  const Wire pitch = def.add("Line", kControl, {f0, f1, duration, nil});
  const Wire level = def.add("XLine", kControl, {amp, end, duration, two});
  const Wire tone = def.add("SinOsc", kAudio, {pitch, nil});
  def.add("Out", kAudio, {nil, def.binary(kTimes, tone, level)}, 0);
  return def.compiled("bubble");
}

struct Voice {
  double time = 0.0;  ///< [s]
  double amplitude = 0.0, f0 = 0.0, f1 = 0.0, duration = 0.0, end = 0.0;
};

void write_score(const std::filesystem::path& path, const std::vector<Voice>& voices,
                 double seconds) {
  std::ofstream file(path, std::ios::binary);
  supercollider::write_definition(file, synthdef());
  std::int64_t id = 1000;
  for (const Voice& voice : voices) {
    supercollider::Packet message;
    message.text("/s_new");
    message.text(",siiisfsfsfsfsf");
    message.text("bubble");
    for (const std::int64_t value : {id++, std::int64_t{0}, std::int64_t{0}}) message.whole(value);
    for (const auto& [name, value] : {std::pair{"amp", voice.amplitude},
                                      {"f0", voice.f0},
                                      {"f1", voice.f1},
                                      {"dur", voice.duration},
                                      {"end", voice.end}}) {
      message.text(name);
      message.real(value);
    }
    supercollider::write_bundle(file, voice.time, message.bytes());
  }
  supercollider::write_end(file, seconds);
}

double render(const std::filesystem::path& folder, const std::vector<Voice>& voices,
              double seconds) {
  const auto score = folder / "score.osc";
  write_score(score, voices, seconds);
  return run_peer({"scsynth", "-V", "-1", "-N", score.string(), "_", (folder / "out.wav").string(),
                   "44100", "WAV", "float", "-o", "1", "-i", "0", "-n", "262144", "-m", "1048576"},
                  kPackage);
}

double steady_voices(const std::filesystem::path& folder) {
  constexpr double kShort = 1.0;
  constexpr double kLong = 5.0;
  std::vector<Voice> voices;
  for (int i = 0; i < kVoices; ++i) {
    voices.push_back({0.0, 1e-4, 20.0 + 0.1 * i, 40.0 + 0.1 * i, 100.0, 1e-5});
  }
  std::vector<double> costs;
  for (int run = 0; run < kRuns; ++run) {
    costs.push_back((render(folder, voices, kLong) - render(folder, voices, kShort)) /
                    (kLong - kShort));
  }
  return kVoices / median(costs);
}

double onsets(const std::filesystem::path& folder) {
  constexpr int kCount = 40000;
  constexpr double kSeconds = 2.0;
  std::vector<Voice> voices;
  std::uint64_t state = 2026;
  for (int i = 0; i < kCount; ++i) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    const double life = 0.010 * std::pow(30.0, static_cast<double>(state >> 11U) / 9.007199e15);
    voices.push_back({i * kSeconds / kCount, 1e-4, 500.0, 800.0, life, 1e-7});
  }
  std::vector<double> costs;
  for (int run = 0; run < kRuns; ++run) {
    costs.push_back(render(folder, voices, kSeconds + 0.3) - render(folder, {}, kSeconds + 0.3));
  }
  return kCount / median(costs);
}

double error(const std::filesystem::path& folder) {
  const auto tone =
      synth::paper_bubble(kErrorRadius, 1.0 / kErrorRadius, {.rise = synth::kIntegratedRise});
  const double life = 6.9077552789821368 / tone.damping;
  const double pitch = tone.frequency * (1.0 + 2.0 * tone.rise * life);
  render(folder, {{0.0, 1.0, tone.frequency, pitch, life, 1e-3}}, 1.0);
  return bubble_error(folder / "out.wav");
}

}  // namespace

Peer measure_scsynth(const std::filesystem::path& folder) {
  return {"scsynth", steady_voices(folder), onsets(folder), error(folder)};
}

}  // namespace splash::bench
