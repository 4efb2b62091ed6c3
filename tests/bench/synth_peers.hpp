// SPDX-License-Identifier: MIT
// The same bubbles on the two engines that people use for such things, as each plays them fastest:
// an oscillator and two ramps.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace splash::bench {

struct Peer {
  std::string name;       ///< with its version
  double voices = 0.0;    ///< in real time on one core at 44.1 kHz
  double onsets = 0.0;    ///< bubbles of 10 to 300 ms per second and core
  double error_db = 0.0;  ///< of a bubble of 5 mm over its life to -60 dB, the chirp integrated
};

/// scsynth without real time: SinOsc.ar with Line.kr and XLine.kr. `folder` for its files. Throws
/// std::runtime_error with what it printed.
[[nodiscard]] Peer measure_scsynth(const std::filesystem::path& folder);

/// pd -batch: osc~, line~, exp~ in clone. The same.
[[nodiscard]] Peer measure_pd(const std::filesystem::path& folder);

/// Runs a program to its end and returns the processor time it took [s]. Throws
/// std::runtime_error with what it printed, or, when it is missing, naming its package.
double run_peer(const std::vector<std::string>& arguments, const std::string& package);

/// Largest difference between a recording and the formula of a bubble (5 mm, A0 = 1, integrated
/// chirp), at the best of some whole shifts [dB].
[[nodiscard]] double bubble_error(const std::filesystem::path& wav);

/// What both play for the error.
inline constexpr double kErrorRadius = 0.005;  // [m]

}  // namespace splash::bench
