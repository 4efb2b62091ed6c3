// SPDX-License-Identifier: MIT
// OSC's arrays, which are brackets in a type string and nothing in the arguments. The gate knows
// none; what trackers send in them is read as if the brackets were not there.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "protocol/gate.hpp"
#include "protocol/message.hpp"

namespace splash::protocol {

/// The packet with no bracket in any type string; nullopt where there is none, or no packet. What
/// comes out is to pass the gate like any other.
[[nodiscard]] std::optional<std::vector<std::byte>> without_arrays(Bytes packet);

/// What decode() says of the packet, or of it without its brackets where these are why it is
/// refused.
[[nodiscard]] DecodeResult decode_with_arrays(Bytes packet);

}  // namespace splash::protocol
