// SPDX-License-Identifier: MIT
// Reports the program's state to systemd in the datagrams of sd_notify(3): starting, ready, alive,
// stopping. Each is a line of text, so no library is needed.
#pragma once

#include <string>
#include <vector>

namespace splash::program {

class ServiceNotice {
 public:
  /// Reports to $NOTIFY_SOCKET, at the rate of $WATCHDOG_USEC; without them every call does
  /// nothing. Removes them from the environment, since they are not meant for programs that this
  /// one starts. Must be constructed before any other thread starts.
  ServiceNotice();
  ~ServiceNotice();
  ServiceNotice(const ServiceNotice&) = delete;
  ServiceNotice& operator=(const ServiceNotice&) = delete;

  /// Extends the start's timeout: the program is not ready yet but works on it. systemd waits for
  /// at least `seconds` more; the next call must come within them.
  void starting(double seconds);
  /// Reports that the program is ready; systemctl shows `status`.
  void ready(const std::string& status);
  /// Returns whether a quarter of the watchdog's period has passed since the last alive(). The loop
  /// that the watchdog guards asks this in each iteration.
  [[nodiscard]] bool is_due() const;
  /// Resets the watchdog.
  void alive();
  /// Reports that the program shuts down on request.
  void stopping();
  /// The process begins anew (this_program.hpp), which may take as long as a start: the watchdog
  /// waits so long, and what the constructor took is in the environment again.
  void beginning_anew();

 private:
  void send(const std::string& text) const;

  /// As the environment had it.
  struct Variable {
    const char* name;
    std::string value;
  };
  std::vector<Variable> taken_;
  std::string address_;  ///< of the socket; a leading 0 byte: in the abstract namespace
  int socket_ = -1;
  double period_ = 0.0;  ///< between two resets of the watchdog [s]; 0: there is no watchdog
  double next_ = 0.0;    ///< [s, monotonic]
};

}  // namespace splash::program
