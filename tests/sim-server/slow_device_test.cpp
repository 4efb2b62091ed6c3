// SPDX-License-Identifier: MIT
// A device that is made slower than real time: the server says what gives way, in order, simulated
// time runs slower, and no backlog grows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "sim-server/serve/server.hpp"
#include "tests/sim-server/fluid/small_water.hpp"

namespace splash::sim {
namespace {

using testing::HasSubstr;

TEST(SlowDevice, StepsStretchThenTimeRunsSlowerAndNoBacklogGrows) {
  Device device;
  Scene scene = tank_scene(0.04, {0.24, 0.24, 0.5}, 0.2);
  scene.skip.idle = false;
  Simulation simulation(device, scene, {});
  const double step = simulation.time_step();
  double longest = 0.0;
  simulation.set_hook([&](Fluid&, Step& now, Moment moment) {
    longest = std::max(longest, now.dt);
    if (moment == Moment::before) std::this_thread::sleep_for(std::chrono::milliseconds(15));
  });
  Options options;
  options.listen = protocol::parse_endpoint("127.0.0.1:0", 0);
  options.duration = 0.7;
  testing::internal::CaptureStderr();
  Server server(options, simulation, "slow");
  server.run([] { return false; });
  const std::string said = testing::internal::GetCapturedStderr();
  const RunReport report = server.finish();
  EXPECT_THAT(said, testing::ContainsRegex("times as long(.|\n)*slower than the clock"));
  EXPECT_GT(longest, 1.02 * step);
  EXPECT_LT(longest, 1.08 * step) << "never beyond what is stable";
  EXPECT_LT(report.real_time_factor(), 0.6);
  EXPECT_GT(report.slow_seconds, 0.0);
  EXPECT_GT(report.paced.slipped, 0.5);
  // All that is behind the clock has been given up, but for the present lag.
  const double lag = report.run.wall - report.simulated_seconds - report.paced.slipped;
  EXPECT_LT(lag, 0.5);
  EXPECT_EQ(report.totals.retried + report.totals.calmed + report.totals.resets, 0U);
}

}  // namespace
}  // namespace splash::sim
