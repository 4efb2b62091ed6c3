// SPDX-License-Identifier: MIT
// The tests and benchmarks that the documents name exist: what is promised there is looked after.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/house/source_tree.hpp"

namespace splash::house {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;

std::string read_text(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<fs::path> documents() {
  std::vector<fs::path> all;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(SPLASH_SOURCE_DIR) / "tests")) {
    if (entry.path().extension() == ".md") all.push_back(entry.path());
  }
  return all;
}

/// "Suite" and "Suite.Name" of each test in `source`.
std::set<std::string> tests_in(const std::string& source) {
  static const std::regex kTest(R"((?:^|\n)TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\))");
  std::set<std::string> names;
  for (std::sregex_iterator it(source.begin(), source.end(), kTest), end; it != end; ++it) {
    names.insert((*it)[1].str());
    names.insert((*it)[1].str() + "." + (*it)[2].str());
  }
  return names;
}

std::set<std::string> all_tests() {
  std::set<std::string> names;
  for (const SourceFile& file : read_files(SPLASH_SOURCE_DIR, {"_test.cpp"})) {
    names.merge(tests_in(read_text(fs::path(SPLASH_SOURCE_DIR) / file.path)));
  }
  return names;
}

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? ""
                                    : text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

std::vector<std::string> parts(const std::string& text, char separator) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) all.push_back(trimmed(part));
  return all;
}

/// What stands in table columns headed "tests", and `Suite.Name` anywhere.
std::set<std::string> named_in(const std::string& document) {
  std::set<std::string> names;
  std::size_t column = 0;  // of the table that the line is in; 0: none
  std::istringstream in(document);
  for (std::string line; std::getline(in, line);) {
    const auto cells = line.starts_with('|') ? parts(line, '|') : std::vector<std::string>();
    if (cells.empty()) column = 0;
    for (std::size_t k = 1; column == 0 && k < cells.size(); ++k) {
      if (cells[k] == "tests") column = k;
    }
    if (column == 0 || column >= cells.size()) continue;
    if (cells[column] == "tests" || cells[column].starts_with("---")) continue;
    for (const std::string& name : parts(cells[column], ',')) names.insert(name);
  }
  static const std::regex kQuoted(R"(`([A-Z]\w+\.[A-Z]\w+)`)");
  for (std::sregex_iterator it(document.begin(), document.end(), kQuoted), end; it != end; ++it) {
    names.insert((*it)[1].str());
  }
  names.erase("");
  return names;
}

/// Benchmarks in commands of `document`, each with the options that it is given.
std::map<std::string, std::set<std::string>> benchmarks_in(const std::string& document) {
  static const std::regex kCommand(R"(\./splash bench ([a-z]+)((?: [^`\n#]*)?))");
  static const std::regex kOption(R"( (--[a-z][a-z-]*))");
  std::map<std::string, std::set<std::string>> found;
  for (std::sregex_iterator it(document.begin(), document.end(), kCommand), end; it != end; ++it) {
    const std::string rest = (*it)[2].str();
    std::set<std::string>& options = found[(*it)[1].str()];
    for (std::sregex_iterator o(rest.begin(), rest.end(), kOption); o != end; ++o) {
      options.insert((*o)[1].str());
    }
  }
  return found;
}

TEST(Promises, NameTestsThatExist) {
  const std::set<std::string> known = all_tests();
  ASSERT_TRUE(known.contains("Promises.NameTestsThatExist"));
  std::vector<std::string> missing;
  std::size_t named = 0;
  for (const fs::path& document : documents()) {
    for (const std::string& name : named_in(read_text(document))) {
      ++named;
      if (!known.contains(name)) missing.push_back(document.string() + ": " + name);
    }
  }
  EXPECT_GT(named, 100U);
  EXPECT_THAT(missing, IsEmpty());
}

TEST(Promises, NameBenchmarksAndTheirOptions) {
  const fs::path folder = fs::path(SPLASH_SOURCE_DIR) / "tests" / "bench";
  std::vector<std::string> missing;
  for (const fs::path& document : documents()) {
    for (const auto& [name, options] : benchmarks_in(read_text(document))) {
      const std::string source = read_text(folder / (name + "_bench.cpp"));
      if (source.empty()) missing.push_back(document.string() + ": bench " + name);
      for (const std::string& option : options) {
        if (source.find('"' + option + '"') != std::string::npos) continue;
        missing.push_back(document.string() + ": bench " + name + " " + option);
      }
    }
  }
  EXPECT_THAT(missing, IsEmpty());
}

TEST(Promises, AreReadWhereverTheyStand) {
  EXPECT_THAT(named_in("| a | tests |\n|---|---|\n| x | One, Two.Three |\n\n| b | c |\n| d | e |\n"
                       "See `Four.Five` and `six.Seven`."),
              testing::ElementsAre("Four.Five", "One", "Two.Three"));
  EXPECT_THAT(tests_in("TEST_F(One,\n     Two) {\n}\n// TEST(Three, Four)\n"),
              testing::ElementsAre("One", "One.Two"));
  const auto commands = benchmarks_in("`./splash bench soak -- --minutes 10 --hours 3` --none");
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_THAT(commands.at("soak"), testing::ElementsAre("--hours", "--minutes"));
}

}  // namespace
}  // namespace splash::house
