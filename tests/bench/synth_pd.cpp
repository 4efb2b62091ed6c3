// SPDX-License-Identifier: MIT
#include <cmath>
#include <fstream>

#include "synth-server/voices/bubble_tone.hpp"
#include "tests/bench/synth_peers.hpp"
#include "tests/bench/synth_timing.hpp"

namespace splash::bench {
namespace {

constexpr int kVoices = 1000;
constexpr int kRuns = 3;
constexpr const char* kPackage = "puredata-core";

/// A voice takes "f0 f1 logA0 logA1 milliseconds": osc~ and two ramps, the amplitude's in its
/// logarithm. The oscillator starts with the sine's nil.
constexpr const char* kVoice = R"(#N canvas 0 0 600 400 10;
#X obj 20 20 inlet;
#X obj 20 50 unpack f f f f f;
#X obj 20 80 pack f f f;
#X obj 200 80 pack f f f;
#X msg 20 110 \$1 \, \$2 \$3;
#X msg 200 110 \$1 \, \$2 \$3;
#X obj 20 140 line~;
#X obj 200 140 line~;
#X obj 20 170 osc~;
#X obj 200 170 exp~;
#X obj 20 200 *~;
#X obj 20 230 outlet~;
#X obj 400 50 t b a;
#X msg 400 80 0.75;
#X obj 300 50 t f f;
#X connect 0 0 12 0;
#X connect 12 1 1 0;
#X connect 12 0 13 0;
#X connect 13 0 8 1;
#X connect 1 4 14 0;
#X connect 14 1 3 2;
#X connect 14 0 2 2;
#X connect 1 3 3 1;
#X connect 1 2 3 0;
#X connect 1 1 2 1;
#X connect 1 0 2 0;
#X connect 2 0 4 0;
#X connect 3 0 5 0;
#X connect 4 0 6 0;
#X connect 5 0 7 0;
#X connect 6 0 8 0;
#X connect 7 0 9 0;
#X connect 8 0 10 0;
#X connect 9 0 10 1;
#X connect 10 0 11 0;
)";

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

/// Object 0 is the clone; `rest` continues the patch from object 3 on.
std::string patch(int voices, double seconds, const std::string& rest) {
  return "#N canvas 0 0 600 400 10;\n#X obj 20 80 clone bench-voice " + std::to_string(voices) +
         ";\n#X obj 20 20 loadbang;\n#X msg 200 50 \\; pd dsp 1;\n" + rest +
         "#X obj 400 20 delay " + std::to_string(1000.0 * seconds) +
         ";\n#X msg 400 50 \\; pd quit;\n#X connect 1 0 2 0;\n";
}

double run(const std::filesystem::path& folder, const std::string& text) {
  write(folder / "bench-voice.pd", kVoice);
  write(folder / "bench.pd", text);
  return run_peer(
      {"pd", "-batch", "-nogui", "-noaudio", "-r", "44100", (folder / "bench.pd").string()},
      kPackage);
}

double steady(const std::filesystem::path& folder, double seconds) {
  return run(folder, patch(kVoices, seconds,
                           "#X msg 100 50 all 20 40 -9 -11 100000;\n#X obj 20 110 *~ 0.001;\n") +
                         "#X connect 1 0 3 0;\n#X connect 3 0 0 0;\n#X connect 0 0 4 0;\n"
                         "#X connect 1 0 5 0;\n#X connect 5 0 6 0;\n");
}

double steady_voices(const std::filesystem::path& folder) {
  std::vector<double> costs;
  for (int k = 0; k < kRuns; ++k)
    costs.push_back((steady(folder, 5.0) - steady(folder, 1.0)) / 4.0);
  return kVoices / median(costs);
}

/// Eight bubbles per millisecond on as many voices as they need: idle ones cost as much.
double onsets(const std::filesystem::path& folder) {
  const std::string rest =
      "#X obj 100 20 metro 1;\n#X obj 100 40 t b b b b b b b b;\n"
      "#X msg 100 60 next 500 800 -9 -16 85;\n";
  std::string wires =
      "#X connect 1 0 3 0;\n#X connect 3 0 4 0;\n#X connect 5 0 0 0;\n"
      "#X connect 1 0 6 0;\n#X connect 6 0 7 0;\n";
  for (int k = 0; k < 8; ++k) wires += "#X connect 4 " + std::to_string(k) + " 5 0;\n";
  const auto play = [&](double seconds) {
    return run(folder, patch(8 * 85, seconds, rest) + wires);
  };
  std::vector<double> costs;
  for (int k = 0; k < kRuns; ++k) costs.push_back((play(5.0) - play(1.0)) / 4.0);
  return 8000.0 / median(costs);
}

double error(const std::filesystem::path& folder) {
  const auto tone =
      synth::paper_bubble(kErrorRadius, 1.0 / kErrorRadius, {.rise = synth::kIntegratedRise});
  const double life = 6.9077552789821368 / tone.damping;
  const double pitch = tone.frequency * (1.0 + 2.0 * tone.rise * life);
  const std::string rest = "#X msg 100 50 all " + std::to_string(tone.frequency) + " " +
                           std::to_string(pitch) + " 0 " + std::to_string(-tone.damping * life) +
                           " " + std::to_string(1000.0 * life) +
                           ";\n#X obj 20 110 tabwrite~ take;\n#X obj 200 110 table take 44100;\n#X "
                           "obj 300 20 delay 900;\n"
                           "#X msg 300 50 write -wave -bytes 4 -nframes 40000 out.wav take;\n#X "
                           "obj 300 80 soundfiler;\n";
  run(folder, patch(1, 1.0, rest) +
                  "#X connect 1 0 4 0;\n#X connect 1 0 3 0;\n#X connect 3 0 0 0;\n"
                  "#X connect 0 0 4 0;\n#X connect 1 0 6 0;\n#X connect 6 0 7 0;\n"
                  "#X connect 7 0 8 0;\n#X connect 1 0 9 0;\n#X connect 9 0 10 0;\n");
  return bubble_error(folder / "out.wav");
}

}  // namespace

Peer measure_pd(const std::filesystem::path& folder) {
  return {"Pd", steady_voices(folder), onsets(folder), error(folder)};
}

}  // namespace splash::bench
