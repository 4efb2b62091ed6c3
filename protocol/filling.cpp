// SPDX-License-Identifier: MIT
#include "protocol/filling.hpp"

#include <algorithm>
#include <stdexcept>

#include "protocol/limits.hpp"

namespace splash::protocol {

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
