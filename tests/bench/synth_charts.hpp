// SPDX-License-Identifier: MIT
// What was measured, as tables (CSV) and pictures (PNG).
#pragma once

#include <filesystem>
#include <vector>

#include "tests/bench/synth_engine.hpp"
#include "tests/bench/synth_peers.hpp"

namespace splash::bench {

struct SynthFigures {
  std::vector<EngineCase> by_voices;
  std::vector<EngineCase> by_channels;
  std::vector<EngineCase> by_block;
  std::vector<EngineCase> capacity;
  std::vector<OnsetCase> onsets;
  std::vector<Peer> peers;
};

/// engine.csv, onsets.csv and peers.csv in `folder`.
void write_tables(const SynthFigures& figures, const std::filesystem::path& folder);

/// engine.png in `folder`: cost against voices, channels and block. Throws synth::GnuplotError.
void draw_chart(const SynthFigures& figures, const std::filesystem::path& folder);

}  // namespace splash::bench
