// SPDX-License-Identifier: MIT
// All gauges of a scene: columns, times, the file, and that looking changes nothing; gauges that
// ride on a body, and sensors with a size, in water whose pressures are known.
#include "sim-server/gauge/gauges.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "sim-server/device/device.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "sim-server/start/scene_start.hpp"
#include "tests/sim-server/gauge/lattice.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kScene = R"(
fluid: {spacing: 0.025}
tank: {lower: [0, 0, 0], upper: [0.3, 0.2, 0.6]}
water: [{lower: [0, 0, 0], upper: [0.2, 0.2, 0.2]}]
gate: {x: 0.2}
bodies:
  - name: post
    shape: {size: [0.05, 0.05, 0.4]}
    rest: {position: [0.1, 0.1, 0.2]}
)";
const std::string kGauges = R"(gauges:
  rate: 40
  probes:
    - {name: H1, kind: height, x: 0.05, y: 0.1}
    - {name: P, kind: pressure, place: [0.05, 0.1, 0]}
    - {name: tip, kind: front, axis: x}
    - {name: post, kind: body, body: post}
    - {name: E, kind: energy}
    - {name: M, kind: momentum}
    - {name: S, kind: spread}
    - {name: C, kind: cavity, lower: [0, 0, 0], upper: [0.2, 0.2, 0.2]}
)";

TEST(Gauges, NameEachOfTheirNumbers) {
  const Gauges gauges(parse_scene(kScene + kGauges, "s.yaml"));
  EXPECT_THAT(
      gauges.columns(),
      ElementsAre("time", "H1_height", "H1_wetted", "P_pressure", "tip_front", "post_x", "post_y",
                  "post_z", "post_qx", "post_qy", "post_qz", "post_qw", "post_vx", "post_vy",
                  "post_vz", "post_wx", "post_wy", "post_wz", "post_fx", "post_fy", "post_fz",
                  "post_tx", "post_ty", "post_tz", "E_kinetic", "E_potential", "E_compression",
                  "E_total", "M_x", "M_y", "M_z", "M_fastest", "M_rms", "S_x", "S_y", "S_z", "S_sx",
                  "S_sy", "S_sz", "C_open", "C_enclosed", "C_pocket"));
}

/// All particles after a tenth of a second; looked at after each frame or not.
Snapshot run(bool looked_at) {
  Device device;
  const Scene scene = parse_scene(kScene + kGauges, "s.yaml");
  Simulation simulation(device, scene, {});
  Gauges gauges(scene);
  while (simulation.seconds() < 0.1) {
    static_cast<void>(simulation.advance());
    if (!looked_at) continue;
    const auto row = gauges.read(simulation.seconds(), simulation.fluid(), simulation.bodies());
    EXPECT_EQ(row.size(), gauges.columns().size());
    for (const double value : row) EXPECT_TRUE(std::isfinite(value));
  }
  return simulation.fluid().snapshot();
}

TEST(Gauges, ChangeNothingByLooking) {
  const Snapshot alone = run(false);
  const Snapshot watched = run(true);
  // Looking sorts the particles: compare each with itself.
  for (std::size_t i = 0; i < alone.id.size(); ++i) {
    const auto same = std::find(watched.id.begin(), watched.id.end(), alone.id[i]);
    ASSERT_NE(same, watched.id.end());
    const auto j = static_cast<std::size_t>(same - watched.id.begin());
    ASSERT_EQ(alone.place(i), watched.place(j));
    ASSERT_EQ(alone.velocity[i], watched.velocity[j]);
  }
}

class GaugeFiles : public ::testing::Test {
 protected:
  tests::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "gauges.csv";
};

TEST_F(GaugeFiles, HoldALinePerSampleAtTheScenesRate) {
  Device device;
  const Scene scene = parse_scene(kScene + kGauges, "s.yaml");
  Simulation simulation(device, scene, {});
  int frames = 0;
  {
    GaugeFile file(path_, scene);
    file.note(0.0, simulation.fluid(), simulation.bodies());
    for (; simulation.seconds() < 0.2; ++frames) {
      static_cast<void>(simulation.advance());
      file.note(simulation.seconds(), simulation.fluid(), simulation.bodies());
    }
  }
  std::ifstream in(path_);
  std::string line;
  std::getline(in, line);
  EXPECT_THAT(line, HasSubstr("time,H1_height,"));
  std::vector<double> times;
  while (std::getline(in, line)) times.push_back(std::stod(line));
  EXPECT_GT(frames, 20);
  ASSERT_EQ(times.size(), 9U) << "40 a second for 0.2 s, and the beginning";
  for (std::size_t k = 0; k < times.size(); ++k) {
    EXPECT_GE(times[k], static_cast<double>(k) / 40.0 - 1e-9);
    EXPECT_LT(times[k], static_cast<double>(k) / 40.0 + 0.01);
  }
}

TEST_F(GaugeFiles, RefuseASceneWithoutGauges) {
  try {
    const GaugeFile file(path_, parse_scene(kScene, "bare.yaml"));
    FAIL();
  } catch (const program::Failure& error) {
    EXPECT_EQ(error.code(), program::kExitConfig);
    EXPECT_THAT(error.what(), HasSubstr("bare"));
    EXPECT_THAT(error.what(), HasSubstr("leave out --gauges"));
  }
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST(Gauges, TheGateHoldsTheWaterUntilTimeBegins) {
  Device device;
  const Scene scene = parse_scene(kScene + kGauges, "s.yaml");
  Simulation simulation(device, scene, {});
  Gauges gauges(scene);
  const auto front = [&] {
    return gauges.read(simulation.seconds(), simulation.fluid(), simulation.bodies())[4];
  };
  EXPECT_NEAR(front(), 0.2, 0.0125);
  while (simulation.seconds() < 0.1) static_cast<void>(simulation.advance());
  EXPECT_GT(front(), 0.23);
}

constexpr double kLevel = 0.3;  // [m]

// Pressures on a grid are read at the places themselves, whatever the faces.
const std::string kTank = R"(
fluid: {spacing: 0.01, solver: grid_projected}
tank: {lower: [0, 0, 0], upper: [0.3, 0.3, 0.6]}
water: [{lower: [0, 0, 0], upper: [0.3, 0.3, 0.3]}]
)";

WaterState at_rest() {
  WaterState water = lattice_water({0.0, 0.0, 0.0}, {0.3, 0.3, kLevel}, 0.01);
  for (const Vector3& x : water.position) {
    water.pressure.push_back(9810.0 * (kLevel - x[2]));
    water.velocity[water.pressure.size() - 1] = {x[2], 0.0, 0.0};
  }
  return water;
}

/// What the gauges of a scene tell of the water at rest, without the time.
std::vector<double> readings(const std::string& text, double seconds) {
  const Scene scene = parse_scene(text, "riding.yaml");
  std::vector<PosedMotion*> live;
  const Bodies bodies = make_bodies(scene, {}, live);
  const std::vector<double> row = Gauges(scene).read(seconds, at_rest(), bodies);
  return {row.begin() + 1, row.end()};
}

TEST(RidingGauges, GoWhereTheirBodyTakesThem) {
  // It rises by 0.1 m/s, and turns about y: its x axis points down after a second.
  const std::string text = kTank + R"(
bodies:
  - name: paddle
    shape: {size: [0.04, 0.04, 0.04]}
    motion:
      kind: script
      smooth: false
      keyframes:
        - {time: 0, position: [0.15, 0.15, 0.1]}
        - {time: 1, position: [0.15, 0.15, 0.2], rotation: [0, 0.70710678, 0, 0.70710678]}
gauges:
  probes:
    - {name: p, kind: pressure, body: paddle, place: [0.06, 0, 0]}
    - {name: v, kind: velocity, body: paddle, place: [0.06, 0, 0]}
)";
  const std::vector<double> before = readings(text, 0.0);
  EXPECT_NEAR(before[0], 9810.0 * (kLevel - 0.1), 1.0);
  EXPECT_NEAR(before[1], 0.1, 1.0e-4);
  const std::vector<double> after = readings(text, 1.0);
  EXPECT_NEAR(after[0], 9810.0 * (kLevel - 0.14), 1.0);
  EXPECT_NEAR(after[1], 0.14, 1.0e-4);
  EXPECT_NEAR(after[4], 1.0, 0.01) << "within the water";
}

TEST(SizedSensors, ReadTheMeanOverTheirDisc) {
  const std::string text = kTank + R"(
gauges:
  probes:
    - {name: small, kind: pressure, place: [0, 0.15, 0.15]}
    - {name: large, kind: pressure, place: [0, 0.15, 0.15], radius: 0.05}
    - {name: half, kind: pressure, place: [0, 0.15, 0.3], radius: 0.1}
    - {name: low, kind: pressure, place: [0, 0.15, 0.0001], radius: 0.05}
)";
  const std::vector<double> read = readings(text, 0.0);
  EXPECT_NEAR(read[0], 9810.0 * 0.15, 1.0);
  EXPECT_NEAR(read[1], read[0], 1.0) << "of what changes linearly it is that of its middle";
  // Half of it is in the air: rho g times the depth of a half disc's centroid, 4 R / (3 pi).
  EXPECT_NEAR(read[2] / (0.5 * 9810.0 * 0.4 / (3.0 * std::numbers::pi)), 1.0, 0.05);
  const double deep = kLevel - 4.0 * 0.05 / (3.0 * std::numbers::pi);
  EXPECT_NEAR(read[3] / (9810.0 * deep), 1.0, 0.005) << "half of it is under the floor";
}

TEST(SizedSensors, EndAtTheirBodysEdge) {
  const std::string text = kTank + R"(
bodies:
  - {name: box, shape: {size: [0.1, 0.1, 0.1]}, rest: {position: [0.15, 0.15, 0.1]}}
gauges:
  probes:
    - {name: flank, kind: pressure, body: box, place: [0.05, 0, 0.047], radius: 0.04}
)";
  const double deep = kLevel - 0.147 + 4.0 * 0.04 / (3.0 * std::numbers::pi);
  EXPECT_NEAR(readings(text, 0.0)[0] / (9810.0 * deep), 1.0, 0.02);
}

}  // namespace
}  // namespace splash::sim
