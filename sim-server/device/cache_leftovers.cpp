// SPDX-License-Identifier: MIT
#include "sim-server/device/cache_leftovers.hpp"

#include <cctype>
#include <string>
#include <string_view>

namespace splash::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kDraft = "tempfile_";     // PoCL leaves one, empty, at every start
constexpr std::string_view kUsed = "last_accessed";  // PoCL touches it at every start

bool is_program_letter(char c) {
  return std::isupper(static_cast<unsigned char>(c)) != 0;
}

/// What PoCL did not finish has no such file: it is as old as its folder.
fs::file_time_type last_use(const fs::path& program) {
  std::error_code missing;
  const auto used = fs::last_write_time(program / kUsed, missing);
  if (!missing) return used;
  std::error_code ignored;
  return fs::last_write_time(program, ignored);
}

void remove_drafts(const fs::path& folder) {
  std::vector<fs::path> drafts;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().filename().string().starts_with(kDraft)) drafts.push_back(entry.path());
  }
  for (const fs::path& draft : drafts) fs::remove(draft, ignored);
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

int remove_leftovers(const fs::path& folder) {
  remove_drafts(folder);
  const auto oldest = fs::file_time_type::clock::now() - kProgramKept;
  int removed = 0;
  for (const fs::path& program : programs_in(folder)) {
    if (last_use(folder / program) >= oldest) continue;
    std::error_code ignored;
    fs::remove_all(folder / program, ignored);
    ++removed;
  }
  return removed;
}

}  // namespace splash::sim
