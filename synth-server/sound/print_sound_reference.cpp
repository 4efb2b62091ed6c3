// SPDX-License-Identifier: MIT
// Prints the generated part of configs/sounds/README.md: sound-reference
#include <cstdio>

#include "synth-server/sound/sound_reader.hpp"

int main() {
  std::fputs(splash::synth::describe_sound_keys().c_str(), stdout);
  return 0;
}
