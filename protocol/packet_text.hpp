// SPDX-License-Identifier: MIT
// Packets as text for people: what /dumpOSC prints.
#pragma once

#include <optional>
#include <string>

#include "protocol/message.hpp"

namespace splash::protocol {

/// "/bubble ,iifff 1 0 0.004 ...": floats with all their digits. The time tag of its bundle stands
/// in front, as seconds and fraction in hexadecimal digits.
[[nodiscard]] std::string to_text(const Message& message, const std::optional<TimeTag>& time = {});
/// "2f 62 75 ...", one line.
[[nodiscard]] std::string to_hexadecimal(Bytes bytes);

}  // namespace splash::protocol
