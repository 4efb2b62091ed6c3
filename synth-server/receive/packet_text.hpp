// SPDX-License-Identifier: MIT
// Packets for people to read: what /dumpOSC prints.
#pragma once

#include <string>

#include "protocol/message.hpp"

namespace splash::synth {

/// "/bubble 1 0 0.004 0.1 ..." per message, lines divided by "\n"; floats with all their digits.
[[nodiscard]] std::string to_text(const protocol::Packet& packet);
/// "2f 62 75 ...", one line.
[[nodiscard]] std::string to_hexadecimal(protocol::Bytes bytes);

}  // namespace splash::synth
