// SPDX-License-Identifier: MIT
// Tells systemd how the program is, in the datagrams of sd_notify(3): starting, ready, alive,
// stopping. They are a line of text each, so no library is needed to say them.
#pragma once

#include <string>
#include <vector>

namespace splash::program {

class ServiceNotice {
 public:
  /// Speaks to $NOTIFY_SOCKET, at the pace of $WATCHDOG_USEC; without them every call does nothing.
  /// Takes them out of the environment: they are not meant for programs started by this one.
  /// To be made before any other thread.
  ServiceNotice();
  ~ServiceNotice();
  ServiceNotice(const ServiceNotice&) = delete;
  ServiceNotice& operator=(const ServiceNotice&) = delete;

  /// Not ready yet, and it is no hang: whoever waits is to go on waiting for at least `seconds`
  /// from now, however soon he would have given up. Nothing of a start may take longer between two
  /// calls.
  void starting(double seconds);
  /// The program does its work from now on; `status` is what systemctl shows.
  void ready(const std::string& status);
  /// Whether the next sign of life is due: four in the watchdog's period. To be asked by the loop
  /// whose hang is to be seen, as often as it turns.
  [[nodiscard]] bool is_due() const;
  /// The work goes on.
  void alive();
  /// The program ends because it was asked to.
  void stopping();
  /// The process begins anew (start_anew.hpp), which may take as long as a start: the watchdog
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
  double period_ = 0.0;  ///< between two signs of life [s]; 0: nobody watches
  double next_ = 0.0;    ///< [s, monotonic]
};

}  // namespace splash::program
