// SPDX-License-Identifier: MIT
// TRC files: units, axes, gaps and times as documented; mistakes refused with line and column.
#include "sim-server/bodies/motion/marker_file.hpp"
#include "tests/support/refusal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace splash::sim {
namespace {

std::string trc(const std::string& units, const std::string& rows, int frames = 2) {
  return "PathFileType\t4\t(X/Y/Z)\ta.trc\n"
         "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\n"
         "60.00\t60.00\t" +
         std::to_string(frames) + "\t2\t" + units +
         "\t60.00\n"
         "Frame#\tTime\tHeel\t\t\tToe\t\t\t\n"
         "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n"
         "\n" +
         rows;
}

const std::string kRows =
    "1\t0.000\t100\t200\t300\t400\t500\t600\n"
    "2\t0.017\t110\t210\t310\t\t\t\n";

TEST(MarkerFile, TurnsAxesAndUnits) {
  const auto recording = parse_markers(trc("mm", kRows), "a.trc");
  EXPECT_EQ(recording.names, (std::vector<std::string>{"Heel", "Toe"}));
  ASSERT_EQ(recording.frames.size(), 2U);
  // X forward, Y up, Z right become x, -y, z: x = X, y = -Z, z = Y.
  const Vector3 heel = recording.frames[0][0].value();
  EXPECT_NEAR(heel[0], 0.1, 1e-12);
  EXPECT_NEAR(heel[1], -0.3, 1e-12);
  EXPECT_NEAR(heel[2], 0.2, 1e-12);
  const auto in_metres = parse_markers(trc("m", "1\t0\t1\t2\t3\t4\t5\t6\n", 1), "a.trc");
  EXPECT_DOUBLE_EQ(in_metres.frames[0][1].value()[2], 5.0);
}

TEST(MarkerFile, MarkersThatWereNotSeenAreGaps) {
  const auto recording = parse_markers(trc("mm", kRows), "a.trc");
  EXPECT_TRUE(recording.frames[0][1].has_value());
  EXPECT_FALSE(recording.frames[1][1].has_value());
}

TEST(MarkerFile, RestoresTimesThatWereRoundedToMilliseconds) {
  const auto rounded = parse_markers(trc("mm", kRows), "a.trc");
  EXPECT_DOUBLE_EQ(rounded.times[1], 1.0 / 60.0);
  const auto own =
      parse_markers(trc("mm", "1\t0.0\t1\t2\t3\t4\t5\t6\n2\t0.020\t1\t2\t3\t4\t5\t6\n"), "a.trc");
  EXPECT_DOUBLE_EQ(own.times[1], 0.020) << "times that are not the rate's stay";
}

// A recording with what the system computed from the markers behind them: not counted by
// NumMarkers, one of them with a name that another has, one with none at all.
TEST(MarkerFile, ComputedMarkersAreReadAndNotCounted) {
  const std::string cortex =
      "PathFileType\t4\t(X/Y/Z)\ta.trc\n"
      "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\n"
      "60.00\t60.00\t2\t2\tmm\t60.00\n"
      "Frame#\tTime\tHeel\t\t\tToe\t\t\tV_Mid\t\t\tV_Mid\t\t\t\t\t\n"
      "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\tX3\tY3\tZ3\tX4\tY4\tZ4\tX5\tY5\tZ5\n"
      "\n"
      "1\t0.0\t1\t2\t3\t4\t5\t6\t7\t8\t9\t7\t8\t9\t0\t0\t0\n"
      "2\t0.02\t1\t2\t3\t4\t5\t6\t7\t8\t9\t\t\t\t\t\t\n";
  const auto recording = parse_markers(cortex, "a.trc");
  EXPECT_EQ(recording.names, (std::vector<std::string>{"Heel", "Toe", "V_Mid", "V_Mid", ""}));
  EXPECT_EQ(recording.lines, (std::vector<int>{7, 8}));
  EXPECT_NEAR(recording.frames[0][3].value()[2], 0.008, 1e-12);
  EXPECT_FALSE(recording.frames[1][3].has_value());
}

TEST(MarkerFile, NumMarkersIsNotBelieved) {
  for (const std::string number : {"1", "28", "many", ""}) {
    std::string text = trc("mm", kRows);
    text.replace(text.find("\t2\t2\tmm"), 7, "\t2\t" + number + "\tmm");
    EXPECT_EQ(parse_markers(text, "a.trc").names.size(), 2U) << number;
  }
}

struct Mistake {
  std::string name;
  std::string text;
  std::string message;
};

class MarkerFileMistake : public ::testing::TestWithParam<Mistake> {};

TEST_P(MarkerFileMistake, IsRefused) {
  EXPECT_THAT(tests::refusal([] { return parse_markers(GetParam().text, "a.trc"); }),
              ::testing::HasSubstr("a.trc:" + GetParam().message));
}

std::string changed(const std::string& from, const std::string& to) {
  std::string text = trc("mm", kRows);
  return text.replace(text.find(from), from.size(), to);
}

INSTANTIATE_TEST_SUITE_P(
    All, MarkerFileMistake,
    ::testing::Values(
        Mistake{"empty", "", "1:1: error: is no TRC file"},
        Mistake{"other_file", "t,x,y\n1,2,3\n\n\n\n\n", "1:1: error: is no TRC file"},
        Mistake{"unknown_unit", trc("inch", kRows), "3:17: error: Units is 'inch'"},
        Mistake{"no_rate", changed("DataRate\t", "Rate\t"),
                "2:1: error: the header has no DataRate"},
        Mistake{"zero_rate", changed("60.00\t60.00\t2", "0\t60.00\t2"),
                "3:1: error: DataRate is not"},
        Mistake{"frame_missing", trc("mm", kRows, 3),
                "3:1: error: NumFrames is 3, but there are 2"},
        Mistake{"no_name", changed("\tHeel\t\t\tToe", "\t\t\t\t"), "4:1: error: there is no"},
        Mistake{"name_shifted", changed("\t\t\tToe", "\t\tToe\t"), "4:"},
        Mistake{"no_axes", changed("X1\tY1", "a\tb"), "5:1: error: the line of axes"},
        Mistake{"no_number", changed("\t200\t", "\t2oo\t"), "7:13: error: Heel is '2oo'"},
        Mistake{"infinite", changed("\t200\t", "\tinf\t"), "7:13: error: Heel is 'inf'"},
        Mistake{"too_far", changed("\t200\t", "\t2e6\t"), "7:13: error: Heel is 2e+06, beyond"},
        Mistake{"half_a_marker", changed("310\t\t\t", "310\t1\t\t"),
                "8:21: error: marker 'Toe' lacks"},
        Mistake{"too_many", changed("\t600\n", "\t600\t7\n"),
                "7:33: error: there are more numbers"},
        Mistake{"time_runs_back", changed("2\t0.017", "2\t0.000"), "8:3: error: the time is not"}),
    [](const auto& mistake) { return mistake.param.name; });

}  // namespace
}  // namespace splash::sim
