// SPDX-License-Identifier: MIT
// Which sound is played: chosen at the start, read again, or called for while it plays.
#pragma once

#include <string>

#include "synth-server/sound/sound_reader.hpp"
#include "synth-server/voice_options.hpp"

namespace splash::synth {

/// What --sound names, with what other options change of it. Throws program::Failure.
[[nodiscard]] NamedSound chosen_sound(const SoundOptions& options);

/// The sound called `name` among one's own and the shipped ones: no path, no file elsewhere. Throws
/// program::Failure, or program::ConfigError where it is wrong.
[[nodiscard]] NamedSound sound_called(const std::string& name);

}  // namespace splash::synth
