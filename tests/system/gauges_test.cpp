// SPDX-License-Identifier: MIT
// The simulator writes its scene's gauges, and says what to do when there are none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::tests {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string kClosedBox =
    std::string(SPLASH_SOURCE_DIR) + "/tests/validation/scenes/closed_box.yaml";

TEST(Gauges, AreWritten) {
  const TemporaryFolder folder;
  const std::string csv = folder / "gauges.csv";
  const auto [code, text] = simulate(kClosedBox, 0.1, {"--gauges", csv});
  EXPECT_EQ(code, 0) << text;
  std::ifstream in(csv);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line,
            "time,sum_kinetic,sum_potential,sum_compression,sum_total,all_x,all_y,all_z,"
            "all_fastest,all_rms,mass_x,mass_y,mass_z,mass_sx,mass_sy,mass_sz");
  std::getline(in, line);
  EXPECT_THAT(line, StartsWith("0,"));
  int lines = 1;
  while (std::getline(in, line)) ++lines;
  EXPECT_GE(lines, 5) << "50 a second";
  EXPECT_LE(lines, 7);
}

TEST(Gauges, OfASceneWithoutAnyAreAMistakeOfTheScene) {
  const SmallScene scene(plunging());
  const auto [code, text] = simulate(scene.path(), 0.1, {"--gauges", temporary_path("none.csv")});
  EXPECT_EQ(code, 78);
  EXPECT_THAT(text, HasSubstr("names no gauges"));
  const auto unwritable = simulate(kClosedBox, 0.1, {"--gauges", "/nowhere/g.csv"});
  EXPECT_EQ(unwritable.code, 74);
  EXPECT_THAT(unwritable.text, HasSubstr("/nowhere/g.csv"));
}

TEST(Gauges, ThatTheDeviceRefusesToComputeAreNoFilesThatCannotBeWritten) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers must be the first library that is loaded";
#endif
  const SmallScene scene(plunging() +
                         "\ngauges: {probes: [{name: floor, kind: pressure, place: [0, 0, 0]}]}");
  const TemporaryFolder folder;
  const std::string csv = folder / "refused.csv";
  const auto [code, text] =
      simulate(scene.path(), 0.1, {"--gauges", csv},
               {{"LD_PRELOAD", std::string(SPLASH_BINARY_DIR) + "/libopencl_shim.so"},
                {"SPLASH_SHIM_DEVICE", "pthread"},
                {"SPLASH_SHIM", "build"},
                {"SPLASH_SHIM_KERNEL", "push_by_walls"}});
  EXPECT_EQ(code, 69) << text;
  EXPECT_THAT(text, HasSubstr("do not build on pthread"));
}

}  // namespace
}  // namespace splash::tests
