// SPDX-License-Identifier: MIT
// Either program killed at random moments while the other runs, and both started in any order: what
// the tests do a few times and ./splash bench faults many.
#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

namespace splash::tests {

struct Kills {
  int survived = 0;                     ///< rounds in which the other program ran on and answered
  std::vector<double> recovery;         ///< from the start of the next one to its first event [s]
  std::vector<std::string> complaints;  ///< what went wrong, with the programs' words
  double largest_step = 0.0;  ///< between two samples of the synth's recording [full scale]
  double slew_limit = 0.0;    ///< of the rig it drove [full scale per sample]
};

/// Called after each round with its number.
using Progress = std::function<void(int)>;

/// `rounds` simulators, each killed soon after its start, for one synth that records.
[[nodiscard]] Kills kill_simulators(int rounds, std::mt19937& random, const Progress& progress);
/// `rounds` synths, each killed soon after its start, under one simulator.
[[nodiscard]] Kills kill_synths(int rounds, std::mt19937& random, const Progress& progress);
/// Both, by turns the one or the other first, ended cleanly.
[[nodiscard]] Kills start_in_any_order(int rounds, std::mt19937& random, const Progress& progress);

}  // namespace splash::tests
