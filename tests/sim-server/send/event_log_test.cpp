// SPDX-License-Identifier: MIT
// The log knows nothing of the wall clock: runs at other times, at other paces, give equal bytes.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "protocol/event_log.hpp"
#include "sim-server/send/event_sender.hpp"
#include "tests/sim-server/send/sample_events.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::sim {
namespace {

constexpr double kEnd = 1.0;  // of the little run below, simulated [s]

struct RunAs {
  double unix_origin = 1.7e9;
  double pace = 1.0;  // wall seconds per simulated second
  int seed = 1;
  double lead = 0.0;
  bool forces = false;
};

/// A quarter of a second of events, some in one frame too many for one bundle, then rest.
void run(const std::filesystem::path& path, const RunAs& as) {
  Targets nobody({});
  protocol::UdpSocket socket{protocol::Endpoint{}};
  protocol::LogWriter log(path);
  double now = as.unix_origin;
  EventSender sender(nobody, socket, &log,
                     {.seed = as.seed, .lead = as.lead, .clock = [&now] { return now; }});
  for (int i = 0; i < 250; ++i) {
    const double seconds = 0.004 * i;
    now = as.unix_origin + as.pace * seconds;
    std::vector<TimedEvent> events;
    if (i % 10 == 0 && i < 60) events.push_back(test::impact(i, seconds + 0.0031));
    if (i == 30) events = test::bubbles(40, seconds + 0.01);
    if (i % 7 == 0 && i < 60) events.push_back(test::bubble(100 + i, seconds + 0.006));
    const FrameTime frame = {.step = 10 * i, .seconds = seconds, .unix_origin = as.unix_origin};
    if (as.forces) sender.log_forces(frame, {{"/force", {0, 1.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F}}});
    sender.send_step(frame, events);
  }
  sender.close(kEnd);
}

TEST(EventLog, TwoRunsAtOtherTimesAndPacesAreByteIdentical) {
  const tests::TemporaryFolder folder;
  run(folder / "a.osc", {.unix_origin = 1.7e9, .pace = 1.0});
  run(folder / "b.osc", {.unix_origin = 1.9e9 + 0.123456, .pace = 0.1});
  run(folder / "c.osc", {.unix_origin = 1.9e9, .pace = 3.0});  // behind: every event is overdue
  const auto bytes = tests::text_of(folder / "a.osc");
  EXPECT_GT(bytes.size(), 3000U);
  EXPECT_EQ(bytes, tests::text_of(folder / "b.osc"));
  EXPECT_EQ(bytes, tests::text_of(folder / "c.osc"));
}

TEST(EventLog, HasForcesAtTheirFramesAndTheSameEvents) {
  const tests::TemporaryFolder folder;
  run(folder / "plain.osc", {.lead = 0.015});
  run(folder / "forces.osc", {.lead = 0.015, .forces = true});
  run(folder / "again.osc", {.unix_origin = 1.9e9, .pace = 3.0, .lead = 0.015, .forces = true});
  EXPECT_EQ(tests::text_of(folder / "forces.osc"), tests::text_of(folder / "again.osc"));
  std::vector<protocol::LogEntry> events;
  std::vector<double> forces;
  for (const protocol::LogEntry& entry : protocol::read_log(folder / "forces.osc")) {
    if (entry.messages.back().address != "/force") {
      events.push_back(entry);
      continue;
    }
    const auto frame = protocol::to_frame(entry.messages.front()).value();
    EXPECT_EQ(frame.sequence, static_cast<std::int32_t>(forces.size()));
    EXPECT_EQ(frame.step, static_cast<std::int32_t>(10 * forces.size()));
    forces.push_back(entry.seconds);
  }
  ASSERT_EQ(forces.size(), 250U);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    EXPECT_NEAR(forces[i], 0.004 * static_cast<double>(i), 1e-9);
  }
  const auto plain = protocol::read_log(folder / "plain.osc");
  ASSERT_EQ(events.size(), plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_EQ(events[i].seconds, plain[i].seconds);
    EXPECT_EQ(events[i].messages, plain[i].messages);
  }
}

TEST(EventLog, AnotherSeedIsAnotherSession) {
  const tests::TemporaryFolder folder;
  std::set<std::int32_t> sessions;
  for (int seed = -2; seed < 10; ++seed) {
    run(folder / "log.osc", {.seed = seed});
    const auto entries = protocol::read_log(folder / "log.osc");
    sessions.insert(protocol::to_frame(entries.at(0).messages.at(0)).value().session);
  }
  EXPECT_EQ(sessions.size(), 12U);
}

TEST(EventLog, TellsEachEventOnceAtItsSimulatedMoment) {
  for (const double lead : {0.0, 0.005}) {
    const tests::TemporaryFolder folder;
    run(folder / "log.osc", {.lead = lead});
    const auto entries = protocol::read_log(folder / "log.osc");
    std::size_t impacts = 0;
    std::size_t bubbles = 0;
    std::int32_t sequence = 0;
    for (const auto& entry : entries) {
      const auto frame = protocol::to_frame(entry.messages.at(0)).value();
      EXPECT_EQ(frame.sequence, sequence++);
      EXPECT_GE(frame.delay_ms, 0.0F);
      for (std::size_t i = 1; i < entry.messages.size(); ++i) {
        const auto event = protocol::to_event(entry.messages[i]).value();
        if (const auto* impact = std::get_if<protocol::Impact>(&event)) {
          ++impacts;
          EXPECT_NEAR(entry.seconds + 1.0e-3 * static_cast<double>(impact->offset_ms),
                      0.004 * impact->id + 0.0031, 1.0e-8);
        } else {
          ++bubbles;
        }
      }
    }
    EXPECT_EQ(impacts, 5U);        // frames 0, 10, 20, 40, 50; 30 became bubbles
    EXPECT_EQ(bubbles, 40U + 9U);  // frames 0, 7, ... 56
  }
}

TEST(EventLog, ClosesWithAFrameAtTheEnd) {
  const tests::TemporaryFolder folder;
  run(folder / "log.osc", {});
  const auto entries = protocol::read_log(folder / "log.osc");
  EXPECT_NEAR(entries.back().seconds, kEnd, 1.0e-9);
  EXPECT_EQ(entries.back().messages.size(), 1U);
  EXPECT_TRUE(protocol::to_frame(entries.back().messages.at(0)).has_value());
}

TEST(EventLog, TheEndIsNotBeforeTheLastSound) {
  const tests::TemporaryFolder folder;
  Targets nobody({});
  protocol::UdpSocket socket{protocol::Endpoint{}};
  protocol::LogWriter log(folder / "log.osc");
  EventSender sender(nobody, socket, &log);
  sender.send_step({.seconds = 0.5, .unix_origin = 0.0}, {test::bubble(0, 2.5)});
  sender.close(0.6);
  EXPECT_NEAR(protocol::read_log(folder / "log.osc").back().seconds, 2.5, 1.0e-9);
}

TEST(EventLog, AnEventThatSoundsSoonerThanAnEarlierFramesEventIsNotHeldBack) {
  const tests::TemporaryFolder folder;
  Targets nobody({});
  protocol::UdpSocket socket{protocol::Endpoint{}};
  protocol::LogWriter log(folder / "log.osc");
  EventSender sender(nobody, socket, &log);
  sender.send_step({.seconds = 1.0, .unix_origin = 0.0}, {test::bubble(0, 1.050)});
  sender.send_step({.seconds = 1.004, .unix_origin = 0.0}, {test::impact(0, 1.006)});
  sender.close(1.1);
  const auto entry = protocol::read_log(folder / "log.osc").at(1);
  const auto event = protocol::to_event(entry.messages.at(1)).value();
  EXPECT_NEAR(
      entry.seconds + 1.0e-3 * static_cast<double>(std::get<protocol::Impact>(event).offset_ms),
      1.006, 1.0e-8);
}

TEST(EventLog, AFullDiskIsToldAndNotSwallowed) {
  if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_THROW(run("/dev/full", {}), std::runtime_error);
}

}  // namespace
}  // namespace splash::sim
