// SPDX-License-Identifier: MIT
// Gauges, gates, flows and forms of water as a scene spells them; each mistake at its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim-server/scene/scene_reader.hpp"
#include "tests/support/refusal.hpp"

namespace splash::sim {
namespace {

using ::testing::HasSubstr;

const std::string kGood = R"(fluid: {spacing: 0.02}
tank: {lower: [0, 0, 0], upper: [1, 0.2, 1]}
water:
  - {lower: [0.5, 0, 0], upper: [0.8, 0.2, 0.3], form: cylinder}
  - {lower: [0.6, 0, 0.5], upper: [0.8, 0.2, 0.7], form: sphere}
gate: {x: 0.45}
flow: {kind: strain, centre: [0.65, 0, 0.15], rate: 3}
bodies:
  - {name: post, shape: {size: [0.1, 0.1, 0.4]}, rest: {position: [0.2, 0.1, 0.2]}}
gauges:
  rate: 50
  probes:
    - {name: H1, kind: height, x: 0.6, y: 0.1}
    - {name: P1, kind: pressure, place: [0.6, 0.1, 0.05]}
    - {name: tip, kind: front, axis: -x}
    - {name: post, kind: body, body: post}
    - {name: flank, kind: pressure, body: post, place: [0.05, 0, 0.1], radius: 0.02}
    - {name: flow, kind: velocity, body: post, place: [0.1, 0, 0]}
    - {name: hole, kind: cavity, lower: [0.5, 0, 0], upper: [0.8, 0.2, 0.3]}
)";

TEST(GaugeReader, ReadsWhatIsWritten) {
  const Scene scene = parse_scene(kGood, "good.yaml");
  EXPECT_EQ(scene.water[0].form, WaterForm::cylinder);
  EXPECT_EQ(scene.water[1].form, WaterForm::sphere);
  EXPECT_TRUE(scene.gate.present);
  EXPECT_EQ(scene.flow.kind, FlowKind::strain);
  EXPECT_DOUBLE_EQ(scene.flow.rate, 3.0);
  EXPECT_DOUBLE_EQ(scene.gauges.rate, 50.0);
  ASSERT_EQ(scene.gauges.probes.size(), 7U);
  EXPECT_DOUBLE_EQ(scene.gauges.probes[0].x, 0.6);
  EXPECT_DOUBLE_EQ(scene.gauges.probes[1].place[2], 0.05);
  EXPECT_EQ(scene.gauges.probes[2].axis, 0U);
  EXPECT_EQ(scene.gauges.probes[2].sign, -1.0);
  EXPECT_EQ(scene.gauges.probes[3].body, 0U);
  EXPECT_FALSE(scene.gauges.probes[3].rides);
  EXPECT_TRUE(scene.gauges.probes[4].rides);
  EXPECT_DOUBLE_EQ(scene.gauges.probes[4].radius, 0.02);
  EXPECT_EQ(scene.gauges.probes[5].kind, GaugeKind::velocity);
  EXPECT_DOUBLE_EQ(scene.gauges.probes[6].upper[2], 0.3);
}

TEST(GaugeReader, RefusesGaugesWithoutProbes) {
  const std::string text = kGood.substr(0, kGood.find("  probes:"));
  EXPECT_THAT(tests::refusal([&] { return parse_scene(text, "bad.yaml"); }),
              HasSubstr("name at least one"));
}

/// One change to the good scene, and what the error must say.
struct Mistake {
  std::string name;
  std::string from;
  std::string to;
  std::string says;
};

class GaugeReaderMistakes : public ::testing::TestWithParam<Mistake> {};

TEST_P(GaugeReaderMistakes, AreRefused) {
  const Mistake& mistake = GetParam();
  std::string text = kGood;
  const std::size_t at = text.find(mistake.from);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, mistake.from.size(), mistake.to);
  EXPECT_THAT(tests::refusal([&] { return parse_scene(text, "bad.yaml"); }),
              AllOf(HasSubstr("bad.yaml:"), HasSubstr(mistake.says)));
}

INSTANTIATE_TEST_SUITE_P(
    Each, GaugeReaderMistakes,
    ::testing::Values(
        Mistake{"GateInTheWater", "x: 0.45", "x: 0.6", "stands in the water"},
        Mistake{"GateOutside", "x: 0.45", "x: 1.5", "outside the tank"},
        Mistake{"FormOnASlope", "gate: {x: 0.45}", "slope: {foot: 0.1}", "only boxes"},
        Mistake{"UnknownForm", "form: sphere", "form: cube", "sphere"},
        Mistake{"FlowWithoutKind", "kind: strain, ", "", "kind"},
        Mistake{"ForeignKeyOfAFlow", "rate: 3", "speed: 3", "no meaning for a flow of kind strain"},
        Mistake{"MissingKey", "x: 0.6, y: 0.1", "x: 0.6", "a gauge of kind height needs it"},
        Mistake{"ForeignKey", "axis: -x", "axis: -x, body: post",
                "no meaning for a gauge of kind front"},
        Mistake{"UnknownKind", "kind: pressure", "kind: presure", "pressure"},
        Mistake{"UnknownAxis", "axis: -x", "axis: z", "-x"},
        Mistake{"UnknownBody", "body: post}", "body: pots}", "there are: post"},
        Mistake{"SameNameTwice", "name: P1", "name: H1", "another gauge named 'H1'"},
        Mistake{"NameWithAComma", "name: P1", "name: 'P,1'", "letters, digits"},
        Mistake{"ProbeOutside", "place: [0.6, 0.1, 0.05]", "place: [0.6, 0.3, 0.05]",
                "outside the tank"},
        Mistake{"SensorInsideItsBody", "body: post, place: [0.05, 0, 0.1]",
                "body: post, place: [0.02, 0, 0.1]", "0.03 m inside the body 'post'"},
        Mistake{"SizedSensorInTheOpen", "body: post, place: [0.05, 0, 0.1]",
                "body: post, place: [0.08, 0, 0.1]", "this one is 0.03 m from it"},
        Mistake{"SizedSensorFarFromWalls", "place: [0.6, 0.1, 0.05]",
                "place: [0.6, 0.1, 0.05], radius: 0.01", "let into a wall"},
        Mistake{"SizedVelocity", "body: post, place: [0.1, 0, 0]",
                "body: post, place: [0.1, 0, 0], radius: 0.01",
                "no meaning for a gauge of kind velocity"},
        Mistake{"RidingOnNobody", "velocity, body: post", "velocity, body: pots",
                "there are: post"},
        Mistake{"FlatRegion", "cavity, lower: [0.5, 0, 0]", "cavity, lower: [0.9, 0, 0]",
                "not above that of 'lower'"}),
    [](const auto& parameter) { return parameter.param.name; });

}  // namespace
}  // namespace splash::sim
