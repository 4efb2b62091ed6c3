// SPDX-License-Identifier: MIT
#include "sim-server/tracker_monitor/heard.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "program/text.hpp"
#include "protocol/address.hpp"
#include "protocol/arrays.hpp"
#include "protocol/limits.hpp"
#include "sim-server/scene/scene_table.hpp"

namespace splash::sim {
namespace {

constexpr double kUnitTolerance = 0.1;  ///< of a quaternion's length, as of /body/pose [1]
constexpr double kNotMetres = 20.0;     ///< coordinates beyond are no metres of any room

const std::string kHole = "{name}";

constexpr const char* kWhatAxesAre =
    "# see that `axes` are the sender's: [x, y, z] has z up, [x, -z, y] has y up, [x, z, y] has\n"
    "# y up and is mirrored. Lift the tracker: the number that changes is the scene's z. Move it\n"
    "# along the scene's x, then its y: these change. What falls where it should grow wants a -.\n"
    "# `position` and `yaw` of `tracking` say where the sender's room lies in the scene\n";

/// What stands for {name} in `text`: of a text without the hole "", if it is the same.
std::optional<std::string> name_in(const std::string& pattern, const std::string& text) {
  const std::size_t at = pattern.find(kHole);
  if (at == std::string::npos) return pattern == text ? std::optional("") : std::nullopt;
  const std::string before = pattern.substr(0, at);
  const std::string after = pattern.substr(at + kHole.size());
  if (text.size() <= before.size() + after.size()) return std::nullopt;
  if (!text.starts_with(before) || !text.ends_with(after)) return std::nullopt;
  return text.substr(at, text.size() - before.size() - after.size());
}

std::string text_of(const protocol::Argument& argument) {
  if (const auto* text = std::get_if<std::string>(&argument)) return *text;
  if (const auto* number = std::get_if<std::int32_t>(&argument)) return std::to_string(*number);
  return {};
}

/// The name that makes the message one of the preset's; "" where it needs none.
std::optional<std::string> name_by(const protocol::Message& message, const std::string& address,
                                   const std::vector<std::string>& match) {
  std::optional<std::string> name = name_in(address, message.address);
  if (!name || message.arguments.size() < match.size()) return std::nullopt;
  for (std::size_t i = 0; i < match.size(); ++i) {
    const auto part = name_in(match[i], text_of(message.arguments[i]));
    if (!part) return std::nullopt;
    if (!part->empty()) name = part;
  }
  return name;
}

/// In single quotes, as YAML wants it.
std::string quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

std::string source_lines(const std::string& source) {
  return "tracking:\n  sources:\n    - {body: BODY, " + source + "}\n";
}

/// Whether what is set, a cursor, an object or a blob, is within the surface's edges.
bool is_on_surface(const protocol::Message& message) {
  const std::size_t x = message.address == "/tuio/2Dobj" ? 3 : 2;
  for (std::size_t i = x; i < std::min(x + 2, message.arguments.size()); ++i) {
    const auto* const part = std::get_if<float>(&message.arguments[i]);
    if (part != nullptr && !(*part >= 0.0F && *part <= 1.0F)) return false;
  }
  return true;
}

/// Of a whole bundle the lines are offered once.
std::optional<std::string> of_surface(const protocol::Message& message) {
  if (!message.address.starts_with("/tuio/")) return std::nullopt;
  if (!message.address.starts_with("/tuio/2D")) {
    return "# of TUIO only /tuio/2Dcur, /tuio/2Dobj and /tuio/2Dblb are read: send one of these\n";
  }
  const std::string part =
      message.arguments.empty() ? std::string() : text_of(message.arguments.front());
  if (part == "set" && !is_on_surface(message)) {
    return "# x or y is beyond 0 to 1, the surface's edges: TUIO counts in parts of the surface.\n"
           "# Pixels or millimetres put feet beside it: change that in the sender\n";
  }
  if (part != "alive") return "# part of a frame, see alive\n";
  const bool plain = message.address == tracker_presets().at("tuio").address;
  return source_lines("preset: tuio, floor: [1.83, 1.83]" +
                      (plain ? "" : ", address: " + message.address)) +
         "# floor: the surface's size in metres; a body for each foot, with motion: {kind: "
         "touch}\n";
}

std::optional<std::string> by_preset(const protocol::Message& message) {
  for (const auto& [preset, entry] : tracker_presets()) {
    for (const bool turns : {false, true}) {
      if (turns && entry.rotation_address.empty() && entry.rotation_match.empty()) continue;
      const std::string& address =
          turns && !entry.rotation_address.empty() ? entry.rotation_address : entry.address;
      const auto name = name_by(message, address, turns ? entry.rotation_match : entry.match);
      if (!name) continue;
      return source_lines("preset: " + preset + (name->empty() ? "" : ", name: " + quoted(*name)));
    }
  }
  return std::nullopt;
}

std::string list_of(std::size_t first, std::size_t count) {
  std::string list = "[";
  for (std::size_t i = 0; i < count; ++i) {
    list += (i > 0 ? ", " : "") + std::to_string(first + i);
  }
  return list + "]";
}

/// How much comes before the numbers: texts and whole numbers that tell trackers apart.
std::size_t count_labels(const protocol::Message& message) {
  std::size_t count = 0;
  for (const auto& argument : message.arguments) {
    if (std::holds_alternative<float>(argument)) return count;
    ++count;
  }
  return 0;
}

std::string spelled_out(const protocol::Message& message) {
  const std::size_t first = count_labels(message);
  std::vector<double> numbers;
  for (std::size_t i = first; i < message.arguments.size(); ++i) {
    const auto* number = std::get_if<float>(&message.arguments[i]);
    if (number == nullptr) break;
    numbers.push_back(static_cast<double>(*number));
  }
  if (numbers.size() < 3) {
    return "# no position: three numbers at least of type f are wanted, behind what names the\n"
           "# tracker. A sender that writes 1 where it means 1.0 sends type i: let it write 1.0\n";
  }
  std::string source = "address: " + message.address;
  std::string match;
  for (std::size_t i = 0; i < first; ++i) {
    match += (i > 0 ? ", " : "") + quoted(text_of(message.arguments[i]));
  }
  if (first > 0) source += ", match: [" + match + "]";
  source += ", position: " + list_of(first, 3);
  std::string doubt;
  if (numbers.size() >= 7) {
    const double length =
        std::hypot(std::hypot(numbers[3], numbers[4]), std::hypot(numbers[5], numbers[6]));
    if (std::abs(length - 1.0) <= kUnitTolerance) {
      source += ", rotation: " + list_of(first + 3, 4);
      std::string w_first = list_of(first + 4, 3);
      w_first.insert(w_first.size() - 1, ", " + std::to_string(first + 3));
      doubt += "# `rotation` is x, y, z, w; of a sender that begins with w it is " + w_first + "\n";
    }
  } else if (numbers.size() == 6) {
    source += ", rotation: " + list_of(first + 3, 3);
    doubt += "# three angles: see that `euler` and `angles` are the sender's\n";
  }
  if (std::max({std::abs(numbers[0]), std::abs(numbers[1]), std::abs(numbers[2])}) > kNotMetres) {
    source += ", unit: 0.001";
    doubt += "# taken for millimetres: see that `unit` is the sender's\n";
  }
  return source_lines(source) + doubt + kWhatAxesAre;
}

constexpr std::size_t kMost = 200;  ///< trackers that are told apart, and hosts
constexpr std::size_t kShown = 64;  ///< characters of what was refused
constexpr double kLeastSpan = 0.5;  ///< over which a rate is told: a single message has none [s]

std::string host_of(std::uint32_t address) {
  const std::string text = protocol::to_string({.address = address, .port = 0});
  return text.substr(0, text.rfind(':'));
}

/// Its types and the texts before its numbers: a sender that writes 1 where it means 1.0 sends
/// messages of two kinds, of which one may be no pose.
std::string labels_of(const protocol::Message& message) {
  std::string labels = protocol::type_tags(message) + ' ';
  for (const auto& argument : message.arguments) {
    const auto* text = std::get_if<std::string>(&argument);
    if (text == nullptr) break;
    labels += *text + ' ';
  }
  return labels;
}

std::string values_of(const protocol::Message& message) {
  std::string values = protocol::type_tags(message);
  for (const auto& argument : message.arguments) {
    values += ' ';
    if (const auto* text = std::get_if<std::string>(&argument)) values += '"' + *text + '"';
    if (const auto* whole = std::get_if<std::int32_t>(&argument)) values += std::to_string(*whole);
    if (const auto* real = std::get_if<float>(&argument)) {
      values += program::format("%.3f", static_cast<double>(*real));
    }
  }
  return values;
}

/// Every line moved in.
std::string indented(const std::string& lines) {
  std::string moved;
  std::size_t begin = 0;
  while (begin < lines.size()) {
    const std::size_t end = lines.find('\n', begin) + 1;
    moved += "        " + lines.substr(begin, end - begin);
    begin = end;
  }
  return moved;
}

std::string beginning_of(protocol::Bytes packet) {
  std::string text;
  for (const std::byte byte : packet.first(std::min(packet.size(), kShown))) {
    if (byte == std::byte{0}) break;
    text += static_cast<char>(byte);
  }
  return program::printable(text, kShown);
}

}  // namespace

std::string mapping_lines(const protocol::Message& message) {
  if (message.address == "/body/pose") {
    return "# needs no line of `tracking`: a body with motion: {kind: osc} follows it\n";
  }
  if (message.address == "/tile/pressure") {
    return "tracking:\n  floor: {columns: 6, rows: 6, tile: 0.305, sensors: 1}\n"
           "# with the numbers of this floor, and a body for each foot, with motion: {kind: "
           "pressure}\n";
  }
  if (protocol::find_address(message.address) != nullptr) {
    return "# a message of splash's own (protocol/README.md), no pose\n";
  }
  if (const auto surface = of_surface(message)) return *surface;
  const auto known = by_preset(message);
  return known ? *known : spelled_out(message);
}

std::string how_to_take(std::uint32_t host, std::uint16_t port) {
  const bool own = protocol::is_loopback({.address = host, .port = 0});
  if (own && port == protocol::kSimPort) return {};
  const std::string where = (own ? "127.0.0.1:" : "0.0.0.0:") + std::to_string(port);
  return "sim-server listens at one port only: for this one, start it with --listen " + where +
         (own ? "" : " --allow " + host_of(host));
}

void Heard::take(protocol::Bytes packet, const protocol::Endpoint& from, std::uint16_t port,
                 double now) {
  if (since_ < 0.0) since_ = now;
  ++packets_;
  const auto decoded = protocol::decode_with_arrays(packet);
  if (decoded.refusal != protocol::Refusal::none) {
    if (refused_.size() >= kMost && !refused_.contains(from.address)) return;
    Refused& refused = refused_[from.address];
    ++refused.count;
    refused.why = decoded.refusal;
    refused.begins = beginning_of(packet);
    return;
  }
  for (const auto& message : decoded.packet.messages) note(message, from, port);
}

void Heard::note(const protocol::Message& message, const protocol::Endpoint& from,
                 std::uint16_t port) {
  const Key key = {message.address, labels_of(message), from.address, port};
  const auto known = rows_.find(key);
  if (known == rows_.end() && rows_.size() >= kMost) {
    ++left_out_;
    return;
  }
  Row& row = rows_[key];
  row.last = message;
  row.from_port = from.port;
  ++row.count;
}

std::string Heard::report(double now) {
  std::string text;
  const double span = std::max(now - since_, kLeastSpan);
  for (auto& [key, row] : rows_) {
    if (row.count == 0) continue;
    text += key.address + "  from " +
            protocol::to_string({.address = key.host, .port = row.from_port}) + " at port " +
            std::to_string(key.port) + "  " +
            program::format("%.1f/s", static_cast<double>(std::exchange(row.count, 0)) / span) +
            "\n    " + values_of(row.last) + '\n';
    if (!std::exchange(row.told, true)) text += indented(mapping_lines(row.last));
    bool& told = ways_[{key.host, key.port}];
    const std::string way = how_to_take(key.host, key.port);
    if (!std::exchange(told, true) && !way.empty()) text += indented("# " + way + '\n');
  }
  for (auto& [host, refused] : refused_) {
    if (refused.count == 0) continue;
    text += "refused from " + host_of(host) + ": " + std::to_string(refused.count) +
            " datagrams, the last of them: " + std::string(protocol::describe(refused.why)) +
            " (it begins with \"" + refused.begins + "\")\n";
    refused.count = 0;
  }
  if (left_out_ > 0) {
    text += std::to_string(std::exchange(left_out_, 0)) + " messages of more than " +
            std::to_string(kMost) + " trackers are left out\n";
  }
  since_ = now;
  return text;
}

}  // namespace splash::sim
