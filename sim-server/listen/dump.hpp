// SPDX-License-Identifier: MIT
// Packets as text for people, as /dumpOSC prints them.
#pragma once

#include <string>

#include "protocol/gate.hpp"
#include "protocol/message.hpp"

namespace splash::sim {

/// Levels of /dumpOSC, as scsynth counts them.
enum class DumpLevel { off = 0, text = 1, hexadecimal = 2, both = 3 };

/// "/body/pose ,ifff 0 0.25 0 1"; floats with all their digits.
[[nodiscard]] std::string to_text(const protocol::Message& message);

/// "2f 73 74 61 ..."
[[nodiscard]] std::string to_hexadecimal(protocol::Bytes bytes);

}  // namespace splash::sim
