// SPDX-License-Identifier: MIT
// Reads strict YAML. Each parameter is one row of a table: key, unit, range, meaning, source. The
// reader, the error texts and the reference page follow from the rows; the default is the member's
// initialiser.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "program/failure.hpp"

namespace splash::program {

/// A place in a configuration file, counted from 1.
struct Place {
  std::string file;
  int line = 1;
  int column = 1;
};

/// An error in a configuration: "file:line:column: error: key 'a.b': reason".
class ConfigError : public Failure {
 public:
  ConfigError(const Place& place, const std::string& reason);
  [[nodiscard]] const Place& place() const noexcept { return place_; }
  /// The same error, followed by "; did you mean 'name'?".
  [[nodiscard]] static ConfigError with_suggestion(const ConfigError& error,
                                                   const std::string& name);

 private:
  Place place_;
  std::string reason_;
};

/// The bytes of a file that a configuration names. Throws ConfigError: cannot be read, larger.
[[nodiscard]] std::string read_file(const std::filesystem::path& path, std::uintmax_t megabytes);

struct Row {
  std::string key;
  std::string unit = {};                                  ///< "m", "1", "" for text
  std::string meaning;                                    ///< one sentence
  double min = -std::numeric_limits<double>::infinity();  ///< allowed, inclusive
  double max = std::numeric_limits<double>::infinity();
  bool required = false;
  std::vector<std::string> choices = {};  ///< of a text; empty: any
  std::string source = {};                ///< where the default comes from
  bool live = false;                      ///< may change while the program runs
  std::vector<std::string> kinds = {};    ///< of the mapping that use it; empty: all
};

/// A row of a number or of a list of them.
[[nodiscard]] Row number_row(std::string key, std::string unit, double min, double max,
                             std::string meaning, std::string source = {});
/// The same row, whose key must be given.
[[nodiscard]] Row required(Row row);

using Vector3 = std::array<double, 3>;
using Quaternion = std::array<double, 4>;  ///< x y z w

/// A row and the member it fills.
template <class Struct>
struct Field {
  Row row;
  std::variant<double Struct::*, int Struct::*, bool Struct::*, std::string Struct::*,
               Vector3 Struct::*, Quaternion Struct::*, std::vector<double> Struct::*,
               std::vector<std::string> Struct::*>
      member;
};

/// A member of one of these types.
using MemberPlace = std::variant<double*, int*, bool*, std::string*, Vector3*, Quaternion*,
                                 std::vector<double>*, std::vector<std::string>*>;

/// One mapping of a YAML file. It keeps the text's places and refuses what yaml-cpp accepts:
/// duplicate and unknown keys, octal-looking and non-finite numbers, yes/no as booleans.
class ConfigMap {
 public:
  /// Throws ConfigError: unreadable file, over 1 MB, deeper than 32, bad YAML, no mapping.
  [[nodiscard]] static ConfigMap load(const std::filesystem::path& path);
  [[nodiscard]] static ConfigMap parse(const std::string& text, const std::string& file_name);

  /// Fills the members named by `fields`. Keys that are neither in `fields` nor in `children`
  /// are refused, with the nearest known name; so are missing required ones.
  template <class Struct>
  void read(const std::vector<Field<Struct>>& fields, const std::vector<std::string>& children,
            Struct& out) const;

  [[nodiscard]] bool has(const std::string& key) const;
  /// Returns a child mapping. `child` throws when it is missing, `optional_child` does not.
  [[nodiscard]] ConfigMap child(const std::string& key) const;
  [[nodiscard]] std::optional<ConfigMap> optional_child(const std::string& key) const;
  /// Returns a list of mappings; empty when the key is missing.
  [[nodiscard]] std::vector<ConfigMap> list(const std::string& key) const;

  /// Returns the error that a caller throws for a rule that spans several keys.
  [[nodiscard]] ConfigError error(const std::string& key, const std::string& reason) const;
  /// The place where this mapping begins, and the folder of its file (for paths named in it).
  [[nodiscard]] Place place() const;
  [[nodiscard]] std::filesystem::path folder() const;

 private:
  struct Node;
  explicit ConfigMap(std::shared_ptr<const Node> node);
  void check_keys(const std::vector<const Row*>& rows,
                  const std::vector<std::string>& children) const;
  void read_value(const Row& row, const MemberPlace& out) const;

  std::shared_ptr<const Node> node_;
};

template <class Struct>
void ConfigMap::read(const std::vector<Field<Struct>>& fields,
                     const std::vector<std::string>& children, Struct& out) const {
  std::vector<const Row*> rows;
  for (const auto& field : fields) rows.push_back(&field.row);
  check_keys(rows, children);
  for (const auto& field : fields) {
    std::visit([&](auto member) { read_value(field.row, &(out.*member)); }, field.member);
  }
}

/// A default as the table below shows it: "0.5", "true", "[1, 2]".
[[nodiscard]] std::string default_text(const MemberPlace& value);

/// Returns a Markdown table of rows: key, unit, default, range, meaning, source.
[[nodiscard]] std::string describe(const std::vector<Row>& rows,
                                   const std::vector<std::string>& defaults);

}  // namespace splash::program
