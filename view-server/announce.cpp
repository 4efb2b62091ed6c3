// SPDX-License-Identifier: MIT
#include "view-server/announce.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <string>

namespace splash::view {
namespace {

constexpr const char* kProgram = "avahi-publish";

/// Where it is on the path; empty: nowhere.
std::string found() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::string file = folder + '/' + kProgram;
    if (access(file.c_str(), X_OK) == 0) return file;
  }
  return {};
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "this host";
}

}  // namespace

Announcement::Announcement(const protocol::Endpoint& server) {
  std::string program = is_loopback(server) ? "" : found();
  if (program.empty()) return;
  std::string name = "splash on " + host_name();
  std::string service = "-s";
  std::string type = "_oscjson._tcp";
  std::string port = std::to_string(server.port);
  const std::array<char*, 6> arguments = {program.data(), service.data(), name.data(),
                                          type.data(),    port.data(),    nullptr};
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ != 0) return;
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(0);
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int descriptor : {0, 1, 2}) dup2(nowhere, descriptor);
  execv(program.c_str(), arguments.data());
  _exit(127);
}

Announcement::~Announcement() {
  if (process_ <= 0) return;
  kill(process_, SIGTERM);
  waitpid(process_, nullptr, 0);
}

}  // namespace splash::view
