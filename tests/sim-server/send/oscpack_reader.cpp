// SPDX-License-Identifier: MIT
#include "tests/sim-server/send/oscpack_reader.hpp"

#include <oscpack/osc/OscReceivedElements.h>

#include <stdexcept>
#include <string>

namespace splash::test {
namespace {

protocol::Message to_message(const osc::ReceivedMessage& received) {
  protocol::Message message{received.AddressPattern(), {}};
  for (auto it = received.ArgumentsBegin(); it != received.ArgumentsEnd(); ++it) {
    const auto& argument = *it;
    switch (argument.TypeTag()) {
      case 'i':
        message.arguments.emplace_back(static_cast<std::int32_t>(argument.AsInt32()));
        break;
      case 'f':
        message.arguments.emplace_back(argument.AsFloat());
        break;
      case 's':
        message.arguments.emplace_back(std::string(argument.AsString()));
        break;
      case 't':
        message.arguments.emplace_back(
            protocol::TimeTag{static_cast<std::uint64_t>(argument.AsTimeTag())});
        break;
      default:
        throw std::logic_error(std::string("a type no packet of ours has: ") +
                               static_cast<char>(argument.TypeTag()));
    }
  }
  return message;
}

}  // namespace

protocol::Packet read_with_oscpack(protocol::Bytes bytes) {
  const osc::ReceivedPacket received(reinterpret_cast<const char*>(bytes.data()),
                                     static_cast<osc::osc_bundle_element_size_t>(bytes.size()));
  protocol::Packet packet;
  if (received.IsMessage()) {
    packet.messages.push_back(to_message(osc::ReceivedMessage(received)));
    return packet;
  }
  const osc::ReceivedBundle bundle(received);
  packet.time = protocol::TimeTag{static_cast<std::uint64_t>(bundle.TimeTag())};
  for (auto it = bundle.ElementsBegin(); it != bundle.ElementsEnd(); ++it) {
    packet.messages.push_back(to_message(osc::ReceivedMessage(*it)));
  }
  return packet;
}

}  // namespace splash::test
