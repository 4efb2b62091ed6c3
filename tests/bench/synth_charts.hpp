// SPDX-License-Identifier: MIT
// What was measured, as tables (CSV) and pictures (PNG).
#pragma once

#include <filesystem>
#include <vector>

#include "tests/bench/synth_algorithms.hpp"
#include "tests/bench/synth_engine.hpp"
#include "tests/bench/synth_peers.hpp"

namespace splash::bench {

struct SynthFigures {
  std::vector<Algorithm> algorithms;
  std::vector<Limit> limits;
  std::vector<EngineCase> by_voices;
  std::vector<EngineCase> by_channels;
  std::vector<EngineCase> by_block;
  std::vector<EngineCase> capacity;
  std::vector<OnsetCase> onsets;
  std::vector<Peer> peers;
};

/// algorithms.csv, engine.csv, onsets.csv and peers.csv in `folder`.
void write_tables(const SynthFigures& figures, const std::filesystem::path& folder);

/// algorithms.png (voices against error), engine.png (cost against voices, channels, block) in
/// `folder`, drawn from the tables. Throws synth::GnuplotError.
void draw_charts(const SynthFigures& figures, const std::filesystem::path& folder);

}  // namespace splash::bench
