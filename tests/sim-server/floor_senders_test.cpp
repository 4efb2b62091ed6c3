// SPDX-License-Identifier: MIT
// Two programs that say at once what one floor feels: the feet follow the one that began last, and
// both are told of. Sources of other names, and other tiles, are other floors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim-server/bodies/motion/floor_motion.hpp"
#include "sim-server/device/device.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/serve/pose_intake.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {
namespace {

using protocol::Message;

const std::string kTiles = "tracking: {floor: {columns: 4, rows: 1, tile: 0.5, sensors: 1}}\n";
const std::string kTable =
    "tracking:\n  position: [0, 1, 0]\n  sources:\n"
    "    - {preset: tuio, body: left, floor: [2, 1]}\n"
    "    - {preset: tuio, body: right, floor: [2, 1]}\n";

Scene scene_of(const std::string& kind, const std::string& tracking) {
  const std::string foot = ", shape: {size: [0.27, 0.1, 0.08]}, motion: {kind: " + kind + "}, ";
  return parse_scene(
      "fluid: {particles: 300}\ntank: {lower: [0, 0, 0], upper: [2, 1, 0.5]}\n"
      "water: [{lower: [0, 0, 0], upper: [2, 1, 0.1]}]\nbodies:\n  - {name: left" +
          foot + "rest: {position: [0.25, 0.5, 0.05]}}\n  - {name: right" + foot +
          "rest: {position: [1.75, 0.5, 0.05]}}\n" + tracking,
      "floor.yaml");
}

constexpr protocol::Endpoint kFirst = {.address = 0x0A000001, .port = 4001};
constexpr protocol::Endpoint kLast = {.address = 0x0A000002, .port = 4002};

class FloorSenders : public testing::Test {
 protected:
  void open(const std::string& kind, const std::string& tracking) {
    scene_ = scene_of(kind, tracking);
    simulation_.emplace(device_, scene_, std::filesystem::path{});
    intake_.emplace(*simulation_, [this](const std::string& line) { told_.push_back(line); });
  }
  void say(const protocol::Endpoint& from, double now, const std::vector<Message>& messages) {
    for (const Message& message : messages) {
      EXPECT_TRUE(intake_->track(message, {now, {}, from})) << message.address;
    }
  }
  /// Sensor `first` and no other feels `force` [N].
  void weigh(const protocol::Endpoint& from, double now, int first, float force) {
    say(from, now, {{"/tile/pressure", {first, force}}});
  }
  /// Cursor `id` at x [surface widths], none if `id` is 0, as frame `number` of `source`.
  void touch(const protocol::Endpoint& from, double now, int number, int id, float x,
             const std::string& source = "") {
    const std::string address = "/tuio/2Dcur";
    std::vector<Message> frame;
    if (!source.empty()) frame.push_back({address, {std::string("source"), source}});
    frame.push_back({address, {std::string("alive")}});
    if (id != 0) {
      frame.back().arguments.emplace_back(id);
      frame.push_back({address, {std::string("set"), id, x, 0.5F, 0.0F, 0.0F, 0.0F}});
    }
    frame.push_back({address, {std::string("fseq"), number}});
    say(from, now, frame);
  }
  /// Where a foot is on its way to after a second; high: it is in the air.
  Vector3 place(std::int32_t body, double now) {
    PosedMotion* const foot = simulation_->live_body(body);
    for (int k = 0; k < 100; ++k, clock_ += 0.01) foot->begin({clock_, now, 0.01});
    return foot->at(clock_).position;
  }
  void expect_at(std::int32_t body, double now, double x) {
    const Vector3 at = place(body, now);
    EXPECT_LT(at[2], 0.06) << "it stands";
    EXPECT_NEAR(at[0], x, 0.01);
  }
  void expect_up(std::int32_t body, double now) { EXPECT_GT(place(body, now)[2], 0.1); }

  Device device_;
  Scene scene_;
  std::optional<Simulation> simulation_;
  std::optional<PoseIntake> intake_;
  std::vector<std::string> told_;
  double clock_ = 0.0;
};

TEST_F(FloorSenders, OfOneTileTheOneThatBeganLastIsFollowed) {
  open("pressure", kTiles);
  testing::internal::CaptureStderr();
  for (int k = 0; k < 200; ++k) {
    const double now = 10.0 + 0.01 * k;
    weigh(kFirst, now, 0, 500.0F);
    weigh(kFirst, now, 3, 0.0F);
    if (k < 100) continue;
    weigh(kLast, now, 0, 0.0F);
    weigh(kLast, now, 3, 300.0F);
  }
  expect_up(0, 12.0);
  expect_at(1, 12.0, 1.75);
  EXPECT_EQ(
      testing::internal::GetCapturedStderr(),
      "sim-server: 10.0.0.1:4001 and 10.0.0.2:4002 both send the floor's sensor 0: it follows "
      "10.0.0.2:4002, which began last, until that is silent for 3 s. Stop one of them, or "
      "let it send other sensors.\n");
  EXPECT_THAT(told_, testing::ElementsAre("10.0.0.1:4001 yields to 10.0.0.2:4002 on the floor"));
  EXPECT_EQ(intake_->refused(), 198U) << "two each time but the first";
  weigh(kFirst, 15.5, 0, 500.0F);
  weigh(kFirst, 15.5, 3, 0.0F);
  expect_at(0, 15.5, 0.25);
  expect_up(1, 15.6);
}

TEST_F(FloorSenders, OfOtherTilesAreOneFloor) {
  open("pressure", kTiles);
  for (int k = 0; k < 100; ++k) {
    weigh(kFirst, 10.0 + 0.01 * k, 0, 500.0F);
    weigh(kLast, 10.0 + 0.01 * k, 3, 300.0F);
  }
  expect_at(0, 11.0, 0.25);
  expect_at(1, 11.0, 1.75);
  EXPECT_EQ(intake_->refused(), 0U);
  EXPECT_TRUE(told_.empty());
}

TEST_F(FloorSenders, OfOneTuioSourceTheOneThatBeganLastIsFollowed) {
  open("touch", kTable);
  testing::internal::CaptureStderr();
  for (int k = 0; k < 200; ++k) {
    const double now = 10.0 + 0.01 * k;
    touch(kFirst, now, 900 + k, 7, 0.1F, "pad");
    if (k >= 100) touch(kLast, now, k, 4, 0.9F, "pad");
  }
  expect_up(0, 12.0);
  expect_at(1, 12.0, 1.8);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "sim-server: 10.0.0.1:4001 and 10.0.0.2:4002 both send TUIO's /tuio/2Dcur as source "
            "'pad': it follows 10.0.0.2:4002, which began last, until that is silent for 3 s. Stop "
            "one of them, or give it another source name.\n");
  EXPECT_THAT(told_, testing::ElementsAre("10.0.0.1:4001 yields to 10.0.0.2:4002 on TUIO"));
  touch(kFirst, 15.5, 2000, 7, 0.1F, "pad");
  expect_at(0, 15.5, 0.2);
  expect_up(1, 15.6);
}

// A surface that nobody touches says so once a second, and is no other sender each time.
TEST_F(FloorSenders, ASurfaceThatIsNotTouchedTakesNothingAgain) {
  open("touch", kTable);
  touch(kFirst, 9.0, 1, 0, 0.0F);
  for (int k = 0; k < 500; ++k) {
    const double now = 10.0 + 0.01 * k;
    touch(kLast, now, k, 4, 0.9F);
    if (k % 100 == 0) touch(kFirst, now, 2 + k / 100, 0, 0.0F);
  }
  expect_at(1, 15.0, 1.8);
  EXPECT_THAT(told_, testing::SizeIs(1));
}

TEST_F(FloorSenders, SourcesOfOtherNamesAreOtherSurfaces) {
  open("touch", kTable);
  for (int k = 0; k < 100; ++k) {
    touch(kFirst, 10.0 + 0.01 * k, k, 7, 0.1F, "one");
    touch(kLast, 10.0 + 0.01 * k, k, 7, 0.9F, "two");
  }
  expect_at(0, 11.0, 0.2);
  expect_at(1, 11.0, 1.8);
  EXPECT_TRUE(told_.empty());
}

// A seventeenth source takes the place of the one that has been silent for longest, whose senders
// are forgotten.
TEST_F(FloorSenders, NoMoreThanSixteenTuioSourcesAreRemembered) {
  open("touch", kTable);
  touch(kFirst, 10.0, 1, 7, 0.1F, "pad");
  touch(kLast, 10.1, 2, 4, 0.9F, "pad");
  touch(kFirst, 10.2, 3, 7, 0.1F, "pad");
  expect_up(0, 10.2);
  for (int k = 0; k < 16; ++k) touch(kFirst, 11.3, 1, 0, 0.0F, std::to_string(k));
  touch(kFirst, 12.4, 4, 7, 0.1F, "pad");
  expect_at(0, 12.4, 0.2);
}

}  // namespace
}  // namespace splash::sim
