// SPDX-License-Identifier: MIT
// `tracking` of a scene: what it fills in, and what it refuses, each at its place with its reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim-server/scene/scene_reader.hpp"
#include "tests/support/refusal.hpp"

namespace splash::sim {
namespace {

using ::testing::HasSubstr;

Scene read(const std::string& source) {
  return parse_scene(R"(fluid: {particles: 500}
tank: {lower: [0.0, 0.0, 0.0], upper: [1.0, 1.0, 1.0]}
water:
  - {lower: [0.0, 0.0, 0.0], upper: [1.0, 1.0, 0.5]}
bodies:
  - {name: post, shape: {size: [0.1, 0.1, 0.2]}, rest: {position: [0.2, 0.2, 0.2]}}
  - {name: hand, shape: {size: [0.2, 0.1, 0.05]}, motion: {kind: osc}, rest: {position: [0, 0, 1]}}
tracking:
  sources:
    - {)" + source + "}\n",
                     "test.yaml");
}

TEST(TrackingReader, TakesWhatIsGivenInThePresetsPlace) {
  const Scene scene =
      read("body: hand, preset: natnetthree2osc, name: '7', axes: [x, y, z], unit: 0.001");
  ASSERT_EQ(scene.tracking.sources.size(), 1U);
  const TrackerSource& source = scene.tracking.sources[0];
  EXPECT_EQ(source.body, 1U);
  EXPECT_EQ(source.address, "/rigidbody");
  EXPECT_EQ(source.rotation_address, "/rigidbody");
  EXPECT_EQ(source.match, (std::vector<std::string>{"7", "position"}));
  EXPECT_EQ(source.rotation_match, (std::vector<std::string>{"7", "quat"}));
  EXPECT_EQ(source.axes, (std::array<std::size_t, 3>{0, 1, 2}));
  EXPECT_EQ(source.unit, 0.001);
}

struct Mistake {
  std::string source;
  std::string reason;
};
class TrackingMistake : public testing::TestWithParam<Mistake> {};

TEST_P(TrackingMistake, IsRefusedWithItsReason) {
  EXPECT_THAT(tests::refusal([] { return read(GetParam().source); }),
              AllOf(HasSubstr("test.yaml:1"), HasSubstr(GetParam().reason)))
      << GetParam().source;
}

INSTANTIATE_TEST_SUITE_P(
    Each, TrackingMistake,
    testing::Values(
        Mistake{"body: hand", "give it, or a `preset`"},
        Mistake{"body: hnad, address: /a", "there is no body named 'hnad'"},
        Mistake{"body: post, address: /a", "motion: {kind: osc}; there are: hand"},
        Mistake{"body: hand, preset: vcm, name: A", "vmc"},
        Mistake{"body: hand, preset: vmc", "what the sender calls the tracker"},
        Mistake{"body: hand, preset: vrchat, name: left foot", "letters, digits"},
        Mistake{"body: hand, address: a", "must be '/'"},
        Mistake{"body: hand, address: /body/pose", "has a meaning of its own"},
        Mistake{"body: hand, address: /a, position: [0, 1]", "x, y and z"},
        Mistake{"body: hand, address: /a, position: [0, 1, 1.5]", "whole numbers only"},
        Mistake{"body: hand, address: /a, position: [0, 1, 16]", "15"},
        Mistake{"body: hand, address: /a, position: [0, 1, 1]", "twice"},
        Mistake{"body: hand, address: /a, rotation: [3, 4]", "got 2"},
        Mistake{"body: hand, address: /a, rotation: [3, 4, 5, 6], euler: xyz", "three angles"},
        Mistake{"body: hand, address: /a, rotation_address: /b", "without `rotation`"},
        Mistake{"body: hand, address: /a, axes: [x, x, z]", "[z, -x, y]"},
        Mistake{"body: hand, address: /a, axes: [x, up, z]", "[z, -x, y]"},
        Mistake{"body: hand, address: /a, mount: {rotation: [0, 0, 0, 0]}", "length is zero"},
        Mistake{"body: hand, address: /a}\n    - {body: hand, address: /b", "moves it already"}));

}  // namespace
}  // namespace splash::sim
