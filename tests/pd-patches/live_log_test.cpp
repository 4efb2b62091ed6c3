// SPDX-License-Identifier: MIT
// Pd in place of synth-server plays the log of a real run, live: as many events, as loud. When each
// is heard is live_test's.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "tests/pd-patches/live_pd.hpp"

namespace splash::pd {
namespace {

constexpr float kDelay = 20.0F;  ///< announced by each bundle's /frame [ms]

std::vector<protocol::LogEntry> read_log_of(const std::string& scene) {
  return protocol::read_log(std::string(SPLASH_SOURCE_DIR) + "/tests/data/" + scene + ".osc");
}

std::size_t count_events(const std::vector<protocol::LogEntry>& log) {
  std::size_t events = 0;
  for (const auto& entry : log) {
    for (const auto& message : entry.messages) events += protocol::to_event(message) ? 1U : 0U;
  }
  return events;
}

/// Sends each bundle at its time, as the simulator would.
void play(const std::vector<protocol::LogEntry>& log, LivePd& pd) {
  const double start = protocol::monotonic_now() + 0.1;
  for (const protocol::LogEntry& entry : log) {
    auto messages = entry.messages;
    auto frame = protocol::to_frame(messages.at(0)).value();
    frame.delay_ms = kDelay;
    messages[0] = protocol::to_message(frame);
    const double left = start + entry.seconds - protocol::monotonic_now();
    if (left > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(left));
    pd.send(protocol::encode(protocol::kImmediately, messages));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(800));
}

/// What the patch says when it has played `events`: a pd that lags answers before it plays.
protocol::SynthStatus status_after(std::size_t events, LivePd& pd) {
  protocol::SynthStatus status;
  for (int tries = 0; tries < 50 && status.events < events; ++tries) {
    status = pd.status(0.5).value_or(status);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return status;
}

double energy(const Channels& channels) {
  double sum = 0.0;
  for (const auto& channel : channels) {
    for (const float sample : channel)
      sum += static_cast<double>(sample) * static_cast<double>(sample);
  }
  return sum;
}

TEST(LiveLog, IsPlayedWholeAndAsLoud) {
  const auto log = read_log_of("pool");
  ASSERT_GT(count_events(log), 20U);
  LivePd pd;
  play(log, pd);
  const auto status = status_after(count_events(log), pd);
  EXPECT_EQ(status.events, count_events(log)) << pd.output();
  EXPECT_EQ(status.lost, 0U);
  EXPECT_EQ(status.duplicates, 0U);
  const Channels live = pd.recorder().stop();
  const auto frames = static_cast<std::int64_t>((log.back().seconds + 0.5) * kRate);
  const Channels offline = render_with_synth(log, kTiles, frames);
  // A machine too busy for sound loses a period now and then: a few per cent of the energy.
  EXPECT_NEAR(decibels(std::sqrt(energy(live) / energy(offline))), 0.0, 2.0);
}

}  // namespace
}  // namespace splash::pd
