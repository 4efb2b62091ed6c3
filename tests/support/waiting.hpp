// SPDX-License-Identifier: MIT
// Waiting for a time, or for what comes true however slow the machine is.
#pragma once

#include <chrono>
#include <thread>

namespace splash::tests {

inline void sleep(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

/// Whether `condition` comes true within `seconds`; it is looked at every `pause` [s].
template <class Condition>
bool eventually(const Condition& condition, double seconds = 20.0, double pause = 0.002) {
  using Clock = std::chrono::steady_clock;
  const auto limit = Clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (Clock::now() > limit) return false;
    sleep(pause);
  }
  return true;
}

}  // namespace splash::tests
