// SPDX-License-Identifier: MIT
// Converts one value of a configuration according to its row, or refuses it with place, key, value
// and what is allowed.
#pragma once

#include <string>
#include <vector>

#include "program/config.hpp"
#include "program/config_tree.hpp"

namespace splash::program {

struct ConfigValue {
  const ConfigTree& tree;
  const Row& row;
  std::string key;  ///< from the root, with an index for an item of a list: "bodies[0].size[2]"

  /// "key 'a.b': reason (got X, expected Y)" at the value's place.
  [[nodiscard]] ConfigError error(const std::string& reason, const std::string& expected) const;
  [[nodiscard]] ConfigValue item(std::size_t index) const;
};

/// Each throws ConfigError and leaves `out` as it was when the value breaks its row.
void convert(const ConfigValue& value, double& out);
void convert(const ConfigValue& value, int& out);
void convert(const ConfigValue& value, bool& out);
void convert(const ConfigValue& value, std::string& out);
void convert(const ConfigValue& value, Vector3& out);
void convert(const ConfigValue& value, Quaternion& out);
void convert(const ConfigValue& value, std::vector<double>& out);
void convert(const ConfigValue& value, std::vector<std::string>& out);

}  // namespace splash::program
