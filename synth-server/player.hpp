// SPDX-License-Identifier: MIT
// The audio callback's work: take what the receiver sent, give each event its sample, render,
// record. It neither waits nor allocates; everybody else reads its counts.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "synth-server/audio/audio_output.hpp"
#include "synth-server/audio/recorder.hpp"
#include "synth-server/receive/command_queue.hpp"
#include "synth-server/receive/sample_clock.hpp"
#include "synth-server/receive/schedule.hpp"
#include "synth-server/render/counters.hpp"
#include "synth-server/render/engine.hpp"

namespace splash::synth {

struct PlayerCounters {
  std::uint64_t blocks = 0;
  std::uint64_t xruns = 0;         ///< blocks that the device says were late
  std::uint64_t late = 0;          ///< events played at once because their moment had passed
  std::uint64_t too_late = 0;      ///< events dropped for that
  std::uint64_t early = 0;         ///< events played by arrival because they lay too far ahead
  std::uint64_t clock_resets = 0;  ///< times the sample clock had to start anew
  std::uint64_t voices_peak = 0;   ///< most voices at once
  double load_average = 0.0;       ///< rendering time in its block's time, over a second [1]
  double load_peak = 0.0;          ///< the same, largest since the start [1]
};

class Player final : public BlockSource {
 public:
  /// `max_block`: as the engine's. `recorder` may be null.
  Player(Engine& engine, CommandQueue& queue, Recorder* recorder, double sample_rate, int max_block,
         const ScheduleSettings& settings);

  void render(const AudioBlock& block) noexcept override;

  /// From any thread: fades out for good; Engine::silenced() says when it is done.
  void finish() noexcept { finishing_.store(true, std::memory_order_relaxed); }

  /// From any thread.
  [[nodiscard]] PlayerCounters counters() const noexcept;

 private:
  void obey(const Command& command) noexcept;
  void set_silent(bool silent) noexcept;
  void play(const Command& command) noexcept;
  void render_parts(const AudioBlock& block) noexcept;
  void note_load(double seconds, double block_seconds) noexcept;

  Engine& engine_;
  CommandQueue& queue_;
  Recorder* recorder_;
  double sample_rate_;
  int max_block_;
  ScheduleSettings settings_;
  SampleClock clock_;
  std::vector<float*> part_;  ///< channels of a block's part
  double load_ = 0.0;         ///< averaged [1]
  Count blocks_;
  Count xruns_;
  Count late_;
  Count too_late_;
  Count early_;
  Count clock_resets_;
  Count voices_peak_;
  std::atomic<bool> finishing_{false};
  bool silent_ = false;  ///< because no sender is there
  Count load_average_ppm_;
  Count load_peak_ppm_;
};

}  // namespace splash::synth
