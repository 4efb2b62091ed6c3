// SPDX-License-Identifier: MIT
// Both real programs over loopback: what the simulator sends is what each synth gets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "protocol/event_log.hpp"
#include "protocol/status.hpp"
#include "tests/support/programs.hpp"
#include "tests/system/small_scene.hpp"

namespace splash::tests {
namespace {

using Json = nlohmann::json;

Arguments silent_synth() {
  return {"--rig", rig_path("stereo.yaml"), "--device", "null"};
}

protocol::SynthStatus status_of(Synth& synth) {
  const auto status = protocol::to_synth_status(synth.ask({"/status", {}}, "/status.reply"));
  if (!status) throw std::runtime_error("no status:\n" + synth.process().output());
  return *status;
}

std::uint64_t events_in(const std::string& log) {
  std::uint64_t events = 0;
  for (const auto& entry : protocol::read_log(log)) {
    for (const auto& message : entry.messages) events += protocol::to_event(message) ? 1U : 0U;
  }
  return events;
}

/// Three seconds of plunging in real time, to all of `targets`. Returns the report.
class Events : public testing::Test {
 protected:
  ~Events() override {
    std::filesystem::remove(report_);
    std::filesystem::remove(log_);
  }

  Json run(const std::vector<protocol::Endpoint>& targets) const {
    const SmallScene scene(plunging());
    Arguments arguments{"--scene", scene.path(), "--listen", "127.0.0.1:0", "--duration",
                        "3",       "--report",   report_,    "--record",    log_};
    for (const auto& target : targets) {
      arguments.insert(arguments.end(), {"--target", protocol::to_string(target)});
    }
    const auto [code, text] = run_program("sim-server", arguments);
    EXPECT_EQ(code, 0) << text;
    std::ifstream file(report_);
    return Json::parse(file);
  }

  std::string report_ = temporary_path("report.json");
  std::string log_ = temporary_path("events.osc");
};

std::uint64_t events_of(const Json& report) {
  const Json& events = report.at("events");
  return events.at("impacts").get<std::uint64_t>() + events.at("bubbles").get<std::uint64_t>() +
         events.at("cavities").get<std::uint64_t>();
}

TEST_F(Events, SentAreReceived) {
  Synth synth(silent_synth());
  const Json report = run({synth.endpoint()});
  EXPECT_GE(report.at("events").at("impacts"), 2);
  EXPECT_GE(report.at("events").at("bubbles"), 10);
  const auto status = status_of(synth);
  EXPECT_EQ(status.events, events_of(report));
  EXPECT_EQ(status.lost, 0U);
  EXPECT_EQ(status.duplicates, 0U);
  EXPECT_EQ(status.refused, 0U);
  EXPECT_EQ(events_in(log_), events_of(report)) << "the log has all that was sent, and no more";
  EXPECT_EQ(report.at("lost"), 0);
  EXPECT_EQ(report.at("invalid_events"), 0);
  EXPECT_EQ(report.at("send_failures"), 0);
  std::cout << "late: " << report.at("late") << " of " << events_of(report) << '\n';
  synth.process().signal(SIGTERM);
  EXPECT_EQ(synth.process().wait_for_end(), 0);
  EXPECT_THAT(synth.process().output(), testing::HasSubstr("1 sessions"));
}

TEST_F(Events, ReportStatesTheRun) {
  Synth synth(silent_synth());
  const Json report = run({synth.endpoint()});
  for (const char* key :
       {"device", "scene", "particles", "steps", "frames", "simulated_seconds", "wall_seconds",
        "steps_per_second", "real_time_factor", "mean_density_error", "maximum_density_error",
        "events", "late", "lost"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(report.at("scene"), "small");
  EXPECT_NEAR(report.at("particles").get<double>(), 1400.0, 140.0);
  EXPECT_GE(report.at("steps"), report.at("frames"));
  EXPECT_NEAR(report.at("simulated_seconds").get<double>(), 3.0, 0.01);
  // The wall clock may run on while time slips, never the other way round.
  EXPECT_GE(report.at("wall_seconds").get<double>(), 2.95);
  EXPECT_GT(report.at("steps_per_second").get<double>(), 0.0);
  EXPECT_TRUE(report.at("late").is_number_unsigned()) << "the synth answered";
}

/// The counts of a report that a status has, too.
protocol::SimStatus counts_of(const Json& report) {
  const Json& skipped = report.at("skipped");
  protocol::SimStatus status;
  status.steps = report.at("steps");
  status.impacts = report.at("events").at("impacts");
  status.bubbles = report.at("events").at("bubbles");
  status.late = report.at("behind");
  status.skipped = skipped.at("idle_frames").get<std::uint64_t>() +
                   skipped.at("contact_passes").get<std::uint64_t>() +
                   skipped.at("bubble_passes").get<std::uint64_t>() +
                   skipped.at("cavity_searches").get<std::uint64_t>();
  return status;
}

// Asked until the last second of the run, each count is that of the report, but for what follows.
TEST_F(Events, StatusIsThatOfTheReport) {
  const SmallScene scene(plunging());
  Simulator simulator(
      {"--scene", scene.path(), "--target", "127.0.0.1:9", "--duration", "4", "--report", report_});
  std::optional<protocol::SimStatus> last;
  double seconds = 0.0;  // by its steps, each of one length
  do {
    const auto status = protocol::to_sim_status(simulator.ask({"/status", {}}, "/status.reply"));
    if (!status) break;
    last = status;
    seconds = last->steps_per_second > 0.0F
                  ? static_cast<double>(last->steps) / static_cast<double>(last->steps_per_second) *
                        static_cast<double>(last->real_time_factor)
                  : 0.0;
  } while (seconds < 3.2);
  ASSERT_TRUE(last) << simulator.process().output();
  ASSERT_EQ(simulator.process().wait_for_end(), 0) << simulator.process().output();
  std::ifstream file(report_);
  const Json report = Json::parse(file);
  const protocol::SimStatus whole = counts_of(report);
  EXPECT_EQ(last->particles, report.at("particles"));
  for (const auto count : {&protocol::SimStatus::steps, &protocol::SimStatus::impacts,
                           &protocol::SimStatus::bubbles, &protocol::SimStatus::skipped}) {
    EXPECT_LE((*last).*count, whole.*count);
    EXPECT_GE(2 * (*last).*count, whole.*count) << "three of the four seconds had passed";
    EXPECT_GT((*last).*count, 0U);
  }
  EXPECT_LE(last->late, whole.late);
  EXPECT_EQ(last->cavities, 0U);
  EXPECT_EQ(last->resets, 0U);
  EXPECT_LE(last->unsent, report.at("send_failures").get<std::uint64_t>());
  EXPECT_GT(last->real_time_factor, 0.0F);
  EXPECT_LT(last->real_time_factor, 1.1F);
  const double length =
      report.at("simulated_seconds").get<double>() / report.at("steps").get<double>();
  EXPECT_NEAR(
      static_cast<double>(last->real_time_factor) / static_cast<double>(last->steps_per_second),
      length, 0.3 * length)
      << "both are of the last second";
  EXPECT_GT(last->density_error, 0.0F);
  EXPECT_LT(static_cast<double>(last->density_error),
            report.at("maximum_density_error").get<double>());
}

TEST_F(Events, EachOfTwoTargetsGetsAll) {
  Synth first(silent_synth());
  Synth second(silent_synth());
  const Json report = run({first.endpoint(), second.endpoint()});
  ASSERT_GT(events_of(report), 10U);
  for (Synth* synth : {&first, &second}) {
    const auto status = status_of(*synth);
    EXPECT_EQ(status.events, events_of(report));
    EXPECT_EQ(status.lost, 0U);
    EXPECT_EQ(status.duplicates, 0U);
  }
  EXPECT_EQ(report.at("lost"), 0);
}

TEST_F(Events, ATargetThatIsNotThereIsUnknownNotZero) {
  const protocol::Endpoint nobody = protocol::UdpSocket({INADDR_LOOPBACK, 0}).local();
  const Json report = run({nobody});
  EXPECT_TRUE(report.at("late").is_null());
  EXPECT_TRUE(report.at("lost").is_null());
  EXPECT_GT(events_of(report), 10U);
}

}  // namespace
}  // namespace splash::tests
