// SPDX-License-Identifier: MIT
// Announces OSCQuery to the local network (DNS-SD, _oscjson._tcp) with avahi-publish, if that is
// installed. avahi-publish ends with this program, even when this program is killed.
#pragma once

#include <sys/types.h>

#include "protocol/udp_socket.hpp"

namespace splash::view {

class Announcement {
 public:
  /// Announces `server`, unless it is bound to loopback.
  explicit Announcement(const protocol::Endpoint& server);
  ~Announcement();
  Announcement(const Announcement&) = delete;
  Announcement& operator=(const Announcement&) = delete;

  [[nodiscard]] bool is_made() const noexcept { return process_ > 0; }

 private:
  pid_t process_ = -1;
};

}  // namespace splash::view
