// SPDX-License-Identifier: MIT
#include "synth-server/figure/gnuplot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

namespace splash::synth {
namespace {

std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Starts the program with both outputs going to `log`; throws GnuplotError when there is none.
pid_t start(const char* program, const std::filesystem::path& script,
            const std::filesystem::path& log) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  std::string name = program;
  std::string argument = script.string();
  std::array<char*, 3> arguments = {name.data(), argument.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, program, &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) {
    throw GnuplotError(name +
                       " is not installed: it draws the picture (apt-get install gnuplot-nox)");
  }
  if (error != 0) {
    throw GnuplotError(name + " could not be started: " + std::generic_category().message(error));
  }
  return child;
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return status;
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c != '\n') result += c;
  }
  return result + '"';
}

void write_floats(const std::filesystem::path& file, const std::vector<float>& numbers) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(numbers.data()),
            static_cast<std::streamsize>(numbers.size() * sizeof(float)));
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

void run_gnuplot(const std::filesystem::path& script, const char* program) {
  const std::filesystem::path log = std::filesystem::path(script).replace_extension("log");
  const int status = wait_for(start(program, script, log));
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw GnuplotError(std::string(program) + " failed on " + script.string() + ": " +
                       read_text(log));
  }
}

ScratchFolder::ScratchFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "splash-figure-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw std::system_error(errno, std::generic_category(), pattern);
  }
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;  // nothing to be done about it here
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace splash::synth
