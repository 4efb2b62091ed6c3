// SPDX-License-Identifier: MIT
#include "sim-server/start/device_trials.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>
#include <sstream>
#include <utility>

#include "sim-server/fluid/params/parts.hpp"

namespace splash::sim {
namespace {

/// What the test's outcome depends on, as one line.
std::string key_of(const DeviceFacts& device) {
  std::string kernels;
  for (const KernelSource& source : kernels::fluid()) kernels += source.text;
  std::ostringstream key;
  key << std::hash<std::string>()(kernels) << ' ' << device.platform << " | " << device.name
      << " | " << device.driver;
  return key.str();
}

/// A line is "SECONDS KEY".
std::optional<double> seconds_in(const std::filesystem::path& file, const std::string& key) {
  std::ifstream lines(file);
  std::optional<double> found;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t space = line.find(' ');
    if (space == std::string::npos || line.substr(space + 1) != key) continue;
    const double seconds = std::strtod(line.c_str(), nullptr);
    if (seconds > 0.0) found = seconds;
  }
  return found;
}

/// The test's process, and the end of a pipe that its words come from.
struct Process {
  pid_t id = -1;
  int words = -1;
};

/// An id of -1: it could not be started.
Process start(const std::filesystem::path& program, int device) {
  std::array<int, 2> ends = {};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return {};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  std::string name = program.string();
  std::string option = "--check-device";
  std::string number = std::to_string(device);
  const std::array<char*, 4> arguments = {name.data(), option.data(), number.data(), nullptr};
  Process process = {-1, ends[0]};
  const int error =
      posix_spawn(&process.id, name.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (error == 0) return process;
  close(ends[0]);
  return {};
}

struct Ended {
  std::string output;
  int status = -1;
  bool built = false;  ///< the kernels were there
  bool hung = false;
};

/// Whether more was said before `last`; nothing more comes once it was not.
bool hear(const Process& process, std::chrono::steady_clock::time_point last, Ended& ended) {
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
      last - std::chrono::steady_clock::now());
  pollfd readable = {process.words, POLLIN, 0};
  if (left.count() <= 0 || poll(&readable, 1, static_cast<int>(left.count())) == 0) {
    ended.hung = true;
    return false;
  }
  std::array<char, 4096> part = {};
  const ssize_t size = read(process.words, part.data(), part.size());
  if (size <= 0) return false;
  ended.output.append(part.data(), static_cast<std::size_t>(size));
  return true;
}

Ended run(const std::filesystem::path& program, int device, const TrialLimits& limits) {
  const Process process = start(program, device);
  Ended ended;
  if (process.id < 0) return ended;
  auto last = std::chrono::steady_clock::now() + limits.build;
  while (hear(process, last, ended)) {
    if (ended.built) continue;
    ended.built = ended.output.find("built\n") != std::string::npos;
    last = std::chrono::steady_clock::now() + (ended.built ? limits.steps : limits.build);
  }
  if (ended.hung) kill(process.id, SIGKILL);
  close(process.words);
  waitpid(process.id, &ended.status, 0);
  return ended;
}

/// The last line that says anything.
std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

/// What the program ended with, of several lines the first; else the last thing that it said.
std::string complaint(const std::string& output) {
  const std::string name = "sim-server: ";
  const std::size_t begin = output.rfind(name);
  if (begin == std::string::npos) return last_line(output);
  const std::size_t text = begin + name.size();
  return output.substr(text, output.find('\n', text) - text);
}

Trial judge(const Ended& ended, const TrialLimits& limits) {
  if (ended.hung) {
    const auto waited =
        std::chrono::duration_cast<std::chrono::seconds>(ended.built ? limits.steps : limits.build);
    return {0.0, std::string("it hangs: ") + (ended.built ? "a small test" : "building a kernel") +
                     " did not end in " + std::to_string(waited.count()) + " s"};
  }
  if (WIFSIGNALED(ended.status)) {
    return {0.0, "its driver crashed (signal " + std::to_string(WTERMSIG(ended.status)) + ")"};
  }
  const std::string said = last_line(ended.output);
  const std::string sound = "sound ";
  if (ended.status == 0 && said.starts_with(sound)) {
    return {std::strtod(said.c_str() + sound.size(), nullptr), {}};
  }
  const std::string why = complaint(ended.output);
  return {0.0, why.empty() ? "its test could not be run" : why};
}

}  // namespace

DeviceTrials::DeviceTrials(const std::filesystem::path& cache, std::filesystem::path program,
                           const TrialLimits& limits)
    : remembered_(cache / "splash-devices"), program_(std::move(program)), wait_(limits) {}

Trial DeviceTrials::operator()(const DeviceFacts& device) const {
  const std::string key = key_of(device);
  if (const auto seconds = seconds_in(remembered_, key)) return {*seconds, {}};
  Trial trial = judge(run(program_, device.index, wait_), wait_);
  // A folder that refuses the line is no error: the next start tests again.
  if (trial.failure.empty())
    std::ofstream(remembered_, std::ios::app) << trial.step << ' ' << key << '\n';
  return trial;
}

}  // namespace splash::sim
