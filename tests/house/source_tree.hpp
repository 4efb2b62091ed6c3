// SPDX-License-Identifier: MIT
// The source tree as the house checks read it: files, their lines, what they include and link.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace splash::house {

/// A file below the root, its path written with '/' from there ("protocol/event.hpp").
struct SourceFile {
  std::string path;
  std::vector<std::string> lines;
};

/// Everything under the rooms of the house (protocol, sim-server, synth-server, pd-patches, tests)
/// whose name ends in one of `endings`, in order of path.
std::vector<SourceFile> read_files(const std::filesystem::path& root,
                                   const std::vector<std::string>& endings);

/// What stands between the quotes or brackets of a file's #include lines.
std::vector<std::string> includes_of(const SourceFile& file);

/// A library or program of the build: the folder that defines it, and what it names as its links.
struct Target {
  std::string folder;
  std::vector<std::string> links;
};

/// Targets by name, out of the splash_library, splash_test, add_library, add_executable and
/// target_link_libraries calls of CMakeLists.txt files. A ${name} stays as it is written.
std::map<std::string, Target> targets_of(const std::vector<SourceFile>& cmake_files);

/// "sim-server/fluid" for "sim-server/fluid/pressure/density.cl"; "sim-server" for its own files.
std::string room_of(std::string_view path);

}  // namespace splash::house
