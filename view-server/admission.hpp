// SPDX-License-Identifier: MIT
// What is let in: which pages may speak to the server, and what of theirs goes on to the programs.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/message.hpp"

namespace splash::view {

/// Whether a request is from a page of this server's own. `host`: its header; `origin`: the same,
/// empty where there is none, as from what is no browser. A host that is an IPv4 address or
/// localhost is ours: another name that leads here is neither. `ours`: further hosts.
[[nodiscard]] bool is_own(std::string_view host, std::string_view origin,
                          const std::vector<std::string>& ours);

enum class Way { refused, sim, synth, both, here };

struct Admitted {
  Way way = Way::refused;
  protocol::Message message;                   ///< where it is not refused
  std::optional<protocol::TimeTag> made = {};  ///< when, by the page's clock: of a pose
  std::string address;                         ///< of what was refused, as far as it can be told
  std::string reason;                          ///< why it was
};

/// One OSC message of a page; a pose may lie in a bundle, whose time tag says when it was made.
[[nodiscard]] Admitted admit(protocol::Bytes bytes);

}  // namespace splash::view
