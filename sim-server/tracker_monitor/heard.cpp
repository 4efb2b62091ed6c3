// SPDX-License-Identifier: MIT
#include "sim-server/tracker_monitor/heard.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <variant>

#include "program/text.hpp"
#include "protocol/arrays.hpp"
#include "protocol/limits.hpp"
#include "sim-server/tracker_monitor/mapping_lines.hpp"

namespace splash::sim {
namespace {

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
