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

}  // namespace splash::protocol
