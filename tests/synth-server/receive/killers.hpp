// SPDX-License-Identifier: MIT
// Datagrams that crashed, hung or confused an OSC program once.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace splash::synth {

struct Killer {
  std::string name;
  std::vector<std::byte> bytes;
};

[[nodiscard]] std::vector<Killer> killers();

}  // namespace splash::synth
