// SPDX-License-Identifier: MIT
#include "sim-server/bodies/motion/text_table.hpp"

#include <charconv>
#include <cmath>
#include <sstream>

namespace splash::sim {

namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \r");
  if (first == std::string_view::npos) return text.substr(text.size());
  return text.substr(first, text.find_last_not_of(" \r") - first + 1);
}

}  // namespace

TextTable::TextTable(std::string text, std::string file_name)
    : text_(std::move(text)), file_(std::move(file_name)) {
  const std::string_view all = text_;
  std::size_t begin = 0;
  while (begin < all.size()) {
    std::size_t end = all.find('\n', begin);
    if (end == std::string_view::npos) end = all.size();
    std::string_view line = all.substr(begin, end - begin);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    lines_.push_back(line);
    begin = end + 1;
  }
}

TextTable TextTable::load(const std::filesystem::path& path) {
  constexpr std::uintmax_t kLargest = 256;  // [MB]
  return TextTable(program::read_file(path, kLargest), path.string());
}

std::vector<Cell> TextTable::cells(std::size_t index, char separator) const {
  const std::string_view line = lines_[index];
  std::vector<Cell> cells;
  std::size_t begin = 0;
  while (begin <= line.size()) {
    std::size_t end = line.find(separator, begin);
    if (end == std::string_view::npos) end = line.size();
    const std::string_view text = trimmed(line.substr(begin, end - begin));
    cells.push_back({text, static_cast<int>(text.data() - line.data()) + 1});
    begin = end + 1;
  }
  return cells;
}

double TextTable::number(std::size_t index, const Cell& cell, const std::string& what,
                         double limit) const {
  double value = 0.0;
  const char* end = cell.text.data() + cell.text.size();
  const auto [rest, failure] = std::from_chars(cell.text.data(), end, value);
  if (failure != std::errc() || rest != end || !std::isfinite(value)) {
    throw error(index, cell.column,
                what + " is '" + std::string(cell.text.substr(0, 40)) + "', not a finite number");
  }
  if (std::abs(value) > limit) {
    std::ostringstream reason;
    reason << what << " is " << value << ", beyond the limit of " << limit;
    throw error(index, cell.column, reason.str());
  }
  return value;
}

program::ConfigError TextTable::error(std::size_t index, int column,
                                      const std::string& reason) const {
  return {program::Place{.file = file_, .line = static_cast<int>(index) + 1, .column = column},
          reason};
}

}  // namespace splash::sim
