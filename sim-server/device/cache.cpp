// SPDX-License-Identifier: MIT
#include "sim-server/device/cache.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

#include "program/failure.hpp"
#include "sim-server/device/cache_seal.hpp"

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

}  // namespace splash::sim
