// SPDX-License-Identifier: MIT
// The README and docs/ speak of commands, options and files that exist.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/programs.hpp"
#include "tests/support/text_of.hpp"

namespace splash::house {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// What it says itself and what it leaves to docs/running.md.
std::string readme() {
  const fs::path root = SPLASH_SOURCE_DIR;
  return tests::text_of(root / "README.md") + tests::text_of(root / "docs/running.md");
}

std::set<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) {
    found.insert((*it)[1].str());
  }
  return found;
}

std::set<std::string> options_in(const std::string& text) {
  static const std::regex kOption(R"((?:^|[\s,`\[])(--[a-z][a-z-]*))");
  return matches(text, kOption);
}

/// Options that the README gives to a program, on lines that start it.
std::set<std::string> options_given_to(const std::string& program, const std::string& text) {
  std::set<std::string> options;
  const std::regex start("(?:^|\n|`)" + program + "( [^\n`]*)");
  for (const std::string& line : matches(text, start)) {
    const std::set<std::string> here = options_in(line);
    options.insert(here.begin(), here.end());
  }
  return options;
}

std::vector<std::string> missing_from(const std::set<std::string>& wanted,
                                      const std::set<std::string>& known) {
  std::vector<std::string> missing;
  for (const std::string& name : wanted) {
    if (!known.contains(name)) missing.push_back(name);
  }
  return missing;
}

void expect_options_known(const std::string& program) {
  const std::string help =
      tests::run_shell(std::string(SPLASH_BINARY_DIR) + "/" + program + " --help").text;
  ASSERT_THAT(help, HasSubstr("--help")) << program << " is not built";
  EXPECT_THAT(missing_from(options_given_to(program, readme()), options_in(help)), IsEmpty());
}

TEST(Readme, LauncherKnowsItsCommandsAndOptions) {
  const std::string launcher = std::string(SPLASH_SOURCE_DIR) + "/splash";
  const std::string help =
      tests::run_shell(launcher + " --help; for command in run test bundle; do " + launcher +
                       " help $command; done")
          .text;
  static const std::regex kCommand(R"(\./splash ([a-z]+))");
  const std::set<std::string> told = matches(readme(), kCommand);
  EXPECT_THAT(told, Contains("demo"));
  EXPECT_THAT(told, Contains("test"));
  EXPECT_THAT(missing_from(told, matches(help, kCommand)), IsEmpty());
  EXPECT_THAT(missing_from(options_given_to(R"(\./splash)", readme()), options_in(help)),
              IsEmpty());
}

TEST(Readme, SynthKnowsItsOptions) {
  expect_options_known("synth-server");
}

TEST(Readme, SimulatorKnowsItsOptions) {
  expect_options_known("sim-server");
}

TEST(Readme, FilesItNamesExist) {
  static const std::regex kFile(R"(((?:configs|examples|pd-patches)/[A-Za-z0-9_+/-]+\.[a-z]+))");
  const std::set<std::string> files = matches(readme(), kFile);
  ASSERT_THAT(files, Contains("pd-patches/splash-stereo.pd"));
  std::vector<std::string> missing;
  for (const std::string& file : files) {
    if (!fs::exists(fs::path(SPLASH_SOURCE_DIR) / file)) missing.push_back(file);
  }
  EXPECT_THAT(missing, IsEmpty());
}

/// What `docs/FILE` says to be written by is a benchmark that writes that file.
TEST(Docs, AreWrittenByBenchmarksThatExist) {
  static const std::regex kBench(R"(\./splash bench ([a-z]+))");
  const fs::path root = SPLASH_SOURCE_DIR;
  for (const char* doc : {"performance.md", "accuracy.md", "robustness.md"}) {
    const std::set<std::string> named = matches(tests::text_of(root / "docs" / doc), kBench);
    EXPECT_FALSE(named.empty()) << doc;
    for (const std::string& name : named) {
      const std::string source = tests::text_of(root / "tests/bench" / (name + "_bench.cpp"));
      EXPECT_THAT(source, HasSubstr("\"" + std::string(doc) + '"')) << doc << ": bench " << name;
    }
  }
}

TEST(Readme, TreeNamesEveryRoom) {
  const std::string text = readme();
  std::vector<std::string> missing;
  for (const std::string top : {"sim-server", "synth-server"}) {
    for (const fs::directory_entry& entry :
         fs::directory_iterator(fs::path(SPLASH_SOURCE_DIR) / top)) {
      const std::string name = entry.path().filename().string();
      if (entry.is_directory() && text.find("\n  " + name + "/ ") == std::string::npos) {
        missing.push_back(top + "/" + name);
      }
    }
  }
  EXPECT_THAT(missing, IsEmpty());
}

}  // namespace
}  // namespace splash::house
