// SPDX-License-Identifier: MIT
// The real pd with splash-tiles.pd, on a JACK server of its own that has no device behind it.
#pragma once

#include <memory>
#include <optional>

#include "protocol/message.hpp"
#include "protocol/status.hpp"
#include "protocol/udp_socket.hpp"
#include "tests/pd-patches/rendering.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/jack.hpp"

namespace splash::pd {

inline constexpr int kPeriod = 256;  ///< of the JACK server [samples]
inline constexpr int kTiles36 = 36;

class LivePd {
 public:
  /// Starts both and waits until pd answers /status. Throws std::runtime_error with what they
  /// printed when one does not come up within a minute.
  LivePd();

  /// Sends a packet to the patch.
  void send(const std::vector<std::byte>& packet);
  /// Asks the patch and waits for an answer of this address; nothing when it stays silent for
  /// `seconds`.
  [[nodiscard]] std::optional<protocol::Message> ask(const protocol::Message& question,
                                                     const std::string& answer, double seconds);
  /// The same of /status.
  [[nodiscard]] std::optional<protocol::SynthStatus> status(double seconds);
  [[nodiscard]] tests::JackCapture& recorder() { return recorder_; }
  [[nodiscard]] std::string output() const { return pd_->output(); }

 private:
  void start_pd();

  tests::JackServer jack_;
  tests::JackCapture recorder_;
  protocol::UdpSocket socket_;
  protocol::Endpoint patch_;
  std::unique_ptr<tests::ChildProcess> pd_;
};

}  // namespace splash::pd
