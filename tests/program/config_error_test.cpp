// SPDX-License-Identifier: MIT
// Wrong configurations, each with the words its author gets to read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "program/config.hpp"
#include "tests/support/refusal.hpp"

namespace splash::program {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Water {
  double depth = 0.2;
  int particles = 0;
  bool waves = false;
  std::string shape = "box";
  Vector3 lower = {};
  Quaternion turn = {};
  std::vector<double> gains;
};

const std::vector<Field<Water>> kWater = {
    {{"depth", "m", "depth of the water", 0.01, 5.0, true}, &Water::depth},
    {{"particles", "1", "how many", 0, 200000}, &Water::particles},
    {{"waves", "", "whether it moves"}, &Water::waves},
    {{"shape", "", "of the body", 0, 0, false, {"box", "sphere", "cylinder"}}, &Water::shape},
    {{"lower", "m", "corner", -100, 100}, &Water::lower},
    {{"turn", "1", "rotation", -1, 1}, &Water::turn},
    {{"gains", "1", "of channels", 0, 2}, &Water::gains},
};

// Reads `text` as a scene reader does: the root, its child "tank", its list "bodies". Empty: it was
// accepted.
std::string answer(const std::string& text) {
  return tests::refusal([&] {
    const auto map = ConfigMap::parse(text, "s.yaml");
    Water water;
    map.read(kWater, {"tank", "bodies"}, water);
    if (const auto tank = map.optional_child("tank")) tank->read(kWater, {}, water);
    for (const auto& body : map.list("bodies")) body.read(kWater, {}, water);
  });
}

struct Wrong {
  const char* text;
  const char* answer;
};

void expect_answers(const std::vector<Wrong>& cases) {
  for (const auto& one : cases) EXPECT_EQ(answer(one.text), one.answer) << one.text;
}

TEST(ConfigError, ARightOneIsAccepted) {
  EXPECT_EQ(answer("depth: 0.2\ntank: {depth: 1}\nbodies:\n  - {depth: 1, shape: sphere}\n"), "");
}

TEST(ConfigError, Keys) {
  expect_answers({
      {"depth: 1\npartciles: 5\n",
       "s.yaml:2:1: error: key 'partciles': unknown key (known here: tank, bodies, depth, "
       "particles, waves, shape, lower, turn, gains); did you mean 'particles'?"},
      {"depth: 1\nbogus: 5\n",
       "s.yaml:2:1: error: key 'bogus': unknown key (known here: tank, bodies, depth, particles, "
       "waves, shape, lower, turn, gains)"},
      {"depth: 1\nbodies:\n  - {depth: 1, Shape: box}\n",
       "s.yaml:3:16: error: key 'bodies[0].Shape': unknown key (known here: depth, particles, "
       "waves, shape, lower, turn, gains); did you mean 'shape'?"},
      {"depth: 1\ndepth: 2\n", "s.yaml:2:1: error: key 'depth': given twice, first in line 1"},
      {"depth: 1\n\"depth\": 2\n", "s.yaml:2:1: error: key 'depth': given twice, first in line 1"},
      {"waves: true\n", "s.yaml:1:1: error: key 'depth': missing (expected depth of the water)"},
      {"depth: 1\ntank:\n  waves: true\n",
       "s.yaml:3:3: error: key 'tank.depth': missing (expected depth of the water)"},
      {"depth: 1\n[a, b]: 2\n", "s.yaml:2:1: error: a key must be a name (got a list or mapping)"},
  });
}

TEST(ConfigError, Numbers) {
  expect_answers({
      {"depth: 7\n", "s.yaml:1:8: error: key 'depth': out of range (got '7', expected 0.01..5 m)"},
      {"depth: -0.2\n",
       "s.yaml:1:8: error: key 'depth': out of range (got '-0.2', expected 0.01..5 m)"},
      {"depth: .nan\n",
       "s.yaml:1:8: error: key 'depth': it must be finite (got '.nan', expected a number, "
       "0.01..5 m)"},
      {"depth: -.inf\n",
       "s.yaml:1:8: error: key 'depth': it must be finite (got '-.inf', expected a number, "
       "0.01..5 m)"},
      {"depth: 1e999\n",
       "s.yaml:1:8: error: key 'depth': too large or too small a number (got '1e999', expected a "
       "number, 0.01..5 m)"},
      {"depth: 0,2\n",
       "s.yaml:1:8: error: key 'depth': write the decimal point as '.' (got '0,2', expected a "
       "number, 0.01..5 m)"},
      {"depth: 20 cm\n",
       "s.yaml:1:8: error: key 'depth': write the number alone, without a unit (got '20 cm', "
       "expected a number, 0.01..5 m)"},
      {"depth: deep\n",
       "s.yaml:1:8: error: key 'depth': wrong kind of value (got 'deep', expected a number, "
       "0.01..5 m)"},
      {"depth: \"1\"\n",
       "s.yaml:1:8: error: key 'depth': text in quotes is no number (got '1', expected a number, "
       "0.01..5 m)"},
      {"depth: [1]\n",
       "s.yaml:1:8: error: key 'depth': wrong kind of value (got a list of 1, expected a number, "
       "0.01..5 m)"},
      {"depth: {a: 1}\n",
       "s.yaml:1:8: error: key 'depth': wrong kind of value (got a mapping, expected a number, "
       "0.01..5 m)"},
      {"depth: ~\n",
       "s.yaml:1:8: error: key 'depth': has no value (got nothing, expected a number, "
       "0.01..5 m)"},
      {"depth: 1\nparticles: 010\n",
       "s.yaml:2:12: error: key 'particles': a leading zero may mean octal, leave it out (got "
       "'010', expected a whole number, 0..200000)"},
      {"depth: 1\nparticles: 0x10\n",
       "s.yaml:2:12: error: key 'particles': write it in decimal (got '0x10', expected a whole "
       "number, 0..200000)"},
      {"depth: 1\nparticles: 1_000\n",
       "s.yaml:2:12: error: key 'particles': write the digits without '_' (got '1_000', expected "
       "a whole number, 0..200000)"},
      {"depth: 1\nparticles: 200001\n",
       "s.yaml:2:12: error: key 'particles': out of range (got '200001', expected 0..200000)"},
      {"depth: 1\nparticles: 1.5\n",
       "s.yaml:2:12: error: key 'particles': it must be whole (got '1.5', expected a whole "
       "number, 0..200000)"},
      {"depth: 1\nparticles: 99999999999\n",
       "s.yaml:2:12: error: key 'particles': too large or too small a number (got '99999999999', "
       "expected a whole number, 0..200000)"},
  });
}

TEST(ConfigError, OtherKinds) {
  expect_answers({
      {"depth: 1\nwaves: yes\n",
       "s.yaml:2:8: error: key 'waves': wrong kind of value (got 'yes', expected true or false)"},
      {"depth: 1\nwaves: 1\n",
       "s.yaml:2:8: error: key 'waves': wrong kind of value (got '1', expected true or false)"},
      {"depth: 1\nshape: shpere\n",
       "s.yaml:2:8: error: key 'shape': unknown choice (got 'shpere', expected one of box, "
       "sphere, cylinder); did you mean 'sphere'?"},
      {"depth: 1\nshape: [box]\n",
       "s.yaml:2:8: error: key 'shape': wrong kind of value (got a list of 1, expected text)"},
      {"depth: 1\nlower: [1, 2]\n",
       "s.yaml:2:8: error: key 'lower': wrong kind of value (got a list of 2, expected a list of "
       "3 numbers, -100..100 m)"},
      {"depth: 1\nlower: [1, 2, x]\n",
       "s.yaml:2:15: error: key 'lower[2]': wrong kind of value (got 'x', expected a number, "
       "-100..100 m)"},
      {"depth: 1\nlower: [1, 200, 3]\n",
       "s.yaml:2:12: error: key 'lower[1]': out of range (got '200', expected -100..100 m)"},
      {"depth: 1\nturn: [0, 0, 1]\n",
       "s.yaml:2:7: error: key 'turn': wrong kind of value (got a list of 3, expected a list of 4 "
       "numbers, -1..1)"},
      {"depth: 1\ngains: 1\n",
       "s.yaml:2:8: error: key 'gains': wrong kind of value (got '1', expected a list, such as "
       "[a, b])"},
      {"depth: 1\ntank: 5\n",
       "s.yaml:2:7: error: key 'tank': wrong kind of value (got '5', expected a mapping of keys "
       "to values)"},
      {"depth: 1\nbodies: {a: 1}\n",
       "s.yaml:2:9: error: key 'bodies': wrong kind of value (got a mapping, expected a list of "
       "mappings)"},
      {"depth: 1\nbodies: [1]\n",
       "s.yaml:2:10: error: key 'bodies[0]': wrong kind of value (got '1', expected a mapping)"},
  });
}

TEST(ConfigError, WhatYamlAllowsAndAConfigurationNeedsNot) {
  expect_answers({
      {"depth: &d 1\n", "s.yaml:1:8: error: anchors (&name) are not allowed; write the value out"},
      {"depth: 1\ntank: {<<: {depth: 1}}\n",
       "s.yaml:2:8: error: merge keys (<<) are not allowed; write the keys out"},
      {"depth: !!float 1\n",
       "s.yaml:1:8: error: tags are not allowed (got 'tag:yaml.org,2002:float')"},
      {"depth: 1\n---\ndepth: 2\n",
       "s.yaml:2:1: error: a second document begins; write one per file"},
      {"- depth\n",
       "s.yaml:1:1: error: the file must be a mapping of keys to values (got a list of 1, "
       "expected 'key: value')"},
      {"",
       "s.yaml:1:1: error: the file must be a mapping of keys to values (got nothing, "
       "expected 'key: value')"},
      {"# only a comment\n",
       "s.yaml:1:1: error: the file must be a mapping of keys to values (got nothing, expected "
       "'key: value')"},
  });
  EXPECT_THAT(answer("depth: *d\n"), StartsWith("s.yaml:1:8: error: "));
}

// What a file says is repeated in its error: it must not get hold of the terminal, nor fill it.
TEST(ConfigError, QuotesNothingThatATerminalObeys) {
  EXPECT_THAT(answer("\"de\\e[2Jpth\": 1\n"),
              StartsWith("s.yaml:1:1: error: key 'de\\x1b[2Jpth': unknown key (known here: "));
  EXPECT_THAT(answer("depth: \"\\e[31m\"\n"),
              StartsWith("s.yaml:1:8: error: key 'depth': text in quotes is no number (got "
                         "'\\x1b[31m', expected "));
  EXPECT_THAT(answer("depth: 1\nshape: \"bo\\ex\"\n"), HasSubstr("has a control character"));
  EXPECT_LT(answer(std::string(5000, 'k') + ": 1\n").size(), 300U);
  EXPECT_LT(answer("depth: " + std::string(5000, 'v') + "\n").size(), 300U);
  EXPECT_LT(answer("depth: !" + std::string(5000, 't') + " 1\n").size(), 300U);
}

TEST(ConfigError, SyntaxErrorsHaveAPlace) {
  EXPECT_THAT(answer("depth: [1, 2\n"), StartsWith("s.yaml:2:1: error: not YAML: "));
  EXPECT_THAT(answer("depth: 1\n\tparticles: 5\n"), StartsWith("s.yaml:2:"));
  for (const char* open : {"shape: 'box\ndepth: 1\n", "depth: 1\nshape: \"box\n", "'depth: 1"}) {
    EXPECT_THAT(answer(open), HasSubstr("error: not YAML: a quote is opened and not closed"));
  }
  EXPECT_THAT(answer("depth: 1\n  particles: 5\n"), StartsWith("s.yaml:2:"));
}

TEST(ConfigError, Limits) {
  EXPECT_EQ(answer("depth: 1 #" + std::string(1 << 20, 'x')),
            "s.yaml:1:1: error: larger than 1048576 bytes");
  const auto nested = [](std::size_t levels) {  // the root's mapping is one of them
    return "depth: " + std::string(levels - 1, '[') + std::string(levels - 1, ']') + "\n";
  };
  EXPECT_THAT(answer(nested(32)), HasSubstr("key 'depth': wrong kind of value"));
  EXPECT_EQ(answer(nested(33)), "s.yaml:1:39: error: nested deeper than 32 levels");
  EXPECT_EQ(answer(nested(50000)), "s.yaml:1:39: error: nested deeper than 32 levels");
  EXPECT_THAT(answer("depth: " + std::string(100000, '[')), StartsWith("s.yaml:1:"));
  EXPECT_THAT(answer("depth: " + std::string(100000, '{')), StartsWith("s.yaml:1:"));
  std::string steps;
  for (std::size_t i = 0; i < 1000; ++i) steps += std::string(i, ' ') + "a:\n";
  EXPECT_THAT(answer(steps), HasSubstr("s.yaml:33:33: error: nested deeper than 32 levels"));
}

TEST(ConfigError, FilesThatCannotBeRead) {
  const auto load = [](const std::string& path) {
    return tests::refusal([&] { return ConfigMap::load(path); });
  };
  EXPECT_EQ(load("/nonexistent/a.yaml"),
            "/nonexistent/a.yaml:1:1: error: cannot be read: No such file or directory");
  EXPECT_EQ(load("/"), "/:1:1: error: cannot be read: it is a folder");
  EXPECT_EQ(load("/dev/zero"), "/dev/zero:1:1: error: larger than 1048576 bytes");
}

// Any text ends as a mapping or as an error with a place.
TEST(ConfigError, RandomTextsNeverCrash) {
  const std::string right =
      "depth: 0.2\nparticles: 15000\nlower: [0, 1, 2]\ntank: {depth: 1, shape: box}\n"
      "bodies:\n  - depth: 1\n    turn: [0, 0, 0, 1]\n  - {depth: 2, gains: [1, 2]}\n";
  const std::string pieces = "{}[]:,-?&*!|>'\"%@`#~\n\t 0x1e9.<\xc3\xff\r";
  std::mt19937 random(4);
  int accepted = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = right;
    for (auto k = 1 + random() % 3; k > 0; --k) {
      const auto at = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[at] = pieces[random() % pieces.size()];
          break;
        case 1:
          text.insert(at, 1, pieces[random() % pieces.size()]);
          break;
        default:
          text.erase(at, 1 + random() % 4);
      }
    }
    const auto said = answer(text);
    accepted += said.empty();
    ASSERT_THAT(said, AnyOf("", StartsWith("s.yaml:"))) << text;
  }
  EXPECT_GT(accepted, 30);
  EXPECT_LT(accepted, 2000);
}

}  // namespace
}  // namespace splash::program
