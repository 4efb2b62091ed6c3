// SPDX-License-Identifier: MIT
#include "sim-server/device/last_words.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <string>

namespace splash::sim {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::array<int, 0> kCrashes = {};  // the sanitizer's report says more
#else
constexpr std::array kCrashes = {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV};
#endif

// Plain memory: a signal handler may touch nothing else.
std::array<char, 1024> words{};
std::size_t word_count = 0;
int code = 0;
std::atomic<bool> listening{false};

extern "C" void say_last_words() {
  if (!listening) return;
  // Nothing can be done about a refusal.
  static_cast<void>(!write(STDERR_FILENO, words.data(), word_count));
  std::_Exit(code);
}

extern "C" void take_crash(int /*number*/) {
  say_last_words();
}

void take_crashes() {
  for (const int number : kCrashes) static_cast<void>(std::signal(number, take_crash));
}

std::string sentence(const std::filesystem::path& cache) {
  std::error_code error;
  const auto space = std::filesystem::space(cache, error);
  const std::string free =
      error ? ""
            : " (" + std::to_string(space.available >> 20U) + " MiB were free there at the start)";
  return "sim-server: OpenCL ended the program, its own words are above. If the disk is full: free "
         "some MiB for compiled kernels in " +
         cache.string() + free +
         ", or set POCL_CACHE_DIR to another folder. If memory is short or limited (ulimit -v): "
         "give it more. Otherwise delete that folder, and if it happens again choose another "
         "device (--list-devices)\n";
}

}  // namespace

LastWords::LastWords(const std::filesystem::path& cache, int exit_code) {
  const std::string text = sentence(cache);
  word_count = std::min(text.size(), words.size());
  std::copy_n(text.begin(), word_count, words.begin());
  code = exit_code;
  listening = true;
  static const bool kRegistered = std::atexit(say_last_words) == 0;
  static_cast<void>(kRegistered);
  take_crashes();
}

LastWords::~LastWords() {
  built();
  listening = false;
}

// Not static functions: whoever has no last words has no crash to take or to give back.
// NOLINTNEXTLINE(readability-convert-member-functions-to-static)
void LastWords::devices_known() {
  take_crashes();
}

// NOLINTNEXTLINE(readability-convert-member-functions-to-static)
void LastWords::built() {
  for (const int number : kCrashes) static_cast<void>(std::signal(number, SIG_DFL));
}

}  // namespace splash::sim
