// SPDX-License-Identifier: MIT
// Dependencies point one way: every #include and every link against the house's plan.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/house/rooms.hpp"
#include "tests/house/source_tree.hpp"

namespace splash::house {
namespace {

using testing::IsEmpty;

std::vector<std::string> include_complaints(const std::vector<SourceFile>& files) {
  std::vector<std::string> complaints;
  for (const SourceFile& file : files) {
    for (const std::string& header : includes_of(file)) {
      const std::string said = complaint(room_of(file.path), header);
      if (!said.empty()) complaints.push_back(file.path + ": " + said);
    }
  }
  return complaints;
}

std::vector<std::string> link_complaints(const std::vector<SourceFile>& cmake_files) {
  std::vector<std::string> complaints;
  const auto targets = targets_of(cmake_files);
  for (const auto& [name, target] : targets) {
    for (const std::string& link : target.links) {
      const auto linked = targets.find(link);
      if (linked == targets.end()) continue;  // an outer library: its headers are checked instead
      const std::string said = link_complaint(target.folder, linked->second.folder);
      if (!said.empty()) complaints.push_back(name + ": " + said);
    }
  }
  return complaints;
}

TEST(Direction, IncludesOfTheTreeFollowThePlan) {
  const auto files = read_files(SPLASH_SOURCE_DIR, {".hpp", ".cpp", ".def", ".h", ".cl"});
  ASSERT_GT(files.size(), 20U);
  EXPECT_THAT(include_complaints(files), IsEmpty());
}

TEST(Direction, LinksOfTheTreeFollowThePlan) {
  const auto files = read_files(SPLASH_SOURCE_DIR, {"CMakeLists.txt"});
  ASSERT_GT(targets_of(files).size(), 5U);
  EXPECT_THAT(link_complaints(files), IsEmpty());
}

}  // namespace
}  // namespace splash::house
