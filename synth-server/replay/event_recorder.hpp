// SPDX-License-Identifier: MIT
// What an engine that plays live starts, and which forces push bodies when, as an event log:
// rendered again it gives the same sound, whatever network, clocks and load had made of the moments
// that were meant.
#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "protocol/event_log.hpp"
#include "synth-server/render/engine.hpp"

namespace splash::synth {

class EventRecorder final : public StartWatch {
 public:
  /// Throws std::runtime_error when `path` cannot be written. `sample_rate` [Hz].
  EventRecorder(const std::filesystem::path& path, int sample_rate);
  ~EventRecorder();
  EventRecorder(const EventRecorder&) = delete;
  EventRecorder& operator=(const EventRecorder&) = delete;

  /// From the audio thread; the log counts seconds from the engine's first sample. What does not
  /// fit the queue, because the disk stalls, is left out and counted.
  void started(const TimedEvent& event) noexcept override;
  void pushed(const TimedPush& push) noexcept override;

  /// Writes what is left and ends the thread; nothing may start any more.
  void finish();
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }
  /// Why the log ended early; empty: it did not. To be read after finish().
  [[nodiscard]] const std::string& error() const noexcept { return error_; }

 private:
  static constexpr std::size_t kCapacity = 16384;  // as many as may wait in the engine

  void run();
  void write(const TimedEvent& event);
  void write(const TimedPush& push);
  void append(std::int64_t sample, const std::vector<protocol::Message>& messages);

  protocol::LogWriter log_;
  double sample_rate_;
  std::int32_t sequence_ = 0;  ///< of the log's bundles
  boost::lockfree::spsc_queue<std::variant<TimedEvent, TimedPush>,
                              boost::lockfree::capacity<kCapacity>>
      queue_;
  std::atomic<std::uint64_t> lost_{0};
  std::string error_;
  std::atomic<bool> finishing_{false};
  std::thread thread_;
};

}  // namespace splash::synth
