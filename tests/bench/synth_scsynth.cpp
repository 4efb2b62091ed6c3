// SPDX-License-Identifier: MIT
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <vector>

#include "synth-server/voices/bubble_tone.hpp"
#include "tests/bench/synth_peers.hpp"
#include "tests/bench/synth_timing.hpp"

namespace splash::bench {
namespace {

constexpr double kRate = 44100.0;
constexpr int kVoices = 3000;
constexpr int kRuns = 3;
constexpr const char* kPackage = "supercollider-server";

/// Big-endian bytes.
class Bytes {
 public:
  Bytes& whole(std::int64_t value, int bytes) {
    for (int k = bytes - 1; k >= 0; --k) {
      text_.push_back(static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * k) & 0xFFU));
    }
    return *this;
  }
  Bytes& real(double value) {
    return whole(std::bit_cast<std::int32_t>(static_cast<float>(value)), 4);
  }
  Bytes& pascal(const std::string& value) {
    return whole(static_cast<std::int64_t>(value.size()), 1).raw(value);
  }
  Bytes& padded(const std::string& value) {
    raw(value);
    text_.append(4 - value.size() % 4, '\0');
    return *this;
  }
  Bytes& raw(const std::string& value) {
    text_ += value;
    return *this;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// A unit generator of the SynthDef file format, version 2. An input is {ugen, output}, or
/// {-1, constant}.
void ugen(Bytes& out, const std::string& name, int rate,
          const std::vector<std::pair<int, int>>& inputs, int outputs, int special = 0) {
  out.pascal(name).whole(rate, 1).whole(static_cast<std::int64_t>(inputs.size()), 4);
  out.whole(outputs, 4).whole(special, 2);
  for (const auto& [from, index] : inputs) out.whole(from, 4).whole(index, 4);
  for (int k = 0; k < outputs; ++k) out.whole(rate, 1);
}

/// Out.ar(0, SinOsc.ar(Line.kr(f0, f1, dur)) * XLine.kr(amp, end, dur, doneAction: 2))
std::string synthdef() {
  constexpr int kControl = 1;
  constexpr int kAudio = 2;
  Bytes out;
  out.raw("SCgf").whole(2, 4).whole(1, 2).pascal("bubble");
  out.whole(2, 4).real(0.0).real(2.0);  // constants
  out.whole(5, 4);
  for (int k = 0; k < 5; ++k) out.real(1.0);
  out.whole(5, 4);
  const std::vector<std::string> names = {"amp", "f0", "f1", "dur", "end"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    out.pascal(names[k]).whole(static_cast<std::int64_t>(k), 4);
  }
  out.whole(6, 4);
  ugen(out, "Control", kControl, {}, 5);
  ugen(out, "Line", kControl, {{0, 1}, {0, 2}, {0, 3}, {-1, 0}}, 1);
  ugen(out, "XLine", kControl, {{0, 0}, {0, 4}, {0, 3}, {-1, 1}}, 1);
  ugen(out, "SinOsc", kAudio, {{1, 0}, {-1, 0}}, 1);
  ugen(out, "BinaryOpUGen", kAudio, {{3, 0}, {2, 0}}, 1, 2);
  ugen(out, "Out", kAudio, {{-1, 0}, {4, 0}}, 0);
  out.whole(0, 2);
  return out.text();
}

struct Voice {
  double time = 0.0;  ///< [s]
  double amplitude = 0.0, f0 = 0.0, f1 = 0.0, duration = 0.0, end = 0.0;
};

/// A bundle behind its size, with one message.
void write_bundle(std::ofstream& file, double time, const std::string& message) {
  Bytes bundle;
  bundle.padded("#bundle");
  bundle.whole(static_cast<std::int64_t>(std::ldexp(time, 32)), 8);
  bundle.whole(static_cast<std::int64_t>(message.size()), 4).raw(message);
  Bytes size;
  size.whole(static_cast<std::int64_t>(bundle.text().size()), 4);
  file << size.text() << bundle.text();
}

void write_score(const std::filesystem::path& path, const std::vector<Voice>& voices,
                 double seconds) {
  std::ofstream file(path, std::ios::binary);
  const std::string definition = synthdef();
  Bytes receive;
  receive.padded("/d_recv").padded(",b").whole(static_cast<std::int64_t>(definition.size()), 4);
  receive.raw(definition).raw(std::string((4 - definition.size() % 4) % 4, '\0'));
  write_bundle(file, 0.0, receive.text());
  std::int64_t id = 1000;
  for (const Voice& voice : voices) {
    Bytes message;
    message.padded("/s_new").padded(",siiisfsfsfsfsf").padded("bubble");
    message.whole(id++, 4).whole(0, 4).whole(0, 4);
    message.padded("amp").real(voice.amplitude).padded("f0").real(voice.f0);
    message.padded("f1").real(voice.f1).padded("dur").real(voice.duration);
    message.padded("end").real(voice.end);
    write_bundle(file, voice.time, message.text());
  }
  Bytes last;
  last.padded("/c_set").padded(",if").whole(0, 4).real(0.0);
  write_bundle(file, seconds, last.text());
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
