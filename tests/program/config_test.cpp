// SPDX-License-Identifier: MIT
// What a configuration may say, and how it is read.
#include "program/config.hpp"

#include <gtest/gtest.h>

#include "program/config_value.hpp"
#include "program/text.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::program {
namespace {

struct Everything {
  double length = 1.5;
  int count = 3;
  bool on = false;
  std::string name = "unnamed";
  Vector3 place = {0, 0, 0};
  Quaternion turn = {0, 0, 0, 1};
  std::vector<double> gains;
  std::vector<std::string> markers;
};

const std::vector<Field<Everything>> kFields = {
    {{"length", "m", "a length", 0.0, 10.0}, &Everything::length},
    {{"count", "1", "a number of things", -5, 100}, &Everything::count},
    {{"on", "", "whether"}, &Everything::on},
    {{"name", "", "a name"}, &Everything::name},
    {{"place", "m", "a place", -10, 10}, &Everything::place},
    {{"turn", "1", "a rotation", -1, 1}, &Everything::turn},
    {{"gains", "1", "gains", 0, 2}, &Everything::gains},
    {{"markers", "", "marker names"}, &Everything::markers},
};

TEST(Config, ReadsEveryKind) {
  Everything out;
  ConfigMap::parse(R"(# a comment
length: 2.5e0
count: -5
on: true
name: "010"
place: [1, -2.5, .5]
turn: [0, 0, 1, 0]
gains:
  - 0
  - 1.5
markers: [L.Toe, 'R Heel']
)",
                   "all.yaml")
      .read(kFields, {}, out);
  EXPECT_EQ(out.length, 2.5);
  EXPECT_EQ(out.count, -5);
  EXPECT_TRUE(out.on);
  EXPECT_EQ(out.name, "010");
  EXPECT_EQ(out.place, (Vector3{1, -2.5, 0.5}));
  EXPECT_EQ(out.turn, (Quaternion{0, 0, 1, 0}));
  EXPECT_EQ(out.gains, (std::vector<double>{0, 1.5}));
  EXPECT_EQ(out.markers, (std::vector<std::string>{"L.Toe", "R Heel"}));
}

TEST(Config, WhatIsNotSaidKeepsItsDefault) {
  Everything out;
  ConfigMap::parse("count: 7\n", "some.yaml").read(kFields, {}, out);
  EXPECT_EQ(out.count, 7);
  EXPECT_EQ(out.length, 1.5);
  EXPECT_EQ(out.name, "unnamed");
}

TEST(Config, ChildrenAndLists) {
  const auto map = ConfigMap::parse("tank: {length: 2}\nbodies:\n  - count: 1\n  - count: 2\n",
                                    "/some/folder/scene.yaml");
  Everything tank;
  map.child("tank").read(kFields, {}, tank);
  EXPECT_EQ(tank.length, 2.0);
  EXPECT_FALSE(map.optional_child("slope"));
  EXPECT_TRUE(map.has("bodies"));
  const auto bodies = map.list("bodies");
  ASSERT_EQ(bodies.size(), 2U);
  Everything second;
  bodies[1].read(kFields, {}, second);
  EXPECT_EQ(second.count, 2);
  EXPECT_EQ(bodies[1].place().line, 4);
  EXPECT_EQ(bodies[1].place().column, 5);
  EXPECT_TRUE(map.list("none").empty());
  EXPECT_EQ(map.folder(), "/some/folder");
  EXPECT_STREQ(bodies[1].error("count", "is odd").what(),
               "/some/folder/scene.yaml:4:12: error: key 'bodies[1].count': is odd");
}

TEST(Config, AMapOutlivesItsParent) {
  const auto child = ConfigMap::parse("a: {b: {count: 9}}", "x").child("a").child("b");
  Everything out;
  child.read(kFields, {}, out);
  EXPECT_EQ(out.count, 9);
}

TEST(Config, LoadsAFile) {
  const tests::TemporaryFolder folder;
  Everything out;
  const auto map = ConfigMap::load(  // with a byte order mark and CRLF
      folder.write("good.yaml", "\xef\xbb\xbfname: t\xc3\xbcmpel\r\n"));
  map.read(kFields, {}, out);
  EXPECT_EQ(out.name, "t\xc3\xbcmpel");
  EXPECT_EQ(map.folder(), folder.path());
}

TEST(Number, OneSpellingEach) {
  EXPECT_EQ(parse_number("1"), 1.0);
  EXPECT_EQ(parse_number("-0.25"), -0.25);
  EXPECT_EQ(parse_number("+1.e-3"), 1e-3);
  EXPECT_EQ(parse_number("0.1"), 0.1);
  EXPECT_EQ(parse_number("0"), 0.0);
  EXPECT_EQ(parse_whole("-2147483648"), -2147483647 - 1);
  EXPECT_EQ(parse_whole("+7"), 7);
  for (const char* wrong : {"",     "+",     "-",      ".",    "e5",  "1e",   "1e+", "010", "-007",
                            "0x10", "1_000", "inf",    ".inf", "nan", ".nan", "1,5", "1 m", "1..2",
                            "--1",  "1e400", "1e-400", " 1",   "1 ",  "0b1",  "1:30"}) {
    EXPECT_FALSE(parse_number(wrong)) << wrong;
  }
  for (const char* wrong : {"1.0", "1e3", "2147483648", "-2147483649", "08", "", "-"}) {
    EXPECT_FALSE(parse_whole(wrong)) << wrong;
  }
  EXPECT_EQ(parse_truth("true"), true);
  EXPECT_EQ(parse_truth("false"), false);
  for (const char* wrong : {"yes", "no", "on", "off", "True", "1", ""}) {
    EXPECT_FALSE(parse_truth(wrong)) << wrong;
  }
}

TEST(NearestName, FindsTyposAndOnlyTypos) {
  const std::vector<std::string> names = {"particles", "spacing", "density", "sound_speed"};
  EXPECT_EQ(nearest_name("particels", names), "particles");
  EXPECT_EQ(nearest_name("Spacing", names), "spacing");
  EXPECT_EQ(nearest_name("sound-speed", names), "sound_speed");
  EXPECT_EQ(nearest_name("densty", names), "density");
  EXPECT_EQ(nearest_name("sede", {"seed"}), "seed");  // neighbours swapped: one slip, not two
  EXPECT_EQ(nearest_name("gravity", names), "");
  EXPECT_EQ(nearest_name("", names), "");
  EXPECT_EQ(nearest_name(std::string(100000, 'x'), names), "");
  EXPECT_EQ(nearest_name("x", {}), "");
}

TEST(Describe, IsAMarkdownTable) {
  const std::vector<Row> rows = {
      {"length", "m", "a length", 0, 10, true},
      {"mode", "", "a | b", -1, 1, false, {"a", "b"}, "Smith 1999"},
      {"free", "1", "anything"},
  };
  EXPECT_EQ(describe(rows, {"", "a", "3"}),
            "| key | unit | default | range | meaning | source |\n|---|---|---|---|---|---|\n"
            "| `length` | m | required | 0 .. 10 | a length |  |\n"
            "| `mode` |  | a | `a`, `b` | a \\| b | Smith 1999 |\n"
            "| `free` | 1 | 3 | any | anything |  |\n");
}

}  // namespace
}  // namespace splash::program
