// SPDX-License-Identifier: MIT
// A log's events and pushes on their way into an engine that plays live, each at its sample of the
// engine's clock. Allocates nothing after its construction.
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
  /// The score in the order of its samples, of whose events the first `done` are left out. What
  /// comes next of the log sounds at `start`, counted from the engine's first sample.
  Track(Score score, std::size_t done, std::int64_t start)
      : score_(std::move(score)), next_(std::min(done, score_.events.size())) {
    const std::vector<TimedEvent>& events = score_.events;
    const std::int64_t from = done == 0 || next_ == events.size() ? 0 : events[next_].sample;
    shift_ = start - from;
    end_ = shift_ + last_sample(score_);
    while (next_push_ < score_.pushes.size() && score_.pushes[next_push_].sample < from) {
      ++next_push_;
    }
  }

  /// From the rendering thread: hands over what starts before `end` of the engine's clock.
  void give(Engine& engine, std::int64_t end) noexcept {
    std::size_t next = next_.load(std::memory_order_relaxed);
    for (; next < score_.events.size() && score_.events[next].sample + shift_ < end; ++next) {
      const TimedEvent& event = score_.events[next];
      (void)engine.schedule({event.event, event.sample + shift_, event.session});
    }
    next_.store(next, std::memory_order_relaxed);
    const std::vector<TimedPush>& pushes = score_.pushes;
    // A push acts from the beginning of its cell on, which may lie before its sample.
    for (; next_push_ < pushes.size(); ++next_push_) {
      const std::int64_t sample = pushes[next_push_].sample + shift_;
      if (sample >= end + kCell) break;
      engine.push({pushes[next_push_].push, sample});
    }
  }

  /// From any thread: events handed over so far, left-out ones included.
  [[nodiscard]] std::size_t done() const noexcept { return next_.load(std::memory_order_relaxed); }
  [[nodiscard]] bool over() const noexcept { return done() == score_.events.size(); }
  [[nodiscard]] std::size_t size() const noexcept { return score_.events.size(); }
  /// The last sample of the score, of the engine's clock.
  [[nodiscard]] std::int64_t end() const noexcept { return end_; }

 private:
  Score score_;
  std::atomic<std::size_t> next_;
  std::size_t next_push_ = 0;
  std::int64_t shift_ = 0;  ///< from the log's samples to the engine's
  std::int64_t end_ = 0;
};

}  // namespace splash::synth
