// SPDX-License-Identifier: MIT
// What every benchmark does besides measuring: it reads its command line, says what stopped it,
// keeps its tables on the screen and as CSV, and writes its section of a file in docs/, if it has
// one, when it is asked to, with date, commit, machine and command.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/tables.hpp"

namespace splash::bench {

/// Whether `name` is among those that were asked for; none: all are.
[[nodiscard]] bool is_wanted(const std::vector<std::string>& asked, const std::string& name);

class Bench {
 public:
  /// `doc`: the file in docs/ that has its section; `title`: of that section.
  Bench(std::string name, std::string doc, std::string title, const std::string& what);
  /// One without a section.
  Bench(std::string name, const std::string& what) : Bench(std::move(name), "", "", what) {}

  CLI::App& options() { return app_; }
  /// --device for `device`, an OpenCL device's number.
  void add_device_option(int& device);
  /// An option whose values have the names that name_of() gives them.
  template <class Values, class Value>
  void add_choice(const std::string& option, Values& chosen, std::initializer_list<Value> all,
                  const std::string& what) {
    std::map<std::string, Value> named;
    for (const Value value : all) named[name_of(value)] = value;
    app_.add_option(option, chosen, what)->transform(CLI::CheckedTransformer(named));
  }

  /// Reads the command line and measures. `measure`: true when all is as it must be. The exit code:
  /// 0, 1 when it is not, 70 when it could not be measured.
  int run(int argc, char** argv, const std::function<bool()>& measure);

  /// For all that it leaves; exists while it measures.
  [[nodiscard]] const std::filesystem::path& out() const { return out_; }
  void set_device(const std::string& description);  ///< says it, too
  /// A table with its CSV in the folder.
  [[nodiscard]] Table table(const std::string& file, Row head) const;
  /// More of the section in docs/: Markdown.
  void tell(const std::string& paragraph) { section_ << paragraph << "\n\n"; }
  void tell(const Table& table) { tell(table.text()); }
  /// The same on the screen, too.
  void say(const std::string& paragraph);
  /// A picture in the folder, copied into docs/ when the section is written.
  void show(const std::string& picture, const std::string& what);

 private:
  void write_docs(const std::string& begun) const;
  std::string name_;
  std::string doc_;
  std::string title_;
  std::filesystem::path out_;
  CLI::App app_;
  bool to_docs_ = false;
  std::string command_;
  std::string device_;
  std::ostringstream section_;
  std::vector<std::string> pictures_;
};

}  // namespace splash::bench
