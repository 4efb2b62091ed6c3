// SPDX-License-Identifier: MIT
// The reference page holds what the reader knows.
#include "sim-server/scene/scene_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/text_of.hpp"

namespace splash::sim {
namespace {

TEST(SceneReference, StandsInTheReadme) {
  const std::string path = std::string(SPLASH_SOURCE_DIR) + "/configs/README.md";
  const std::string text = tests::text_of(path);
  const std::string begin = "<!-- begin: scene-reference -->\n";
  const auto from = text.find(begin);
  const auto to = text.find("<!-- end: scene-reference -->\n");
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(to, std::string::npos);
  const auto start = from + begin.size();
  EXPECT_EQ(text.substr(start, to - start), scene_reference())
      << "build and run scene-reference and put its output between the markers of " << path;
}

TEST(SceneReference, GivesDefaultsAndSaysWhatIsRequired) {
  const std::string text = scene_reference();
  EXPECT_THAT(text, ::testing::HasSubstr("| `density` | kg/m3 | 998 |"));
  EXPECT_THAT(text, ::testing::HasSubstr("| `spacing` | m |  | 0.001"));
  EXPECT_THAT(text, ::testing::HasSubstr("| `size` | m | required |"));
}

}  // namespace
}  // namespace splash::sim
