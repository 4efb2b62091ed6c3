// SPDX-License-Identifier: MIT
#include "tests/protocol/other_readers.hpp"

#include <lo/lo.h>
#include <lo/lo_lowlevel.h>
#include <oscpack/osc/OscReceivedElements.h>

#include <cstring>
#include <stdexcept>
#include <utility>

namespace splash::protocol::test {
namespace {

Message from_oscpack(const osc::ReceivedMessage& received) {
  Message message{received.AddressPattern(), {}};
  for (auto it = received.ArgumentsBegin(); it != received.ArgumentsEnd(); ++it) {
    if (it->IsInt32()) {
      message.arguments.emplace_back(static_cast<std::int32_t>(it->AsInt32()));
    } else if (it->IsFloat()) {
      message.arguments.emplace_back(it->AsFloat());
    } else if (it->IsString()) {
      message.arguments.emplace_back(std::string(it->AsString()));
    } else {
      message.arguments.emplace_back(TimeTag{it->AsTimeTag()});
    }
  }
  return message;
}

TimeTag from_liblo(lo_timetag tag) {
  return {static_cast<std::uint64_t>(tag.sec) << 32U | tag.frac};
}

int on_bundle(lo_timetag time, void* packet) {
  static_cast<Packet*>(packet)->time = from_liblo(time);
  return 0;
}

// liblo's arguments point into the packet, which is aligned to four bytes, not to eight.
template <class Value>
Value copied(const lo_arg* argument) {
  Value value{};
  std::memcpy(&value, argument, sizeof value);
  return value;
}

int on_message(const char* path, const char* types, lo_arg** values, int count, lo_message,
               void* packet) {
  Message message{path, {}};
  for (int i = 0; i < count; ++i) {
    switch (types[i]) {
      case 'i':
        message.arguments.emplace_back(copied<std::int32_t>(values[i]));
        break;
      case 'f':
        message.arguments.emplace_back(copied<float>(values[i]));
        break;
      case 's':
        message.arguments.emplace_back(std::string(reinterpret_cast<const char*>(values[i])));
        break;
      default:
        message.arguments.emplace_back(from_liblo(copied<lo_timetag>(values[i])));
    }
  }
  static_cast<Packet*>(packet)->messages.push_back(std::move(message));
  return 0;
}

}  // namespace

std::optional<Packet> read_with_oscpack(Bytes packet) {
  try {
    const osc::ReceivedPacket received(reinterpret_cast<const char*>(packet.data()),
                                       static_cast<osc::osc_bundle_element_size_t>(packet.size()));
    Packet out;
    if (!received.IsBundle()) {
      out.messages.push_back(from_oscpack(osc::ReceivedMessage(received)));
      return out;
    }
    const osc::ReceivedBundle bundle(received);
    out.time = TimeTag{bundle.TimeTag()};
    for (auto it = bundle.ElementsBegin(); it != bundle.ElementsEnd(); ++it) {
      out.messages.push_back(from_oscpack(osc::ReceivedMessage(*it)));
    }
    return out;
  } catch (const osc::Exception&) {
    return std::nullopt;
  }
}

LibloReader::LibloReader() {
  server_ = lo_server_new_with_proto((folder_ / "socket").c_str(), LO_UNIX, nullptr);
  if (server_ == nullptr) throw std::runtime_error("liblo opens no UNIX socket");
  auto* server = static_cast<lo_server>(server_);
  lo_server_enable_queue(server, 0, 0);  // bundles of the future are read at once
  lo_server_add_bundle_handlers(server, on_bundle, nullptr, &packet_);
  lo_server_add_method(server, nullptr, nullptr, on_message, &packet_);
}

LibloReader::~LibloReader() {
  lo_server_free(static_cast<lo_server>(server_));
}

std::optional<Packet> LibloReader::read(Bytes packet) {
  packet_ = {};
  std::vector<std::byte> copy(packet.begin(), packet.end());  // liblo swaps bytes in place
  const int used =
      lo_server_dispatch_data(static_cast<lo_server>(server_), copy.data(), copy.size());
  if (used < 0) return std::nullopt;
  return packet_;
}

}  // namespace splash::protocol::test
