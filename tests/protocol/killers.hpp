// SPDX-License-Identifier: MIT
// Datagrams that crashed, hung, stalled or confused an OSC program once, or look as if they might;
// and what the gate says of each.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "protocol/gate.hpp"

namespace splash::protocol::test {

struct Killer {
  std::string name;
  std::vector<std::byte> bytes;
  Refusal why;  ///< none: legal, and must do no harm
};

[[nodiscard]] const std::vector<Killer>& killers();

}  // namespace splash::protocol::test
