// SPDX-License-Identifier: MIT
// The shipped rigs are what they say; broken ones are answered with place, key, limit and cure.
#include "synth-server/output/rig_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program/config.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/text_of.hpp"

namespace splash::synth {
namespace {

using testing::HasSubstr;

Rig shipped(const std::string& name) {
  return read_rig(std::filesystem::path(SPLASH_SOURCE_DIR) / "configs/rigs" / (name + ".yaml"));
}

TEST(ShippedRigs, FloorOf36Tiles) {
  const Rig rig = shipped("tiles36");
  ASSERT_EQ(channel_count(rig), 36);
  const Output& floor = rig.outputs.at(0);
  EXPECT_EQ(floor.kind, OutputKind::tiles);
  EXPECT_DOUBLE_EQ(floor.tile_size, 0.305);
  EXPECT_DOUBLE_EQ(floor.band.low, 20.0);
  EXPECT_DOUBLE_EQ(floor.band.high, 750.0);
  const auto names = channel_names(rig);
  EXPECT_EQ(names.front(), "floor/tile/00");
  EXPECT_EQ(names.back(), "floor/tile/35");
}

TEST(ShippedRigs, HandheldAndStereoAndBoth) {
  EXPECT_EQ(channel_names(shipped("handheld")), std::vector<std::string>{"hand"});
  const Rig stereo = shipped("stereo");
  EXPECT_EQ(channel_names(stereo), (std::vector<std::string>{"speakers/left", "speakers/right"}));
  EXPECT_DOUBLE_EQ(stereo.outputs.at(0).band.low, 12.0);
  EXPECT_DOUBLE_EQ(stereo.outputs.at(0).band.high, 20000.0);
  const Rig both = shipped("handheld+stereo");
  EXPECT_EQ(channel_names(both),
            (std::vector<std::string>{"hand", "speakers/left", "speakers/right"}));
  EXPECT_DOUBLE_EQ(both.outputs.at(0).band.high, 750.0);
  EXPECT_DOUBLE_EQ(both.outputs.at(1).band.high, 20000.0);
}

TEST(ShippedRigs, LoudspeakersStandAroundTheScenesMiddle) {
  for (const char* name : {"stereo", "handheld+stereo"}) {
    Rig rig = shipped(name);
    centre(rig, {0.915, 0.5, 0.25});
    EXPECT_EQ(rig.outputs.back().place, (std::array<double, 3>{0.915, 0.5, 0.25})) << name;
  }
  Rig floor = shipped("tiles36");
  centre(floor, {0.915, 0.5, 0.25});
  EXPECT_EQ(floor.outputs.at(0).place, (std::array<double, 3>{0.0, 0.0, 0.0}));
}

TEST(ShippedRigs, AMiddleOfTheRigsOwnIsKept) {
  Rig rig = parse_rig(
      "name: r\noutputs:\n  - {name: s, kind: stereo, band: {low: 20, high: 750}, "
      "stereo: {middle: [0.0, 0.0, 0.0]}}\n",
      "r.yaml");
  centre(rig, {0.915, 0.5, 0.25});
  EXPECT_EQ(rig.outputs.at(0).place, (std::array<double, 3>{0.0, 0.0, 0.0}));
}

TEST(ShippedRigs, ShoesGoByTheirFootAndAGloveByItsHand) {
  const Rig shoes = shipped("shoes");
  EXPECT_EQ(channel_names(shoes), (std::vector<std::string>{"left shoe/heel", "left shoe/toe",
                                                            "right shoe/heel", "right shoe/toe"}));
  EXPECT_EQ(shoes.outputs.at(0).body, 0);
  EXPECT_EQ(shoes.outputs.at(1).body, 1);
  const Rig glove = shipped("glove");
  EXPECT_EQ(channel_names(glove),
            (std::vector<std::string>{"fingertips/thumb", "fingertips/index", "fingertips/middle",
                                      "fingertips/ring", "fingertips/little", "palm/centre"}));
  for (const Output& output : glove.outputs) EXPECT_EQ(output.body, 0);
}

TEST(ShippedRigs, AllOfThemReadAndKnowWhatIsPerceived) {
  int count = 0;
  const std::filesystem::path folder = std::filesystem::path(SPLASH_SOURCE_DIR) / "configs/rigs";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".yaml") continue;
    for (const Output& output : read_rig(entry.path()).outputs) {
      const bool felt = output.band.high < 1000.0;
      EXPECT_EQ(output.threshold.sense, felt ? Sense::touch : Sense::hearing) << entry.path();
    }
    ++count;
  }
  EXPECT_GE(count, 4);
}

const std::string kBegin = "name: x\noutputs:\n  - name: hand\n    band: {low: 20, high: 750}\n";

const std::string kWorn = "    kind: worn\n    parts: [heel, toe]\n";
const std::string kSections = "    equalisers:\n      - sections:\n        [";
const std::string kResponse = "    equalisers:\n      - response: ";

struct Broken {
  std::string text;
  std::string place;
  std::string words;
};

class BrokenRig : public testing::TestWithParam<Broken> {};
INSTANTIATE_TEST_SUITE_P(
    All, BrokenRig,
    testing::Values(
        Broken{kBegin + "    kind: single\n    celing: 0.5\n", "rig.yaml:6:5", "ceiling"},
        Broken{kBegin + "    kind: single\n    ceiling: 1.5\n", "rig.yaml:6:", "ceiling"},
        Broken{kBegin + "    kind: tile\n", "rig.yaml:5:", "tiles"},
        Broken{kBegin, "rig.yaml:3:", "kind"},
        Broken{kBegin + "    kind: single\n    tiles: {columns: 2}\n", "rig.yaml:6:", "kind"},
        Broken{kBegin + "    kind: single\n    trims_db: [1, 2]\n",
               "rig.yaml:3:", "one per channel"},
        Broken{kBegin + "    kind: single\n    body: 1.5\n", "rig.yaml:6:", "body"},
        Broken{kBegin + "    kind: single\n    parts: [heel]\n", "rig.yaml:6:", "not worn"},
        Broken{kBegin + "    kind: worn\n", "rig.yaml:3:", "[heel, toe]"},
        Broken{kBegin + "    kind: worn\n    parts: [toe, toe]\n", "rig.yaml:3:", "differ"},
        Broken{kBegin + kWorn + "    equalisers: [{channels: [heal]}]\n", "rig.yaml:3:", "heal"},
        Broken{kBegin + kWorn + "    equalisers: [{most_boost_db: 30}]\n",
               "rig.yaml:7:", "most_boost_db"},
        Broken{kBegin + kWorn + kSections + "{kind: peak, frequency: 99, gain_db: 12}]\n",
               "rig.yaml:3:", "most_boost_db"},
        Broken{kBegin + kWorn + kSections + "{kind: notch, frequency: 99, gain_db: 1}]\n",
               "rig.yaml:9:", "peak"},
        Broken{kBegin + kWorn + kResponse + "{frequency: [90, 80], level_db: [1, 2]}\n",
               "rig.yaml:3:", "1.05"},
        Broken{kBegin + kWorn + kResponse + "{frequency: [80, 90], level_db: [1]}\n",
               "rig.yaml:3:", "as many"},
        Broken{kBegin + "    kind: tiles\n    tiles: {reach: 0.1}\n", "rig.yaml:3:", "tiles.reach"},
        Broken{kBegin + "    kind: tiles\n    tiles: {rows: 64, columns: 64}\n",
               "rig.yaml:6:32:", "at most 16 with 64 rows, got '64'"},
        Broken{
            "name: x\noutputs:\n  - name: a\n    kind: single\n    band: {low: 800, high: 750}\n",
            "rig.yaml:3:", "band.high"},
        Broken{kBegin + kWorn + "    heat: {rms: 0}\n", "rig.yaml:7:", "rms"},
        Broken{kBegin + kWorn + "    heat: {rms: 0.2, seconds: 0}\n", "rig.yaml:7:", "seconds"},
        Broken{kBegin + "    kind: single\ndevice_channels: [1, 2]\n",
               "rig.yaml:6:", "1 channels: one each"},
        Broken{kBegin + kWorn + "device_channels: [2, 2]\n", "rig.yaml:7:", "named twice"},
        Broken{kBegin + kWorn + "device_channels: [2, 0]\n", "rig.yaml:7:", "device_channels"},
        Broken{kBegin + kWorn + "device_channels: [2, 1.5]\n", "rig.yaml:7:", "whole"},
        Broken{"name: x\n", "rig.yaml:", "outputs"},
        Broken{"name: x\noutputs: []\n", "rig.yaml:", "outputs"}));

TEST_P(BrokenRig, IsAnsweredWithItsPlaceAndTheReason) {
  EXPECT_THAT(tests::refusal([] { return parse_rig(GetParam().text, "rig.yaml"); }),
              AllOf(HasSubstr(GetParam().place), HasSubstr(GetParam().words)))
      << GetParam().text;
}

TEST(Rig, ReadsEqualisers) {
  const Rig rig = parse_rig(kBegin + kWorn +
                                "    equalisers:\n"
                                "      - channels: [toe]\n"
                                "        most_boost_db: 9\n"
                                "        sections: [{kind: low_shelf, frequency: 40, gain_db: 9}]\n"
                                "      - response:\n"
                                "          frequency: [30, 60, 120]\n"
                                "          level_db: [-8, 0, 4]\n",
                            "rig.yaml");
  const auto& equalisers = rig.outputs.at(0).equalisers;
  ASSERT_EQ(equalisers.size(), 2U);
  EXPECT_EQ(equalisers[0].channels, std::vector<std::string>{"toe"});
  ASSERT_EQ(equalisers[0].sections.size(), 1U);
  EXPECT_EQ(equalisers[0].sections[0].kind, SectionKind::low_shelf);
  EXPECT_DOUBLE_EQ(equalisers[0].sections[0].gain_db, 9.0);
  EXPECT_TRUE(equalisers[1].channels.empty());
  EXPECT_EQ(equalisers[1].response.level_db, (std::vector<double>{-8, 0, 4}));
}

TEST(Rig, ReadsWhatATransducerBears) {
  const Rig rig = parse_rig(kBegin + kWorn + "    heat: {rms: 0.25, seconds: 2}\n", "rig.yaml");
  EXPECT_DOUBLE_EQ(rig.outputs.at(0).heat.rms, 0.25);
  EXPECT_DOUBLE_EQ(rig.outputs.at(0).heat.seconds, 2.0);
}

TEST(Rig, ReadsWhichOfTheDevicesChannelsAreItsOwn) {
  const Rig rig = parse_rig(kBegin + kWorn + "device_channels: [7, 2]\n", "rig.yaml");
  EXPECT_EQ(rig.device_channels, (std::vector<int>{7, 2}));
  EXPECT_TRUE(parse_rig(kBegin + kWorn, "rig.yaml").device_channels.empty());
}

TEST(Rig, RefusesTwoOutputsOfOneName) {
  Rig rig;
  rig.outputs.resize(2);
  rig.outputs[0].name = rig.outputs[1].name = "hand";
  EXPECT_THROW(check(rig), std::invalid_argument);
  rig.outputs[1].name = "foot";
  EXPECT_NO_THROW(check(rig));
}

TEST(RigKeys, AreDescribedWithUnitsDefaultsAndSources) {
  const std::string text = describe_rig_keys();
  EXPECT_THAT(text, HasSubstr("| `size` | m | 0.305 |"));
  EXPECT_THAT(text, HasSubstr("| `full_scale` | m | 0.01 |"));
  EXPECT_THAT(text, HasSubstr("paper, section 6"));
}

TEST(RigKeys, AreWhatTheReadmeOfTheRigsSays) {
  const std::string readme =
      tests::text_of(std::filesystem::path(SPLASH_SOURCE_DIR) / "configs/rigs/README.md");
  EXPECT_THAT(readme, HasSubstr(describe_rig_keys()))
      << "put the output of rig-reference behind the README's text";
}

}  // namespace
}  // namespace splash::synth
