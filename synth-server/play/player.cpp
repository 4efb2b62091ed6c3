// SPDX-License-Identifier: MIT
#include "synth-server/play/player.hpp"

#include <algorithm>
#include <cmath>

namespace splash::synth {
namespace {

/// The load is averaged over this [s].
constexpr double kLoadSpan = 1.0;
constexpr double kPartsPerMillion = 1e6;
/// Callbacks are late on a busy machine; when so much later, samples were lost, too [s].
constexpr double kStall = 0.25;

}  // namespace

Player::Player(Engine& engine, CommandQueue& queue, Recorder* recorder,
               const PlayerSettings& settings)
    : engine_(engine),
      queue_(queue),
      recorder_(recorder),
      settings_(settings),
      schedule_(settings.schedule),
      clock_(settings.sample_rate),
      tone_(settings.tones, settings.sample_rate),
      gate_(settings.start_ramp, settings.sample_rate, !settings.muted),
      meter_(engine.channels(), settings.sample_rate),
      part_(static_cast<std::size_t>(engine.channels())),
      governor_(settings.max_voices) {}

void Player::render(const AudioBlock& block) noexcept {
  const double start = settings_.now();
  if (block.restart || blocks_.get() == 0) take_device(block);
  follow(block);
  queue_.consume_all([this](const Command& command) { obey(command); });
  if (finishing_.load(std::memory_order_relaxed)) {
    engine_.silence(true);
    tone_.choose(LiveTone::kNone);
  }
  render_parts(block);
  const std::uint64_t voices = engine_.counters().voices;
  voices_peak_.set(std::max(voices_peak_.get(), voices));
  blocks_.add();
  const double block_seconds = block.frames / settings_.sample_rate;
  const double seconds = settings_.now() - start;
  note_load(seconds, block_seconds);
  engine_.limit_voices(governor_.note(seconds / block_seconds, block_seconds, voices));
}

/// The first block of a device, which may have another size than the last one's.
void Player::take_device(const AudioBlock& block) noexcept {
  if (blocks_.get() != 0) gate_.restart();
  schedule_.latency = latency_for(settings_.schedule.latency, block.frames, settings_.sample_rate);
  latency_shown_ = schedule_.latency;
}

/// The sample clock goes with the device. Where samples were lost (an xrun, another device, a
/// machine that stood still), what waits in the engine keeps its moment, not its sample.
void Player::follow(const AudioBlock& block) noexcept {
  if (block.xrun) xruns_.add();
  const std::uint64_t resets = clock_.resets();
  const double expected = clock_.sample_at(block.time);
  if (block.xrun || block.restart) clock_.reset();
  clock_.update(block.time, engine_.clock(), block.frames);
  if (clock_.resets() == resets) return;
  clock_resets_.set(clock_.resets());
  const double lost = expected - static_cast<double>(engine_.clock());  // [samples]
  const bool late_only = !block.xrun && !block.restart;                 // callbacks, not samples
  if (late_only && std::abs(lost) < kStall * settings_.sample_rate) return;
  const Engine::Overtaken overtaken = engine_.catch_up(
      std::llround(lost), std::llround(schedule_.late_window * settings_.sample_rate));
  late_.add(overtaken.late);
  too_late_.add(overtaken.too_late);
}

void Player::obey(const Command& command) noexcept {
  switch (command.kind) {
    case Command::Kind::play:
      return play(command);
    case Command::Kind::push:
      return push(command);
    case Command::Kind::clear_scheduled:
      return engine_.clear();
    case Command::Kind::mute:
      return gate_.open(false);
    case Command::Kind::unmute:
      return gate_.open(true);
    case Command::Kind::tone:
      return tone_.choose(command.channel, command.share);
  }
}

void Player::play(const Command& command) noexcept {
  const Placement placement =
      command.at_once
          ? place_at_once(command.offset, engine_.clock(), settings_.sample_rate, schedule_)
          : place(command.moment, command.by_arrival, clock_, engine_.clock(), schedule_);
  switch (placement.timing) {
    case Timing::too_late:
      return too_late_.add();
    case Timing::late:
      late_.add();
      break;
    case Timing::early:
      early_.add();
      break;
    case Timing::on_time:
      break;
  }
  // The engine counts what it refuses.
  (void)engine_.schedule({command.event, placement.sample, command.session});
}

/// One that is too late is left out: the next one comes soon.
void Player::push(const Command& command) noexcept {
  const Placement placement =
      place(command.moment, command.by_arrival, clock_, engine_.clock(), schedule_);
  if (placement.timing != Timing::too_late) engine_.push({command.push, placement.sample});
}

void Player::render_parts(const AudioBlock& block) noexcept {
  for (int done = 0; done < block.frames;) {
    const int frames = std::min(settings_.max_block, block.frames - done);
    for (std::size_t c = 0; c < part_.size(); ++c) part_[c] = block.channels[c] + done;
    if (settings_.track != nullptr) settings_.track->give(engine_, engine_.clock() + frames);
    engine_.render(part_.data(), frames);
    tone_.process(part_.data(), frames);
    gate_.process(part_.data(), static_cast<int>(part_.size()), frames);
    meter_.note(part_.data(), frames);
    if (recorder_ != nullptr) recorder_->push(part_.data(), frames);
    if (settings_.monitor != nullptr) {  // a block is played when the next one is asked for
      settings_.monitor->push(part_.data(), frames,
                              block.time + (block.frames + done) / settings_.sample_rate,
                              settings_.sample_rate);
    }
    done += frames;
  }
}

void Player::note_load(double seconds, double block_seconds) noexcept {
  const double load = seconds / block_seconds;
  load_ += (load - load_) * std::min(1.0, block_seconds / kLoadSpan);
  load_average_ppm_.set(static_cast<std::uint64_t>(load_ * kPartsPerMillion));
  const auto ppm = static_cast<std::uint64_t>(load * kPartsPerMillion);
  if (ppm > load_peak_ppm_.get()) load_peak_ppm_.set(ppm);
}

PlayerCounters Player::counters() const noexcept {
  return {blocks_.get(),
          xruns_.get(),
          late_.get(),
          too_late_.get(),
          early_.get(),
          clock_resets_.get(),
          voices_peak_.get(),
          static_cast<double>(load_average_ppm_.get()) / kPartsPerMillion,
          static_cast<double>(load_peak_ppm_.get()) / kPartsPerMillion,
          static_cast<std::uint64_t>(governor_.limit()),
          governor_.lowered()};
}

}  // namespace splash::synth
