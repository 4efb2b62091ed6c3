// SPDX-License-Identifier: MIT
// The address table: one row per OSC address, with the unit, range and meaning of each argument. It
// is the only source of the range checks, of the status messages' order and of README.md's
// reference.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/message.hpp"

namespace splash::protocol {

enum class Direction {
  to_synth,     ///< the simulator's events
  to_sim,       ///< trackers' poses
  to_both,      ///< commands of either program
  synth_alone,  ///< commands of the synth alone
  sim_alone,    ///< commands of the simulator alone
  subscribers,  ///< from the simulator to hosts that subscribed with /notify
  reply,        ///< to the sender of a command
};

struct ArgumentRow {
  char type;              ///< i f s t
  std::string_view name;  ///< as in the structs
  std::string_view unit;  ///< "m", "1"; "" for text and time tags
  double min = 0.0;       ///< allowed, inclusive; unused by s and t
  double max = 0.0;
  std::string_view meaning;
  std::string_view fixed = {};  ///< a text argument that tells rows of one address apart
  bool optional = false;        ///< may be missing, only at the end
};

struct AddressRow {
  std::string_view address;
  Direction direction;
  std::string_view meaning;
  std::span<const ArgumentRow> arguments;
};

[[nodiscard]] std::span<const AddressRow> address_table() noexcept;

/// Returns whether the row is a command, whose sender waits for a reply. A command may have further
/// text arguments, which are ignored: they pad the request (reply_budget.hpp).
[[nodiscard]] constexpr bool is_command(const AddressRow& row) noexcept {
  return row.direction == Direction::to_both || row.direction == Direction::synth_alone ||
         row.direction == Direction::sim_alone;
}

/// The row's type string with its comma, optional arguments included.
[[nodiscard]] std::string type_tags(const AddressRow& row);

/// First row of an address (/body/pose and /status.reply have two); nullptr: no such address.
[[nodiscard]] const AddressRow* find_address(std::string_view address) noexcept;

/// Returns whether a value is within the range of its row.
[[nodiscard]] bool in_range(const Argument& argument, const ArgumentRow& row) noexcept;
/// Whether a message has the row's address, types and ranges.
[[nodiscard]] bool conforms(const Message& message, const AddressRow& row) noexcept;

/// Returns why a message breaks the table, in words for /fail and logs ("speed 120 m/s, allowed 0
/// to 100"); nullopt: it conforms.
[[nodiscard]] std::optional<std::string> violation(const Message& message);

/// The reference in Markdown: one table of all addresses, one of each address's arguments.
[[nodiscard]] std::string address_reference();

}  // namespace splash::protocol
