// SPDX-License-Identifier: MIT
// The part of the command line that concerns the sound: which model, how exactly, how many voices,
// what is left out.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "synth-server/render/engine.hpp"

namespace splash::synth {

/// The options whose text becomes something else.
struct VoiceTexts {
  std::string bubbles = "paper";
  std::string chirp = "literal";
  std::string precision = "exact";
  std::vector<std::string> no_skip;
};

/// Both must outlive the parsing.
void add_voices(CLI::App& app, VoiceTexts& texts, EngineSettings& engine);

/// After the parsing.
void apply(const VoiceTexts& texts, EngineSettings& engine);

}  // namespace splash::synth
