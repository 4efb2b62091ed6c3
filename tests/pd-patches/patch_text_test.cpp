// SPDX-License-Identifier: MIT
// What can be told of the patches by reading them: no file is lost, no number differs from the
// rigs, and the object that loses files is not used.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "protocol/event.hpp"
#include "tests/support/text_of.hpp"

namespace splash::pd {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(SPLASH_SOURCE_DIR) / "pd-patches";

std::vector<std::filesystem::path> patches() {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    if (entry.path().extension() == ".pd") found.push_back(entry.path());
  }
  return found;
}

/// Names of the abstractions of ours that a patch uses, dollars put in for the rigs' names.
std::set<std::string> used_abstractions(const std::string& text) {
  static const std::regex kName(R"((?:obj \d+ \d+|clone -s 1|splash-pool~) (splash-[^ ;,]*))");
  std::set<std::string> names;
  for (std::sregex_iterator it(text.begin(), text.end(), kName), end; it != end; ++it) {
    const std::string name = (*it)[1];
    const auto dollar = name.find("\\$");
    if (dollar == std::string::npos) {
      names.insert(name);
      continue;
    }
    for (const char* rig : {"tiles", "stereo"}) {
      names.insert(name.substr(0, dollar) + rig + name.substr(dollar + 3));
    }
  }
  return names;
}

// A kind that no outlet is there for would be lost without a word.
TEST(Patches, RouteEachKindOfEvent) {
  int routes = 0;
  for (const char* file : {"splash-events.pd", "offline.pd", "offline-stereo.pd"}) {
    std::istringstream text(tests::text_of(kFolder / file));
    for (std::string line; std::getline(text, line);) {
      if (line.find(" route ") == std::string::npos || line.find(" impact ") == std::string::npos)
        continue;
      ++routes;
      for (const protocol::KindNames& kind : protocol::kKindNames) {
        EXPECT_THAT(line, ::testing::ContainsRegex(std::string(" ") + kind.name() + "[ ;]"))
            << file;
      }
    }
  }
  EXPECT_EQ(routes, 3);
}

TEST(PatchText, EveryAbstractionIsThere) {
  std::size_t uses = 0;
  for (const auto& patch : patches()) {
    for (const std::string& name : used_abstractions(tests::text_of(patch))) {
      ++uses;
      EXPECT_TRUE(std::filesystem::exists(kFolder / (name + ".pd")))
          << patch.filename() << " needs " << name << ".pd";
    }
  }
  EXPECT_GT(uses, 30U);
}

TEST(PatchText, EveryPatchStatesItsLicence) {
  EXPECT_GT(patches().size(), 20U);
  for (const auto& patch : patches()) {
    EXPECT_THAT(tests::text_of(patch), testing::HasSubstr("SPDX-License-Identifier: MIT")) << patch;
  }
}

/// Pd replaces only the first dollar of an atom: "$f1*$1" would silently take $1 for 0.
TEST(PatchText, ArgumentsInExpressionsStandAlone) {
  static const std::regex kWrong(R"(\\\$f\d[^ ]*\\\$\d|\\\$\d[^ ]*\\\$(f?)\d)");
  std::size_t expressions = 0;
  for (const auto& patch : patches()) {
    std::istringstream lines(tests::text_of(patch));
    for (std::string line; std::getline(lines, line);) {
      if (line.find(" expr ") == std::string::npos) continue;
      ++expressions;
      EXPECT_FALSE(std::regex_search(line, kWrong)) << patch.filename() << ": " << line;
    }
  }
  EXPECT_GT(expressions, 10U);
}

TEST(PatchText, NothingWritesFromAThread) {
  for (const auto& patch : patches()) {
    EXPECT_FALSE(std::regex_search(tests::text_of(patch), std::regex(R"(obj \d+ \d+ writesf~)")))
        << patch;
  }
}

}  // namespace
}  // namespace splash::pd
