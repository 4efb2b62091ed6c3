// SPDX-License-Identifier: MIT
#include "tests/bench/tables.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

namespace splash::bench {
namespace {

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

}  // namespace

std::string number(double value, int digits) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

std::string markdown(const std::vector<Row>& rows) {
  std::string text;
  const auto add = [&](const Row& row) {
    text += '|';
    for (const std::string& cell : row) text += ' ' + cell + " |";
    text += '\n';
  };
  for (std::size_t k = 0; k < rows.size(); ++k) {
    add(rows[k]);
    if (k == 0) add(Row(rows[0].size(), "---"));
  }
  return text;
}

Table::Table(Row head, const std::filesystem::path& csv) {
  if (!csv.empty()) {
    csv_.open(csv);
    if (!csv_) throw std::runtime_error("cannot write " + csv.string());
  }
  add(head);
}

void Table::add(const Row& row) {
  rows_.push_back(row);
  show(row);
  if (!csv_.is_open()) return;
  for (std::size_t k = 0; k < row.size(); ++k) csv_ << (k == 0 ? "" : ",") << quoted(row[k]);
  csv_ << std::endl;
}

void Table::show(const Row& row) {
  for (std::size_t k = 0; k < row.size(); ++k) {
    const auto width = static_cast<int>(std::max<std::size_t>(rows_.front()[k].size(), 6));
    std::printf(k == 0 ? "%-*s" : "  %*s", k == 0 ? std::max(width, 26) : width, row[k].c_str());
  }
  std::printf("\n");
  std::fflush(stdout);
}

std::string with_section(const std::string& text, const std::string& bench,
                         const std::string& section) {
  const std::string begin = "<!-- bench " + bench + " -->\n";
  const std::string end = "<!-- end of bench " + bench + " -->\n";
  const std::string whole = begin + section + end;
  const std::size_t from = text.find(begin);
  const std::size_t to = text.find(end);
  if (from == std::string::npos || to == std::string::npos || to < from) return text + '\n' + whole;
  return text.substr(0, from) + whole + text.substr(to + end.size());
}

}  // namespace splash::bench
