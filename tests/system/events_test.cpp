// SPDX-License-Identifier: MIT
// Both real programs over loopback: what the simulator sends is what each synth gets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "protocol/control_port.hpp"
#include "protocol/event_log.hpp"
#include "protocol/status.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"
#include "tests/support/waiting.hpp"

namespace splash::tests {
namespace {

using Json = nlohmann::json;

Arguments silent_synth() {
  return {"--rig", rig_path("stereo.yaml"), "--device", "null"};
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
  Json run(const std::vector<protocol::Endpoint>& targets) const {
    const SmallScene scene(plunging());
    Arguments arguments{"--scene", scene.path(), "--listen", "127.0.0.1:0", "--duration",
                        "3",       "--report",   report_,    "--record",    log_};
    for (const auto& target : targets) {
      arguments.insert(arguments.end(), {"--target", protocol::to_string(target)});
    }
    const auto [code, text] = run_program("sim-server", arguments);
    EXPECT_EQ(code, 0) << text;
    return Json::parse(text_of(report_));
  }

  TemporaryFolder folder_;
  std::string report_ = folder_ / "report.json";
  std::string log_ = folder_ / "events.osc";
};

std::uint64_t events_of(const Json& report) {
  const Json& events = report.at("events");
  return events.at("impacts").get<std::uint64_t>() + events.at("bubbles").get<std::uint64_t>() +
         events.at("cavities").get<std::uint64_t>();
}

TEST_F(Events, EachOfTwoTargetsGetsAllAndTheReportStatesTheRun) {
  Synth first(silent_synth());
  Synth second(silent_synth());
  const Json report = run({first.endpoint(), second.endpoint()});
  EXPECT_GE(report.at("events").at("impacts"), 2);
  EXPECT_GE(report.at("events").at("bubbles"), 10);
  for (Synth* synth : {&first, &second}) {
    const auto status = synth->status();
    EXPECT_EQ(status.events, events_of(report));
    EXPECT_EQ(status.lost, 0U);
    EXPECT_EQ(status.duplicates, 0U);
    EXPECT_EQ(status.refused, 0U);
  }
  EXPECT_EQ(events_in(log_), events_of(report)) << "the log has all that was sent, and no more";
  EXPECT_EQ(report.at("lost"), 0);
  EXPECT_EQ(report.at("invalid_events"), 0);
  EXPECT_EQ(report.at("send_failures"), 0);
  std::cout << "late: " << report.at("late") << " of " << events_of(report) << '\n';
  EXPECT_EQ(first.end(), 0);
  EXPECT_THAT(first.process().output(), testing::HasSubstr("1 sessions"));
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
  const auto cost = [](const Json& of, const char* clock) { return of.at(clock).get<double>(); };
  EXPECT_GT(cost(report, "processor_seconds"), 0.0);
  for (const char* clock : {"wall_seconds", "processor_seconds"}) {
    EXPECT_GT(cost(report.at("settling"), clock), 0.0) << "the water came to rest";
    EXPECT_GT(cost(report.at("start"), clock), cost(report.at("settling"), clock));
  }
  EXPECT_TRUE(report.at("late").is_number_unsigned()) << "the synth answered";
}

std::uint64_t sum_of(const Json& counts) {
  std::uint64_t sum = 0;
  for (const auto& [name, count] : counts.items()) sum += count.get<std::uint64_t>();
  return sum;
}

/// What a status has that a report has, too. `unsent` goes on counting while time stands still.
protocol::SimStatus status_in(const Json& report) {
  const Json& skipped = report.at("skipped");
  const Json& refused = report.at("refused");
  const auto count = [](const Json& json, const char* key) {
    return json.at(key).get<std::uint64_t>();
  };
  protocol::SimStatus status;
  status.particles = report.at("particles");
  status.steps = report.at("steps");
  status.events.of<protocol::Impact>() = count(report.at("events"), "impacts");
  status.events.of<protocol::Bubble>() = count(report.at("events"), "bubbles");
  status.events.of<protocol::Cavity>() = count(report.at("events"), "cavities");
  status.late = report.at("behind");
  status.refused =
      sum_of(refused.at("poses")) + sum_of(refused.at("datagrams")) + count(refused, "messages");
  status.resets =
      count(report, "resets") + count(report, "retried_frames") + count(report, "calmed_frames");
  status.skipped = count(skipped, "idle_frames") + count(skipped, "contact_passes") +
                   count(skipped, "bubble_passes") + count(skipped, "cavity_searches");
  status.thinned = count(report.at("air"), "thinned_bubbles");
  return status;
}

template <class Condition>
protocol::SimStatus status_when(Simulator& simulator, const Condition& condition) {
  protocol::SimStatus status = simulator.status();
  for (int i = 0; i < 400 && !condition(status); ++i) {
    sleep(0.06);
    status = simulator.status();
  }
  EXPECT_TRUE(condition(status)) << simulator.process().output();
  return status;
}

// While time stands still each count is that of the report.
TEST_F(Events, StatusIsThatOfTheReport) {
  const SmallScene scene(plunging());
  // The system refuses to send to everybody.
  Simulator simulator(
      {"--scene", scene.path(), "--target", "255.255.255.255:9", "--report", report_});
  const auto running = status_when(simulator, [](const protocol::SimStatus& now) {
    return now.events.of<protocol::Impact>() >= 2 && now.events.of<protocol::Bubble>() > 0 &&
           now.skipped > 0;
  });
  EXPECT_GT(running.density_error, 0.0F);
  EXPECT_GT(running.real_time_factor, 0.0F);
  simulator.send(std::vector<std::byte>(3));            // to the gate
  simulator.send(protocol::encode({"/sync", {0.5F}}));  // to the table
  simulator.send(protocol::encode(protocol::to_message(protocol::BodyPose{
      .body = 7, .position = {}, .qx = 0.0F, .qy = 0.0F, .qz = 0.0F, .qw = 1.0F})));  // for no body
  simulator.send(protocol::encode({"/body/pose", {0, 0.5F}}));                        // malformed
  simulator.send(protocol::encode({"/body/pose", {0, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F}}));
  simulator.send(protocol::encode({"/notify", {2}}));  // obeyed by scenes with forces alone
  EXPECT_EQ(simulator.ask({"/pause", {1}}, "/done").address, "/done");
  const auto paused = status_when(simulator, [](const protocol::SimStatus& now) {
    return now.real_time_factor == 0.0F;  // for a second: that is what the rates are of
  });
  EXPECT_EQ(paused.steps_per_second, 0.0F);
  EXPECT_EQ(simulator.ask({"/quit", {}}, "/done").address, "/done");
  ASSERT_EQ(simulator.process().wait_for_end(), 0) << simulator.process().output();
  const Json report = Json::parse(text_of(report_));
  protocol::SimStatus expected = status_in(report);
  EXPECT_EQ(expected.refused, 5U);
  EXPECT_GE(report.at("send_failures").get<std::uint64_t>(), paused.unsent);
  EXPECT_GT(paused.unsent, 0U);
  EXPECT_LE(static_cast<double>(paused.bubble_particles),
            report.at("bubble_particles").at("largest_share").get<double>() *
                    report.at("particles").get<double>() +
                0.5);
  EXPECT_LE(static_cast<double>(paused.density_error),
            report.at("maximum_density_error").get<double>());
  expected.unsent = paused.unsent;
  expected.bubble_particles = paused.bubble_particles;
  expected.density_error = paused.density_error;
  EXPECT_EQ(protocol::to_text(protocol::to_message(paused)),
            protocol::to_text(protocol::to_message(expected)));
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
