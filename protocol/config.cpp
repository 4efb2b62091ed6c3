// SPDX-License-Identifier: MIT
// Reads values of a configuration's tree by their rows; every refusal names place, key, what was
// found and what is allowed.
#include "protocol/config.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <utility>

#include "protocol/config_number.hpp"
#include "protocol/config_tree.hpp"
#include "protocol/nearest_name.hpp"

namespace splash::protocol {

using Kind = ConfigTree::Kind;

struct ConfigMap::Node {
  std::shared_ptr<const ConfigTree> root;  // keeps `tree` alive
  const ConfigTree* tree = nullptr;
  std::string path;  // of keys: "bodies[0].motion", "" at the root
};

namespace {

std::string joined(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + '.' + key;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

std::string with_unit(const std::string& text, const Row& row) {
  return row.unit.empty() || row.unit == "1" ? text : text + ' ' + row.unit;
}

std::string range_of(const Row& row) {
  const bool low = row.min > -std::numeric_limits<double>::infinity();
  const bool high = row.max < std::numeric_limits<double>::infinity();
  if (low && high) return with_unit(number(row.min) + ".." + number(row.max), row);
  if (low) return "at least " + with_unit(number(row.min), row);
  if (high) return "at most " + with_unit(number(row.max), row);
  return row.unit.empty() || row.unit == "1" ? "" : "in " + row.unit;
}

std::string with_range(const std::string& expected, const Row& row) {
  const auto range = range_of(row);
  return range.empty() ? expected : expected + ", " + range;
}

/// One value of the tree and how errors call it.
struct Value {
  const ConfigTree& tree;
  const Row& row;
  std::string key;  // full, with an index for an item of a list

  [[nodiscard]] ConfigError error(const std::string& reason, const std::string& expected) const {
    return {tree.place, "key '" + key + "': " + reason + " (got " + describe_kind(tree) +
                            ", expected " + expected + ")"};
  }

  [[nodiscard]] ConfigError wrong(const std::string& expected) const {
    if (tree.kind == Kind::null) return error("has no value", expected);
    const bool scalar = tree.kind == Kind::scalar;
    if (scalar && tree.quoted) return error("text in quotes is no number", expected);
    const auto advice = scalar ? number_advice(tree.text) : std::string();
    return error(advice.empty() ? "wrong kind of value" : advice, expected);
  }

  void check_range(double number) const {
    if (number >= row.min && number <= row.max) return;
    throw error("out of range", range_of(row));
  }

  [[nodiscard]] bool plain() const { return tree.kind == Kind::scalar && !tree.quoted; }

  [[nodiscard]] Value item(std::size_t index) const {
    return {tree.items[index], row, key + '[' + std::to_string(index) + ']'};
  }
};

void convert(const Value& value, double& out) {
  const auto parsed = value.plain() ? parse_number(value.tree.text) : std::nullopt;
  if (!parsed) throw value.wrong(with_range("a number", value.row));
  value.check_range(*parsed);
  out = *parsed;
}

void convert(const Value& value, int& out) {
  const auto parsed = value.plain() ? parse_whole(value.tree.text) : std::nullopt;
  if (!parsed) throw value.wrong(with_range("a whole number", value.row));
  value.check_range(*parsed);
  out = *parsed;
}

void convert(const Value& value, bool& out) {
  const auto parsed = value.plain() ? parse_truth(value.tree.text) : std::nullopt;
  if (!parsed) throw value.error("wrong kind of value", "true or false");
  out = *parsed;
}

void convert(const Value& value, std::string& out) {
  const auto& choices = value.row.choices;
  if (value.tree.kind != Kind::scalar) {
    throw value.error(value.tree.kind == Kind::null ? "has no value" : "wrong kind of value",
                      "text");
  }
  const auto& text = value.tree.text;
  bool known = choices.empty();
  std::string listed;
  for (const auto& choice : choices) {
    known = known || choice == text;
    listed += (listed.empty() ? "" : ", ") + choice;
  }
  if (!known) {
    const auto error = value.error("unknown choice", "one of " + listed);
    const auto nearest = nearest_name(text, choices);
    if (nearest.empty()) throw error;
    throw ConfigError::with_suggestion(error, nearest);
  }
  out = text;
}

template <std::size_t Count>
void convert(const Value& value, std::array<double, Count>& out) {
  if (value.tree.kind != Kind::list || value.tree.items.size() != Count) {
    const auto expected = "a list of " + std::to_string(Count) + " numbers";
    throw value.error("wrong kind of value", with_range(expected, value.row));
  }
  std::array<double, Count> numbers{};
  for (std::size_t i = 0; i < Count; ++i) convert(value.item(i), numbers[i]);
  out = numbers;
}

template <class Item>
void convert(const Value& value, std::vector<Item>& out) {
  if (value.tree.kind != Kind::list) {
    throw value.error("wrong kind of value", "a list, such as [a, b]");
  }
  std::vector<Item> items(value.tree.items.size());
  for (std::size_t i = 0; i < items.size(); ++i) convert(value.item(i), items[i]);
  out = std::move(items);
}

template <class Out>
bool convert_entry(const ConfigTree& tree, const std::string& path, const Row& row, Out& out) {
  const auto* found = tree.find(row.key);
  if (found == nullptr) return false;
  convert(Value{*found, row, joined(path, row.key)}, out);
  return true;
}

std::string read_text(const std::filesystem::path& path) {
  const Place start{path.string(), 1, 1};
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw ConfigError(start, "cannot be read: it is a folder");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw ConfigError(start, std::string("cannot be read: ") + std::strerror(errno));
  std::string text(kMaxConfigBytes + 1, '\0');  // one more shows that it is too large
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (file.bad()) throw ConfigError(start, "cannot be read: input error");
  return text;
}

}  // namespace

ConfigError::ConfigError(const Place& place, const std::string& reason)
    : std::runtime_error(place.file + ':' + std::to_string(place.line) + ':' +
                         std::to_string(place.column) + ": error: " + reason),
      place_(place),
      reason_(reason) {}

ConfigError ConfigError::with_suggestion(const ConfigError& error, const std::string& name) {
  return {error.place_, error.reason_ + "; did you mean '" + name + "'?"};
}

ConfigMap::ConfigMap(std::shared_ptr<const Node> node) : node_(std::move(node)) {}

ConfigMap ConfigMap::load(const std::filesystem::path& path) {
  return parse(read_text(path), path.string());
}

ConfigMap ConfigMap::parse(const std::string& text, const std::string& file_name) {
  auto root = std::make_shared<const ConfigTree>(parse_config_tree(text, file_name));
  if (root->kind != Kind::mapping) {
    throw ConfigError(root->place, "the file must be a mapping of keys to values (got " +
                                       describe_kind(*root) + ", expected 'key: value')");
  }
  const auto* tree = root.get();
  return ConfigMap(std::make_shared<const Node>(Node{std::move(root), tree, ""}));
}

void ConfigMap::check_keys(const std::vector<const Row*>& rows,
                           const std::vector<std::string>& children) const {
  std::vector<std::string> known = children;
  for (const auto* row : rows) known.push_back(row->key);
  for (const auto& [key, value] : node_->tree->entries) {
    if (std::find(known.begin(), known.end(), key.name) != known.end()) continue;
    std::string listed;
    for (const auto& name : known) listed += (listed.empty() ? "" : ", ") + name;
    const ConfigError error(key.place, "key '" + joined(node_->path, key.name) +
                                           "': unknown key (known here: " + listed + ")");
    const auto nearest = nearest_name(key.name, known);
    throw nearest.empty() ? error : ConfigError::with_suggestion(error, nearest);
  }
  for (const auto* row : rows) {
    if (row->required && !has(row->key)) {
      throw ConfigError(place(), "key '" + joined(node_->path, row->key) + "': missing (expected " +
                                     row->meaning + ")");
    }
  }
}

bool ConfigMap::read_value(const Row& row, double& out) const {
  return convert_entry(*node_->tree, node_->path, row, out);
}
bool ConfigMap::read_value(const Row& row, int& out) const {
  return convert_entry(*node_->tree, node_->path, row, out);
}
bool ConfigMap::read_value(const Row& row, bool& out) const {
  return convert_entry(*node_->tree, node_->path, row, out);
}
bool ConfigMap::read_value(const Row& row, std::string& out) const {
  return convert_entry(*node_->tree, node_->path, row, out);
}
bool ConfigMap::read_value(const Row& row, Vector3& out) const {
  return convert_entry(*node_->tree, node_->path, row, out);
}
bool ConfigMap::read_value(const Row& row, Quaternion& out) const {
  return convert_entry(*node_->tree, node_->path, row, out);
}
bool ConfigMap::read_value(const Row& row, std::vector<double>& out) const {
  return convert_entry(*node_->tree, node_->path, row, out);
}
bool ConfigMap::read_value(const Row& row, std::vector<std::string>& out) const {
  return convert_entry(*node_->tree, node_->path, row, out);
}

bool ConfigMap::has(const std::string& key) const {
  return node_->tree->find(key) != nullptr;
}

ConfigMap ConfigMap::child(const std::string& key) const {
  if (auto found = optional_child(key)) return *found;
  throw ConfigError(place(),
                    "key '" + joined(node_->path, key) + "': missing (expected a mapping)");
}

std::optional<ConfigMap> ConfigMap::optional_child(const std::string& key) const {
  const auto* found = node_->tree->find(key);
  if (found == nullptr) return std::nullopt;
  const Row row{key, "", ""};
  const auto path = joined(node_->path, key);
  if (found->kind != Kind::mapping) {
    throw Value{*found, row, path}.error("wrong kind of value", "a mapping of keys to values");
  }
  return ConfigMap(std::make_shared<const Node>(Node{node_->root, found, path}));
}

std::vector<ConfigMap> ConfigMap::list(const std::string& key) const {
  std::vector<ConfigMap> maps;
  const auto* found = node_->tree->find(key);
  if (found == nullptr) return maps;
  const Row row{key, "", ""};
  const Value value{*found, row, joined(node_->path, key)};
  if (found->kind != Kind::list) throw value.error("wrong kind of value", "a list of mappings");
  for (std::size_t i = 0; i < found->items.size(); ++i) {
    const auto item = value.item(i);
    if (item.tree.kind != Kind::mapping) throw item.error("wrong kind of value", "a mapping");
    maps.push_back(
        ConfigMap(std::make_shared<const Node>(Node{node_->root, &item.tree, item.key})));
  }
  return maps;
}

ConfigError ConfigMap::error(const std::string& key, const std::string& reason) const {
  const auto* found = node_->tree->find(key);
  return {found == nullptr ? place() : found->place,
          "key '" + joined(node_->path, key) + "': " + reason};
}

Place ConfigMap::place() const {
  return node_->tree->place;
}

std::filesystem::path ConfigMap::folder() const {
  return std::filesystem::path(place().file).parent_path();
}

}  // namespace splash::protocol
