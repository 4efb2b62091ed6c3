// SPDX-License-Identifier: MIT
// OSC messages as plain values, their encoding and decoding, and events as messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/event.hpp"
#include "protocol/gate.hpp"
#include "protocol/time_tag.hpp"

namespace splash::protocol {

using Argument = std::variant<std::int32_t, float, std::string, TimeTag>;

struct Message {
  std::string address;
  std::vector<Argument> arguments;
  bool operator==(const Message&) const = default;
};

/// A datagram: a bundle with a time, or a bare message (no time).
struct Packet {
  std::optional<TimeTag> time;
  std::vector<Message> messages;
  bool operator==(const Packet&) const = default;
};

/// OSC bytes of a message or a bundle. Throws std::length_error when it breaks the wire's limits.
[[nodiscard]] std::vector<std::byte> encode(const Message& message);
[[nodiscard]] std::vector<std::byte> encode(TimeTag time, const std::vector<Message>& messages);

/// The message's type string, e.g. ",iff", and the bytes it takes on the wire (in a bundle four
/// more, its size). A bundle has 16 bytes besides its messages.
[[nodiscard]] std::string type_tags(const Message& message);
[[nodiscard]] std::size_t encoded_size(const Message& message) noexcept;

/// Decodes a packet that the gate accepts; an accepted packet always decodes.
struct DecodeResult {
  Refusal refusal = Refusal::none;
  Packet packet;  ///< empty when refused
};
[[nodiscard]] DecodeResult decode(Bytes bytes);

/// Events and frames as messages, and back. `nullopt`: another address, wrong types, or a value
/// outside the ranges of the address table.
[[nodiscard]] Message to_message(const Event& event);
[[nodiscard]] Message to_message(const Frame& frame);
[[nodiscard]] Message to_message(const BodyPose& pose);
[[nodiscard]] Message to_message(const Push& push);
[[nodiscard]] std::optional<Event> to_event(const Message& message);
/// Whether events have this address.
[[nodiscard]] bool is_event(std::string_view address);
[[nodiscard]] std::optional<Frame> to_frame(const Message& message);
[[nodiscard]] std::optional<Push> to_push(const Message& message);
[[nodiscard]] std::optional<BodyPose> to_body_pose(const Message& message);
/// The pose of a message that conforms to its row. `nullopt`: its quaternion is no rotation.
[[nodiscard]] std::optional<BodyPose> conforming_pose(const Message& message);

/// Sets the moment of an event's message after its bundle's time [ms].
void set_offset(Message& event, float offset_ms);

}  // namespace splash::protocol
