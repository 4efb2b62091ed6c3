// SPDX-License-Identifier: MIT
// Tables on the screen, as CSV and as Markdown.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace splash::bench {

using Row = std::vector<std::string>;

/// With so many significant digits.
[[nodiscard]] std::string number(double value, int digits = 3);

[[nodiscard]] std::string markdown(const Row& row);
/// The first row is the head.
[[nodiscard]] std::string markdown(const std::vector<Row>& rows);

/// Throws std::runtime_error when the file cannot be written.
void write_csv(const std::filesystem::path& path, const std::vector<Row>& rows);

/// A table that grows: each row appears on the screen and in a CSV file as soon as it is known.
class Table {
 public:
  /// `csv`: empty: none. Throws std::runtime_error when it cannot be written.
  explicit Table(Row head, const std::filesystem::path& csv = {});
  void add(const Row& row);
  [[nodiscard]] std::string text() const { return markdown(rows_); }

 private:
  void show(const Row& row);
  std::vector<Row> rows_;
  std::ofstream csv_;
};

}  // namespace splash::bench
