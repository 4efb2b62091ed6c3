// SPDX-License-Identifier: MIT
// What every source owes its reader: a licence line, a sentence about itself, lines that fit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/house/source_tree.hpp"

namespace splash::house {
namespace {

using testing::IsEmpty;

constexpr std::size_t kMaxColumns = 100;

const std::vector<std::string> kSources = {".hpp", ".cpp", ".def", ".h", ".cl"};

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

}  // namespace
}  // namespace splash::house
