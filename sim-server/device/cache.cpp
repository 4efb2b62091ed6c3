// SPDX-License-Identifier: MIT
#include "sim-server/device/cache.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "program/failure.hpp"

namespace splash::sim {

namespace {

/// `folder` in a place where everybody may write: what is loaded from it runs as this user, so it
/// must be a folder of this user alone.
std::filesystem::path own_folder(const std::filesystem::path& folder) {
  static_cast<void>(mkdir(folder.c_str(), S_IRWXU));
  struct stat found {};
  const bool own = lstat(folder.c_str(), &found) == 0 && S_ISDIR(found.st_mode) &&
                   found.st_uid == geteuid() && (found.st_mode & (S_IWGRP | S_IWOTH)) == 0;
  if (!own) {
    throw program::Failure(program::kExitUnavailable,
                           "the folder for compiled kernels, " + folder.string() +
                               ", is not a folder that this user alone may write to: remove it, or "
                               "set HOME, XDG_CACHE_HOME or POCL_CACHE_DIR");
  }
  return folder;
}

std::filesystem::path default_cache() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0') {
    return std::filesystem::path(cache) / "splash";
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') {
    return std::filesystem::path(home) / ".cache" / "splash";
  }
  return own_folder(std::filesystem::temp_directory_path() /
                    ("splash-cache-" + std::to_string(geteuid())));
}

void try_to_write(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const auto probe = folder / (".probe-" + std::to_string(getpid()));
  errno = 0;
  const bool written = std::ofstream(probe).put('x').flush().good();
  const std::string cause = errno != 0 ? std::strerror(errno) : "input/output error";
  std::filesystem::remove(probe, error);
  if (!written) {
    throw program::Failure(program::kExitUnavailable,
                           "the folder for compiled kernels, " + folder.string() +
                               ", cannot be written: " + cause +
                               "; mend that, or set POCL_CACHE_DIR to a folder that can");
  }
}

/// Takes part in using `folder` until the process ends. The first to come looks through it; who
/// comes meanwhile waits for that.
void join(const std::filesystem::path& folder) {
  const int lock = open((folder / "splash-lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
  if (lock < 0) return;  // the folder was tried before: another limit, and no reason to give up
  if (flock(lock, LOCK_EX | LOCK_NB) == 0) {
    remove_leftovers(folder);
    const int removed = remove_damaged_programs(folder);
    if (removed > 0) {
      std::cerr << "note: " << removed << " compiled programs in " << folder.string()
                << " were damaged or left unfinished; they are compiled again\n";
    }
  }
  flock(lock, LOCK_SH);
}

/// Without it Linux often keeps all of PoCL's workers on one core for seconds. PoCL counts cores
/// from the first whatever the process was given, so one that was given some of them only, as by
/// taskset, keeps its workers where they are.
void pin_workers() {
  cpu_set_t given;
  const bool all = sched_getaffinity(0, sizeof given, &given) == 0 &&
                   CPU_COUNT(&given) == sysconf(_SC_NPROCESSORS_ONLN);
  if (all) setenv("POCL_AFFINITY", "1", 0);
}

}  // namespace

std::filesystem::path prepare_kernel_cache() {
  const char* chosen = std::getenv("POCL_CACHE_DIR");
  std::filesystem::path folder =
      chosen != nullptr && *chosen != '\0' ? std::filesystem::path(chosen) : default_cache();
  try_to_write(folder);
  static std::filesystem::path joined;
  if (joined != folder) join(joined = folder);
  setenv("POCL_CACHE_DIR", folder.c_str(), 1);
  pin_workers();
  return folder;
}

void refuse_slow_settings() {
  if (std::getenv("POCL_WORK_GROUP_METHOD") != nullptr) {
    std::cerr << "warning: POCL_WORK_GROUP_METHOD is set and ignored: it slows kernels up to four "
                 "times\n";
    unsetenv("POCL_WORK_GROUP_METHOD");
  }
}

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSeal = "splash-sums";
constexpr std::string_view kMark = "splash-at-work-";

/// FNV-1a (Fowler, Noll, Vo) over words of eight bytes, each folded once more, since a product
/// carries nothing downwards; the last word is filled up with zeros. Against accidents, not against
/// enemies.
std::optional<std::uint64_t> checksum(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
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

/// Returns the files of a cached program, relative to the cache; nullopt if its folder cannot be
/// read.
std::optional<std::vector<std::string>> files_of(const fs::path& folder, const fs::path& program) {
  std::vector<std::string> files;
  std::error_code error;
  // Step by step: in a range's loop a step that fails throws, as without a free descriptor.
  for (fs::recursive_directory_iterator entry(folder / program, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& file = entry->path();
    std::error_code ignored;
    if (!entry->is_regular_file(ignored) || file.filename() == kLastAccessed) continue;
    files.push_back(file.lexically_relative(folder));
  }
  if (error) return std::nullopt;
  return files;
}

/// Same; nullopt: some cannot be read.
std::optional<Sums> sums_of(const fs::path& folder, const fs::path& program) {
  const auto files = files_of(folder, program);
  if (!files) return std::nullopt;
  Sums sums;
  for (const std::string& name : *files) {
    const auto sum = checksum(folder / name);
    if (!sum) return std::nullopt;
    sums[name] = *sum;
  }
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

/// Whether the seal is there and says nothing: a power cut took it before it was on the disk.
bool seal_is_lost(const fs::path& folder, const Sums& seal) {
  std::error_code missing;
  return seal.empty() && fs::exists(folder / kSeal, missing);
}

/// Waits until a file, or what a folder lists, has reached the disk; a disk that refuses is found
/// out at the next start.
void to_disk(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  static_cast<void>(fsync(file));
  close(file);
}

/// Takes the files whose names begin so; whether there was any.
bool remove_all_named(const fs::path& folder, std::string_view beginning) {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().filename().string().starts_with(beginning)) found.push_back(entry.path());
  }
  for (const fs::path& file : found) fs::remove(file, ignored);
  return !found.empty();
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
  const Sums seal = read_seal(folder);
  // A mark that is left is of a simulator that died.
  const bool trusting = !remove_all_named(folder, kMark) && !seal_is_lost(folder, seal);
  int removed = 0;
  for (const fs::path& program : programs_in(folder)) {
    const auto found = sums_of(folder, program);
    if (found && is_whole(*found, seal, program, trusting)) continue;
    std::error_code ignored;
    fs::remove_all(folder / program, ignored);
    ++removed;
  }
  return removed;
}

CacheSeal::CacheSeal(fs::path folder)
    : folder_(std::move(folder)), mark_(folder_ / (std::string(kMark) + std::to_string(getpid()))) {
  std::ofstream(mark_).flush();
  to_disk(folder_);
}

CacheSeal::~CacheSeal() {
  if (in_doubt_) return;
  std::error_code ignored;
  fs::remove(mark_, ignored);
}

bool CacheSeal::has_new() const {
  const Sums sealed = read_seal(folder_);
  const auto programs = programs_in(folder_);
  return std::any_of(programs.begin(), programs.end(), [&](const fs::path& program) {
    const auto files = files_of(folder_, program);
    return files && std::any_of(files->begin(), files->end(),
                                [&](const std::string& name) { return !sealed.contains(name); });
  });
}

void CacheSeal::renew() const {
  const Sums sealed = read_seal(folder_);
  Sums sums;
  for (const fs::path& program : programs_in(folder_)) {
    const auto found = sums_of(folder_, program);
    if (!found) return;  // the old seal says nothing wrong
    sums.insert(found->begin(), found->end());
  }
  const fs::path draft = folder_ / (std::string(kSeal) + "-" + std::to_string(getpid()));
  std::ofstream file(draft);
  for (const auto& [name, sum] : sums) {
    const auto known = sealed.find(name);
    if (known == sealed.end() || known->second != sum) to_disk(folder_ / name);
    file << std::hex << sum << ' ' << name << '\n';
  }
  file.close();
  std::error_code ignored;
  if (!file) {
    fs::remove(draft, ignored);
    return;
  }
  to_disk(draft);
  fs::rename(draft, folder_ / kSeal, ignored);
  to_disk(folder_);
}

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

}  // namespace

int remove_leftovers(const fs::path& folder) {
  remove_all_named(folder, kDraft);
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
