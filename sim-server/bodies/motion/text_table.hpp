// SPDX-License-Identifier: MIT
// Text files of numbers, read strictly: every complaint names file, line and column.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "program/config.hpp"

namespace splash::sim {

/// A cell and where it stands; spaces around it are gone.
struct Cell {
  std::string_view text;
  int column = 1;  ///< counted from 1
};

class TextTable {
 public:
  TextTable(std::string text, std::string file_name);
  TextTable(const TextTable&) = delete;  // lines point into the text
  TextTable& operator=(const TextTable&) = delete;
  /// Throws program::ConfigError when the file cannot be read or is larger than 256 MB.
  [[nodiscard]] static TextTable load(const std::filesystem::path& path);

  [[nodiscard]] std::size_t lines() const { return lines_.size(); }
  /// Line `index` from 0, without its end.
  [[nodiscard]] std::string_view line(std::size_t index) const { return lines_[index]; }
  [[nodiscard]] std::vector<Cell> cells(std::size_t index, char separator) const;
  /// The cell as a finite number within +-`limit`; `what` names it in the error.
  [[nodiscard]] double number(std::size_t index, const Cell& cell, const std::string& what,
                              double limit) const;
  [[nodiscard]] program::ConfigError error(std::size_t index, int column,
                                           const std::string& reason) const;

 private:
  std::string text_;
  std::string file_;
  std::vector<std::string_view> lines_;
};

}  // namespace splash::sim
