// SPDX-License-Identifier: MIT
// What a scene says so that a message moves a body: the lines that `./splash listen` offers.
#pragma once

#include <string>

#include "protocol/message.hpp"

namespace splash::sim {

/// Lines of a scene, each ended by a line feed, or one that says why none maps the message.
/// Lines of YAML begin with "tracking:" or with a blank, others with "#".
[[nodiscard]] std::string mapping_lines(const protocol::Message& message);

}  // namespace splash::sim
