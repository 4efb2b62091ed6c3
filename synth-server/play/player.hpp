// SPDX-License-Identifier: MIT
// The audio callback's work: take what the receiver sent, give each event its sample, render, open
// or close the gate, measure, record. It neither waits nor allocates; everybody else reads its
// counts.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "protocol/time_tag.hpp"
#include "synth-server/audio/audio_output.hpp"
#include "synth-server/audio/recorder.hpp"
#include "synth-server/output/fade.hpp"
#include "synth-server/play/command_queue.hpp"
#include "synth-server/play/governor.hpp"
#include "synth-server/play/live_tone.hpp"
#include "synth-server/play/meter.hpp"
#include "synth-server/play/sample_clock.hpp"
#include "synth-server/play/track.hpp"
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
  std::uint64_t most_voices = 0;   ///< that may sound at once now: fewer where the load is high
  std::uint64_t lowered = 0;       ///< times that number was lowered
};

struct PlayerSettings {
  double sample_rate = 48000.0;  ///< [Hz]
  int max_block = 4096;          ///< as the engine's [frames]
  double start_ramp = 2.0;       ///< of the gate [s]
  bool muted = false;            ///< until /mute 0 comes
  ScheduleSettings schedule;
  BlockTap* monitor = nullptr;                          ///< for viewers; null: none
  Track* track = nullptr;                               ///< a log that is played; null: none
  int max_voices = 4096;                                ///< the engine's
  double (*now)() noexcept = &protocol::monotonic_now;  ///< by which the load is measured [s]
  std::vector<Tone> tones = {};  ///< of each channel, for tests of the transducers
};

/// Off until it is started: the gate behind the engine opens within two seconds at the start, when
/// a device came back and when it was muted; it closes in 20 ms. It only ever takes away.
class Gate {
 public:
  /// `ramp`: of every opening [s]; 0: open from the first sample on. `sample_rate` [Hz].
  Gate(double ramp, double sample_rate, bool open) noexcept
      : ramp_(ramp),
        sample_rate_(sample_rate),
        open_(open),
        fade_(open ? ramp : std::max(ramp, Fade::kSeconds), sample_rate) {}

  void open(bool open) noexcept {
    if (open && !open_ && fade_.closed()) restart();
    open_ = open;
  }
  /// Closed at once, to open slowly: for a device that has heard nothing yet.
  void restart() noexcept { fade_ = Fade(ramp_, sample_rate_); }

  [[nodiscard]] bool is_open() const noexcept { return open_; }

  /// Multiplies channels[c][i] with the gate's gain.
  void process(float* const* channels, int count, int frames) noexcept {
    if (open_ && fade_.opened()) return;
    for (int i = 0; i < frames; ++i) {
      const auto gain = static_cast<float>(fade_.next(open_));
      for (int c = 0; c < count; ++c) channels[c][i] *= gain;
    }
  }

 private:
  double ramp_;
  double sample_rate_;
  bool open_;
  Fade fade_;
};

class Player final : public BlockSource {
 public:
  /// `recorder` may be null.
  Player(Engine& engine, CommandQueue& queue, Recorder* recorder, const PlayerSettings& settings);

  void render(const AudioBlock& block) noexcept override;

  /// From any thread: fades out for good; Engine::silenced() says when it is done.
  void finish() noexcept { finishing_.store(true, std::memory_order_relaxed); }

  /// From any thread.
  [[nodiscard]] PlayerCounters counters() const noexcept;
  [[nodiscard]] const Meter& meter() const noexcept { return meter_; }
  /// Added to every time tag; follows the device's block when that changes [s].
  [[nodiscard]] double latency() const noexcept { return latency_shown_; }

 private:
  void take_device(const AudioBlock& block) noexcept;
  void follow(const AudioBlock& block) noexcept;
  void obey(const Command& command) noexcept;
  void play(const Command& command) noexcept;
  void push(const Command& command) noexcept;
  void render_parts(const AudioBlock& block) noexcept;
  void note_load(double seconds, double block_seconds) noexcept;

  Engine& engine_;
  CommandQueue& queue_;
  Recorder* recorder_;
  PlayerSettings settings_;
  ScheduleSettings schedule_;  ///< with the latency that this device's blocks need
  SampleClock clock_;
  LiveTone tone_;
  Gate gate_;
  Meter meter_;
  std::vector<float*> part_;  ///< channels of a block's part
  double load_ = 0.0;         ///< averaged [1]
  Governor governor_;
  Count blocks_;
  Count xruns_;
  Count late_;
  Count too_late_;
  Count early_;
  Count clock_resets_;
  Count voices_peak_;
  std::atomic<bool> finishing_{false};
  Count load_average_ppm_;
  Count load_peak_ppm_;
  std::atomic<double> latency_shown_{0.0};
};

}  // namespace splash::synth
