// SPDX-License-Identifier: MIT
// Keeps the sound going: notices from outside the callback that a device has died, lets the null
// clock stand in, and takes the device back with a new object as soon as it can be opened.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "synth-server/audio/audio_output.hpp"

namespace splash::synth {

struct WatchSettings {
  std::chrono::milliseconds look{50};     ///< between two looks at the output
  std::chrono::milliseconds limits{400};  ///< without a callback: the device is gone
  std::chrono::milliseconds retry{100};   ///< between two attempts to open it
};

class DeviceWatch {
 public:
  /// Opens the device anew; throws DeviceError while it cannot.
  using Open = std::function<std::unique_ptr<AudioOutput>()>;
  using Report = std::function<void(const std::string&)>;
  /// The device came back at another rate: gives what renders at that one. Nothing renders
  /// meanwhile, and the source so far is not called any more.
  using Adapt = std::function<BlockSource&(const AudioFormat&)>;

  /// Starts `output`, already open, with `source`. Without `open`, nothing is ever reopened.
  /// `missing`: why `output` only stands in for a device (that is known already and not reported
  /// again); empty: it is the device. Without `adapt`, a device at another rate is refused.
  DeviceWatch(BlockSource& source, std::unique_ptr<AudioOutput> output, std::string missing,
              Open open, Report report, Adapt adapt = {}, WatchSettings settings = {});
  /// Stops the output; afterwards `source` is not called any more.
  ~DeviceWatch();
  DeviceWatch(const DeviceWatch&) = delete;
  DeviceWatch& operator=(const DeviceWatch&) = delete;

  /// Devices lost since the start.
  [[nodiscard]] std::uint64_t losses() const noexcept { return losses_; }
  [[nodiscard]] AudioFormat format() const;
  [[nodiscard]] std::string scheduling() const;

 private:
  using Clock = std::chrono::steady_clock;
  /// What was last seen of the output's progress.
  struct Progress {
    std::uint64_t frames = 0;
    Clock::time_point moved;        ///< when `frames` last changed
    std::uint64_t span_frames = 0;  ///< at `span_start`
    Clock::time_point span_start;
  };

  void run();
  void look();
  /// Why the running device is of no use any more; empty: it works.
  [[nodiscard]] std::string fault(Clock::time_point now);
  void stand_in(const std::string& why);
  void try_device();
  void exchange(std::unique_ptr<AudioOutput> next);
  void restart_progress();

  BlockSource* source_;
  Open open_;
  Report report_;
  Adapt adapt_;
  WatchSettings settings_;
  AudioFormat needed_;        ///< channels and rate that the source renders
  mutable std::mutex mutex_;  ///< guards output_ against the readers of its format
  std::unique_ptr<AudioOutput> output_;
  bool standing_in_;
  std::string last_refusal_;
  Progress progress_;
  Clock::time_point next_try_;
  std::atomic<std::uint64_t> losses_{0};
  std::mutex sleep_mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace splash::synth
