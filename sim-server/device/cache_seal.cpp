// SPDX-License-Identifier: MIT
#include "sim-server/device/cache_seal.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim-server/device/cache_layout.hpp"

namespace splash::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSeal = "splash-sums";
constexpr std::string_view kMark = "splash-at-work-";

/// FNV-1a (Fowler, Noll, Vo) over words of eight bytes, each folded once more, since a product
/// carries nothing downwards; the last word is filled up with zeros. Against accidents, not against
/// enemies.
std::uint64_t checksum(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 65536> piece = {};
  std::uint64_t sum = 14695981039346656037ULL;
  std::uint64_t size = 0;
  const auto take = [&sum](std::uint64_t word) {
    sum = (sum ^ word) * 1099511628211ULL;
    sum ^= sum >> 32;
  };
  while (file.read(piece.data(), piece.size()), file.gcount() > 0) {
    const auto count = static_cast<std::size_t>(file.gcount());
    std::fill(piece.begin() + file.gcount(), piece.end(), '\0');
    for (std::size_t at = 0; at < count; at += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, &piece[at], sizeof word);
      take(word);
    }
    size += count;
  }
  take(size);
  return sum;
}

using Sums = std::map<std::string, std::uint64_t>;  // file, relative to the cache

/// Of a program, relative to the cache.
std::vector<std::string> files_of(const fs::path& folder, const fs::path& program) {
  std::vector<std::string> files;
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(folder / program, ignored)) {
    if (!entry.is_regular_file(ignored) || entry.path().filename() == kLastAccessed) continue;
    files.push_back(entry.path().lexically_relative(folder));
  }
  return files;
}

Sums sums_of(const fs::path& folder, const fs::path& program) {
  Sums sums;
  for (const std::string& name : files_of(folder, program)) sums[name] = checksum(folder / name);
  return sums;
}

Sums read_seal(const fs::path& folder) {
  Sums sums;
  std::ifstream file(folder / kSeal);
  std::uint64_t sum = 0;
  std::string name;
  while (file >> std::hex >> sum && std::getline(file >> std::ws, name)) sums[name] = sum;
  return sums;
}

/// Takes the marks of simulators that died; whether there was any.
bool clear_marks(const fs::path& folder) {
  std::vector<fs::path> marks;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().filename().string().starts_with(kMark)) marks.push_back(entry.path());
  }
  for (const fs::path& mark : marks) fs::remove(mark, ignored);
  return !marks.empty();
}

/// `seal` has the same files of `program` with the same contents, or, when what is in no seal is
/// trusted, no other contents.
bool is_whole(const Sums& found, const Sums& seal, const fs::path& program, bool trusting) {
  for (const auto& [name, sum] : found) {
    const auto sealed = seal.find(name);
    if (sealed == seal.end() ? !trusting : sealed->second != sum) return false;
  }
  const std::string start = program.string() + '/';
  for (auto row = seal.lower_bound(start); row != seal.end() && row->first.starts_with(start);
       ++row) {
    if (!found.contains(row->first)) return false;
  }
  return true;
}

}  // namespace

int remove_damaged_programs(const fs::path& folder) {
  const bool trusting = !clear_marks(folder);
  const Sums seal = read_seal(folder);
  int removed = 0;
  for (const fs::path& program : programs_in(folder)) {
    if (is_whole(sums_of(folder, program), seal, program, trusting)) continue;
    std::error_code ignored;
    fs::remove_all(folder / program, ignored);
    ++removed;
  }
  return removed;
}

CacheSeal::CacheSeal(fs::path folder)
    : folder_(std::move(folder)), mark_(folder_ / (std::string(kMark) + std::to_string(getpid()))) {
  std::ofstream{mark_};
}

CacheSeal::~CacheSeal() {
  std::error_code ignored;
  fs::remove(mark_, ignored);
}

bool CacheSeal::has_new() const {
  const Sums sealed = read_seal(folder_);
  const auto programs = programs_in(folder_);
  return std::any_of(programs.begin(), programs.end(), [&](const fs::path& program) {
    const auto files = files_of(folder_, program);
    return std::any_of(files.begin(), files.end(),
                       [&](const std::string& name) { return !sealed.contains(name); });
  });
}

void CacheSeal::renew() const {
  const fs::path draft = folder_ / (std::string(kSeal) + "-" + std::to_string(getpid()));
  std::ofstream file(draft);
  for (const fs::path& program : programs_in(folder_)) {
    for (const auto& [name, sum] : sums_of(folder_, program)) {
      file << std::hex << sum << ' ' << name << '\n';
    }
  }
  file.close();
  std::error_code ignored;
  if (file) {
    fs::rename(draft, folder_ / kSeal, ignored);
  } else {
    fs::remove(draft, ignored);
  }
}

}  // namespace splash::sim
