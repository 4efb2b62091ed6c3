// SPDX-License-Identifier: MIT
// The gate, the two decoders behind it, and the address table behind those.
#include <algorithm>
#include <string>

#include "protocol/address.hpp"
#include "protocol/control_port.hpp"
#include "protocol/limits.hpp"
#include "protocol/message.hpp"
#include "protocol/status.hpp"
#include "synth-server/receive/oscpack_reader.hpp"
#include "tests/fuzz/target.hpp"

namespace splash::fuzz {
namespace {

using namespace protocol;

/// An exact copy on the heap: a sanitizer sees a read behind its end.
std::vector<std::byte> tight(Bytes input) {
  return {input.begin(), input.end()};
}

/// Whether `told` is `message`, behind which optional arguments stand that are not known (0).
bool says_the_same(const Message& told, const Message& message) {
  const auto& [address, arguments] = message;
  return told.address == address && told.arguments.size() >= arguments.size() &&
         std::equal(arguments.begin(), arguments.end(), told.arguments.begin()) &&
         std::all_of(told.arguments.begin() + static_cast<std::ptrdiff_t>(arguments.size()),
                     told.arguments.end(), [](const auto& one) { return one == Argument(0.0F); });
}

/// A message that a reader takes is one that the table takes, and says the same when told again.
template <class Taken>
void check_taken(const Taken& taken, const Message& message) {
  if (!taken) return;
  promise(!violation(message), message.address + " was taken although it breaks the table");
  promise(says_the_same(to_message(*taken), message),
          message.address + " does not survive being read");
}

void check_message(const Message& message) {
  promise(message.arguments.size() <= kMaxArguments, "too many arguments");
  promise(message.address.size() <= kMaxString, "an address that is too long");
  if (const auto why = violation(message)) promise(!why->empty(), "a refusal without a reason");
  check_taken(to_event(message), message);
  check_taken(to_frame(message), message);
  const auto pose = to_body_pose(message);
  if (pose) promise(to_body_pose(to_message(*pose)) == pose, "a pose changes when read again");
  if (const auto status = to_synth_status(message)) promise(!violation(message), "bad status");
  if (const auto status = to_sim_status(message)) promise(!violation(message), "bad status");
}

}  // namespace

bool try_gate(Bytes input) {
  const auto bytes = tight(input);
  const Refusal refusal = gate(bytes);
  promise(refusal < Refusal::count_, "a refusal that does not exist");
  promise(!describe(refusal).empty(), "a refusal without words");
  promise(refusal != Refusal::none || bytes.size() <= kMaxDatagram, "too long, and accepted");
  return refusal == Refusal::none;
}

bool try_packet(Bytes input) {
  const auto bytes = tight(input);
  const DecodeResult ours = decode(bytes);
  const DecodeResult oscpacks = synth::read_packet(bytes);
  promise(ours.refusal == gate(bytes), "decode and gate disagree");
  promise(ours.refusal == oscpacks.refusal, "oscpack refuses what the gate accepts");
  promise(ours.packet == oscpacks.packet, "oscpack reads something else");
  if (ours.refusal != Refusal::none) return false;
  const auto& [time, messages] = ours.packet;
  promise(messages.size() <= kMaxMessages, "too many messages");
  promise((time ? encode(*time, messages) : encode(messages.at(0))) == bytes,
          "an accepted packet has a second form");
  for (const Message& message : messages) check_message(message);
  for (const Message& message : messages) {
    const std::string text = to_text(message, time);
    promise(std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c <= 0x7e; }),
            "what /dumpOSC prints is not printable");
  }
  return true;
}

}  // namespace splash::fuzz
