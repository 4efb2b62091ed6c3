// SPDX-License-Identifier: MIT
// The address table as Markdown.
#include "program/text.hpp"
#include "protocol/address.hpp"

namespace splash::protocol {
namespace {

std::string_view name_of(Direction direction) {
  switch (direction) {
    case Direction::to_synth:
    case Direction::synth_alone:
      return "to the synth";
    case Direction::to_sim:
    case Direction::sim_alone:
      return "to the simulator";
    case Direction::to_both:
      return "to either program";
    case Direction::subscribers:
      return "from the simulator to subscribers";
    case Direction::reply:
      return "reply";
  }
  return "";
}

std::string number(double value) {
  return program::format("%.10g", value);
}

std::string range_of(const ArgumentRow& row) {
  if (row.type == 't') return "time tag";
  if (row.type == 's') return row.fixed.empty() ? "text" : "`" + std::string(row.fixed) + "`";
  return number(row.min) + " .. " + number(row.max);
}

std::string types_of(const AddressRow& row) {
  return type_tags(row) + (is_command(row) ? "s*" : "");
}

std::string heading(const AddressRow& row) {
  return "`" + std::string(row.address) + " " + types_of(row) + "`";
}

std::string overview() {
  std::string out =
      "`s*`: behind a command's own arguments any texts are allowed and ignored, 24 arguments in\n"
      "all. They fill a question up to the length of its answer (see \"Who is answered\").\n\n"
      "| address | types | direction | meaning |\n|---|---|---|---|\n";
  for (const auto& row : address_table()) {
    out += "| `" + std::string(row.address) + "` | `" + types_of(row) + "` | " +
           std::string(name_of(row.direction)) + " | " + std::string(row.meaning) + " |\n";
  }
  return out;
}

std::string arguments_of(const AddressRow& row) {
  std::string out = "\n### " + heading(row) + "\n\n" + std::string(row.meaning) + " (" +
                    std::string(name_of(row.direction)) + ").\n\n" +
                    "| argument | type | unit | range | meaning |\n|---|---|---|---|---|\n";
  for (const auto& argument : row.arguments) {
    out += "| " + std::string(argument.name) + " | " + argument.type + " | " +
           std::string(argument.unit) + " | " + range_of(argument) + " | " +
           std::string(argument.meaning) + (argument.optional ? " (may be missing)" : "") + " |\n";
  }
  if (is_command(row)) out += "| filling | s* |  | text | ignored |\n";
  return out;
}

}  // namespace

std::string address_reference() {
  std::string out = overview();
  for (const auto& row : address_table()) {
    if (!row.arguments.empty()) out += arguments_of(row);
  }
  return out;
}

}  // namespace splash::protocol
