// SPDX-License-Identifier: MIT
// Owns liblo's objects for as long as one packet takes. A bundle frees the messages it was given:
// of liblo's ways to free a bundle, only the recursive one counts references alike in all of
// 0.31 ... 0.35.
#include "sim-server/send/lo_packet.hpp"

#include <lo/lo.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "protocol/limits.hpp"

namespace splash::sim {
namespace {

struct FreeMessage {
  void operator()(lo_message message) const noexcept { lo_message_free(message); }
};
struct FreeBundle {
  void operator()(lo_bundle bundle) const noexcept { lo_bundle_free_recursive(bundle); }
};
struct FreeBytes {
  void operator()(void* bytes) const noexcept { std::free(bytes); }
};
using LoMessage = std::unique_ptr<std::remove_pointer_t<lo_message>, FreeMessage>;
using LoBundle = std::unique_ptr<std::remove_pointer_t<lo_bundle>, FreeBundle>;
using LoBytes = std::unique_ptr<void, FreeBytes>;

lo_timetag to_lo(protocol::TimeTag time) {
  return {static_cast<std::uint32_t>(time.value >> 32),
          static_cast<std::uint32_t>(time.value & 0xFFFFFFFFU)};
}

/// Appends one argument of a message: one overload for each type of the wire.
struct Append {
  lo_message message;
  int operator()(std::int32_t value) const { return lo_message_add_int32(message, value); }
  int operator()(float value) const { return lo_message_add_float(message, value); }
  int operator()(const std::string& value) const {
    return lo_message_add_string(message, value.c_str());
  }
  int operator()(protocol::TimeTag value) const {
    return lo_message_add_timetag(message, to_lo(value));
  }
};

LoMessage to_lo(const protocol::Message& message) {
  LoMessage lo(lo_message_new());
  if (!lo) throw std::bad_alloc();
  for (const auto& argument : message.arguments) {
    if (std::visit(Append{lo.get()}, argument) < 0) throw std::bad_alloc();
  }
  return lo;
}

void check_size(std::size_t size, const std::string& first_address) {
  if (size <= protocol::kMaxDatagram) return;
  throw std::length_error("OSC packet that opens with " + first_address + " has " +
                          std::to_string(size) + " bytes, the wire allows " +
                          std::to_string(protocol::kMaxDatagram) + ": split it");
}

/// Copies what liblo allocated. It is never given a buffer of ours: on an inner error it would
/// free that.
std::vector<std::byte> take(LoBytes bytes, std::size_t size) {
  if (!bytes) throw std::bad_alloc();
  std::vector<std::byte> packet(size);
  std::memcpy(packet.data(), bytes.get(), size);
  return packet;
}

}  // namespace

std::vector<std::byte> build_message(const protocol::Message& message) {
  const LoMessage lo = to_lo(message);
  check_size(lo_message_length(lo.get(), message.address.c_str()), message.address);
  std::size_t size = 0;
  LoBytes bytes(lo_message_serialise(lo.get(), message.address.c_str(), nullptr, &size));
  return take(std::move(bytes), size);
}

std::vector<std::byte> build_bundle(protocol::TimeTag time,
                                    const std::vector<protocol::Message>& messages) {
  if (messages.size() > protocol::kMaxMessages) {
    throw std::length_error("OSC bundle of " + std::to_string(messages.size()) +
                            " messages, the wire allows " + std::to_string(protocol::kMaxMessages) +
                            ": split it");
  }
  LoBundle bundle(lo_bundle_new(to_lo(time)));
  if (!bundle) throw std::bad_alloc();
  for (const auto& message : messages) {
    LoMessage lo = to_lo(message);
    if (lo_bundle_add_message(bundle.get(), message.address.c_str(), lo.get()) < 0) {
      throw std::bad_alloc();
    }
    static_cast<void>(lo.release());  // the bundle frees it now
  }
  check_size(lo_bundle_length(bundle.get()),
             messages.empty() ? std::string("nothing") : messages.front().address);
  std::size_t size = 0;
  LoBytes bytes(lo_bundle_serialise(bundle.get(), nullptr, &size));
  return take(std::move(bytes), size);
}

}  // namespace splash::sim
