// SPDX-License-Identifier: MIT
// Listens to yaml-cpp's parser and builds the tree, refusing what a configuration never needs.
#include "program/config_tree.hpp"

#include <yaml-cpp/anchor.h>
#include <yaml-cpp/emitterstyle.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "program/text.hpp"

namespace splash::program {
namespace {

using Kind = ConfigTree::Kind;

constexpr std::size_t kShown = 40;  // bytes of a value or a key that an error quotes

Place to_place(const std::string& file, const YAML::Mark& mark) {
  // A null mark (-1) stands for "unknown": the file's start.
  return {file, std::max(mark.line, 0) + 1, std::max(mark.column, 0) + 1};
}

class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(std::string file) : file_(std::move(file)) {}
  [[nodiscard]] ConfigTree& root() { return root_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) throw error(mark, "a second document begins; write one per file");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    refuse_extras(mark, "", anchor);
    add(make(Kind::null, mark));
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw error(mark, "aliases (*name) are not allowed; write the value out");
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_extras(mark, tag, anchor);
    auto scalar = make(Kind::scalar, mark);
    scalar.text = value;
    scalar.quoted = tag == "!";  // how yaml-cpp marks quoted and block scalars
    const bool is_null = !scalar.quoted && (value == "~" || value == "null");
    if (is_null && !expects_key()) scalar.kind = Kind::null;
    if (expects_key()) {
      take_key(mark, value);
    } else {
      add(std::move(scalar));
    }
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    refuse_extras(mark, tag, anchor);
    open(Kind::list, mark);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    refuse_extras(mark, tag, anchor);
    open(Kind::mapping, mark);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Level {
    ConfigTree tree;
    bool has_key = false;  // a mapping's next event is the value of its newest key
    ConfigTree::Key key;
  };

  [[nodiscard]] ConfigError error(const YAML::Mark& mark, const std::string& reason) const {
    return {to_place(file_, mark), reason};
  }

  [[nodiscard]] ConfigTree make(Kind kind, const YAML::Mark& mark) const {
    ConfigTree tree;
    tree.kind = kind;
    tree.place = to_place(file_, mark);
    return tree;
  }

  void refuse_extras(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) const {
    if (anchor != 0) throw error(mark, "anchors (&name) are not allowed; write the value out");
    if (!tag.empty() && tag != "?" && tag != "!") {
      throw error(mark, "tags are not allowed (got '" + printable(tag, kShown) + "')");
    }
  }

  [[nodiscard]] bool expects_key() const {
    return !levels_.empty() && levels_.back().tree.kind == Kind::mapping && !levels_.back().has_key;
  }

  void take_key(const YAML::Mark& mark, const std::string& name) {
    auto& level = levels_.back();
    if (name == "<<") throw error(mark, "merge keys (<<) are not allowed; write the keys out");
    for (const auto& [key, value] : level.tree.entries) {
      if (key.name == name) {
        throw error(mark, "key '" + printable(name, kShown) + "': given twice, first in line " +
                              std::to_string(key.place.line));
      }
    }
    level.key = {name, to_place(file_, mark)};
    level.has_key = true;
  }

  void open(Kind kind, const YAML::Mark& mark) {
    if (expects_key()) throw error(mark, "a key must be a name (got a list or mapping)");
    if (levels_.size() == kMaxConfigDepth) {
      throw error(mark, "nested deeper than " + std::to_string(kMaxConfigDepth) + " levels");
    }
    levels_.push_back({make(kind, mark), false, {}});
  }

  void close() {
    auto tree = std::move(levels_.back().tree);
    levels_.pop_back();
    add(std::move(tree));
  }

  void add(ConfigTree tree) {
    if (levels_.empty()) {
      root_ = std::move(tree);
      return;
    }
    auto& level = levels_.back();
    if (level.tree.kind == Kind::list) {
      level.tree.items.push_back(std::move(tree));
      return;
    }
    if (!level.has_key) {
      throw ConfigError(tree.place, "a key must be a name (got " + describe_kind(tree) + ")");
    }
    level.tree.entries.push_back({std::move(level.key), std::move(tree)});
    level.has_key = false;
  }

  std::string file_;
  ConfigTree root_;
  std::vector<Level> levels_;
  int documents_ = 0;
};

}  // namespace

const ConfigTree* ConfigTree::find(const std::string& key) const {
  for (const auto& [name, value] : entries) {
    if (name.name == key) return &value;
  }
  return nullptr;
}

ConfigTree parse_config_tree(const std::string& text, const std::string& file_name) {
  if (text.size() > kMaxConfigBytes) {
    throw ConfigError({file_name, 1, 1},
                      "larger than " + std::to_string(kMaxConfigBytes) + " bytes");
  }
  TreeBuilder builder(file_name);
  builder.root().place = {file_name, 1, 1};
  try {
    // The end mark makes yaml-cpp see quotes that are never closed; without it, it closes them.
    const bool closed = text.empty() || text.back() == '\n';
    std::istringstream stream(text + (closed ? "...\n" : "\n...\n"));
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& exception) {
    const bool open = exception.msg == YAML::ErrorMsg::DOC_IN_SCALAR;
    throw ConfigError(to_place(file_name, exception.mark),
                      "not YAML: " + (open ? "a quote is opened and not closed" : exception.msg));
  }
  return std::move(builder.root());
}

std::string describe_kind(const ConfigTree& tree) {
  switch (tree.kind) {
    case Kind::null:
      return "nothing";
    case Kind::list:
      return "a list of " + std::to_string(tree.items.size());
    case Kind::mapping:
      return "a mapping";
    case Kind::scalar:
      break;
  }
  return "'" + printable(tree.text, kShown) + "'";
}

}  // namespace splash::program
