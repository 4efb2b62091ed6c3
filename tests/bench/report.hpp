// SPDX-License-Identifier: MIT
// What every benchmark does besides measuring: it reads its command line, says what stopped it,
// keeps its tables on the screen and as CSV, and writes its section of a file in docs/ when it is
// asked to, with date, commit, machine and command.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "tests/bench/tables.hpp"

namespace splash::bench {

class Bench {
 public:
  /// `doc`: the file in docs/ that has its section; `title`: of that section.
  Bench(std::string name, std::string doc, std::string title, const std::string& what);

  CLI::App& options() { return app_; }

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
