// SPDX-License-Identifier: MIT
#include "sim-server/scene/mesh/mesh_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace splash::sim {
namespace {

constexpr double kFarthest = 100.0;  // [m]
constexpr std::string_view kSpace = " \t\r";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::vector<std::string_view> words_of(std::string_view line) {
  line = line.substr(0, line.find('#'));
  std::vector<std::string_view> words;
  std::size_t begin = line.find_first_not_of(kSpace);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(kSpace, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kSpace, end);
  }
  return words;
}

/// Whether the line goes on in the next one: its backslash is no word.
bool take_backslash(std::vector<std::string_view>& words) {
  if (words.empty() || !words.back().ends_with('\\')) return false;
  words.back().remove_suffix(1);
  if (words.back().empty()) words.pop_back();
  return true;
}

}  // namespace

double checked_length(double value) {
  if (!std::isfinite(value)) throw std::invalid_argument("a coordinate is not finite");
  if (std::abs(value) > kFarthest) {
    throw std::invalid_argument("a coordinate is " + std::to_string(value) +
                                " m, beyond 100 m; a file in millimetres needs scale: 0.001");
  }
  return value;
}

std::string quoted(std::string_view word) {
  return "'" + std::string(word.substr(0, 40)) + "'";
}

MeshText::MeshText(std::string_view text, std::string file, double scale, bool continues)
    : rest_(text), file_(std::move(file)), scale_(scale), continues_(continues) {
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
}

std::optional<MeshLine> MeshText::next() {
  MeshLine line;
  while (!rest_.empty()) {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const auto words = words_of(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++lines_;
    if (line.words.empty()) line.number = lines_;
    line.words.insert(line.words.end(), words.begin(), words.end());
    if (continues_ && take_backslash(line.words)) continue;
    if (!line.words.empty()) return line;
  }
  return line.words.empty() ? std::nullopt : std::optional(std::move(line));
}

Vector3 MeshText::place(const MeshLine& line, std::size_t first) const {
  if (line.words.size() < first + 3) throw error(line, "a place has three coordinates");
  Vector3 place = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string_view word = line.words[first + axis];
    const auto [rest, failure] =
        std::from_chars(word.data(), word.data() + word.size(), place[axis]);
    if (failure != std::errc() || rest != word.data() + word.size()) {
      throw error(line, quoted(word) + " is no number");
    }
    try {
      place[axis] = checked_length(scale_ * place[axis]);
    } catch (const std::invalid_argument& problem) {
      throw error(line, problem.what());
    }
  }
  return place;
}

program::ConfigError MeshText::error(const MeshLine& line, const std::string& reason) const {
  return {program::Place{.file = file_, .line = line.number}, reason};
}

}  // namespace splash::sim
