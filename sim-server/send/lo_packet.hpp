// SPDX-License-Identifier: MIT
// OSC bytes built by liblo: every packet the simulator sends is born here. liblo's own sockets and
// parser are not used, only its messages, bundles and their serialisation.
#pragma once

#include <cstddef>
#include <vector>

#include "protocol/message.hpp"
#include "protocol/time_tag.hpp"

namespace splash::sim {

/// A bare message, as replies are. Throws std::length_error over kMaxDatagram, std::bad_alloc.
[[nodiscard]] std::vector<std::byte> build_message(const protocol::Message& message);

/// A bundle with its time tag. Throws std::length_error over kMaxDatagram or kMaxMessages.
[[nodiscard]] std::vector<std::byte> build_bundle(protocol::TimeTag time,
                                                  const std::vector<protocol::Message>& messages);

}  // namespace splash::sim
