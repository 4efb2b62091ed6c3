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

// When an event is played: its moment plus the fixed latency, on the sample clock; what comes late
// plays at once or not at all, what lies too far ahead is not believed, what has no time plays with
// the next block.

struct ScheduleSettings {
  double latency = -1.0;       ///< wanted, added to every moment [s]; negative: by the block
  double late_window = 0.050;  ///< later than this an event is dropped [s]
  double horizon = 2.0;        ///< further ahead a time tag is taken for a wrong clock [s]
};

enum class Timing {
  on_time,
  late,      ///< within the window: plays at the block's start
  too_late,  ///< dropped
  early,     ///< beyond the horizon: plays by arrival
};

struct Placement {
  Timing timing = Timing::on_time;
  std::int64_t sample = 0;  ///< never before the block's start; meaningless when too late
};

/// The wanted latency; without a wish (negative) one block, since that long before its last sample
/// sounds a block is asked for, and half a block more for late callbacks, and 5 ms or more [s].
/// A sender whose tags lie ahead by as much needs none: its events sound at their moment.
[[nodiscard]] double latency_for(double wanted, int block, double sample_rate) noexcept;

/// An event without a time: as soon as it can be, `offset` [s] into the block, no latency added.
[[nodiscard]] Placement place_at_once(double offset, std::int64_t block_start, double sample_rate,
                                      const ScheduleSettings& settings) noexcept;

/// `moment`: when the event happens; `by_arrival`: when it would, going by its arrival and the
/// delay it names [s, monotonic]. `block_start`: first sample that can still be rendered.
[[nodiscard]] Placement place(double moment, double by_arrival, const SampleClock& clock,
                              std::int64_t block_start, const ScheduleSettings& settings) noexcept;

}  // namespace splash::synth
