// SPDX-License-Identifier: MIT
// Walks a configuration's tree by its rows: which keys may be there, which must, where they are.
#include "program/config.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

#include "program/config_tree.hpp"
#include "program/config_value.hpp"
#include "program/text.hpp"

namespace splash::program {

using Kind = ConfigTree::Kind;

struct ConfigMap::Node {
  std::shared_ptr<const ConfigTree> root;  // keeps `tree` alive
  const ConfigTree* tree = nullptr;
  std::string path;  // of keys: "bodies[0].motion", "" at the root
};

namespace {

constexpr std::size_t kLongestKey = 64;       // shown of one that nobody knows
constexpr std::size_t kLongestReason = 1000;  // whatever else a reason quotes

std::string joined(const std::string& path, const std::string& key) {
  const std::string shown = printable(key, kLongestKey);
  return path.empty() ? shown : path + '.' + shown;
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
    : Failure(kExitConfig, place.file + ':' + std::to_string(place.line) + ':' +
                               std::to_string(place.column) +
                               ": error: " + printable(reason, kLongestReason)),
      place_(place),
      reason_(reason) {}

ConfigError ConfigError::with_suggestion(const ConfigError& error, const std::string& name) {
  return {error.place_, error.reason_ + "; did you mean '" + name + "'?"};
}

Row number_row(std::string key, std::string unit, double min, double max, std::string meaning,
               std::string source) {
  return {.key = std::move(key),
          .unit = std::move(unit),
          .meaning = std::move(meaning),
          .min = min,
          .max = max,
          .source = std::move(source)};
}

Row required(Row row) {
  row.required = true;
  return row;
}

std::string read_file(const std::filesystem::path& path, std::uintmax_t megabytes) {
  const Place place{.file = path.string()};
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(path, failure);
  if (failure) throw ConfigError(place, "cannot be read: " + failure.message());
  if (size > megabytes << 20U) {
    throw ConfigError(place, "is larger than " + std::to_string(megabytes) + " MB");
  }
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file) throw ConfigError(place, "cannot be read");
  return bytes;
}

ConfigMap::ConfigMap(std::shared_ptr<const Node> node) : node_(std::move(node)) {}

ConfigMap ConfigMap::load(const std::filesystem::path& path) {
  return parse(read_text(path), path.string());
}

ConfigMap ConfigMap::parse(const std::string& text, const std::string& file_name) {
  auto root = std::make_shared<const ConfigTree>(parse_config_tree(text, file_name));
  if (root->kind != Kind::mapping) {
    const bool empty = root->kind == Kind::null;
    throw ConfigError(empty ? Place{file_name} : root->place,
                      "the file must be a mapping of keys to values (got " + describe_kind(*root) +
                          ", expected 'key: value')");
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

void ConfigMap::read_value(const Row& row, const MemberPlace& out) const {
  const auto* found = node_->tree->find(row.key);
  if (found != nullptr) convert({*found, row, joined(node_->path, row.key)}, out);
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
    throw ConfigValue{*found, row, path}.error("wrong kind of value",
                                               "a mapping of keys to values");
  }
  return ConfigMap(std::make_shared<const Node>(Node{node_->root, found, path}));
}

std::vector<ConfigMap> ConfigMap::list(const std::string& key) const {
  std::vector<ConfigMap> maps;
  const auto* found = node_->tree->find(key);
  if (found == nullptr) return maps;
  const Row row{key, "", ""};
  const ConfigValue value{*found, row, joined(node_->path, key)};
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

}  // namespace splash::program
