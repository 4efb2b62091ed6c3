// SPDX-License-Identifier: MIT
// view-server: from the command line to an exit code.
#include <cstdio>

#include "program/failure.hpp"
#include "program/service_notice.hpp"
#include "view-server/announce.hpp"
#include "view-server/server.hpp"

namespace {

using namespace splash;

void run(const view::Options& options) {
  program::ServiceNotice service;
  view::Server server(options);
  const std::string place = protocol::to_string(server.local());
  std::printf("listening: %s\nopen http://%s/\n", place.c_str(), place.c_str());
  const view::Announcement announcement(server.local());
  if (announcement.is_made()) std::printf("announced as _oscjson._tcp\n");
  std::fflush(stdout);
  service.ready("http://" + place + "/");
  server.run([&service] {
    if (service.is_due()) service.alive();
  });
  service.stopping();
}

}  // namespace

int main(int argc, char** argv) {
  const auto [options, exit_code] = view::parse_options(argc, argv);
  if (!options) return exit_code;
  return program::exit_code_of("view-server", [&chosen = *options] { run(chosen); });
}
