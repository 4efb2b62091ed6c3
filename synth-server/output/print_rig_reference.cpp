// SPDX-License-Identifier: MIT
// Prints the generated part of configs/rigs/README.md: rig-reference
#include <cstdio>

#include "synth-server/output/rig_reader.hpp"

int main() {
  std::fputs(splash::synth::describe_rig_keys().c_str(), stdout);
  return 0;
}
