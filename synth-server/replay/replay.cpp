// SPDX-License-Identifier: MIT
#include "synth-server/replay/replay.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "protocol/force_changes.hpp"
#include "synth-server/output/fade.hpp"

namespace splash::synth {
namespace {

/// What rings out is looked at so often [s].
constexpr double kStep = 0.1;
constexpr float kSilent = 1e-7F;  ///< -140 dB of full scale

/// Renders block after block, handing the engine its events and pushes as their samples come near.
class Player {
 public:
  Player(const Score& score, Engine& engine, int block, const BlockSink& sink)
      : score_(score),
        engine_(engine),
        block_(block),
        sink_(sink),
        samples_(static_cast<std::size_t>(engine.channels()) * static_cast<std::size_t>(block)) {
    for (int c = 0; c < engine.channels(); ++c) {
      channels_.push_back(samples_.data() + static_cast<std::ptrdiff_t>(c) * block);
    }
  }

  /// Whether voices are left, or the samples since this was last asked can be told from silence.
  [[nodiscard]] bool sounds() {
    return engine_.counters().voices > 0 || std::exchange(peak_, 0.0F) > kSilent;
  }

  void play_until(std::int64_t end) {
    while (engine_.clock() < end) {
      const auto frames = static_cast<int>(std::min<std::int64_t>(block_, end - engine_.clock()));
      const std::int64_t next = engine_.clock() + frames;
      const auto& [events, pushes] = score_;
      while (next_ < events.size() && events[next_].sample < next)
        engine_.schedule(events[next_++]);
      // A push acts from the beginning of its cell on, which may lie before its sample.
      while (next_push_ < pushes.size() && pushes[next_push_].sample < next + kCell) {
        engine_.push(pushes[next_push_++]);
      }
      engine_.render(channels_.data(), frames);
      note_peak(frames);
      sink_(channels_.data(), frames);
    }
  }

 private:
  void note_peak(int frames) {
    for (const float* channel : channels_) {
      for (int i = 0; i < frames; ++i) peak_ = std::max(peak_, std::abs(channel[i]));
    }
  }

  const Score& score_;
  Engine& engine_;
  int block_;
  const BlockSink& sink_;
  std::vector<float> samples_;
  std::vector<float*> channels_;
  std::size_t next_ = 0;       ///< of the events
  std::size_t next_push_ = 0;  ///< of the pushes
  float peak_ = 0.0F;          ///< since it was last asked for [full scale]
};

}  // namespace

Score score_of(const std::vector<protocol::LogEntry>& log, double sample_rate,
               std::uint64_t& others) {
  Score score;
  protocol::ForceChanges forces;
  others = 0;
  for (const protocol::LogEntry& entry : log) {
    const auto frame =
        entry.messages.empty() ? std::nullopt : protocol::to_frame(entry.messages.front());
    const std::int32_t session = frame ? frame->session : 0;
    const auto push = [&](const protocol::Push& found) {
      score.pushes.push_back({found, protocol::start_sample(entry.seconds, 0.0F, sample_rate)});
    };
    for (const protocol::Message& message : entry.messages) {
      const std::optional<protocol::Event> event = protocol::to_event(message);
      if (!event) {
        ++others;
        if (const auto found = protocol::to_push(message)) push(*found);
        continue;
      }
      const float offset = std::visit([](const auto& kind) { return kind.offset_ms; }, *event);
      score.events.push_back(
          {*event, protocol::start_sample(entry.seconds, offset, sample_rate), session});
    }
    for (const protocol::Push& found : forces.take(entry.messages, entry.seconds)) push(found);
  }
  std::stable_sort(score.events.begin(), score.events.end(),
                   [](const TimedEvent& a, const TimedEvent& b) { return a.sample < b.sample; });
  return score;
}

ReplayReport replay(const std::vector<protocol::LogEntry>& log, const Rig& rig,
                    const ReplaySettings& settings, const BlockSink& sink) {
  if (settings.tail && !(*settings.tail >= 0.0 && *settings.tail <= 3600.0)) {
    throw std::invalid_argument("replay: tail = " + std::to_string(*settings.tail) +
                                " s: must be 0 to 3600 s");
  }
  ReplayReport report;
  EngineSettings engine_settings = settings.engine;
  engine_settings.start_ramp = settings.fade_in;
  engine_settings.max_block = settings.block;
  const double rate = engine_settings.sample_rate;
  Engine engine(rig, engine_settings);
  const Score score = score_of(log, rate, report.not_events);
  report.events = score.events.size();
  const std::int64_t last = last_sample(score);
  const std::int64_t fade = std::llround(Fade::kSeconds * rate);
  const std::int64_t total = last + std::llround(settings.tail.value_or(kLongestRing) * rate);
  const std::int64_t end = std::max<std::int64_t>(0, total - fade);
  Player player(score, engine, settings.block, sink);
  player.play_until(settings.tail ? end : std::min(end, last + 1));
  const std::int64_t step = std::llround(kStep * rate);
  while (!settings.tail && engine.clock() < end && player.sounds()) {
    player.play_until(std::min(end, engine.clock() + step));
  }
  engine.silence(true);
  player.play_until(std::min(total, engine.clock() + fade));
  report.frames = engine.clock();
  report.counters = engine.counters();
  return report;
}

}  // namespace splash::synth
