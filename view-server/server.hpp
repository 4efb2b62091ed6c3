// SPDX-License-Identifier: MIT
// The web server: page and WebSockets on one port, frames of both programs to every page, commands
// of the pages to the programs. One thread does it all.
#pragma once

#include <functional>
#include <memory>

#include "view-server/options.hpp"

namespace splash::view {

class Server {
 public:
  /// Takes the port. Throws program::Failure.
  explicit Server(const Options& options);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  [[nodiscard]] protocol::Endpoint local() const;
  /// Until SIGINT, SIGTERM or stop(). Calls `turn` several times a second: it has not hung.
  void run(const std::function<void()>& turn = {});
  /// From any thread.
  void stop();

 private:
  class Hub;
  std::unique_ptr<Hub> hub_;
};

}  // namespace splash::view
