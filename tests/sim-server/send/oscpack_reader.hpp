// SPDX-License-Identifier: MIT
// A packet as oscpack, the synth's library, understands it.
#pragma once

#include "protocol/message.hpp"

namespace splash::test {

/// Throws osc::Exception where oscpack does.
[[nodiscard]] protocol::Packet read_with_oscpack(protocol::Bytes bytes);

}  // namespace splash::test
