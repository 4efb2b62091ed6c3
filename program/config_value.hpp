// SPDX-License-Identifier: MIT
// The values of a configuration.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "program/config.hpp"
#include "program/config_tree.hpp"

namespace splash::program {

// Parses numbers and truth values of configurations strictly: each has one spelling.

/// Parses a finite decimal number: sign, digits, point, exponent. Refuses 010, 0x10, 1_000, .inf
/// and .nan.
[[nodiscard]] std::optional<double> parse_number(const std::string& text);
/// Parses a whole number without point or exponent.
[[nodiscard]] std::optional<int> parse_whole(const std::string& text);
/// Parses true or false.
[[nodiscard]] std::optional<bool> parse_truth(const std::string& text);
/// Returns what to write instead of a text that none of the above accepts; "": there is no advice.
[[nodiscard]] std::string number_advice(const std::string& text);

// Converts one value of a configuration according to its row, or refuses it with place, key, value
// and what is allowed.

struct ConfigValue {
  const ConfigTree& tree;
  const Row& row;
  std::string key;  ///< from the root, with an index for an item of a list: "bodies[0].size[2]"

  /// "key 'a.b': reason (got X, expected Y)" at the value's place.
  [[nodiscard]] ConfigError error(const std::string& reason, const std::string& expected) const;
  [[nodiscard]] ConfigValue item(std::size_t index) const;
};

/// Throws ConfigError and leaves `out` as it was when the value breaks its row.
void convert(const ConfigValue& value, const MemberPlace& out);

}  // namespace splash::program
