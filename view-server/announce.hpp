// SPDX-License-Identifier: MIT
// Tells the local network where OSCQuery is (DNS-SD, _oscjson._tcp), by avahi-publish, where there
// is one. It ends with this program, however that ends.
#pragma once

#include <sys/types.h>

#include "protocol/udp_socket.hpp"

namespace splash::view {

class Announcement {
 public:
  /// Nothing is announced of a server that only its own host can reach.
  explicit Announcement(const protocol::Endpoint& server);
  ~Announcement();
  Announcement(const Announcement&) = delete;
  Announcement& operator=(const Announcement&) = delete;

  [[nodiscard]] bool is_made() const noexcept { return process_ > 0; }

 private:
  pid_t process_ = -1;
};

}  // namespace splash::view
