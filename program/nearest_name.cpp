// SPDX-License-Identifier: MIT
// Edit distance with swaps of neighbours (optimal string alignment; Damerau 1964).
#include "program/nearest_name.hpp"

#include <algorithm>
#include <cctype>

namespace splash::program {
namespace {

constexpr std::size_t kLongestName = 64;  // longer ones are not worth their quadratic cost

std::string folded(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto lower = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    out += lower == '-' || lower == ' ' ? '_' : lower;
  }
  return out;
}

std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> two_back(b.size() + 1);
  std::vector<std::size_t> back(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) back[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({back[j] + 1, row[j - 1] + 1, back[j - 1] + change});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], two_back[j - 2] + 1);
    }
    two_back.swap(back);
    back.swap(row);
  }
  return back[b.size()];
}

}  // namespace

std::string nearest_name(const std::string& wrong, const std::vector<std::string>& known) {
  std::string best;
  if (wrong.empty() || wrong.size() > kLongestName) return best;
  std::size_t least = kLongestName;
  for (const auto& name : known) {
    const std::size_t apart = distance(folded(wrong), folded(name));
    if (apart < least && apart <= std::max<std::size_t>(1, name.size() / 3)) {
      least = apart;
      best = name;
    }
  }
  return best;
}

}  // namespace splash::program
