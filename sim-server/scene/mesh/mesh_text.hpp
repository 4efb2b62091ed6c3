// SPDX-License-Identifier: MIT
// A mesh file's text as words, and what is wrong with one of them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "program/config.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

struct MeshLine {
  int number = 1;                       ///< of its beginning, counted from 1
  std::vector<std::string_view> words;  ///< without what follows a '#'; at least one
};

class MeshText {
 public:
  /// `text` must outlive this. `scale`: of all lengths [m per unit of the file]. `continues`: a
  /// line that ends with a backslash goes on in the next. A byte order mark at the beginning is
  /// nothing.
  MeshText(std::string_view text, std::string file, double scale, bool continues = false);

  /// The next line that says anything; none at the end.
  [[nodiscard]] std::optional<MeshLine> next();
  /// Words `first` to `first` + 2 as a place [m].
  [[nodiscard]] Vector3 place(const MeshLine& line, std::size_t first) const;
  [[nodiscard]] program::ConfigError error(const MeshLine& line, const std::string& reason) const;

 private:
  std::string_view rest_;
  std::string file_;
  double scale_;
  bool continues_;
  int lines_ = 0;  ///< so far
};

/// A word as an error text may repeat it.
[[nodiscard]] std::string quoted(std::string_view word);

/// A coordinate in metres; throws std::invalid_argument with the reason: not finite, beyond 100 m.
[[nodiscard]] double checked_length(double value);

}  // namespace splash::sim
