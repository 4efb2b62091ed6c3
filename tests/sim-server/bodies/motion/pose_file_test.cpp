// SPDX-License-Identifier: MIT
// Pose files: read as written, or refused with line and column.
#include "sim-server/bodies/motion/pose_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program/config.hpp"
#include "tests/support/refusal.hpp"

namespace splash::sim {
namespace {

const std::string kHeader = "t,x,y,z,qx,qy,qz,qw\n";

TEST(PoseFile, ReadsPosesAndSkipsRemarks) {
  const auto poses = parse_poses("# a remark\n" + kHeader +
                                     "0.0, 1, 2, 3, 0, 0, 0, 1\r\n"
                                     "\n"
                                     "0.5,1.5,-2e-1,3,0,0,0.92,0\n",
                                 "hand.csv");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].position, (Vector3{1.0, 2.0, 3.0}));
  EXPECT_DOUBLE_EQ(poses[1].time, 0.5);
  EXPECT_DOUBLE_EQ(poses[1].position[1], -0.2);
  EXPECT_DOUBLE_EQ(poses[1].rotation[2], 1.0) << "brought to unit length";
}

struct Mistake {
  std::string name;
  std::string text;
  std::string message;
};

class PoseFileMistake : public ::testing::TestWithParam<Mistake> {};

TEST_P(PoseFileMistake, IsRefused) {
  EXPECT_THAT(tests::refusal([] { return parse_poses(GetParam().text, "hand.csv"); }),
              ::testing::HasSubstr("hand.csv:" + GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    All, PoseFileMistake,
    ::testing::Values(
        Mistake{"empty", "", "1:1: error: there is no pose"},
        Mistake{"header_only", kHeader, "2:1: error: there is no pose"},
        Mistake{"wrong_header", "t,x,y,z,qw,qx,qy,qz\n", "1:9: error: the header must be"},
        Mistake{"no_number", kHeader + "0,1,2,three,0,0,0,1\n", "2:7: error: z is 'three'"},
        Mistake{"nan", kHeader + "0,1,nan,3,0,0,0,1\n", "2:5: error: y is 'nan', not a finite"},
        Mistake{"too_far", kHeader + "0,1,2,300,0,0,0,1\n", "2:7: error: z is 300, beyond"},
        Mistake{"too_few", kHeader + "0,1,2,3,0,0,0\n", "2:13: error: a pose has eight"},
        Mistake{"no_unit", kHeader + "0,1,2,3,0,0,0,0.5\n", "2:9: error: the quaternion's length"},
        Mistake{"same_time", kHeader + "0,1,2,3,0,0,0,1\n0,1,2,3,0,0,0,1\n",
                "3:1: error: the time"},
        // Across the tank in a billionth of a second, and what a capture's jitter makes of 5 mm.
        Mistake{"no_time", kHeader + "0,0,0,.5,0,0,0,1\n1e-9,0,0,-.5,0,0,0,1\n",
                "3:1: error: 1 m in 1e-09 s is 1e+09 m/s, beyond the limit of 20: one of the poses "
                "of lines 2 and 3"},
        Mistake{"jitter", kHeader + "0,0,0,0,0,0,0,1\n# a remark\n1e-4,0,0,.005,0,0,0,1\n",
                "4:1: error: 0.005 m in 0.0001 s is 50 m/s"},
        Mistake{"no_time_to_turn", kHeader + "0,0,0,0,0,0,0,1\n.01,0,0,0,0,0,1,0\n",
                "3:1: error: 3.14159 rad in 0.01 s is 314.159 rad/s"},
        Mistake{"trailing_letters", kHeader + "0,1,2m,3,0,0,0,1\n", "2:5: error: y is '2m'"}),
    [](const auto& mistake) { return mistake.param.name; });

TEST(PoseFile, NamesAFileThatIsNotThere) {
  EXPECT_THROW(static_cast<void>(read_poses("/nowhere/hand.csv")), program::ConfigError);
}

}  // namespace
}  // namespace splash::sim
