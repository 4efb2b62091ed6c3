// SPDX-License-Identifier: MIT
#include "tests/bench/synth_peers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "synth-server/figure/wav_reader.hpp"
#include "synth-server/voices/bubble_tone.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/process_use.hpp"

namespace splash::bench {

double run_peer(const std::vector<std::string>& arguments, const std::string& package) {
  const double before = tests::cpu_of_children();
  tests::ChildProcess program(arguments);
  const int status = program.wait_for_end(300.0);
  if (status == 127) {
    throw std::runtime_error(arguments[0] + " is not there: apt-get install " + package);
  }
  if (status != 0) {
    throw std::runtime_error(arguments[0] + " ended with " + std::to_string(status) + ": " +
                             program.output());
  }
  return tests::cpu_of_children() - before;
}

double bubble_error(const std::filesystem::path& wav) {
  const std::vector<float> samples = synth::read_wav(wav).channels.at(0);
  const synth::BubbleTone tone =
      synth::paper_bubble(kErrorRadius, 1.0 / kErrorRadius, {.rise = synth::kIntegratedRise});
  const auto length = static_cast<int>(6.9 / tone.damping * 44100.0);
  double best = std::numeric_limits<double>::infinity();
  for (int shift = -2; shift <= 130; ++shift) {
    double worst = 0.0;
    for (int n = 0; n < length; ++n) {
      const int at = n + shift;
      const bool there = at >= 0 && at < static_cast<int>(samples.size());
      const double found = there ? static_cast<double>(samples[static_cast<std::size_t>(at)]) : 0.0;
      worst = std::max(worst, std::abs(found - pressure(tone, n / 44100.0)));
    }
    best = std::min(best, worst);
  }
  return 20.0 * std::log10(best);
}

}  // namespace splash::bench
