// SPDX-License-Identifier: MIT
// The part of the command line that concerns the sound: which one, how many voices, what
// is left out.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "synth-server/render/engine.hpp"
#include "synth-server/sound/sound_rows.hpp"

// Its header takes seconds to compile, and only the command line needs it.
namespace CLI {  // NOLINT(readability-identifier-naming): CLI11's name
class App;
}  // namespace CLI

namespace splash::synth {

/// Options that change one row of the sound, whatever its file says.
struct SoundOptions {
  std::filesystem::path file;  ///< a sound's name or file; empty: the paper's
  std::string bubbles;         ///< physical, paper; empty: as the sound has it
  std::string chirp;           ///< rise: integrated, literal; empty: as the sound has it
  std::optional<double> impact_exponent;
};

/// The options whose text becomes something else.
struct VoiceTexts {
  std::vector<std::string> no_skip;
};

/// What they fill must outlive the parsing.
void add_voices(CLI::App& app, VoiceTexts& texts, EngineSettings& engine);
void add_sound(CLI::App& app, SoundOptions& options);

/// After the parsing.
void apply(const VoiceTexts& texts, EngineSettings& engine);
void apply(const SoundOptions& options, Sound& sound);

/// What --sound names, with what other options change of it. Throws program::Failure.
[[nodiscard]] NamedSound chosen_sound(const SoundOptions& options);

/// The sound called `name` among one's own and the shipped ones: no path, no file elsewhere. Throws
/// program::Failure, or program::ConfigError where it is wrong.
[[nodiscard]] NamedSound sound_called(const std::string& name);

}  // namespace splash::synth
