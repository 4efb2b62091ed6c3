// SPDX-License-Identifier: MIT
// Text behind a command's own arguments, which nobody reads: it makes a question as long as its
// answer, and only then is it answered across hosts (reply_budget.hpp).
#pragma once

#include <cstddef>

#include "protocol/message.hpp"

namespace splash::protocol {

/// What a question has that is to be answered whatever is added to its reply one day; the longest
/// reply of today, the synth's /status.reply, has 116 [bytes].
inline constexpr std::size_t kFilledQuestion = 256;

/// `command` with text behind it, so that it has `bytes` on the wire or, where no text is so
/// short, four more. Throws std::length_error where a message cannot be so long.
[[nodiscard]] Message filled_up(Message command, std::size_t bytes);

}  // namespace splash::protocol
