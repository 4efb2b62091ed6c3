// SPDX-License-Identifier: MIT
#include "tests/bench/tables.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "program/text.hpp"

namespace splash::bench {
namespace {

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

std::string line_of(const Row& row) {
  std::string line;
  for (std::size_t k = 0; k < row.size(); ++k) line += (k == 0 ? "" : ",") + quoted(row[k]);
  return line;
}

}  // namespace

std::string number(double value, int digits) {
  return program::format("%.*g", digits, value);
}

std::string markdown(const Row& row) {
  std::string text = "|";
  for (const std::string& cell : row) text += ' ' + cell + " |";
  return text + '\n';
}

std::string markdown(const std::vector<Row>& rows) {
  std::string text;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    text += markdown(rows[k]);
    if (k == 0) text += markdown(Row(rows[0].size(), "---"));
  }
  return text;
}

void write_csv(const std::filesystem::path& path, const std::vector<Row>& rows) {
  std::ofstream file(path);
  for (const Row& row : rows) file << line_of(row) << '\n';
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
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
  if (csv_.is_open()) csv_ << line_of(row) << std::endl;
}

void Table::show(const Row& row) {
  for (std::size_t k = 0; k < row.size(); ++k) {
    const auto width = static_cast<int>(std::max<std::size_t>(rows_.front()[k].size(), 6));
    std::printf(k == 0 ? "%-*s" : "  %*s", k == 0 ? std::max(width, 26) : width, row[k].c_str());
  }
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace splash::bench
