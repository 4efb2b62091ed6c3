// SPDX-License-Identifier: MIT
// The two libraries of the programs, asked the same question as decode(): what does a packet say?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol/message.hpp"

namespace splash::protocol::test {

/// Reads with oscpack; nullopt when it throws. Only for packets the gate has accepted.
[[nodiscard]] std::optional<Packet> read_with_oscpack(Bytes packet);

/// Reads with liblo's server, which listens on no network: a UNIX socket in a temporary folder.
class LibloReader {
 public:
  LibloReader();
  ~LibloReader();
  LibloReader(const LibloReader&) = delete;
  LibloReader& operator=(const LibloReader&) = delete;
  /// nullopt when liblo refuses. Only for packets the gate has accepted.
  [[nodiscard]] std::optional<Packet> read(Bytes packet);

 private:
  std::string folder_;
  void* server_ = nullptr;
  Packet packet_;
};

/// The bytes liblo builds, as the simulator sends them.
[[nodiscard]] std::vector<std::byte> build_with_liblo(const Message& message);
[[nodiscard]] std::vector<std::byte> build_with_liblo(TimeTag time,
                                                      const std::vector<Message>& messages);

}  // namespace splash::protocol::test
