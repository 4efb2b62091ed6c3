// SPDX-License-Identifier: MIT
#include "sim-server/device/cache_layout.hpp"

#include <cctype>
#include <string>

namespace splash::sim {
namespace {

namespace fs = std::filesystem;

bool is_program_letter(char c) {
  return std::isupper(static_cast<unsigned char>(c)) != 0;
}

}  // namespace

std::vector<fs::path> programs_in(const fs::path& folder) {
  std::vector<fs::path> programs;
  std::error_code ignored;
  for (const auto& outer : fs::directory_iterator(folder, ignored)) {
    const std::string name = outer.path().filename();
    if (name.size() != 2 || !is_program_letter(name[0]) || !is_program_letter(name[1])) continue;
    for (const auto& inner : fs::directory_iterator(outer.path(), ignored)) {
      if (inner.is_directory(ignored)) programs.push_back(fs::path(name) / inner.path().filename());
    }
  }
  return programs;
}

}  // namespace splash::sim
