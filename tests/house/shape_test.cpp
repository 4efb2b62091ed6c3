// SPDX-License-Identifier: MIT
// What every source owes its reader: a licence line, a sentence about itself, a bearable length.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "tests/house/source_tree.hpp"

namespace splash::house {
namespace {

using testing::IsEmpty;

constexpr std::size_t kMaxCodeLines =
    500;  // an idea is cut where it ends, not where a file is full
constexpr std::size_t kMaxColumns = 100;

const std::vector<std::string> kSources = {".hpp", ".cpp", ".h", ".cl"};
const std::vector<std::string> kAllText = {".hpp",           ".cpp", ".h",     ".cl",
                                           "CMakeLists.txt", ".sh",  ".cmake", ".pd"};

/// UTF-8 text counted in characters: bytes that only continue a character are left out.
std::size_t columns(const std::string& line) {
  return static_cast<std::size_t>(std::count_if(line.begin(), line.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

bool states_licence(const SourceFile& file) {
  const std::size_t first = !file.lines.empty() && file.lines.front().starts_with("#!") ? 1 : 0;
  return file.lines.size() > first &&
         file.lines[first].find("SPDX-License-Identifier: MIT") != std::string::npos;
}

/// The second line of a header or kernel says what it is; so does a source without a header.
bool introduces_itself(const SourceFile& file) {
  return file.lines.size() > 1 && file.lines[1].starts_with("//");
}

std::vector<std::string> paths_where(const std::vector<SourceFile>& files,
                                     bool (*wrong)(const SourceFile&)) {
  std::vector<std::string> paths;
  for (const SourceFile& file : files) {
    if (wrong(file)) paths.push_back(file.path);
  }
  return paths;
}

std::vector<std::string> lines_matching(const std::vector<SourceFile>& files,
                                        const std::regex& pattern) {
  std::vector<std::string> found;
  for (const SourceFile& file : files) {
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      if (std::regex_search(file.lines[i], pattern)) {
        found.push_back(file.path + ":" + std::to_string(i + 1) + ": " + file.lines[i]);
      }
    }
  }
  return found;
}

/// Marks of unfinished work. Written so that this file does not match itself.
const std::regex& unfinished() {
  static const std::regex kPattern(R"(\b(TO)"
                                   R"(DO|FIX)"
                                   R"(ME|XX)"
                                   R"(X|HA)"
                                   R"(CK)\b)");
  return kPattern;
}

/// Folders of the machine something was written on.
const std::regex& private_path() {
  static const std::regex kPattern(R"((^|[\s"'=(])/(wo)"
                                   R"(rk|ro)"
                                   R"(ot|ho)"
                                   R"(me)/)");
  return kPattern;
}

/// Names that promise no idea.
bool is_vague(const SourceFile& file) {
  static const std::regex kPattern(
      R"((^|[/_-])(utils?|helpers?|manager|handler|common|misc)[./_-])");
  return std::regex_search(file.path, kPattern);
}

TEST(Shape, EveryFileStatesItsLicence) {
  auto files = read_files(SPLASH_SOURCE_DIR, kSources);
  for (SourceFile& file : read_files(SPLASH_SOURCE_DIR, {"CMakeLists.txt", ".sh", ".cmake"})) {
    files.push_back(std::move(file));
  }
  ASSERT_GT(files.size(), 20U);
  EXPECT_THAT(paths_where(files, [](const SourceFile& file) { return !states_licence(file); }),
              IsEmpty());
}

TEST(Shape, EveryHeaderAndKernelIntroducesItself) {
  const auto files = read_files(SPLASH_SOURCE_DIR, {".hpp", ".h", ".cl"});
  EXPECT_THAT(paths_where(files, [](const SourceFile& file) { return !introduces_itself(file); }),
              IsEmpty());
}

TEST(Shape, EveryHeaderIsReadOnce) {
  const auto files = read_files(SPLASH_SOURCE_DIR, {".hpp"});
  EXPECT_THAT(paths_where(files,
                          [](const SourceFile& file) {
                            return std::find(file.lines.begin(), file.lines.end(),
                                             "#pragma once") == file.lines.end();
                          }),
              IsEmpty());
}

TEST(Shape, NoFileIsTooLong) {
  const auto files = read_files(SPLASH_SOURCE_DIR, kSources);
  EXPECT_THAT(
      paths_where(files,
                  [](const SourceFile& file) { return count_code_lines(file) > kMaxCodeLines; }),
      IsEmpty());
}

TEST(Shape, NoLineIsTooWide) {
  auto files = read_files(SPLASH_SOURCE_DIR, kSources);
  EXPECT_THAT(paths_where(files,
                          [](const SourceFile& file) {
                            return std::any_of(file.lines.begin(), file.lines.end(),
                                               [](const std::string& line) {
                                                 return columns(line) > kMaxColumns;
                                               });
                          }),
              IsEmpty());
}

TEST(Shape, NothingIsLeftOpen) {
  EXPECT_THAT(lines_matching(read_files(SPLASH_SOURCE_DIR, kAllText), unfinished()), IsEmpty());
}

TEST(Shape, NoPathOfOneMachine) {
  EXPECT_THAT(lines_matching(read_files(SPLASH_SOURCE_DIR, kAllText), private_path()), IsEmpty());
}

TEST(Shape, NamesPromiseAnIdea) {
  EXPECT_THAT(paths_where(read_files(SPLASH_SOURCE_DIR, kSources), is_vague), IsEmpty());
}

TEST(Shape, RulesSeeWhatTheyForbid) {
  const std::string open_mark = std::string("// TO") + "DO: think";
  const std::string path = std::string("path = \"/wo") + "rk/data\"";
  const SourceFile bad{"protocol/osc_utils.hpp", {"#include <vector>", open_mark, path}};
  EXPECT_FALSE(states_licence(bad));
  EXPECT_TRUE(is_vague(bad));
  EXPECT_EQ(lines_matching({bad}, unfinished()).size(), 1U);
  EXPECT_EQ(lines_matching({bad}, private_path()).size(), 1U);
  const SourceFile silent{"protocol/gate.hpp", {"// SPDX-License-Identifier: MIT", "#pragma once"}};
  EXPECT_TRUE(states_licence(silent));
  EXPECT_FALSE(introduces_itself(silent));
  EXPECT_EQ(columns("x — y"), 5U);
  const SourceFile code{"a.cpp", {"int a;", "", "  // why", "int b;  // what"}};
  EXPECT_EQ(count_code_lines(code), 2U);
}

}  // namespace
}  // namespace splash::house
