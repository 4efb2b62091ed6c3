// SPDX-License-Identifier: MIT
#include "synth-server/sound_choice.hpp"

#include "program/config_file.hpp"
#include "program/failure.hpp"

namespace splash::synth {

NamedSound chosen_sound(const SoundOptions& options) {
  NamedSound chosen;
  if (!options.file.empty()) {
    chosen = read_sound(program::find_config("--sound", "sounds", options.file));
  }
  apply(options, chosen.sound);
  return chosen;
}

NamedSound sound_called(const std::string& name) {
  const auto path = program::named_config("sounds", name);
  if (!path) throw program::Failure(program::kExitNoInput, "no sound is called so");
  return read_sound(*path);
}

}  // namespace splash::synth
