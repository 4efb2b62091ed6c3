// SPDX-License-Identifier: MIT
// Time is cut into cells of 64 samples at fixed multiples of the clock. All that is decided once in
// a while (whether a channel is at rest, how many voices may start) is decided per cell, and a cell
// may be rendered in pieces: that is why block sizes cannot be heard.
#include "synth-server/render/engine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "synth-server/output/fade.hpp"
#include "synth-server/output/output_guard.hpp"
#include "synth-server/render/ensemble.hpp"
#include "synth-server/render/event_queue.hpp"
#include "synth-server/render/live_controls.hpp"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace splash::synth {
namespace {

constexpr double kMostPlace = 1.0e6;  // [m]

void require(bool good, const std::string& name, double value, const std::string& limits) {
  if (good) return;
  throw std::invalid_argument("engine: " + name + " = " + std::to_string(value) + ": must be " +
                              limits);
}

/// The settings. Throws std::invalid_argument naming the setting, its value and its limits.
const EngineSettings& checked(const EngineSettings& s) {
  require(s.sample_rate >= 8000.0 && s.sample_rate <= 384000.0, "sample_rate", s.sample_rate,
          "8000 to 384000 Hz");
  require(s.max_block >= 1 && s.max_block <= 65536, "max_block", s.max_block, "1 to 65536 frames");
  require(s.max_voices >= 1 && s.max_voices <= 131072, "max_voices", s.max_voices, "1 to 131072");
  require(s.max_impacts >= 1 && s.max_impacts <= 4096, "max_impacts", s.max_impacts, "1 to 4096");
  require(s.water_level <= kMostPlace, "water_level", s.water_level, "at most 1000000 m");
  require(s.floor_level <= kMostPlace, "floor_level", s.floor_level, "at most 1000000 m");
  require(s.max_scheduled >= 1 && s.max_scheduled <= (1 << 20), "max_scheduled", s.max_scheduled,
          "1 to 1048576");
  for (const double number : numbers_of(s.sound)) {
    require(std::isfinite(number), "number of the sound", number, "finite");
  }
  require(s.sound.impact.frequency < 0.5 * s.sample_rate, "sound.impact.frequency",
          s.sound.impact.frequency, "under half the sample rate");
  require(s.start_ramp >= 0.0 && s.start_ramp <= 60.0, "start_ramp", s.start_ramp, "0 to 60 s");
  return s;
}

const Rig& checked(const Rig& rig, double sample_rate) {
  check(rig);
  for (const Output& output : rig.outputs) {
    if (output.band.low < 0.45 * sample_rate) continue;  // a high-pass beyond Nyquist blows up
    throw std::invalid_argument(
        "output '" + output.name + "': band.low = " + std::to_string(output.band.low) +
        " Hz: must be under 0.45 of the sample rate, " + std::to_string(sample_rate) + " Hz");
  }
  return rig;
}

/// Denormal numbers count as nil while this lives: dying filters would otherwise cost many times
/// their time on some processors. The setting is the thread's, so it is put back afterwards.
class FlushDenormals {
 public:
#if defined(__SSE2__)
  FlushDenormals() noexcept : saved_(_mm_getcsr()) {
    _mm_setcsr(saved_ | kFlushAndZero);
  }
  ~FlushDenormals() {
    _mm_setcsr(saved_);
  }
#elif defined(__aarch64__)
  FlushDenormals() noexcept {
    asm volatile("mrs %0, fpcr" : "=r"(saved_));
    asm volatile("msr fpcr, %0" ::"r"(saved_ | (std::uint64_t{1} << 24U)));
  }
  ~FlushDenormals() {
    asm volatile("msr fpcr, %0" ::"r"(saved_));
  }
#else
  FlushDenormals() noexcept = default;
  ~FlushDenormals() {
    static_cast<void>(saved_);
  }
#endif
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
#if defined(__SSE2__)
  static constexpr unsigned kFlushAndZero = 0x8040U;  ///< FTZ (bit 15) and DAZ (bit 6) of MXCSR
  unsigned saved_;
#else
  std::uint64_t saved_ = 0;
#endif
};

}  // namespace

struct Engine::State {
  State(const Rig& rig, const EngineSettings& s);

  void begin_cell() noexcept;
  void render_piece(float* const* channels, int done, int count) noexcept;
  void guard_channel(std::size_t channel, float* out, int count) noexcept;
  void end_cell() noexcept;

  EngineSettings settings;
  LiveControls controls;
  Ensemble ensemble;
  EventQueue queue;
  std::vector<TimedPush> pushes;  ///< that wait for their cell
  Mix mix;
  std::vector<OutputGuard> guards;
  std::vector<char> idle;  ///< per channel: its guard is at rest
  Fade fade;
  std::array<double, kCell> fade_gains{};
  std::array<double, kCell> ceilings{};
  std::int64_t clock = 0;
  int most_voices;  ///< that the load leaves room for
  std::atomic<bool> silent{false};
  std::atomic<bool> silenced{false};
  std::atomic<std::int64_t> shown_clock{0};
  struct Counts {
    Count voices, scheduled, late, refused, queue, muted, cleared, skipped, cells, resets, limited;
    protocol::ByKind<Count> without_place;
  } counts;
};

Engine::State::State(const Rig& rig, const EngineSettings& s)
    : settings(checked(s)),
      controls(rig, s.sound, s.sample_rate, s.controls),
      ensemble(checked(rig, s.sample_rate), s),
      queue(s.max_scheduled),
      mix(static_cast<std::size_t>(channel_count(rig))),
      fade(s.start_ramp, s.sample_rate),
      most_voices(s.max_voices) {
  for (const Output& output : rig.outputs) {
    for (int c = 0; c < channel_count(output); ++c) guards.emplace_back(output, s.sample_rate, c);
  }
  idle.assign(guards.size(), 1);
  pushes.reserve(kMostPushes);
}

void Engine::State::begin_cell() noexcept {
  controls.begin_cell();
  ensemble.follow(controls);
  ensemble.limit(most_voices, clock);
  for (std::size_t k = 0; k < protocol::kEventKinds; ++k) {
    mix.gains.values[k] = controls.component(k);
  }
  std::erase_if(pushes, [this](const TimedPush& waiting) {
    if (waiting.sample >= clock + kCell) return false;
    if (settings.watch != nullptr) settings.watch->pushed({waiting.push, clock});
    ensemble.press(waiting.push, clock);
    return true;
  });
}

/// `count` samples from the clock on, within one cell; `done`: samples of the block before them.
void Engine::State::render_piece(float* const* channels, int done, int count) noexcept {
  const std::int64_t end = clock + count;
  if (clock % kCell == 0) begin_cell();
  while (queue.due(end)) {
    const EventQueue::Waiting next = queue.pop();
    const std::int64_t sample = std::max(next.sample, clock);
    if (next.sample < clock) counts.late.add();
    if (settings.watch != nullptr) settings.watch->started({next.event, sample, next.session});
    ensemble.start({next.event, sample, next.session});
  }
  ensemble.mix(clock, end, mix);
  const bool open = !silent.load(std::memory_order_relaxed);
  for (int i = 0; i < count; ++i) fade_gains[static_cast<std::size_t>(i)] = fade.next(open);
  for (std::size_t c = 0; c < guards.size(); ++c) guard_channel(c, channels[c] + done, count);
  clock = end;
  if (clock % kCell == 0) end_cell();
}

void Engine::State::guard_channel(std::size_t channel, float* out, int count) noexcept {
  if (settings.skip_silent && idle[channel] != 0 && mix.touched[channel] == 0) {
    std::fill_n(out, count, 0.0F);
    return;
  }
  const auto first = static_cast<int>(clock % kCell);
  double* const in = mix.samples.data() + channel * kCell + static_cast<std::size_t>(first);
  const CellGain& gain = controls.channel(channel);
  for (int n = 0; n < count && !gain.is_one(); ++n) in[n] *= gain.at(first + n);
  const double* limits = nullptr;
  if (!controls.has_rigs_ceiling(channel)) {
    const CellGain& ceiling = controls.ceiling(channel);
    for (int n = 0; n < count; ++n) ceilings[static_cast<std::size_t>(n)] = ceiling.at(first + n);
    limits = ceilings.data();
  }
  guards[channel].process(in, fade_gains.data(), out, count, limits);
}

/// The cell is complete: find the channels that have come to rest, and begin the next one.
void Engine::State::end_cell() noexcept {
  ensemble.end_cell(clock);
  std::uint64_t skipped = 0;
  std::uint64_t resets = 0;
  std::uint64_t limited = 0;
  for (std::size_t c = 0; c < guards.size(); ++c) {
    if (mix.touched[c] != 0) {
      idle[c] = 0;
      mix.touched[c] = 0;
      std::fill_n(mix.samples.begin() + static_cast<std::ptrdiff_t>(c * kCell), kCell, 0.0);
    } else if (idle[c] == 0) {
      idle[c] = guards[c].settle() ? 1 : 0;
    } else if (settings.skip_silent) {
      ++skipped;
    }
    resets += guards[c].resets();
    limited += guards[c].limited();
  }
  counts.skipped.add(skipped);
  counts.resets.set(resets);
  counts.limited.set(limited);
  counts.cells.add();
}

Engine::Engine(const Rig& rig, const EngineSettings& settings)
    : state_(std::make_unique<State>(rig, settings)) {}

Engine::~Engine() = default;

bool Engine::schedule(const TimedEvent& timed) noexcept {
  auto& counts = state_->counts;
  if ((state_->settings.components & (1U << timed.event.index())) == 0) {
    counts.muted.add();
    return false;
  }
  if (!protocol::conforms(timed.event)) {
    counts.refused.add();
    return false;
  }
  if (!state_->queue.push(timed.event, timed.sample, timed.session)) {
    counts.queue.add();
    counts.without_place.of(timed.event).add();
    return false;
  }
  counts.scheduled.set(state_->queue.size());
  return true;
}

void Engine::push(const TimedPush& push) noexcept {
  if (state_->pushes.size() < kMostPushes) state_->pushes.push_back(push);
}

Engine::Overtaken Engine::catch_up(std::int64_t samples, std::int64_t late_window) noexcept {
  State& s = *state_;
  Overtaken overtaken;
  s.queue.advance(samples);
  for (TimedPush& waiting : s.pushes) waiting.sample -= samples;
  while (s.queue.due(s.clock - late_window)) {
    (void)s.queue.pop();
    ++overtaken.too_late;
  }
  overtaken.late = s.queue.count_before(s.clock);
  s.counts.scheduled.set(s.queue.size());
  return overtaken;
}

void Engine::render(float* const* channels, int frames) noexcept {
  const FlushDenormals flush;
  State& s = *state_;
  const int wanted = std::clamp(frames, 0, s.settings.max_block);
  for (int done = 0; done < wanted;) {
    const int left = kCell - static_cast<int>(s.clock % kCell);
    const int count = std::min(wanted - done, left);
    s.render_piece(channels, done, count);
    done += count;
  }
  s.silenced.store(s.fade.closed(), std::memory_order_relaxed);
  s.counts.voices.set(s.ensemble.voices());
  s.counts.scheduled.set(s.queue.size());
  s.shown_clock.store(s.clock, std::memory_order_relaxed);
}

std::int64_t Engine::clock() const noexcept {
  return state_->shown_clock.load(std::memory_order_relaxed);
}

void Engine::clear() noexcept {
  state_->counts.cleared.add(state_->queue.size());
  state_->queue.clear();
  state_->pushes.clear();
  state_->counts.scheduled.set(0);
  state_->ensemble.fade_all(state_->clock);
}

void Engine::limit_voices(int most) noexcept {
  state_->most_voices = most;
}

void Engine::silence(bool silent) noexcept {
  state_->silent.store(silent, std::memory_order_relaxed);
}

bool Engine::silenced() const noexcept {
  return state_->silenced.load(std::memory_order_relaxed);
}

EngineCounters Engine::counters() const noexcept {
  const auto& c = state_->counts;
  const auto& e = state_->ensemble.counts();
  EngineCounters all{.voices = c.voices.get(),
                     .scheduled = c.scheduled.get(),
                     .late = c.late.get(),
                     .stolen = e.stolen.get(),
                     .dropped_refused = c.refused.get(),
                     .dropped_queue = c.queue.get(),
                     .dropped_pool = e.pool.get(),
                     .dropped_band = e.band.get(),
                     .dropped_unheard = e.unheard.get(),
                     .dropped_muted = c.muted.get(),
                     .dropped_cleared = c.cleared.get(),
                     .channels_skipped = c.skipped.get(),
                     .cells = c.cells.get(),
                     .resets = c.resets.get(),
                     .limited = c.limited.get(),
                     .crowded = e.crowded.get()};
  for (std::size_t k = 0; k < protocol::kEventKinds; ++k) {
    all.started.values[k] = e.started.values[k].get();
    all.without_place.values[k] = c.without_place.values[k].get() + e.without_place.values[k].get();
  }
  return all;
}

int Engine::channels() const noexcept {
  return static_cast<int>(state_->guards.size());
}

}  // namespace splash::synth
