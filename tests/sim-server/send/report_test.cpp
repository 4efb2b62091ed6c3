// SPDX-License-Identifier: MIT
// The report read back by a JSON parser, and every way in which a disk can refuse it.
#include "sim-server/serve/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>

#include "tests/support/source_folder.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::sim {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

RunReport example() {
  RunReport report;
  report.device = "cpu-haswell (PoCL 3.1)";
  report.scene = "basin";
  report.solver = "grid_projected";
  report.solver_notice = "grid_projected: nothing strikes the water";
  report.particles = 7000;
  report.simulated_seconds = 30.0;
  report.run = {.wall = 24.0, .processor = 31.5};
  report.start = {.wall = 5.0, .processor = 6.5};
  report.settling = {.wall = 2.25, .processor = 4.0};
  report.totals.steps = 7200;
  report.totals.frames = 7500;
  report.totals.resets = 1;
  report.totals.retried = 5;
  report.totals.calmed = 2;
  report.totals.mean_excess_sum = 0.004 * (7500 - 1 - 2);
  report.totals.max_excess = 0.03;
  report.totals.no_cavity = {.stopped = 1};
  report.totals.air = {.entrapped = 0.0125, .by_bodies = 0.004, .told = 0.012, .thinned = 17};
  report.totals.bubbles_alive_sum = 70.0 * 7500;
  report.totals.bubbles_alive_most = 420;
  report.solve = {.solves = 7200, .iterations = 36000, .most = 20, .given_up = 3};
  report.sent.events = {{3, 120, 2}};
  report.late = 0;
  report.lost = 7;
  report.paced.behind = 4;
  report.refused_poses = {{"too_fast", 2}, {"outlier", 7}, {"no_body", 0}};
  report.refused_datagrams = {{"padding is not zero", 4}};
  report.slow_seconds = 1.5;
  return report;
}

TEST(Report, HasNoKeyThatTheDocumentsLackNorTheyOneThatItLacks) {
  const std::string text = tests::text_of(tests::source_folder() / "docs" / "running.md");
  const std::size_t start = text.find("\n## The report\n");
  ASSERT_NE(start, std::string::npos);
  const std::string section = text.substr(start, text.find("\n## ", start + 1) - start);
  std::set<std::string> told;
  static const std::regex kKey("`([a-z_]+)`");
  for (std::sregex_iterator it(section.begin(), section.end(), kKey), end; it != end; ++it) {
    told.insert((*it)[1]);
  }
  std::set<std::string> written;
  const json report = json::parse(to_json(example()));
  for (const auto& [key, value] : report.items()) written.insert(key);
  EXPECT_EQ(told, written);
}

TEST(Report, HoldsTheKeysOfTheContract) {
  const auto read = json::parse(to_json(example()));
  EXPECT_EQ(read.at("device"), "cpu-haswell (PoCL 3.1)");
  EXPECT_EQ(read.at("scene"), "basin");
  EXPECT_EQ(read.at("solver"), "grid_projected");
  EXPECT_EQ(read.at("solver_notice"), "grid_projected: nothing strikes the water");
  EXPECT_EQ(read.at("particles"), 7000);
  EXPECT_EQ(read.at("steps"), 7200);
  EXPECT_EQ(read.at("frames"), 7500);
  EXPECT_EQ(read.at("processor_seconds"), 31.5);
  EXPECT_EQ(read.at("start"), (json{{"wall_seconds", 5.0}, {"processor_seconds", 6.5}}));
  EXPECT_EQ(read.at("settling"), (json{{"wall_seconds", 2.25}, {"processor_seconds", 4.0}}));
  EXPECT_DOUBLE_EQ(read.at("steps_per_second"), 300.0);
  EXPECT_DOUBLE_EQ(read.at("real_time_factor"), 1.25);
  EXPECT_DOUBLE_EQ(read.at("mean_density_error"), 0.004);
  EXPECT_DOUBLE_EQ(read.at("maximum_density_error"), 0.03);
  EXPECT_EQ(read.at("iterations"),
            (json{{"mean", 5.0}, {"most", 20}, {"given_up", 3}, {"solves", 7200}}));
  EXPECT_EQ(read.at("events"), (json{{"impacts", 3}, {"bubbles", 120}, {"cavities", 2}}));
  EXPECT_EQ(read.at("no_cavity"),
            (json{{"stopped", 1}, {"shallow", 0}, {"afloat", 0}, {"unseen", 0}, {"filled", 0}}));
  const auto& air = read.at("air");
  EXPECT_DOUBLE_EQ(air.at("entrapped_litres"), 12.5);
  EXPECT_DOUBLE_EQ(air.at("by_bodies_litres"), 4.0);
  EXPECT_DOUBLE_EQ(air.at("told_litres"), 12.0);
  EXPECT_EQ(air.at("thinned_bubbles"), 17);
  EXPECT_EQ(read.at("bubble_particles"), (json{{"mean_share", 0.01}, {"largest_share", 0.06}}));
  EXPECT_EQ(read.at("late"), 0);
  EXPECT_EQ(read.at("lost"), 7);
  EXPECT_EQ(read.at("behind"), 4);
  EXPECT_EQ(read.at("resets"), 1);
  EXPECT_EQ(read.at("retried_frames"), 5);
  EXPECT_EQ(read.at("calmed_frames"), 2);
  EXPECT_EQ(read.at("refused_poses"), 9);
  EXPECT_EQ(read.at("refused").at("poses"),
            (json{{"too_fast", 2}, {"outlier", 7}, {"no_body", 0}}));
  EXPECT_EQ(read.at("refused").at("datagrams"), (json{{"padding is not zero", 4}}));
  EXPECT_DOUBLE_EQ(read.at("overload").at("slow_seconds"), 1.5);
}

TEST(Report, WhatIsUnknownIsNull) {
  auto report = example();
  report.late.reset();
  report.lost.reset();
  report.run.wall = 0.0;
  report.totals.mean_excess_sum = std::numeric_limits<double>::quiet_NaN();
  report.totals.max_excess = std::numeric_limits<double>::infinity();
  const auto read = json::parse(to_json(report));
  for (const auto* key : {"late", "lost", "steps_per_second", "real_time_factor",
                          "mean_density_error", "maximum_density_error"}) {
    EXPECT_TRUE(read.at(key).is_null()) << key;
  }
}

TEST(Report, ADeviceWithAStrangeNameIsStillJson) {
  auto report = example();
  report.device = "quote \" backslash \\ newline \n bad utf-8 \xFF";
  EXPECT_THAT(json::parse(to_json(report)).at("device").get<std::string>(),
              HasSubstr("quote \" backslash \\ newline \n bad utf-8"));
}

TEST(Report, IsWrittenWholeAndReplacesAnOlderOne) {
  const tests::TemporaryFolder folder;
  auto report = example();
  write_report(folder / "r.json", report);
  report.particles = 1;
  write_report(folder / "r.json", report);
  EXPECT_EQ(tests::text_of(folder / "r.json"), to_json(report));
  const auto begin = std::filesystem::directory_iterator(folder.path());
  EXPECT_EQ(std::distance(begin, std::filesystem::directory_iterator()), 1) << "no draft is left";
}

TEST(Report, RefusalsNameThePathAndTheCause) {
  const tests::TemporaryFolder folder;
  const auto nowhere = folder / "no" / "such" / "r.json";
  EXPECT_THAT([&] { write_report(nowhere, example()); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr(nowhere.string()), HasSubstr("No such file"))));
  EXPECT_THAT([&] { write_report(folder.path(), example()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("directory")));
}

// By way of a link: if the report ever replaced what it should write into, run by root, this test
// would cost the machine a link and not its device.
TEST(Report, ADeviceIsWrittenInPlaceAndItsErrorTold) {
  if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const tests::TemporaryFolder folder;
  const auto link = folder / "full";
  std::filesystem::create_symlink("/dev/full", link);
  EXPECT_THAT([&] { write_report(link, example()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("No space left")));
  EXPECT_TRUE(std::filesystem::is_symlink(link));
}

TEST(Report, SummaryTellsThePersonTheSame) {
  const auto text = summary(example());
  for (const auto* part :
       {"basin", "7000 particles", "cpu-haswell", "real-time factor 1.25", "300 steps/s",
        "3 impacts, 120 bubbles, 2 cavities; impacts without one: stopped 1\n", "lost 7",
        "12.50 l entrapped (4.00 by bodies), 12.00 l told, 17 bubbles over the budget",
        "6.00 % at most", "4 of 7500 frames behind", "1 resets, 2 frames given up, 5 retried",
        "9 refused: too_fast 2 outlier 7\n"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  auto report = example();
  report.late.reset();
  EXPECT_THAT(summary(report), HasSubstr("no target answered"));
  EXPECT_THAT(summary(report), HasSubstr("per step: 5.00, at most 20; given up 3"));
  report.solve = {};
  EXPECT_THAT(summary(report), testing::Not(HasSubstr("iterations"))) << "nothing was solved";
}

}  // namespace
}  // namespace splash::sim
