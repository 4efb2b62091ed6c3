// SPDX-License-Identifier: MIT
// Which sample sounds at which moment: a delay-locked loop that smooths the jittering times of the
// audio callbacks. F. Adriaensen, "Using a DLL to filter time", Linux Audio Conference 2005. A
// callback can be late by chance but never early, so the loop follows the earliest of each quarter
// of a second: load on the machine, which makes most of them late, then hardly moves it.
#pragma once

#include <cstdint>

namespace splash::synth {

class SampleClock {
 public:
  /// `sample_rate`: nominal [Hz].
  explicit SampleClock(double sample_rate) noexcept;

  /// A callback that starts at sample `first` and holds `frames` samples was called at `now`
  /// [s, monotonic].
  void update(double now, std::int64_t first, int frames) noexcept;
  /// Forgets everything but the nominal rate: after an xrun the samples before say nothing about
  /// those to come. The next update starts anew.
  void reset() noexcept;

  /// The sample (with its fraction) that sounds at `moment` [s, monotonic].
  [[nodiscard]] double sample_at(double moment) const noexcept;
  /// Filtered start of the current block [s, monotonic].
  [[nodiscard]] double block_time() const noexcept { return time_; }
  /// Estimated rate of the device [Hz].
  [[nodiscard]] double rate() const noexcept { return 1.0 / seconds_per_sample_; }
  [[nodiscard]] std::uint64_t resets() const noexcept { return resets_; }

 private:
  void start(double now, std::int64_t first, int frames) noexcept;
  void begin_span() noexcept;
  void correct() noexcept;
  [[nodiscard]] double omega(double seconds) const noexcept;

  double nominal_;             ///< seconds per sample [s]
  double seconds_per_sample_;  ///< estimated [s]
  double time_ = 0.0;          ///< filtered start of the current block [s]
  double elapsed_ = 0.0;       ///< since the last start [s]
  double earliest_ = 0.0;      ///< least error of a callback in this span [s]
  std::int64_t span_ = 0;      ///< its length so far [samples]
  std::int64_t first_ = 0;     ///< sample at `time_`
  std::int64_t next_first_ = 0;
  int outliers_ = 0;  ///< callbacks in a row whose error was too large to believe
  bool running_ = false;
  std::uint64_t resets_ = 0;
};

}  // namespace splash::synth
