// SPDX-License-Identifier: MIT
#include "sim-server/device/cache_leftovers.hpp"

#include <string>
#include <vector>

#include "sim-server/device/cache_layout.hpp"

namespace splash::sim {
namespace {

namespace fs = std::filesystem;

/// What PoCL did not finish has no such file: it is as old as its folder.
fs::file_time_type last_use(const fs::path& program) {
  std::error_code missing;
  const auto used = fs::last_write_time(program / kLastAccessed, missing);
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
