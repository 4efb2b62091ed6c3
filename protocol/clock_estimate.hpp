// SPDX-License-Identifier: MIT
// Estimates a peer's clock from pings and pongs: offset and drift are fitted to the samples with
// the shortest round trips, because queues delay those least.
#pragma once

#include <cstddef>
#include <vector>

namespace splash::protocol {

/// Uses four stamps as NTP does (RFC 5905, section 8). The error is at most half the shortest round
/// trip when the delays of the two directions differ, and far less when they do not.
class ClockEstimate {
 public:
  /// Remembers the last `window` samples (at least 4).
  explicit ClockEstimate(std::size_t window = 64);

  /// t0: ping sent, t3: pong back, both by our clock; t1: ping received, t2: pong sent, by the
  /// peer's [s]. Returns false, and ignores the sample, when the stamps contradict each other or,
  /// once, the older samples. A second contradiction means that a clock was set: all older samples
  /// are forgotten.
  bool add(double t0, double t1, double t2, double t3);

  [[nodiscard]] bool ready() const noexcept { return !samples_.empty(); }
  /// The peer's clock minus ours when ours shows `local_time`; 0 before the first sample [s].
  [[nodiscard]] double offset_at(double local_time) const noexcept;
  /// How much faster the peer's clock runs [s/s]; 0 until the samples span enough time.
  [[nodiscard]] double drift() const noexcept { return drift_; }
  /// The shortest round trip of the window [s].
  [[nodiscard]] double round_trip() const noexcept { return shortest_; }
  /// The number of times that a clock was set, as far as the samples show.
  [[nodiscard]] std::size_t steps() const noexcept { return steps_; }

 private:
  struct Sample {
    double time = 0.0;  ///< our clock, middle of the round trip [s]
    double offset = 0.0;
    double round_trip = 0.0;
  };
  [[nodiscard]] bool contradicts(const Sample& sample) const noexcept;
  void fit();

  std::size_t window_;
  std::vector<Sample> samples_;  ///< oldest first
  std::vector<Sample> doubted_;  ///< at most one that contradicted the others
  double centre_ = 0.0;          ///< the fit is offset_ + drift_ (t - centre_)
  double offset_ = 0.0;
  double drift_ = 0.0;
  double shortest_ = 0.0;
  std::size_t steps_ = 0;
};

}  // namespace splash::protocol
