// SPDX-License-Identifier: MIT
// Numbered commands from one thread to another through the real queue: do all come, in order,
// whole?
#pragma once

#include <cstdint>
#include <memory>
#include <thread>

#include "synth-server/play/command_queue.hpp"

namespace splash::synth {

struct QueueReport {
  std::uint64_t taken = 0;
  std::uint64_t wrong = 0;  ///< out of order, or torn: their parts do not belong together
  std::uint64_t full = 0;   ///< times the producer met a full queue and tried again
};

/// The `number`th command: three of its parts say which it is.
inline Command numbered(std::uint64_t number) {
  Command command;
  command.moment = static_cast<double>(number);
  command.offset = -command.moment;
  command.event = protocol::Bubble{
      static_cast<std::int32_t>(number % (1U << 24U)), -1, 0.004F, 0.05F, {}, 0.0F};
  return command;
}

inline bool is_number(const Command& command, std::uint64_t number) {
  const auto* bubble = std::get_if<protocol::Bubble>(&command.event);
  return command.moment == static_cast<double>(number) && command.offset == -command.moment &&
         bubble != nullptr && bubble->id == static_cast<std::int32_t>(number % (1U << 24U));
}

[[nodiscard]] inline QueueReport run_queue(std::uint64_t items) {
  const auto queue = std::make_unique<CommandQueue>();
  QueueReport report;
  std::jthread producer([&] {
    for (std::uint64_t number = 0; number < items; ++number) {
      while (!queue->push(numbered(number))) {
        ++report.full;
        std::this_thread::yield();
      }
    }
  });
  while (report.taken < items) {
    const auto some = queue->consume_all([&](const Command& command) {
      if (!is_number(command, report.taken++)) ++report.wrong;
    });
    if (some == 0) std::this_thread::yield();
  }
  producer.join();
  return report;
}

}  // namespace splash::synth
