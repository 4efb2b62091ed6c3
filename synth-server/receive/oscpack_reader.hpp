// SPDX-License-Identifier: MIT
// Datagrams to plain messages, read with oscpack behind our own gate.
#pragma once

#include "protocol/gate.hpp"
#include "protocol/message.hpp"

namespace splash::synth {

/// Refuses what the gate refuses, before oscpack sees a byte of it: Debian's oscpack 1.1.0 reads
/// past a packet with a blob and never returns from a bundle element of size -4.
[[nodiscard]] protocol::DecodeResult read_packet(protocol::Bytes bytes);

}  // namespace splash::synth
