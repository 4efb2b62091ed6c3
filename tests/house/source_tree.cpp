// SPDX-License-Identifier: MIT
#include "tests/house/source_tree.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>

namespace splash::house {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 7> kRoots = {
    "program", "protocol", "sim-server", "synth-server", "view-server", "pd-patches", "tests"};

std::vector<std::string> read_lines(const fs::path& path) {
  std::ifstream in(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

bool ends_with_any(const std::string& name, const std::vector<std::string>& endings) {
  return std::any_of(endings.begin(), endings.end(),
                     [&](const std::string& ending) { return name.ends_with(ending); });
}

/// The words of a CMake call, comments left out.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  const std::regex word(R"([^\s"()]+)");
  for (std::sregex_iterator it(text.begin(), text.end(), word), end; it != end; ++it) {
    words.push_back(it->str());
  }
  return words;
}

std::string without_comments(const SourceFile& file) {
  std::string text;
  for (const std::string& line : file.lines) text += line.substr(0, line.find('#')) + '\n';
  return text;
}

bool is_keyword(const std::string& word) {
  return word == "PUBLIC" || word == "PRIVATE" || word == "INTERFACE";
}

/// What a call names as links: everything of target_link_libraries, after LINK of the splash_*
/// ones.
void add_links(const std::string& call, const std::vector<std::string>& words, Target& target) {
  bool linking = call == "target_link_libraries";
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i] == "LINK") {
      linking = true;
    } else if (words[i] == "LABELS" || words[i] == "TIMEOUT" || words[i] == "SOURCES") {
      linking = false;
    } else if (linking && !is_keyword(words[i])) {
      target.links.push_back(words[i]);
    }
  }
}

}  // namespace

std::vector<SourceFile> read_files(const fs::path& root, const std::vector<std::string>& endings) {
  std::vector<SourceFile> files;
  for (const std::string_view room : kRoots) {
    if (!fs::is_directory(root / room)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / room)) {
      if (!entry.is_regular_file() || !ends_with_any(entry.path().filename().string(), endings)) {
        continue;
      }
      files.push_back(
          {entry.path().lexically_relative(root).generic_string(), read_lines(entry.path())});
    }
  }
  std::sort(files.begin(), files.end(),
            [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

std::vector<std::string> includes_of(const SourceFile& file) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*["<]([^">]+)[">])");
  std::vector<std::string> found;
  for (const std::string& line : file.lines) {
    std::smatch match;
    if (std::regex_search(line, match, kInclude)) found.push_back(match[1].str());
  }
  return found;
}

std::map<std::string, Target> targets_of(const std::vector<SourceFile>& cmake_files) {
  static const std::regex kCall(
      R"((splash_library|splash_test|add_library|add_executable|target_link_libraries))"
      R"(\s*\(([^)]*)\))");
  std::map<std::string, Target> targets;
  for (const SourceFile& file : cmake_files) {
    const std::string text = without_comments(file);
    for (std::sregex_iterator it(text.begin(), text.end(), kCall), end; it != end; ++it) {
      const std::vector<std::string> words = words_of((*it)[2].str());
      if (words.empty()) continue;
      Target& target = targets[words.front()];
      if (target.folder.empty()) target.folder = room_of(file.path);
      add_links((*it)[1].str(), words, target);
    }
  }
  return targets;
}

std::string room_of(std::string_view path) {
  const std::size_t first = path.find('/');
  if (first == std::string_view::npos) return "";
  const std::string_view top = path.substr(0, first);
  if (top != "sim-server" && top != "synth-server") return std::string(top);
  return std::string(path.substr(0, path.rfind('/')));
}

}  // namespace splash::house
