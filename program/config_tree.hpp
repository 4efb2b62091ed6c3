// SPDX-License-Identifier: MIT
// A YAML text as a plain tree whose nodes know their places in the file. It is built from
// yaml-cpp's events, since yaml-cpp's nodes lose the places of keys, repeated keys, quotes and
// anchors.
#pragma once

#include <string>
#include <vector>

#include "program/config.hpp"

namespace splash::program {

inline constexpr std::size_t kMaxConfigBytes = 1 << 20;
inline constexpr std::size_t kMaxConfigDepth = 32;

struct ConfigTree {
  enum class Kind { null, scalar, list, mapping };
  struct Key {
    std::string name;
    Place place;
  };

  struct Entry;  // a pair of key and tree would need the whole tree first

  Kind kind = Kind::null;
  Place place;
  std::string text;     ///< of a scalar
  bool quoted = false;  ///< a scalar in quotes is text, whatever it looks like
  std::vector<ConfigTree> items;
  std::vector<Entry> entries;

  [[nodiscard]] const ConfigTree* find(const std::string& key) const;
};

struct ConfigTree::Entry {
  Key key;
  ConfigTree value;
};

/// Throws ConfigError: bad syntax, repeated keys, keys that are no names, anchors, aliases, merge
/// keys, tags, a second document, over kMaxConfigBytes, deeper than kMaxConfigDepth.
[[nodiscard]] ConfigTree parse_config_tree(const std::string& text, const std::string& file_name);

/// Describes a node for an error: "a mapping", "the text 'abc'", ...
[[nodiscard]] std::string describe_kind(const ConfigTree& tree);

}  // namespace splash::program
