// SPDX-License-Identifier: MIT
// The two libraries of the programs, asked the same question as decode(): what does a packet say?
#pragma once

#include <optional>

#include "protocol/message.hpp"
#include "tests/support/temporary_folder.hpp"

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
  tests::TemporaryFolder folder_;
  void* server_ = nullptr;
  Packet packet_;
};

}  // namespace splash::protocol::test
