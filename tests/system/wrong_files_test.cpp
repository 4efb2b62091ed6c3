// SPDX-License-Identifier: MIT
// Files as people get them wrong, one mistake each, and logs that are none: the real programs name
// file, line and column, the key, what stands there and what may. What is wrong of any number or
// text, whatever its key, is told by tests/program/config_error_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/programs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::tests {
namespace {

using testing::HasSubstr;

const std::string kScene = R"(name: right
seed: 1
fluid:
  particles: 1400
  density: 998
  solver: weakly_compressible
  viscosity: 0.001
  gravity: [0, 0, -9.81]
tank:
  lower: [-0.2, -0.2, 0.0]
  upper: [0.2, 0.2, 0.5]
slope: {foot: 0.1, gradient: 0.2}
wave_maker: {stroke: 0.05, period: 2}
water:
  - lower: [-0.2, -0.2, 0.0]
    upper: [0.2, 0.2, 0.2]
bodies:
  - name: disc
    shape: {kind: cylinder, size: [0.15, 0.15, 0.05]}
    motion: {kind: script, keyframes: [{time: 0.0, position: [0, 0, 0.35]}]}
gauges:
  rate: 50
  probes: [{name: level, kind: height, x: 0, y: 0}]
detect:
  impact_speed: 0.05
  radius_min: 0.003
  radius_max: 0.03
skip: {sleep: true}
serve: {frame_rate: 160, latency_ms: 15}
)";

const std::string kRig = R"(name: right
outputs:
  - name: floor
    kind: tiles
    band: {low: 20, high: 750}
    tiles: {origin: [0, 0, 0], columns: 6, rows: 6, size: 0.305, reach: 0.4}
    full_scale: 0.01
    gain_db: 0
    ceiling: 0.9
)";

struct Mistake {
  const char* right;               ///< in the right file
  const char* wrong;               ///< in its place
  const char* at;                  ///< a part of `wrong`: what the error's place points to
  std::vector<std::string> words;  ///< key, value and range, as the error gives them
};

const std::vector<Mistake> kWrongScenes{
    {"seed: 1", "sede: 1", "sede", {"'sede'", "did you mean 'seed'?"}},
    {"seed: 1", "seed: -1", "-1", {"'seed'", "got '-1'", "0..2147483647"}},
    {"1400", "50", "50", {"'fluid.particles'", "got '50'", "100..4000000"}},
    {"998", "0", "0", {"'fluid.density'", "got '0'", "100..5000 kg/m3"}},
    {"weakly_compressible", "dfsph", "dfsph", {"'fluid.solver'", "got 'dfsph'", "grid_projected"}},
    {"viscosity: 0.001",
     "sound_speed: 15\n  time_step_factor: 2",
     "2",
     {"'fluid.time_step_factor'", "0.05..1.05", "got '2'", "boil", "sound_speed out"}},
    {"viscosity: 0.001",
     "sound_speed: 1.5",
     "1.5",
     {"'fluid.sound_speed'", "at least", "got '1.5'", "leaves it out"}},
    {"viscosity: 0.001", "time_step_factor: 2.5", "2.5", {"'fluid.time_step_factor'", "0.05..2"}},
    {"viscosity: 0.001", "viscosity: -1", "-1", {"'fluid.viscosity'", "got '-1'", "0..1 m2/s"}},
    {"[0, 0, -9.81]",
     "[0, 0, -981]",
     "-981",
     {"'fluid.gravity[2]'", "got '-981'", "-100..100 m/s2"}},
    {"  lower: [-0.2, -0.2, 0.0]\n  upper: [0.2, 0.2, 0.5]",
     "  lower: [-0.2, -0.2, 0.0]",
     "lower",
     {"'tank.upper'", "missing"}},
    {"  upper: [0.2, 0.2, 0.5]",
     "  upper: [0.2, 0.2, 500]",
     "500",
     {"'tank.upper[2]'", "got '500'", "-100..100 m"}},
    {"  upper: [0.2, 0.2, 0.5]", "  upper: [-0.3, 0.2, 0.5]", "[-0.3", {"tank"}},
    {"slope: {foot: 0.1", "slope: {foots: 0.1", "foots", {"'slope.foots'", "'foot'"}},
    {"gradient: 0.2", "gradient: 3", "3", {"'slope.gradient'", "got '3'", "0.001..2"}},
    {"stroke: 0.05", "stroke: 0", "0", {"'wave_maker.stroke'", "got '0'", "0.001..5 m"}},
    {"period: 2", "period: 0.1", "0.1", {"'wave_maker.period'", "got '0.1'", "0.2..60 s"}},
    {"    upper: [0.2, 0.2, 0.2]",
     "    upper: [0.2, 0.2, 0.2]\n    form: cube",
     "cube",
     {"'water[0].form'", "got 'cube'", "box, cylinder, sphere"}},
    {"kind: cylinder",
     "kind: cilinder",
     "cilinder",
     {"'bodies[0].shape.kind'", "got 'cilinder'", "did you mean 'cylinder'?"}},
    {"size: [0.15, 0.15, 0.05]",
     "size: [0.15, 0.15, 0]",
     "0]",
     {"'bodies[0].shape.size[2]'", "got '0'", "0.005..10 m"}},
    {"kind: script",
     "kind: scripted",
     "scripted",
     {"'bodies[0].motion.kind'", "did you mean 'script'?"}},
    {"time: 0.0", "time: -1", "-1", {"keyframes[0].time'", "got '-1'", "0..86400 s"}},
    {"rate: 50", "rate: 0", "0", {"'gauges.rate'", "got '0'", "0.001..10000 1/s"}},
    {"kind: height", "kind: depth", "depth", {"'gauges.probes[0].kind'", "got 'depth'", "height"}},
    {"impact_speed: 0.05",
     "impact_speed: fast",
     "fast",
     {"'detect.impact_speed'", "got 'fast'", "0..10 m/s"}},
    {"radius_max: 0.03", "radius_max: 0.3", "0.3", {"'detect.radius_max'", "0.0001..0.1 m"}},
    {"frame_rate: 160", "frame_rate: 5", "5", {"'serve.frame_rate'", "got '5'", "20..2000 1/s"}},
};

const std::vector<Mistake> kWrongRigs{
    {"name: right", "nmae: right", "nmae", {"'nmae'", "did you mean 'name'?"}},
    {"kind: tiles",
     "kind: tile",
     "tile",
     {"'outputs[0].kind'", "got 'tile'", "single, worn, stereo"}},
    {"low: 20", "low: 0", "0", {"'outputs[0].band.low'", "got '0'", "1..20000 Hz"}},
    {"columns: 6", "columns: 0", "0", {"'outputs[0].tiles.columns'", "got '0'", "1..1024"}},
    {"size: 0.305", "size: 30.5", "30.5", {"'outputs[0].tiles.size'", "0.01..10 m"}},
    {"full_scale: 0.01", "full_scale: 0", "0", {"'outputs[0].full_scale'", "1e-06..10 m"}},
    {"gain_db: 0", "gain_db: 90", "90", {"'outputs[0].gain_db'", "got '90'", "-60..60 dB"}},
    {"ceiling: 0.9", "ceiling: 1.5", "1.5", {"'outputs[0].ceiling'", "got '1.5'", "0.001..1"}},
};

/// "line:column" of a byte.
std::string place_of(const std::string& text, std::size_t byte) {
  const auto at = static_cast<std::ptrdiff_t>(byte);
  const auto line = 1 + std::count(text.begin(), text.begin() + at, '\n');
  const auto start = text.rfind('\n', byte == 0 ? 0 : byte - 1);
  const auto column = byte - (start == std::string::npos || byte == 0 ? 0 : start + 1) + 1;
  return std::to_string(line) + ":" + std::to_string(column);
}

class WrongFiles : public testing::Test {
 protected:
  Ended read(const std::string& program, const std::string& option, const std::string& text) const {
    std::ofstream(path_, std::ios::binary) << text;
    return run_program(program, {option, path_, "--listen", "127.0.0.1:0", "--duration", "0.01"});
  }

  void expect(const std::string& program, const std::string& option, const std::string& right,
              const Mistake& mistake) const {
    std::string text = right;
    const std::size_t at = text.find(mistake.right);
    ASSERT_NE(at, std::string::npos) << mistake.right;
    text.replace(at, std::string(mistake.right).size(), mistake.wrong);
    const auto [code, said] = read(program, option, text);
    EXPECT_EQ(code, 78) << mistake.wrong << '\n' << said;
    const std::string wrong = mistake.wrong;
    const std::string place = place_of(text, at + wrong.find(mistake.at));
    EXPECT_THAT(said, HasSubstr(path_ + ":" + place + ": error: "));
    for (const std::string& word : mistake.words) EXPECT_THAT(said, HasSubstr(word));
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << "one line:\n" << said;
  }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "wrong.yaml";
};

TEST_F(WrongFiles, OfScenesAreNamedWithPlaceKeyValueAndRange) {
  for (const Mistake& mistake : kWrongScenes) expect("sim-server", "--scene", kScene, mistake);
}

TEST_F(WrongFiles, OfRigsAreNamedWithPlaceKeyValueAndRange) {
  for (const Mistake& mistake : kWrongRigs) expect("synth-server", "--rig", kRig, mistake);
}

TEST_F(WrongFiles, OfTheOtherKindAreToldWhoWantsThem) {
  const Ended scene = read("synth-server", "--rig", kScene);
  EXPECT_EQ(scene.code, 78);
  EXPECT_THAT(scene.text, testing::AllOf(HasSubstr("this is a scene"), HasSubstr("--scene")));
  const Ended rig = read("sim-server", "--scene", kRig);
  EXPECT_EQ(rig.code, 78);
  EXPECT_THAT(rig.text, testing::AllOf(HasSubstr("this is a rig"), HasSubstr("--rig")));
}

TEST_F(WrongFiles, AreNotTheRightOnes) {
  std::string scene = kScene;
  EXPECT_EQ(read("sim-server", "--scene", scene).code, 0);
  scene.replace(scene.find("viscosity: 0.001"), 16, "time_step_factor: 2");
  EXPECT_THAT(read("sim-server", "--scene", scene).text,
              testing::AllOf(HasSubstr("sound   is 0.5"), HasSubstr("fluid.time_step_factor")));
  std::ofstream(path_) << kRig;
  EXPECT_EQ(run_program("synth-server", {"--rig", path_, "--device", "null", "--listen",
                                         "127.0.0.1:0", "--duration", "0.01"})
                .code,
            0);
}

TEST_F(WrongFiles, OfLogsAreNamedWithTheByte) {
  const std::string wav = folder_ / "hostile.wav";
  const auto bundle = [](const std::string& size, const std::string& rest) {
    return size + std::string("#bundle\0\0\0\0\1\0\0\0\0", 16) + rest;
  };
  using namespace std::string_literals;
  const std::vector<std::pair<std::string, std::string>> kLogs{
      {"no log at all", "16..1472; this is no event log (sim-server --record"},
      {"\0\0"s, "byte 0: the file ends inside a packet's size"},
      {"\xff\xff\xff\xff"s, "packet size 4294967295"},
      {"\0\0\0\0"s, "packet size 0, expected a multiple of 4 in 16..1472"},
      {bundle("\0\0\0\x14"s, ""), "the file ends inside a packet"},
      {"\0\0\0\x10"s + std::string(16, 'x'), "byte 0: the packet is refused"},
      {bundle("\0\0\0\x10"s, "") + "\0\0\0\x11"s, "16..1472; 'head -c 20 "},
      {bundle("\0\0\0\x18"s, "\x7f\xff\xff\xf0zzzz"s), "byte 0: the packet is refused"},
      {bundle("\0\0\0\x20"s, "\0\0\0\x0c/b\0\0,b\0\0\x7f\xff\xff\xf0"s),
       "byte 0: the packet is refused"},
  };
  for (const auto& [bytes, words] : kLogs) {
    std::ofstream(path_, std::ios::binary) << bytes;
    const auto [code, text] = run_program(
        "synth-server", {"--rig", rig_path("stereo.yaml"), "--replay", path_, "--render", wav});
    EXPECT_EQ(code, 65) << text;
    EXPECT_THAT(text, testing::AllOf(HasSubstr(path_), HasSubstr(words)));
    EXPECT_FALSE(std::filesystem::exists(wav));
  }
}

}  // namespace
}  // namespace splash::tests
