// SPDX-License-Identifier: MIT
#include "view-server/admission.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <array>

#include "protocol/address.hpp"

namespace splash::view {
namespace {

struct Row {
  std::string_view address;
  Way way;
};

constexpr std::string_view kPose = "/body/pose";

constexpr std::array<Row, 14> kAllowed = {{{"/body/grab", Way::sim},
                                           {kPose, Way::sim},
                                           {"/pause", Way::sim},
                                           {"/reset", Way::sim},
                                           {"/param", Way::sim},
                                           {"/scene", Way::sim},
                                           {"/rig", Way::synth},
                                           {"/mute", Way::synth},
                                           {"/tone", Way::synth},
                                           {"/set", Way::synth},
                                           {"/get", Way::synth},
                                           {"/preset", Way::synth},
                                           {"/clearSched", Way::both},
                                           {"/ping", Way::here}}};

bool is_at_home(std::string_view host) {
  const std::string name(host.substr(0, host.rfind(':')));
  in_addr address{};
  return name == "localhost" || inet_pton(AF_INET, name.c_str(), &address) == 1;
}

Admitted refused(std::string address, std::string reason) {
  return {Way::refused, {}, {}, std::move(address), std::move(reason)};
}

}  // namespace

bool is_own(std::string_view host, std::string_view origin, const std::vector<std::string>& ours) {
  const bool known = is_at_home(host) || std::find(ours.begin(), ours.end(), host) != ours.end();
  return known && (origin.empty() || origin == "http://" + std::string(host) ||
                   origin == "https://" + std::string(host));
}

Admitted admit(protocol::Bytes bytes) {
  protocol::DecodeResult read = protocol::decode(bytes);
  if (read.refusal != protocol::Refusal::none) {
    return refused("/", std::string(protocol::describe(read.refusal)));
  }
  const bool single = read.packet.messages.size() == 1;
  if (!single || (read.packet.time && read.packet.messages.front().address != kPose)) {
    return refused("#bundle", "one message is taken; in a bundle, a pose");
  }
  protocol::Message& message = read.packet.messages.front();
  const auto row = std::find_if(kAllowed.begin(), kAllowed.end(), [&](const Row& allowed) {
    return allowed.address == message.address;
  });
  if (row == kAllowed.end()) return refused(message.address, "a page may not say this");
  if (const auto reason = protocol::violation(message)) return refused(message.address, *reason);
  return {row->way, std::move(message), read.packet.time, {}, {}};
}

}  // namespace splash::view
