// SPDX-License-Identifier: MIT
// OSCQuery (proposal 1.0): what can be said to both programs, as a tree in JSON. /sim and /synth
// stand before the programs' own addresses, and each row of the sound and of the rig is an address,
// /synth/impact/q for what /set calls impact/q; so is each live row of the scene,
// /sim/detect/bubble_speed for what /param calls detect/bubble_speed.
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
  /// A number that /set or /param takes; from the rig's or the scene's frame.
  struct Row {
    std::string name;
    double min = 0.0;
    double max = 1.0;
    std::string unit;
    std::string meaning;
  };
  std::vector<Row> rows = {};
  std::vector<Row> scene_rows = {};
  std::vector<std::string> bodies = {};         ///< names, in the scene's order
  std::map<std::string, double> values = {};    ///< of both
  std::optional<protocol::Message> sim = {};    ///< /status.reply
  std::optional<protocol::Message> synth = {};  ///< same
};

/// Whether a row is the scene's, by its name; else it is the synth's.
[[nodiscard]] bool is_of_scene(std::string_view row);

/// The rows, and their values, of a frame of kind SPR1 from byte 16 on; none where it is no JSON.
void note_rig(std::string_view text, Known& known);
/// The same of a frame of kind SPC1, and its bodies.
void note_scene(std::string_view text, Known& known);

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
