// SPDX-License-Identifier: MIT
#include "synth-server/sound_choice.hpp"

#include "protocol/config_file.hpp"
#include "protocol/failure.hpp"

namespace splash::synth {

NamedSound chosen_sound(const SoundOptions& options) {
  NamedSound chosen;
  if (!options.file.empty()) {
    const auto path = protocol::find_config("--sound", "sounds", options.file);
    chosen = protocol::failing_with(protocol::kExitConfig, [&] { return read_sound(path); });
  }
  apply(options, chosen.sound);
  return chosen;
}

NamedSound sound_called(const std::string& name) {
  const auto path = protocol::named_config("sounds", name);
  if (!path) throw protocol::Failure(protocol::kExitNoInput, "no sound is called so");
  return read_sound(*path);
}

}  // namespace splash::synth
