// SPDX-License-Identifier: MIT
// The service manager's end of sd_notify(3): what a program tells systemd, heard by a test.
#pragma once

#include <string>
#include <vector>

namespace splash::tests {

class NotifySocket {
 public:
  /// Below the temporary folder, or `abstract`: without a file.
  explicit NotifySocket(bool abstract = false);
  ~NotifySocket();
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  /// For $NOTIFY_SOCKET.
  [[nodiscard]] const std::string& address() const noexcept { return address_; }
  /// The next notice that begins with `start`; others are passed over. Empty when none comes within
  /// `seconds`.
  std::string wait_for(const std::string& start, double seconds);
  /// All that came meanwhile is forgotten; how many notices that was.
  int clear();

 private:
  std::string receive(double seconds);

  std::string address_;
  int socket_ = -1;
};

}  // namespace splash::tests
