// SPDX-License-Identifier: MIT
// The real-time engine: timed events in, blocks of channels out. Knows events, voices and outputs;
// no operating system, no allocation after construction, no lock, no exception.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "protocol/event.hpp"
#include "synth-server/output/rig.hpp"
#include "synth-server/render/bubble_pool.hpp"
#include "synth-server/render/control_box.hpp"
#include "synth-server/render/counters.hpp"
#include "synth-server/render/underfoot.hpp"
#include "synth-server/voices/bubble_tone.hpp"

namespace splash::synth {

/// The kinds of events as bits, so that the sound of one, a component, can be rendered alone.
inline constexpr unsigned kAllComponents = (1U << protocol::kEventKinds) - 1U;
template <class Kind>
inline constexpr unsigned kComponent = 1U << protocol::kIndexOf<Kind>;
inline constexpr unsigned kImpacts = kComponent<protocol::Impact>;
inline constexpr unsigned kBubbles = kComponent<protocol::Bubble>;
inline constexpr unsigned kCavities = kComponent<protocol::Cavity>;

/// An event and the absolute sample of the engine's clock at which it starts.
struct TimedEvent {
  protocol::Event event;
  std::int64_t sample = 0;
  std::int32_t session = 0;  ///< of its sender, 0: not known; its impacts have noise of their own
};

/// A body is pushed from the cell of this sample on.
struct TimedPush {
  Push push;
  std::int64_t sample = 0;
};

/// What an engine is to play of a log, from the log's start; both in the order of their samples.
struct Score {
  std::vector<TimedEvent> events;
  std::vector<TimedPush> pushes;
};

/// 0: there is nothing to play.
[[nodiscard]] inline std::int64_t last_sample(const Score& score) noexcept {
  const std::int64_t event = score.events.empty() ? 0 : score.events.back().sample;
  return score.pushes.empty() ? event : std::max(event, score.pushes.back().sample);
}

/// Is told of each event at the sample at which it starts, and of each push at the beginning of the
/// cell in which it acts, from the rendering thread.
class StartWatch {
 public:
  virtual void started(const TimedEvent& event) noexcept = 0;
  virtual void pushed(const TimedPush& push) noexcept = 0;

 protected:
  ~StartWatch() = default;
};

struct EngineSettings {
  double sample_rate = 48000.0;        ///< [Hz], 8000 to 384000
  int max_block = 4096;                ///< most frames of one render call, 1 to 65536
  std::uint64_t seed = 1;              ///< of the impacts' noise
  Sound sound;                         ///< the paper's
  double water_level = kNoWaterLevel;  ///< z of the surface, for the depths of physical bubbles [m]
  double floor_level = kNoFloor;       ///< z of the floor, for bubbles near it [m]
  unsigned components = kAllComponents;
  InstructionSet instructions = InstructionSet::best;
  int max_voices = 4096;         ///< bubbles and cavities at once; above it the quietest fades out
  int max_impacts = 256;         ///< the same of impacts
  int max_scheduled = 16384;     ///< events waiting for their time
  double start_ramp = 2.0;       ///< fade-in of the first samples [s]; 0 for files
  bool skip_silent = true;       ///< leave silent channels uncomputed (same samples, less work)
  bool skip_out_of_band = true;  ///< leave bubbles out where they are born above the band
  bool skip_unfelt = true;       ///< end voices 20 dB below the threshold that the rig states
  StartWatch* watch = nullptr;   ///< may be null; outlives the engine
  ControlBox* controls = nullptr;  ///< what changes sound and levels; may be null; outlives it
};

/// Every method but counters() and silence() belongs to one thread, the rendering one.
/// The samples do not depend on how rendering is cut into blocks.
class Engine {
 public:
  /// Allocates all it will ever use. Throws std::invalid_argument naming the value and its limits.
  Engine(const Rig& rig, const EngineSettings& settings);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// False, and counted, when the event cannot be rendered or the queue is full. An event of the
  /// past starts with the next sample.
  bool schedule(const TimedEvent& timed) noexcept;

  /// For a while the body's events do not drive what is under the foot. Of more than kMostPushes
  /// that wait the last are left out.
  void push(const TimedPush& push) noexcept;
  static constexpr std::size_t kMostPushes = 512;

  struct Overtaken {
    std::uint64_t late = 0;      ///< due before the next sample: they start with it
    std::uint64_t too_late = 0;  ///< by more than the window: dropped
  };
  /// The samples to come sound this much later than was thought when events were scheduled: all
  /// that wait start so many samples earlier, to keep their moments. `late_window` [samples].
  Overtaken catch_up(std::int64_t samples, std::int64_t late_window) noexcept;

  /// Fills `frames` samples (up to max_block) of each channel: channels[c][i], in the rig's order.
  void render(float* const* channels, int frames) noexcept;

  /// Samples rendered so far.
  [[nodiscard]] std::int64_t clock() const noexcept;

  /// Drops all scheduled events and fades out the sounding voices.
  void clear() noexcept;

  /// From the next cell on no more bubbles and cavities at once than this, up to max_voices: the
  /// quietest of those beyond fade out.
  void limit_voices(int most) noexcept;

  /// Fades all channels out (20 ms) or in again; from any thread, heard in the next block.
  void silence(bool silent) noexcept;
  /// Whether the fade-out has reached nil: after it a device may be closed without a click.
  [[nodiscard]] bool silenced() const noexcept;

  /// From any thread.
  [[nodiscard]] EngineCounters counters() const noexcept;

  [[nodiscard]] int channels() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace splash::synth
