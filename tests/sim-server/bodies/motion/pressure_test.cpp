// SPDX-License-Identifier: MIT
// Feet that a floor of tiles feels, against the force plates of a recorded walk: each contact when
// the plate felt it, under the foot that it was, wherever the tiles' edges lie.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "sim-server/bodies/motion/pressure_feet.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "tests/sim-server/bodies/motion/plate_log.hpp"

namespace splash::sim {
namespace {

Scene floor_scene(const std::string& floor, const std::string& position = "[0, 0, 0]") {
  return parse_scene(R"(fluid: {particles: 500}
tank: {lower: [0.0, 0.0, 0.0], upper: [1.0, 1.0, 1.0]}
water:
  - {lower: [0.0, 0.0, 0.0], upper: [1.0, 1.0, 0.1]}
bodies:
  - name: foot_left
    shape: {size: [0.29, 0.1, 0.07]}
    motion: {kind: pressure}
    rest: {position: [0.8, 0.06, 0.035]}
  - name: foot_right
    shape: {size: [0.29, 0.1, 0.07]}
    motion: {kind: pressure}
    rest: {position: [0.3, -0.13, 0.035]}
tracking:
  position: )" + position +
                         "\n  floor: " + floor + "\n",
                     "floor.yaml");
}

/// A foot as the floor tells it.
struct Felt {
  bool down = false;
  Vector3 place = {};
};

class Floor {
 public:
  explicit Floor(const Scene& scene) : scene_(scene), feet_(scene) {}

  void stand(const std::vector<double>& readings) {
    for (const auto& message : pressure_messages(readings)) {
      EXPECT_TRUE(feet_.take(message, [this](const FloorTouch& touch) {
        felt[touch.body] = {touch.down, touch.place};
      }));
    }
  }
  /// Two loads, each in N at a place.
  void stand(const PlateFoot& one, const PlateFoot& other) {
    stand(readings_of({0.0, {one, other}}, scene_.tracking));
  }

  std::array<Felt, 2> felt = {};

 private:
  Scene scene_;
  PressureFeet feet_;
};

double distance(const Vector3& place, const PlateFoot& foot) {
  return std::hypot(place[0] - foot.x, place[1] - foot.y);
}

/// Lets the walk pass over the tiles, which it does with `belt` [m/s] where the treadmill stood
/// still, and compares all that is told with the plates.
void expect_the_walk(const std::string& floor, const std::string& position, double belt) {
  const Scene scene = floor_scene(floor, position);
  Floor tiles(scene);
  std::array<bool, 2> stood = {};
  std::array<double, 2> plate_since = {-1.0, -1.0};
  std::array<int, 2> contacts = {};
  std::mt19937 chance(5);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);  // of each sensor [N]
  double worst = 0.0;
  for (PlateRow row : read_plates()) {
    for (PlateFoot& foot : row.feet) foot.x += belt * row.time;
    std::vector<double> readings = readings_of(row, scene.tracking);
    for (double& reading : readings) reading += noise(chance);
    tiles.stand(readings);
    for (std::size_t side = 0; side < 2; ++side) {
      const PlateFoot& foot = row.feet[side];
      const Felt& felt = tiles.felt[side];
      if (foot.force >= 20.0 && plate_since[side] < 0.0) plate_since[side] = row.time;
      if (foot.force < 8.0) plate_since[side] = -1.0;
      if (felt.down && !stood[side]) {
        ++contacts[side];
        ASSERT_GE(plate_since[side], 0.0) << "a foot without a load, " << side << " " << row.time;
        worst = std::max(worst, row.time - plate_since[side]);
      }
      stood[side] = felt.down;
      ASSERT_TRUE(felt.down || foot.force <= 60.0) << side << " lost at " << row.time;
      ASSERT_FALSE(felt.down && foot.force < 8.0) << side << " stays at " << row.time;
      // Within its own sole: a foot that was taken for the other one is 0.4 m away.
      ASSERT_TRUE(foot.force <= 60.0 || distance(felt.place, foot) < 0.16) << row.time;
    }
  }
  EXPECT_EQ(contacts[0], 3);
  EXPECT_EQ(contacts[1], 3);
  EXPECT_LE(worst, 0.020);
  std::printf("latest contact %.1f ms after the plates\n", 1e3 * worst);
}

TEST(Pressure, FollowsTheWalkOfThePlatesWhereverTheTilesLie) {
  for (const double x : {-0.34, -0.28, -0.22, -0.16, -0.10}) {
    for (const double y : {-0.915, -0.85, -0.78, -0.70, -0.65}) {
      const std::string position = "[" + std::to_string(x) + ", " + std::to_string(y) + ", 0]";
      SCOPED_TRACE(position);
      expect_the_walk("{sensors: 4}", position, 0.0);
    }
  }
}

// On a floor that stands still, a foot does, too: this is the walk without the treadmill.
TEST(Pressure, FollowsTheWalkOverALongFloor) {
  for (const double x : {-0.3, -0.2, -0.1}) {
    const std::string position = "[" + std::to_string(x) + ", -0.7, 0]";
    SCOPED_TRACE(position);
    expect_the_walk("{columns: 20, sensors: 4}", position, 1.2);
  }
}

TEST(Pressure, TellsFeetApartThatStandOnOneTile) {
  Floor tiles(floor_scene("{sensors: 4}"));
  tiles.stand({400.0, 0.75, 0.15}, {});
  EXPECT_TRUE(tiles.felt[0].down);
  tiles.stand({400.0, 0.75, 0.15}, {300.0, 0.75, 0.50});
  EXPECT_TRUE(tiles.felt[1].down);
  tiles.stand({400.0, 0.75, 0.20}, {300.0, 0.75, 0.40});  // they draw nearer
  tiles.stand({400.0, 0.75, 0.22}, {300.0, 0.75, 0.34});
  tiles.stand({350.0, 0.75, 0.20}, {350.0, 0.75, 0.28});  // now both on the first tile
  EXPECT_TRUE(tiles.felt[0].down && tiles.felt[1].down);
  tiles.stand({700.0, 0.75, 0.20}, {0.0, 0.75, 0.28});
  EXPECT_TRUE(tiles.felt[0].down);
  EXPECT_FALSE(tiles.felt[1].down) << "the one that was taken away";
}

TEST(Pressure, LiftsWithHysteresis) {
  Floor tiles(floor_scene("{sensors: 4, load: 30}"));
  tiles.stand({28.0, 0.5, 0.5}, {});
  EXPECT_FALSE(tiles.felt[0].down || tiles.felt[1].down);
  tiles.stand({32.0, 0.8, 0.1}, {});
  EXPECT_TRUE(tiles.felt[0].down);
  for (const double force : {28.0, 20.0, 16.0}) {
    tiles.stand({force, 0.8, 0.1}, {});
    EXPECT_TRUE(tiles.felt[0].down) << force;
  }
  tiles.stand({14.0, 0.8, 0.1}, {});
  EXPECT_FALSE(tiles.felt[0].down);
}

// The load rolls from heel to toe, 18 cm; the foot slides on by what would leave its sole.
TEST(Pressure, AFootStandsWhileItsLoadRollsOverIt) {
  Floor tiles(floor_scene("{sensors: 4}"));
  for (int k = 0; k <= 20; ++k) tiles.stand({500.0, 0.6 + 0.009 * k, 0.2}, {});
  EXPECT_NEAR(tiles.felt[0].place[0], 0.6 + 0.18 - 0.7 * 0.145, 1.0e-4);
  EXPECT_NEAR(tiles.felt[0].place[1], 0.2, 1.0e-4);
  EXPECT_FALSE(tiles.felt[1].down);
}

TEST(Pressure, OneSensorATileFeelsStepsThatLeaveATileBetween) {
  Floor tiles(floor_scene("{sensors: 1}"));
  tiles.stand({500.0, 0.9, 0.15}, {});  // the edge of two tiles: half on either
  EXPECT_TRUE(tiles.felt[0].down);
  EXPECT_FALSE(tiles.felt[1].down);
  tiles.stand({500.0, 0.45, 0.15}, {200.0, 1.07, 0.46});
  EXPECT_TRUE(tiles.felt[0].down && tiles.felt[1].down);
}

TEST(Pressure, DriftBelowZeroMovesNoLoad) {
  PressureFeet feet(floor_scene("{columns: 1, rows: 1, tile: 0.4, sensors: 4}"));
  Vector3 place = {};
  feet.take({"/tile/pressure", {0, 100.0F, 100.0F, -80.0F, 0.0F}},
            [&](const FloorTouch& touch) { place = touch.place; });
  EXPECT_LT(length(place - Vector3{0.2, 0.0, 0.0}), 1.0e-6);
}

TEST(Pressure, TurnsWithItsRoom) {
  Scene scene = floor_scene("{columns: 2, rows: 1, tile: 0.5, sensors: 1}", "[1, 2, 0]");
  scene.tracking.yaw = 90.0;
  PressureFeet feet(scene);
  std::vector<FloorTouch> told;
  const GiveTouch give = [&](const FloorTouch& touch) { told.push_back(touch); };
  EXPECT_TRUE(feet.take({"/tile/pressure", {0, -500.0F, 100.0F}}, give));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_LT(length(told[0].place - Vector3{0.75, 2.75, 0.0}), 1.0e-6);
  EXPECT_TRUE(feet.take({"/tile/pressure", {70000, 5.0F}}, give));
  EXPECT_TRUE(feet.take({"/tile/pressure", {-1, 5.0F}}, give));
  EXPECT_FALSE(feet.take({"/tile/other", {0, 5.0F}}, give));
}

}  // namespace
}  // namespace splash::sim
