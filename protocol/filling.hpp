// SPDX-License-Identifier: MIT
// Padding of requests against amplification: text behind a command's own arguments, which is
// ignored, makes the request as long as its reply. Only then is another host answered
// (reply_budget.hpp).
#pragma once

#include <cstddef>

#include "protocol/message.hpp"

namespace splash::protocol {

/// The size of a request that still is answered when fields are added to its reply; the longest
/// reply at present, the synth's /status.reply, has 116 [bytes].
inline constexpr std::size_t kFilledQuestion = 256;

/// Returns `command` with text behind it, so that it has `bytes` on the wire or, where no text is
/// so short, four more. Throws std::length_error when a message cannot be so long.
[[nodiscard]] Message filled_up(Message command, std::size_t bytes);

}  // namespace splash::protocol
