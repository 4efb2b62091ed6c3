// SPDX-License-Identifier: MIT
// Builds the replies; every text is cut to what the gate lets pass.
#include "protocol/control.hpp"

#include "protocol/limits.hpp"

namespace splash::protocol {
namespace {

std::string fit(const std::string& text) {
  std::string out = text.substr(0, kMaxString);
  for (char& c : out) {
    if (c < 0x20 || c > 0x7e) c = '?';
  }
  return out;
}

}  // namespace

Message done(const std::string& command, std::optional<std::int32_t> value) {
  Message message{"/done", {fit(command)}};
  if (value) message.arguments.emplace_back(*value);
  return message;
}

Message fail(const std::string& command, const std::string& reason) {
  return {"/fail", {fit(command), fit(reason)}};
}

std::string too_many_subscribers() {
  return "full: " + std::to_string(kMaxSubscribers) + " subscribers";
}

Message value_of(const std::string& name, double value) {
  return {"/value", {fit(name), static_cast<float>(value)}};
}

Message synced(std::int32_t id) {
  return {"/synced", {id}};
}

Message ping(TimeTag sent) {
  return {"/ping", {sent}};
}

Message pong(TimeTag sent, TimeTag received, TimeTag replied) {
  return {"/pong", {sent, received, replied}};
}

Message version_reply(const std::string& program) {
  return {"/version.reply",
          {fit(program), SPLASH_VERSION_MAJOR, SPLASH_VERSION_MINOR, SPLASH_VERSION_PATCH,
           std::string(), std::string()}};
}

std::string version() {
  return std::to_string(SPLASH_VERSION_MAJOR) + '.' + std::to_string(SPLASH_VERSION_MINOR) + '.' +
         std::to_string(SPLASH_VERSION_PATCH);
}

}  // namespace splash::protocol
