// SPDX-License-Identifier: MIT
// A log's events on their way into an engine that plays live, each at its sample of the engine's
// clock. Allocates nothing after its construction.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

#include "synth-server/render/engine.hpp"

namespace splash::synth {

class Track {
 public:
  /// `events` in the order of their samples, of which the first `done` are left out. What comes
  /// next of the log sounds at `start`, counted from the engine's first sample.
  Track(std::vector<TimedEvent> events, std::size_t done, std::int64_t start)
      : events_(std::move(events)), next_(std::min(done, events_.size())) {
    shift_ = start - (done == 0 || next_ == events_.size() ? 0 : events_[next_].sample);
    end_ = shift_ + (events_.empty() ? 0 : events_.back().sample);
  }

  /// From the rendering thread: hands over what starts before `end` of the engine's clock.
  void give(Engine& engine, std::int64_t end) noexcept {
    std::size_t next = next_.load(std::memory_order_relaxed);
    for (; next < events_.size() && events_[next].sample + shift_ < end; ++next) {
      const TimedEvent& event = events_[next];
      (void)engine.schedule({event.event, event.sample + shift_, event.session});
    }
    next_.store(next, std::memory_order_relaxed);
  }

  /// From any thread: events handed over so far, left-out ones included.
  [[nodiscard]] std::size_t done() const noexcept { return next_.load(std::memory_order_relaxed); }
  [[nodiscard]] bool over() const noexcept { return done() == events_.size(); }
  [[nodiscard]] std::size_t size() const noexcept { return events_.size(); }
  /// The last event's sample of the engine's clock.
  [[nodiscard]] std::int64_t end() const noexcept { return end_; }

 private:
  std::vector<TimedEvent> events_;
  std::atomic<std::size_t> next_;
  std::int64_t shift_ = 0;  ///< from the log's samples to the engine's
  std::int64_t end_ = 0;
};

}  // namespace splash::synth
