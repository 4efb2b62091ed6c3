// SPDX-License-Identifier: MIT
#include "synth-server/receive/oscpack_reader.hpp"

#include <oscpack/osc/OscReceivedElements.h>

#include <stdexcept>
#include <string>

namespace splash::synth {
namespace {

protocol::Argument read_argument(const ::osc::ReceivedMessageArgument& argument) {
  switch (argument.TypeTag()) {
    case ::osc::INT32_TYPE_TAG:
      return static_cast<std::int32_t>(argument.AsInt32Unchecked());
    case ::osc::FLOAT_TYPE_TAG:
      return argument.AsFloatUnchecked();
    case ::osc::STRING_TYPE_TAG:
      return std::string(argument.AsStringUnchecked());
    case ::osc::TIME_TAG_TYPE_TAG:
      return protocol::TimeTag{argument.AsTimeTagUnchecked()};
    default:  // the gate lets no other type pass
      throw std::logic_error(std::string("the gate let an argument of type '") +
                             argument.TypeTag() + "' pass");
  }
}

protocol::Message read_message(const ::osc::ReceivedMessage& received) {
  protocol::Message message{received.AddressPattern(), {}};
  message.arguments.reserve(received.ArgumentCount());
  for (auto it = received.ArgumentsBegin(); it != received.ArgumentsEnd(); ++it) {
    message.arguments.push_back(read_argument(*it));
  }
  return message;
}

protocol::Packet parse(const ::osc::ReceivedPacket& received) {
  protocol::Packet packet;
  if (received.IsMessage()) {
    packet.messages.push_back(read_message(::osc::ReceivedMessage(received)));
    return packet;
  }
  const ::osc::ReceivedBundle bundle(received);
  packet.time = protocol::TimeTag{bundle.TimeTag()};
  for (auto it = bundle.ElementsBegin(); it != bundle.ElementsEnd(); ++it) {
    packet.messages.push_back(read_message(::osc::ReceivedMessage(*it)));
  }
  return packet;
}

}  // namespace

protocol::DecodeResult read_packet(protocol::Bytes bytes) {
  const protocol::Refusal refusal = protocol::gate(bytes);
  if (refusal != protocol::Refusal::none) return {refusal, {}};
  try {
    const auto size = static_cast<::osc::osc_bundle_element_size_t>(bytes.size());
    return {refusal,
            parse(::osc::ReceivedPacket(reinterpret_cast<const char*>(bytes.data()), size))};
  } catch (const ::osc::Exception&) {
    // Tested never to happen: what the gate accepts, oscpack reads. It must not end the receiver.
    return {protocol::Refusal::truncated, {}};
  }
}

}  // namespace splash::synth
