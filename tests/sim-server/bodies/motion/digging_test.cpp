// SPDX-License-Identifier: MIT
// Bodies whose recording or script takes them through the floor or a wall.
#include "sim-server/bodies/motion/digging.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/scene/shape.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A foot that stands for half a second and then rises on its ball, 19 cm before its heel, until
/// its sole is pitched by 57 degrees. Its markers end at the ball, as those of many recordings do.
class PushOff {
 public:
  PushOff() {
    std::ostringstream text;
    text << "PathFileType\t4\t(X/Y/"
            "Z)\ta.trc\nDataRate\tNumFrames\tNumMarkers\tUnits\n100\t100\t4\tm\n"
            "Frame#\tTime\tHeel\t\t\tMT2\t\t\tMT1\t\t\tMT5\t\t\n\t\tX1\tY1\tZ1\n";
    for (int k = 0; k < 100; ++k) {
      const double share = std::max(0.0, (k - 50) / 49.0);
      const double pitch = 1.0 * share * share;
      text << k + 1 << '\t' << 0.01 * k;
      // x ahead of the ball, y up, z to the right; the first is the heel's.
      for (const auto& [x, y, z] :
           {std::array{-0.19, 0.06, 0.0}, std::array{0.0, 0.05, 0.0},
            std::array{-0.01, 0.04, -0.04}, std::array{-0.02, 0.04, 0.05}}) {
        text << '\t' << 0.5 + x * std::cos(pitch) + y * std::sin(pitch) << '\t'
             << -x * std::sin(pitch) + y * std::cos(pitch) << '\t' << z;
      }
      text << '\n';
    }
    folder_.write("push-off.trc", text.str());
  }
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "push-off.trc"; }

 private:
  tests::TemporaryFolder folder_;
};

Scene scene_with(const std::string& body) {
  return parse_scene(
      "fluid: {spacing: 0.01}\n"
      "tank: {lower: [-0.5, -0.5, -0.05], upper: [1.5, 0.5, 0.5]}\n"
      "water: [{lower: [-0.5, -0.5, -0.05], upper: [1.5, 0.5, 0.0]}]\n"
      "bodies:\n" +
          body,
      "dig.yaml");
}

Scene with_shoe(const std::string& length) {
  return scene_with("  - {name: shoe, shape: {size: [" + length +
                    ", 0.1, 0.07], rocker: 0.03, flat: 0.5}, motion: {kind: trc, sole: true, "
                    "markers: [Heel, MT2, MT1, MT5]}}\n");
}

TEST(Digging, OfAShoeIsToldWithTheLengthThatFits) {
  const PushOff recording;
  const auto notices = digging_notices(with_shoe("0.29"), recording.path());
  const Digging digging = deepest_digging(with_shoe("0.29"), 0, recording.path());
  EXPECT_NEAR(digging.seconds, 0.99, 0.005) << "when it is steepest";
  EXPECT_GT(digging.depth, 0.02);
  EXPECT_GT(digging.point[0], 0.1) << "at the toe";
  std::ostringstream text;
  text << "'shoe' goes " << std::lround(1e3 * digging.depth)
       << " mm below the floor at 0.99 s, with its toe";
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_THAT(notices[0], HasSubstr(text.str()));
  const auto place = notices[0].find("one of ");
  ASSERT_NE(place, std::string::npos) << notices[0];
  const double fits = std::stod(notices[0].substr(place + 7));
  EXPECT_LT(fits, 0.27);
  EXPECT_GT(fits, 0.2);
  const auto depth = [&](double length) {
    return deepest_digging(with_shoe(std::to_string(length)), 0, recording.path()).depth;
  };
  EXPECT_LE(depth(fits), 0.006) << "a few millimetres, of which three are its softness";
  EXPECT_GT(depth(fits + 0.005), depth(fits));
}

TEST(Digging, OfAShoeThatFitsIsNotTold) {
  const PushOff recording;
  EXPECT_THAT(digging_notices(with_shoe("0.21"), recording.path()), IsEmpty());
}

const std::string kBox =
    "  - {name: box, shape: {size: [0.2, 0.1, 0.1]}, motion: {kind: script, "
    "smooth: false, keyframes: [{time: 0, position: ";

TEST(Digging, OfAScriptIsMeasured) {
  const Scene floor = scene_with(kBox + "[0, 0, 0.3]}, {time: 1, position: [0, 0, -0.02]}]}}\n");
  const Digging low = deepest_digging(floor, 0, {});
  EXPECT_NEAR(low.depth, 0.02, 1e-9) << "its underside is at -0.07, the floor at -0.05";
  EXPECT_NEAR(low.seconds, 1.0, 1e-9);
  EXPECT_THAT(digging_notices(floor, {}),
              ElementsAre(HasSubstr("'box' goes 20 mm below the floor at 1.00 s")));
  const Scene wall = scene_with(kBox + "[0, 0, 0.3]}, {time: 2, position: [1.43, 0, 0.3]}]}}\n");
  EXPECT_THAT(digging_notices(wall, {}),
              ElementsAre(HasSubstr("30 mm through the wall at x = 1.5 m at 2.00 s")));
  const Scene tilted =
      scene_with(kBox +
                 "[0, 0, 0.3], rotation: [0, 0.70711, 0, 0.70711]}, {time: 1, "
                 "position: [0, 0, 0.03], rotation: [0, 0.70711, 0, 0.70711]}]}}\n");
  EXPECT_NEAR(deepest_digging(tilted, 0, {}).depth, 0.02, 1e-6) << "upright it is 0.2 m high";
}

TEST(Digging, IsNoMatterBeyondTheWallsOrInTheAir) {
  EXPECT_THAT(
      digging_notices(scene_with(kBox + "[0, 0, 0.3]}, {time: 1, position: [0, 0, 0.1]}]}}\n"), {}),
      IsEmpty());
  EXPECT_THAT(digging_notices(
                  scene_with(kBox + "[2, 0, 0.3]}, {time: 1, position: [2, 0, -0.5]}]}}\n"), {}),
              IsEmpty())
      << "beside the tank";
  EXPECT_THAT(digging_notices(
                  scene_with(kBox + "[0, 0, 0.8]}, {time: 1, position: [1.49, 0, 0.8]}]}}\n"), {}),
              IsEmpty())
      << "over the rim";
}

// What they are worth is known for a sphere, a cylinder and a box with a curved sole.
TEST(Digging, FindsTheOutermostPointOfEachShape) {
  const Vector3 askew = {0.36, 0.48, -0.8};
  const auto reach = [&](const Shape& shape) {
    const Vector3 point = outermost(shape, askew);
    return point[0] * askew[0] + point[1] * askew[1] + point[2] * askew[2];
  };
  EXPECT_NEAR(reach({ShapeKind::sphere, {0.2, 0.2, 0.2}}), 0.1, 1e-12);
  EXPECT_NEAR(reach({ShapeKind::cylinder, {0.2, 0.2, 0.3}}), 0.1 * 0.6 + 0.15 * 0.8, 1e-12);
  EXPECT_NEAR(reach({ShapeKind::box, {0.2, 0.4, 0.3}}), 0.1 * 0.36 + 0.2 * 0.48 + 0.15 * 0.8,
              1e-12);
  const Shape sole = {ShapeKind::box, {0.3, 0.1, 0.08}, 0.03, 0.5};
  EXPECT_NEAR(outermost(sole, {0.0, 0.0, -1.0})[2], -0.04, 1e-12) << "its flat middle";
  // On the curve rocker s^2, s from 0 to 1 over the last 75 mm, its slope is 0.8 s; where that is
  // the tangent of the pitch it is lowest.
  const Vector3 pitched = {std::sin(0.3), 0.0, -std::cos(0.3)};
  const double s = std::tan(0.3) / 0.8;
  const Vector3 lowest = outermost(sole, pitched);
  EXPECT_NEAR(lowest[0], 0.075 + 0.075 * s, 0.3 / 60.0);
}

}  // namespace
}  // namespace splash::sim
