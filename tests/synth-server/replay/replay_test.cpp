// SPDX-License-Identifier: MIT
// A log rendered twice is the same twice, in any blocks; its events start where it says.
#include "synth-server/replay/replay.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "program/failure.hpp"
#include "synth-server/play/track.hpp"
#include "synth-server/replay/event_recorder.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/synth-server/render/rendering.hpp"

namespace splash::synth {
namespace {

std::vector<protocol::LogEntry> log_of_splashes() {
  std::vector<protocol::LogEntry> log;
  std::int32_t step = 0;
  for (const TimedEvent& timed : splashes(300, 48000)) {
    protocol::LogEntry entry;
    entry.seconds = static_cast<double>(timed.sample) / kRate;
    entry.messages.push_back(protocol::to_message(protocol::Frame{1, step, step, 0.0F}));
    entry.messages.push_back(protocol::to_message(timed.event));
    log.push_back(entry);
    ++step;
  }
  std::stable_sort(log.begin(), log.end(),
                   [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  return log;
}

Channels play(const std::vector<protocol::LogEntry>& log, const Rig& rig, ReplaySettings settings,
              ReplayReport* report = nullptr) {
  Channels out(static_cast<std::size_t>(channel_count(rig)));
  const auto result = replay(log, rig, settings, [&](const float* const* channels, int frames) {
    for (std::size_t c = 0; c < out.size(); ++c) {
      out[c].insert(out[c].end(), channels[c], channels[c] + frames);
    }
  });
  if (report != nullptr) *report = result;
  return out;
}

TEST(Replay, IsBitIdenticalTwiceAndInAnyBlocks) {
  const auto log = log_of_splashes();
  ReplaySettings settings;
  ReplayReport report;
  const auto first = play(log, floor_rig(), settings, &report);
  EXPECT_EQ(report.events, 300U);
  EXPECT_EQ(report.not_events, 300U);
  EXPECT_EQ(report.counters.late, 0U);
  EXPECT_EQ(report.frames, static_cast<std::int64_t>(first[0].size()));
  EXPECT_EQ(play(log, floor_rig(), settings), first);
  for (const int block : {1, 100, 4096}) {
    settings.block = block;
    EXPECT_EQ(play(log, floor_rig(), settings), first) << block;
  }
  settings.engine.seed = 2;
  EXPECT_NE(play(log, floor_rig(), settings), first) << "the impacts' noise follows the seed";
}

/// A body over the floor whose force changes by more and more from frame to frame.
std::vector<protocol::LogEntry> log_of_forces() {
  std::vector<protocol::LogEntry> log;
  for (int i = 0; i < 160; ++i) {
    const float x = 0.01F * static_cast<float>(i);
    const float fz = 0.05F * static_cast<float>(i * i % 97);
    log.push_back({0.00625 * i,
                   {protocol::to_message(protocol::Frame{7, i, i, 0.0F}),
                    {"/body/at", {2, x, 0.9F, 0.0F, 0.0F, 0.0F, 0.0F, 1.0F}},
                    {"/force", {2, 0.0F, 0.0F, fz, 0.0F, 0.0F, 0.0F}}}});
  }
  return log;
}

EngineSettings texture_settings() {
  auto settings = file_settings();
  settings.sound.foot.texture = 1e-3;
  return settings;
}

TEST(Replay, LetsForcesBeFeltInAnyBlocks) {
  ReplaySettings settings;
  settings.engine = texture_settings();
  ReplayReport report;
  const Channels felt = play(log_of_forces(), floor_rig(), settings, &report);
  EXPECT_EQ(report.events, 0U);
  EXPECT_GT(report.frames, 48000) << "to the last force, and until it has died away";
  const auto force_of = [](std::int64_t i) { return 0.05 * static_cast<double>(i * i % 97); };
  Engine engine(floor_rig(), texture_settings());
  for (std::int64_t i = 1; i < 160; ++i) {
    const auto rate = static_cast<float>(std::abs(force_of(i) - force_of(i - 1)) / 0.00625);
    engine.push({{{0.01F * static_cast<float>(i), 0.9F, 0.0F}, 2, rate}, 300 * i});
  }
  const Channels wanted = render(engine, 48000);
  double difference = 0.0;
  double all = 0.0;
  for (std::size_t c = 0; c < wanted.size(); ++c) {
    for (std::size_t n = 0; n < wanted[c].size(); ++n) {
      difference = std::max(difference, std::abs(static_cast<double>(felt[c][n] - wanted[c][n])));
      all = std::max(all, std::abs(static_cast<double>(wanted[c][n])));
    }
  }
  EXPECT_GT(all, 0.01);
  EXPECT_LT(difference, 1e-5 * all) << "but for the rounding of force and time";
  for (const int block : {1, 100, 4096}) {
    settings.block = block;
    EXPECT_EQ(play(log_of_forces(), floor_rig(), settings), felt) << block;
  }
}

TEST(Replay, AloudFeelsTheSame) {
  std::vector<protocol::LogEntry> log = log_of_forces();
  for (const protocol::LogEntry& entry : log_of_splashes()) log.push_back(entry);
  std::stable_sort(log.begin(), log.end(),
                   [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  std::uint64_t others = 0;
  Engine engine(floor_rig(), texture_settings());
  Track track(score_of(log, kRate, others), 0, 0);
  Channels aloud(36);
  while (engine.clock() < 48000) {
    track.give(engine, engine.clock() + 100);
    const Channels block = render(engine, 100);
    for (std::size_t c = 0; c < block.size(); ++c) {
      aloud[c].insert(aloud[c].end(), block[c].begin(), block[c].end());
    }
  }
  ReplaySettings settings;
  settings.engine = texture_settings();
  Channels rendered = play(log, floor_rig(), settings);
  for (auto& channel : rendered) channel.resize(aloud[0].size());
  EXPECT_EQ(aloud, rendered);
}

TEST(Replay, OfARecordingGivesTheSameSamplesWithForcesToo) {
  const tests::TemporaryFolder folder;
  const auto path = folder / "forces.osc";
  EventRecorder recorder(path, static_cast<int>(kRate));
  auto settings = texture_settings();
  settings.watch = &recorder;
  Engine engine(floor_rig(), settings);
  for (const TimedEvent& event : splashes(100, 40000)) engine.schedule(event);
  for (int i = 0; i < 300; ++i) {
    const auto rate = static_cast<float>(1e4 / (1 + i));
    const std::int64_t sample = std::int64_t{133} * i;
    engine.push({{{0.006F * static_cast<float>(i), 0.3F, 0.0F}, i % 4, rate}, sample});
  }
  const Channels live = render(engine, 48000);
  recorder.finish();
  EXPECT_EQ(recorder.lost(), 0U);
  const auto log = protocol::read_log(path);
  ReplaySettings again;
  again.engine = texture_settings();
  ReplayReport report;
  Channels replayed = play(log, floor_rig(), again, &report);
  EXPECT_EQ(report.events, 100U);
  EXPECT_EQ(report.not_events, 300U);
  for (auto& channel : replayed) channel.resize(live[0].size());
  EXPECT_EQ(replayed, live);
}

TEST(Replay, StartsEventsAtTheirTimeAndOffsetAndLastsForTheTail) {
  protocol::Bubble event = bubble(0.005F);
  event.offset_ms = 2.5F;
  const std::vector<protocol::LogEntry> log = {{0.5, {protocol::to_message(event)}}};
  ReplaySettings settings;
  settings.tail = 0.25;
  const auto out = play(log, open_rig(), settings).front();
  const std::size_t start = 24000 + 120;
  EXPECT_EQ(out.size(), start + 12000);
  for (std::size_t n = 0; n <= start; ++n) ASSERT_EQ(out[n], 0.0F);
  EXPECT_GT(out[start + 1], 0.0F);
}

TEST(Replay, EndsInSilence) {
  const std::vector<protocol::LogEntry> log = {{0.0, {protocol::to_message(cavity(0.1F))}}};
  ReplaySettings settings;
  settings.tail = 0.5;
  const auto out = play(log, open_rig(), settings).front();
  EXPECT_NEAR(out.back(), 0.0F, 1e-4F);
  EXPECT_GT(std::abs(*std::max_element(out.end() - 4800, out.end() - 1000)), 0.05F);
}

TEST(Replay, RingsOutUntilAllIsSilentButNotForEver) {
  Rig rig = open_rig();
  rig.outputs[0].band.low = 20.0;  // so that its filters come to rest soon
  const auto length = [&](const protocol::Event& event) {
    const auto out = play({{0.5, {protocol::to_message(event)}}}, rig, {}).front();
    EXPECT_LT(std::abs(out.back()), 1e-6F);
    return static_cast<double>(out.size()) / kRate - 0.5;
  };
  EXPECT_LT(length(bubble(0.005F)), 1.0) << "60 dB in 0.15 s";
  EXPECT_GT(length(cavity(0.1F)), 4.5) << "60 dB in 4.5 s";
  EXPECT_LE(length(cavity(1.0F)), kLongestRing) << "60 dB in a minute and a half";
}

TEST(Replay, GivesImpactsOfTwoSessionsNoiseOfTheirOwn) {
  const auto burst = [](std::int32_t session) {
    std::vector<protocol::Message> messages;
    if (session != 0) {
      messages.push_back(protocol::to_message(protocol::Frame{session, 0, 0, 0.0F}));
    }
    messages.push_back(protocol::to_message(impact(1.0F, 7)));
    ReplaySettings settings;
    settings.tail = 0.5;
    return play({{0.0, messages}}, open_rig(), settings).front();
  };
  const auto product = [](const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0.0;
    for (std::size_t n = 0; n < a.size(); ++n) {
      sum += static_cast<double>(a[n]) * static_cast<double>(b[n]);
    }
    return sum;
  };
  const auto one = burst(1);
  EXPECT_EQ(burst(1), one);
  for (const std::int32_t other : {0, 2, 16777215}) {
    const auto two = burst(other);
    const double alike = product(one, two) / std::sqrt(product(one, one) * product(two, two));
    EXPECT_LT(std::abs(alike), 0.6) << other;  // 84 Hz wide, 0.1 s long
  }
}

TEST(Replay, OfALongLogNeedsNoLongQueue) {
  std::vector<protocol::LogEntry> log;
  for (int i = 0; i < 5000; ++i) {
    log.push_back({i * 1e-3, {protocol::to_message(bubble(0.005F))}});
  }
  ReplaySettings settings;
  settings.engine.max_scheduled = 100;
  ReplayReport report;
  play(log, open_rig(), settings, &report);
  EXPECT_EQ(report.counters.started.of<protocol::Bubble>(), 5000U);
  EXPECT_EQ(report.counters.dropped_queue, 0U);
}

TEST(Replay, OfAnEmptyLogIsTheTail) {
  ReplaySettings settings;
  settings.tail = 0.1;
  EXPECT_EQ(play({}, open_rig(), settings).front(), std::vector<float>(4800, 0.0F));
}

TEST(Replay, RefusesAbsurdTimes) {
  const std::vector<protocol::LogEntry> log = {{1e9, {protocol::to_message(bubble(0.005F))}}};
  EXPECT_THROW(play(log, open_rig(), {}), program::DataError);
  ReplaySettings settings;
  settings.tail = -1.0;
  EXPECT_THROW(play({}, open_rig(), settings), std::invalid_argument);
}

}  // namespace
}  // namespace splash::synth
