// SPDX-License-Identifier: MIT
#include "protocol/reply_budget.hpp"

#include <algorithm>
#include <stdexcept>

#include "protocol/limits.hpp"

namespace splash::protocol {

namespace {

constexpr std::size_t kHeaders = 28;  // IPv4 (RFC 791) and UDP (RFC 768) [bytes]

}  // namespace

// The question's own header pays for one of the replies'.
bool ReplyBudget::fits(const Message& reply) const {
  return !limited_ || spent_ + encoded_size(reply) <= bytes_;
}

std::optional<Message> ReplyBudget::take(const Message& reply) {
  Message sent = reply;
  if (sent.address == "/fail") {
    auto& reason = std::get<std::string>(sent.arguments.back());
    while (!reason.empty() && !fits(sent)) reason.pop_back();
  }
  if (!fits(sent)) return std::nullopt;
  owe(sent);
  return sent;
}

void ReplyBudget::owe(const Message& later) {
  if (limited_) spent_ += encoded_size(later) + kHeaders;
}

std::string ReplyBudget::complaint(const std::string& command, const Message& reply) const {
  const std::size_t size = encoded_size(reply);
  const std::string others = spent_ == 0 ? "" : ", behind others to the same datagram,";
  return "asked " + command + " in a datagram of " + std::to_string(bytes_) +
         " bytes; the reply has " + std::to_string(size) + " bytes" + others +
         " and was not sent. Fill the question up with text to " + std::to_string(spent_ + size) +
         " bytes (protocol/README.md, 'Who is answered')";
}

Message filled_up(Message command, std::size_t bytes) {
  const std::size_t wanted = (bytes + 3) / 4 * 4;  // as all OSC is padded
  while (encoded_size(command) < wanted) {
    if (command.arguments.size() == kMaxArguments) {
      throw std::length_error("'" + command.address + "' cannot be filled up to " +
                              std::to_string(bytes) + " bytes");
    }
    auto& text = std::get<std::string>(command.arguments.emplace_back(std::string()));
    const std::size_t size = encoded_size(command);  // with an empty text, and its type
    if (size < wanted) text.assign(std::min(wanted - size, kMaxString), '.');
  }
  return command;
}

// The buckets stand in a short list, since the allowed peers are few. A flood from ever new ports
// would get a fresh bucket each, so a peer that displaces another starts with an empty one.

bool RateLimit::allow(const Endpoint& peer, double now) {
  Bucket& bucket = bucket_of(is_loopback(peer) ? peer : Endpoint{peer.address, 0}, now);
  const double elapsed = std::max(0.0, now - bucket.updated);
  bucket.tokens = std::min(burst_, bucket.tokens + rate_ * elapsed);
  bucket.updated = now;
  if (bucket.tokens < 1.0) return false;
  bucket.tokens -= 1.0;
  return true;
}

RateLimit::Bucket& RateLimit::bucket_of(const Endpoint& peer, double now) {
  const auto known = std::find_if(buckets_.begin(), buckets_.end(),
                                  [&](const Bucket& bucket) { return bucket.peer == peer; });
  if (known != buckets_.end()) return *known;
  if (buckets_.size() < kMaxPeers) {
    return buckets_.emplace_back(Bucket{.peer = peer, .tokens = burst_, .updated = now});
  }
  const auto oldest =
      std::min_element(buckets_.begin(), buckets_.end(),
                       [](const Bucket& a, const Bucket& b) { return a.updated < b.updated; });
  // Its rest counts as the newcomer's: nothing when the list is churned quickly.
  *oldest = {.peer = peer, .tokens = 0.0, .updated = oldest->updated};
  return *oldest;
}

}  // namespace splash::protocol
