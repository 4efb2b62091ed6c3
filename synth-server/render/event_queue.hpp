// SPDX-License-Identifier: MIT
// Events that wait for their sample: a heap of fixed capacity, first come first served among
// events of one sample. Bubbles leave a sixteenth of it to impacts and cavities.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "protocol/event.hpp"

namespace splash::synth {

class EventQueue {
 public:
  explicit EventQueue(int capacity)
      : capacity_(static_cast<std::size_t>(capacity)), kept_(capacity_ / kKeptPart) {
    waiting_.reserve(capacity_);
  }

  /// False when full.
  bool push(const protocol::Event& event, std::int64_t sample, std::int32_t session = 0) noexcept {
    const std::size_t kept = is_bubble(event) ? kept_ : 0;
    if (waiting_.size() + kept >= capacity_) return false;
    waiting_.push_back({event, sample, session, serial_++});
    std::push_heap(waiting_.begin(), waiting_.end(), later);
    return true;
  }

  /// Whether an event starts before `end`.
  [[nodiscard]] bool due(std::int64_t end) const noexcept {
    return !waiting_.empty() && waiting_.front().sample < end;
  }

  struct Waiting {
    protocol::Event event;
    std::int64_t sample = 0;
    std::int32_t session = 0;
    std::uint64_t serial = 0;
  };
  /// Not to be called when empty.
  Waiting pop() noexcept {
    std::pop_heap(waiting_.begin(), waiting_.end(), later);
    const Waiting first = waiting_.back();
    waiting_.pop_back();
    return first;
  }

  /// All events come `samples` earlier than they were told.
  void advance(std::int64_t samples) noexcept {
    for (Waiting& waiting : waiting_) waiting.sample -= samples;
  }
  /// How many start before `end`.
  [[nodiscard]] std::uint64_t count_before(std::int64_t end) const noexcept {
    return static_cast<std::uint64_t>(
        std::count_if(waiting_.begin(), waiting_.end(),
                      [end](const Waiting& waiting) { return waiting.sample < end; }));
  }

  [[nodiscard]] std::size_t size() const noexcept { return waiting_.size(); }
  void clear() noexcept { waiting_.clear(); }

 private:
  static constexpr std::size_t kKeptPart = 16;
  static bool later(const Waiting& a, const Waiting& b) noexcept {
    return a.sample != b.sample ? a.sample > b.sample : a.serial > b.serial;
  }

  std::size_t capacity_;
  std::size_t kept_;              ///< of it, for others than bubbles
  std::vector<Waiting> waiting_;  ///< a heap, the next one first
  std::uint64_t serial_ = 0;
};

}  // namespace splash::synth
