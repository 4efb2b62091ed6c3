// SPDX-License-Identifier: MIT
// What the engine counts, written by the rendering thread and read from any other.
#pragma once

#include <atomic>
#include <cstdint>

#include "protocol/event.hpp"

namespace splash::synth {

/// Everything since construction, save the first two, which are of now.
struct EngineCounters {
  std::uint64_t voices = 0;     ///< sounding now, fading ones included
  std::uint64_t scheduled = 0;  ///< events waiting now
  protocol::ByKind<std::uint64_t> started{};
  std::uint64_t late = 0;              ///< started after their sample
  std::uint64_t stolen = 0;            ///< voices faded out to make room for louder ones
  std::uint64_t dropped_refused = 0;   ///< a value that is not finite or out of its range
  std::uint64_t dropped_queue = 0;     ///< too many events waiting
  std::uint64_t dropped_pool = 0;      ///< all voices busy with louder ones, or too many at once
  std::uint64_t dropped_band = 0;      ///< bubbles born above every output's band or Nyquist
  std::uint64_t dropped_unheard = 0;   ///< too weak, or no output renders their body or place
  std::uint64_t dropped_muted = 0;     ///< of a component that is switched off
  std::uint64_t dropped_cleared = 0;   ///< waiting when clear() was called
  std::uint64_t channels_skipped = 0;  ///< times a silent channel was left uncomputed for a cell
  std::uint64_t cells = 0;             ///< times of 64 samples rendered, for the line above
  std::uint64_t resets = 0;            ///< samples that were not finite and reset their channel
  std::uint64_t limited = 0;           ///< samples that a limiter turned down
  protocol::ByKind<std::uint64_t> without_place{};  ///< dropped_queue and dropped_pool by kind
  std::uint64_t crowded = 0;  ///< of the started bubbles, those that sound as noise
};

/// One number with one writer: cheaper than fetch_add, and no reader ever sees a torn value.
class Count {
 public:
  void add(std::uint64_t n = 1) noexcept { set(get() + n); }
  void set(std::uint64_t n) noexcept { value_.store(n, std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t get() const noexcept {
    return value_.load(std::memory_order_relaxed);
  }

 private:
  std::atomic<std::uint64_t> value_{0};
};

}  // namespace splash::synth
