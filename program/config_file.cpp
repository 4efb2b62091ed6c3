// SPDX-License-Identifier: MIT
#include "program/config_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string_view>

#include "program/failure.hpp"
#include "program/files.hpp"
#include "program/text.hpp"
#include "program/this_program.hpp"

namespace splash::program {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 64;  ///< of a wrong name that is told [bytes]

/// "": there is none.
fs::path from_environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// The folder whose bin/ holds this program; "" where /proc is not mounted.
fs::path prefix() {
  return this_program().parent_path().parent_path();
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// Without what a link adds on the way, so that errors name the file that one edits.
fs::path plain(const fs::path& path) {
  std::error_code error;
  const fs::path found = fs::canonical(path, error);
  return error ? path : found;
}

std::vector<std::string> names_in(const std::vector<fs::path>& folders) {
  std::set<std::string> names;
  for (const fs::path& folder : folders) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (entry.path().extension() == ".yaml") names.insert(entry.path().stem().string());
    }
  }
  return {names.begin(), names.end()};
}

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::string what_there_is(const std::string& wanted, const std::vector<fs::path>& folders) {
  const std::vector<std::string> names = names_in(folders);
  std::vector<std::string> searched;
  for (const fs::path& folder : folders) searched.push_back(plain(folder).string());
  if (names.empty()) return "nothing lies in " + joined(searched, " or ") + "; name a file";
  const std::string nearest = nearest_name(wanted, names);
  return (nearest.empty() ? std::string() : "did you mean " + nearest + "? ") +
         "There are: " + joined(names, " ");
}

/// What stands behind `description:` in a file, its own quotes left off.
std::string description_in(const fs::path& path) {
  constexpr std::string_view kKey = "description:";
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(kKey)) continue;
    const auto begin = line.find_first_not_of(" \"", kKey.size());
    const auto end = line.find_last_not_of(" \"\r");
    return begin == std::string::npos || end < begin ? "" : line.substr(begin, end + 1 - begin);
  }
  return {};
}

}  // namespace

std::vector<fs::path> config_folders(const std::string& kind) {
  std::vector<fs::path> folders;
  const fs::path home = from_environment("HOME");
  fs::path own = from_environment("XDG_CONFIG_HOME");
  if (own.empty() && !home.empty()) own = home / ".config";
  if (!own.empty()) folders.push_back(own / "splash" / kind);
  const fs::path shipped = prefix();
  if (!shipped.empty()) folders.push_back(shipped / "share" / "splash" / "configs" / kind);
  return folders;
}

std::optional<fs::path> named_config(const std::string& kind, const std::string& name) {
  if (fs::path(name).filename() != name) return std::nullopt;
  for (const fs::path& folder : config_folders(kind)) {
    const fs::path file = folder / (name + ".yaml");
    if (is_file(file)) return plain(file);
  }
  return std::nullopt;
}

std::vector<NamedConfig> list_configs(const std::string& kind) {
  std::vector<NamedConfig> all;
  for (const std::string& name : names_in(config_folders(kind))) {
    if (const auto file = named_config(kind, name)) all.push_back({name, description_in(*file)});
  }
  return all;
}

fs::path find_config(const std::string& option, const std::string& kind, const fs::path& wanted) {
  const auto readable = [&option](const fs::path& path) {
    require_readable(option, path);
    return path;
  };
  if (is_file(wanted) || wanted.has_parent_path()) return readable(wanted);
  if (const auto file = named_config(kind, wanted.string())) return readable(*file);
  const std::vector<fs::path> folders = config_folders(kind);
  std::error_code ignored;
  if (fs::exists(wanted, ignored)) return readable(wanted);  // a folder or a device: says so
  const fs::path here = fs::current_path(ignored);
  throw Failure(kExitNoInput, option + " " + printable(wanted.string(), kLongestName) +
                                  ": there is no such file in " + here.string() +
                                  ", and none of the " + kind + " is called so; " +
                                  what_there_is(wanted.string(), folders));
}

}  // namespace splash::program
