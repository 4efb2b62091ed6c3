// SPDX-License-Identifier: MIT
// Packets as common senders send them end as the poses that they mean. What they mean is worked out
// with matrices here, from the senders' own descriptions.
#include "sim-server/bodies/motion/tracker_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "protocol/arrays.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"

namespace splash::sim {
namespace {

using Matrix = std::array<Vector3, 3>;  // rows

constexpr double kPlace = 1.0e-4;                           // [m]
constexpr double kAngle = 0.01 * std::numbers::pi / 180.0;  // [rad]

Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix product = {};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) product[i][j] += a[i][k] * b[k][j];
    }
  }
  return product;
}
Vector3 operator*(const Matrix& a, const Vector3& v) {
  return {dot(a[0], v), dot(a[1], v), dot(a[2], v)};
}
Matrix transposed(const Matrix& a) {
  Matrix other = {};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) other[i][j] = a[j][i];
  }
  return other;
}

/// About x, y or z, as in any textbook.
Matrix about(std::size_t axis, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  const std::size_t i = (axis + 1) % 3;
  const std::size_t j = (axis + 2) % 3;
  Matrix turn = {};
  turn[axis][axis] = 1.0;
  turn[i][i] = turn[j][j] = std::cos(angle);
  turn[i][j] = -std::sin(angle);
  turn[j][i] = std::sin(angle);
  return turn;
}
Matrix of(const Quaternion& q) {
  const auto [x, y, z, w] = q;
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
           {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
           {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
}
double angle_between(const Matrix& a, const Matrix& b) {
  const Matrix turn = transposed(a) * b;
  const Vector3 twice_sine = {turn[2][1] - turn[1][2], turn[0][2] - turn[2][0],
                              turn[1][0] - turn[0][1]};
  return std::atan2(length(twice_sine), turn[0][0] + turn[1][1] + turn[2][2] - 1.0);
}

constexpr Matrix kFromUnity = {{{0, 0, 1}, {-1, 0, 0}, {0, 1, 0}}};  // ahead, left, up
constexpr Matrix kFromMotive = {{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}};

std::vector<std::byte> bytes(const std::string& hexadecimal) {
  std::vector<std::byte> packet;
  for (std::size_t i = 0; i + 1 < hexadecimal.size(); i += 2) {
    packet.push_back(static_cast<std::byte>(std::stoi(hexadecimal.substr(i, 2), nullptr, 16)));
  }
  return packet;
}

Scene scene_with(const std::string& tracking) {
  return parse_scene(R"(fluid: {particles: 500}
tank: {lower: [0.0, 0.0, 0.0], upper: [1.0, 1.0, 1.0]}
water:
  - {lower: [0.0, 0.0, 0.0], upper: [1.0, 1.0, 0.5]}
bodies:
  - {name: post, shape: {size: [0.1, 0.1, 0.2]}, rest: {position: [0.2, 0.2, 0.2]}}
  - name: hand
    shape: {size: [0.2, 0.1, 0.05]}
    motion: {kind: osc}
    rest: {position: [0.5, 0.5, 0.9], rotation: [0.0, 0.0, 0.6, 0.8]}
tracking:
)" + tracking,
                     "test.yaml");
}

/// What packets made of the scene's one source.
class Mapped {
 public:
  explicit Mapped(const std::string& tracking) : map_(scene_with(tracking)) {}

  bool take(const protocol::Message& message, double arrival = 0.0) {
    return map_.take(message, {arrival, {}}, [this](const MappedPose& p) { poses.push_back(p); });
  }
  void take_packet(const std::string& hexadecimal) {
    const auto decoded = protocol::decode(bytes(hexadecimal));
    ASSERT_EQ(decoded.refusal, protocol::Refusal::none);
    for (const auto& message : decoded.packet.messages) EXPECT_TRUE(take(message));
  }
  void expect_one(const Vector3& position, const Matrix& rotation) const {
    ASSERT_EQ(poses.size(), 1U);
    EXPECT_EQ(poses[0].body, 1U);
    EXPECT_EQ(poses[0].refusal, PoseRefusal::none);
    EXPECT_LT(length(poses[0].position - position), kPlace);
    EXPECT_LT(angle_between(of(poses[0].rotation), rotation), kAngle);
  }

  std::vector<MappedPose> poses;

 private:
  TrackerMap map_;
};

// (0.25, 1.5, -0.75) and (0.1, 0.7, -0.1, 0.7) of the tracker LHR-1A2B3C4D, in a bundle.
const std::string kVmc =
    "2362756e646c6500ed003780400000000000004c2f564d432f4578742f5472612f506f73000000002c7366666666"
    "6666660000004c48522d3141324233433444000000003e8000003fc00000bf4000003dcccccd3f333333bdcccccd"
    "3f333333";
const Vector3 kPosition = {0.25, 1.5, -0.75};
const Quaternion kRotation = {0.1, 0.7, -0.1, 0.7};

TEST(TrackerMap, TakesVirtualMotionCapture) {
  Mapped mapped(R"(  position: [0.9, 0.8, 0.1]
  yaw: 90
  sources:
    - {body: hand, preset: vmc, name: LHR-1A2B3C4D, mount: {position: [0.01, 0.02, -0.03]}}
)");
  mapped.take_packet(kVmc);
  const Matrix tracker = kFromUnity * of(kRotation) * transposed(kFromUnity);
  const Matrix room = about(2, 90.0);
  const Vector3 held = kFromUnity * kPosition + tracker * Vector3{0.01, 0.02, -0.03};
  mapped.expect_one(Vector3{0.9, 0.8, 0.1} + room * held, room * tracker);
}

TEST(TrackerMap, TakesVrChatsTrackers) {
  Mapped mapped("  sources: [{body: hand, preset: vrchat, name: '1'}]\n");
  mapped.take_packet(
      "2f747261636b696e672f747261636b6572732f312f706f736974696f6e0000002c666666000000003e8000003f"
      "c00000bf400000");
  mapped.take_packet(
      "2f747261636b696e672f747261636b6572732f312f726f746174696f6e0000002c6666660000000041a00000c2"
      "0c000042dc0000");
  // Unity turns about z, then x, then y.
  const Matrix unity = about(1, -35.0) * about(0, 20.0) * about(2, 110.0);
  mapped.expect_one(kFromUnity * kPosition, kFromUnity * unity * transposed(kFromUnity));
}

// The numbers are those of the sender's own README, which tells where the body's z points, too.
TEST(TrackerMap, TakesNatnet2osc) {
  Mapped mapped("  sources: [{body: hand, preset: natnet2osc, name: uglyBall, unit: 0.01}]\n");
  mapped.take_packet(
      "2f7269676964626f64792f75676c7942616c6c2f6c6f636174696f6e336400002c6666660000000041e77f8cc2"
      "65688a3ffde4da");
  mapped.take_packet(
      "2f7269676964626f64792f75676c7942616c6c2f6f7269656e746174696f6e002c666666660000003f25c2c93e"
      "b746b13eb027253f14004b");
  ASSERT_EQ(mapped.poses.size(), 1U);
  EXPECT_LT(length(mapped.poses[0].position - Vector3{0.28937279, -0.5735209, 0.019835465}),
            kPlace);
  const Vector3 ahead = rotate(mapped.poses[0].rotation, {0.0, 0.0, 1.0});
  EXPECT_LT(length(ahead - Vector3{0.8594411, -0.50236946, -0.09479372}), kAngle);
}

TEST(TrackerMap, TakesNatNetThree2Osc) {
  Mapped mapped("  sources: [{body: hand, preset: natnetthree2osc, name: '7'}]\n");
  mapped.take_packet(
      "2f7269676964626f647900002c6973666666000000000007706f736974696f6e000000003e8000003fc00000bf"
      "400000");
  mapped.take_packet(
      "2f7269676964626f647900002c697366666666000000000771756174000000003dcccccd3f333333bdcccccd3f"
      "333333");
  mapped.expect_one(kFromMotive * kPosition, kFromMotive * of(kRotation) * transposed(kFromMotive));
}

// A headset and a tracker in arrays, as python-osc writes a list. The tracker is turned by 130, -25
// and 70 degrees about z, y and x, of which the sender says 130, 144.04 and 70.
TEST(TrackerMap, TakesOpenVrOsc) {
  Mapped mapped("  sources: [{body: hand, preset: openvr-osc, name: '1'}]\n");
  const auto decoded = protocol::decode_with_arrays(
      bytes("2362756e646c650000000000000000010000002c2f686d642f3100002c5b6666666666665d000000000000"
            "003fd9999a00000000000000000000000000000000000000302f747261636b65722f3100002c5b66666666"
            "66665d0000003e8000003fc00000bf4000004302000043100a88428c0000"));
  ASSERT_EQ(decoded.refusal, protocol::Refusal::none);
  for (const auto& message : decoded.packet.messages) mapped.take(message);
  constexpr Matrix kFromOpenVr = {{{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}}};  // ahead, left, up
  const Matrix tracker = about(2, 130.0) * about(1, -25.0) * about(0, 70.0);
  mapped.expect_one(kFromOpenVr * kPosition, kFromOpenVr * tracker * transposed(kFromOpenVr));
}

TEST(TrackerMap, TakesMessagesThatAreSpelledOut) {
  Mapped mapped(R"(  sources:
    - {body: hand, address: /phone, position: [3, 2, 0], unit: 0.001, axes: [-y, x, z],
       rotation: [4, 5, 6], euler: xyz, angles: radians}
)");
  EXPECT_TRUE(mapped.take({"/phone", {300.0F, std::string("mm"), 200.0F, 100, 0.3F, -0.4F, 0.5F}}));
  constexpr double kDegree = 180.0 / std::numbers::pi;
  const Matrix axes = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
  const Matrix turned =
      about(2, 0.5 * kDegree) * about(1, -0.4 * kDegree) * about(0, 0.3 * kDegree);
  mapped.expect_one(axes * Vector3{0.1, 0.2, 0.3}, axes * turned * transposed(axes));
}

TEST(TrackerMap, LeavesTheRotationWhereNoneIsSent) {
  Mapped mapped("  sources: [{body: hand, address: /a, position: [0, 1, 2]}]\n");
  EXPECT_TRUE(mapped.take({"/a", {0.1F, 0.2F, 0.3F}}));
  mapped.expect_one({0.1, 0.2, 0.3}, of({0.0, 0.0, 0.6, 0.8}));
}

TEST(TrackerMap, TakesABodyByItsName) {
  Mapped mapped("  yaw: 90\n  sources: [{body: hand, preset: vmc, name: A}]\n");
  EXPECT_TRUE(mapped.take(
      {"/body/pose", {std::string("hand"), 0.1F, 0.2F, 0.3F, 0.1F, 0.7F, -0.1F, 0.7F}}));
  EXPECT_FALSE(
      mapped.take({"/body/pose", {std::string("post"), 0.1F, 0.2F, 0.3F, 0.1F, 0.7F, -0.1F, 0.7F}}))
      << "it stands still";
  mapped.expect_one({0.1, 0.2, 0.3}, of(kRotation));
}

constexpr double kPeriod = 1.0 / 60.0;  // [s]
const protocol::Message kHalfTurn = {"/tracking/trackers/1/rotation", {0.0F, 180.0F, 0.0F}};
const protocol::Message kNoTurn = {"/tracking/trackers/1/rotation", {0.0F, 0.0F, 0.0F}};
protocol::Message at_height(float height) {
  return {"/tracking/trackers/1/position", {0.0F, height, 0.0F}};
}

// At 60 Hz a position that lost its rotation must not be given the next one's, nor the other way.
TEST(TrackerMap, JoinsOnlyWhatIsOfOneMoment) {
  Mapped mapped("  sources: [{body: hand, preset: vrchat, name: '1'}]\n");
  mapped.take(at_height(0.1F), 0.0);
  mapped.take(at_height(0.2F), kPeriod);
  mapped.take(kNoTurn, kPeriod + 0.001);
  ASSERT_EQ(mapped.poses.size(), 1U) << "the first rotation was lost";
  EXPECT_NEAR(mapped.poses[0].position[2], 0.2, 1e-6);
  mapped.take(kNoTurn, 2.0 * kPeriod);
  mapped.take(at_height(0.4F), 3.0 * kPeriod);
  ASSERT_EQ(mapped.poses.size(), 1U) << "the third position was lost";
  mapped.take(kHalfTurn, 3.0 * kPeriod + 0.001);
  ASSERT_EQ(mapped.poses.size(), 2U);
  EXPECT_NEAR(mapped.poses[1].position[2], 0.4, 1e-6);
  EXPECT_NEAR(std::abs(mapped.poses[1].rotation[3]), 0.0, 1e-6) << "the rotation of its moment";
}

TEST(TrackerMap, SaysWhatIsNoPose) {
  Mapped mapped("  sources: [{body: hand, preset: vmc, name: A}]\n");
  EXPECT_TRUE(mapped.take({"/VMC/Ext/Tra/Pos", {std::string("A"), 0.1F, 0.2F}}));
  EXPECT_TRUE(mapped.take(
      {"/VMC/Ext/Tra/Pos", {std::string("A"), 0.1F, 0.2F, 0.3F, 0.0F, 0.0F, 0.0F, 0.0F}}));
  ASSERT_EQ(mapped.poses.size(), 2U);
  EXPECT_EQ(mapped.poses[0].refusal, PoseRefusal::malformed);
  EXPECT_EQ(mapped.poses[1].refusal, PoseRefusal::no_rotation);
}

// So that a scene that maps one of a suit's trackers does not call all others a mistake.
TEST(TrackerMap, KnowsWhatElseItsSendersSay) {
  const TrackerMap map(scene_with(R"(  sources:
    - {body: hand, preset: vmc, name: A}
)"));
  EXPECT_TRUE(map.is_of_sender("/VMC/Ext/OK"));
  EXPECT_TRUE(map.is_of_sender("/VMC/Ext/Bone/Pos"));
  EXPECT_FALSE(map.is_of_sender("/VMCExt"));
  EXPECT_FALSE(map.is_of_sender("/statu"));
  EXPECT_FALSE(map.is_of_sender("/"));
}

TEST(TrackerMap, LeavesOthersMessagesAlone) {
  Mapped mapped("  sources: [{body: hand, preset: vmc, name: A}]\n");
  EXPECT_FALSE(mapped.take({"/VMC/Ext/Tra/Pos", {std::string("B"), 0.1F}}));
  EXPECT_FALSE(mapped.take({"/VMC/Ext/Tra/Pos", {}}));
  EXPECT_FALSE(mapped.take({"/VMC/Ext/Root/Pos", {std::string("A"), 0.1F}}));
  EXPECT_TRUE(mapped.poses.empty());
}

}  // namespace
}  // namespace splash::sim
