// SPDX-License-Identifier: MIT
// How many voices may sound at once, so that rendering a block takes less than the block's time:
// when the load comes near it, the quietest go. Voices cost about alike, so their number follows
// from the load at once; it grows back slowly. A single late block is no load: the load is averaged
// over a tenth of a second.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>

namespace splash::synth {

class Governor {
 public:
  static constexpr double kHigh = 0.8;    ///< load from which on voices go [1]
  static constexpr double kTarget = 0.7;  ///< and to which [1]
  static constexpr double kLow = 0.6;     ///< load under which more may come [1]
  static constexpr int kLeast = 64;       ///< so many may always sound, or all

  /// `most`: at once, while the load is low.
  explicit Governor(int most) noexcept : most_(most), limit_(most), shown_(most) {}

  /// After each block. `load`: rendering time in the block's time [1]; `seconds`: the latter;
  /// `voices`: sounding. Returns how many may sound from now on.
  int note(double load, double seconds, std::uint64_t voices) noexcept {
    load_ += (load - load_) * -std::expm1(-seconds / kSpan);
    if (load_ > kHigh) {
      const double counted = std::min(limit_, static_cast<double>(voices));
      limit_ = std::max(std::min(most_, static_cast<double>(kLeast)), counted * kTarget / load_);
      load_ = kTarget;  // until the next blocks tell otherwise
      lowered_.store(lowered_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    } else if (load_ < kLow) {
      limit_ = std::min(most_, limit_ * std::exp(seconds / kGrowth));
    }
    const int limit = static_cast<int>(limit_);
    shown_.store(limit, std::memory_order_relaxed);
    return limit;
  }

  /// From any thread: voices that may sound now, and how often their number was lowered.
  [[nodiscard]] int limit() const noexcept { return shown_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t lowered() const noexcept {
    return lowered_.load(std::memory_order_relaxed);
  }

 private:
  static constexpr double kSpan = 0.1;    ///< the load is averaged over this [s]
  static constexpr double kGrowth = 1.0;  ///< e times as many voices in this time [s]

  double most_;
  double limit_;
  double load_ = 0.0;  ///< averaged [1]
  std::atomic<int> shown_;
  std::atomic<std::uint64_t> lowered_{0};
};

}  // namespace splash::synth
