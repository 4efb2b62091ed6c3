// SPDX-License-Identifier: MIT
// No box of any patch lies over another, as Pd draws them at its default size of font: by the
// length of their text, which breaks at its width and behind semicolons.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/text_of.hpp"

namespace splash::pd {
namespace {

constexpr int kLetter = 7;  // [pixels]
constexpr int kLine = 16;
constexpr int kMargin = 4;
constexpr std::size_t kUsual = 60;  ///< letters in a line unless the box says otherwise

struct Box {
  std::string text;
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// Lines of one part that no semicolon ends.
std::vector<std::string> lines_of(std::string part, std::size_t width) {
  std::vector<std::string> lines;
  while (part.size() > width) {
    const std::size_t blank = part.rfind(' ', width);
    const bool whole = blank == std::string::npos || blank == 0;  // a word longer than a line
    lines.push_back(part.substr(0, whole ? width : blank));
    part.erase(0, whole ? width : blank + 1);
  }
  lines.push_back(part);
  return lines;
}

/// `statement`: "obj 20 30 expr ...", without what ends it.
Box box_of(const std::string& statement) {
  std::smatch found;
  Box box;
  static const std::regex kPlace(R"((\w+) (-?\d+) (-?\d+) ?([^]*))");
  if (!std::regex_match(statement, found, kPlace)) return box;
  box.x = std::stoi(found[2]);
  box.y = std::stoi(found[3]);
  box.text = found[4];
  if (found[1] == "floatatom") {
    box.width = std::stoi(box.text) * kLetter;
    box.height = kLine + kMargin;
    return box;
  }
  std::size_t width = kUsual;
  std::string text = box.text;
  static const std::regex kWidth(R"(, f (\d+)$)");
  const bool fixed = std::regex_search(text, found, kWidth);
  if (fixed) {
    width = static_cast<std::size_t>(std::stoi(found[1]));
    text = found.prefix();
  }
  text = std::regex_replace(text, std::regex(R"(\\([$,]))"), "$1");
  std::vector<std::string> lines;
  static const std::regex kEnd(R"( ?\\; ?)");
  for (std::sregex_token_iterator part(text.begin(), text.end(), kEnd, -1), end; part != end;
       ++part) {
    for (std::string& line : lines_of(*part, width)) lines.push_back(std::move(line));
  }
  std::size_t longest = fixed ? width : 3;
  for (const std::string& line : lines) longest = std::max(longest, line.size());
  box.width = static_cast<int>(longest) * kLetter;
  box.height = static_cast<int>(lines.size()) * kLine + kMargin;
  return box;
}

std::vector<Box> boxes_of(const std::string& patch) {
  std::vector<Box> boxes;
  static const std::regex kBox(R"(#X ((?:obj|msg|text|floatatom) (?:[^;\\]|\\[^])*);)");
  for (std::sregex_iterator it(patch.begin(), patch.end(), kBox), end; it != end; ++it) {
    boxes.push_back(box_of((*it)[1]));
  }
  return boxes;
}

std::vector<std::string> overlaps(const std::vector<Box>& boxes) {
  std::vector<std::string> found;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Box& a = boxes[i];
      const Box& b = boxes[j];
      if (a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
          b.y < a.y + a.height) {
        found.push_back('[' + a.text.substr(0, 40) + "] and [" + b.text.substr(0, 40) + ']');
      }
    }
  }
  return found;
}

TEST(Boxes, DoNotLieOverEachOther) {
  std::size_t boxes = 0;
  const auto folder = std::filesystem::path(SPLASH_SOURCE_DIR) / "pd-patches";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".pd") continue;
    const std::vector<Box> all = boxes_of(tests::text_of(entry.path()));
    boxes += all.size();
    EXPECT_THAT(overlaps(all), testing::IsEmpty()) << entry.path().filename();
  }
  EXPECT_GT(boxes, 500U);
}

}  // namespace
}  // namespace splash::pd
