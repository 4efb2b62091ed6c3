// SPDX-License-Identifier: MIT
// OSCQuery (proposal 1.0): what can be said to both programs, as a tree in JSON. /sim and /synth
// stand before the programs' own addresses, and each row of the sound and of the rig is an address,
// /synth/impact/q for what /set calls impact/q.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/message.hpp"

namespace splash::view {

/// What the programs said of late.
struct Known {
  /// A number that /set takes; from the rig's frame.
  struct Row {
    std::string name;
    double min = 0.0;
    double max = 1.0;
    std::string unit;
    std::string meaning;
  };
  std::vector<Row> rows = {};
  std::map<std::string, double> values = {};    ///< of rows
  std::optional<protocol::Message> sim = {};    ///< /status.reply
  std::optional<protocol::Message> synth = {};  ///< same
};

/// The rows, and their values, of a frame of kind SPR1 from byte 16 on; none where it is no JSON.
void note_rig(std::string_view text, Known& known);

struct Answer {
  int status = 200;  ///< HTTP
  std::string json;
};

/// `path`: as asked for, such as /synth/impact; `attribute`: behind the question mark, or empty.
/// `port`: where OSC is taken over UDP; 0: nowhere.
[[nodiscard]] Answer query(const Known& known, std::string_view path, std::string_view attribute,
                           int port);

/// The program's own message for one whose address is in the tree; nullopt: it is not.
[[nodiscard]] std::optional<protocol::Message> meant(const protocol::Message& message);

/// The address in the tree of what a program said of itself; empty: it has none.
[[nodiscard]] std::string told_as(const protocol::Message& message);

}  // namespace splash::view
