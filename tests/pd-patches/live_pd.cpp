// SPDX-License-Identifier: MIT
#include "tests/pd-patches/live_pd.hpp"

#include <array>
#include <stdexcept>

#include "tests/support/waiting.hpp"

namespace splash::pd {
namespace {

constexpr double kTimeout = 60.0;    ///< to come up on a busy machine [s]
constexpr double kRecording = 30.0;  ///< longest [s]

/// A port that is free now. Between this and pd's bind another program may take it; then pd does
/// not answer, and the test says so.
protocol::Endpoint free_endpoint() {
  return protocol::UdpSocket({INADDR_LOOPBACK, 0}).local();
}

}  // namespace

LivePd::LivePd()
    : jack_("pd", {.channels = kTiles36,
                   .period = kPeriod,
                   .rate = static_cast<int>(kRate),
                   .waits = false}),
      recorder_(kTiles36, kRecording),
      socket_({INADDR_LOOPBACK, 0}),
      patch_(free_endpoint()) {
  start_pd();
}

void LivePd::start_pd() {
  const std::string patch = std::string(SPLASH_SOURCE_DIR) + "/pd-patches/splash-tiles.pd";
  pd_ = std::make_unique<tests::ChildProcess>(
      std::vector<std::string>{"pd",           "-nogui",
                               "-noprefs",     "-stderr",
                               "-jack",        "-jackname",
                               "splash-pd",    "-nojackconnect",
                               "-inchannels",  "0",
                               "-outchannels", std::to_string(kTiles36),
                               "-r",           std::to_string(static_cast<int>(kRate)),
                               "-audiobuf",    "10",
                               "-open",        patch,
                               "-send",        "splash-port " + std::to_string(patch_.port),
                               "-send",        "splash-gain 1"});
  const double deadline = protocol::monotonic_now() + kTimeout;
  while (!recorder_.connect("splash-pd:output_", 1) || !status(0.2)) {
    if (pd_->wait(0.05) || protocol::monotonic_now() > deadline) {
      throw std::runtime_error("pd does not come up: " + pd_->output() + jack_.output());
    }
  }
  tests::sleep(0.2);  // splash-gain has reached 1
}

void LivePd::send(const std::vector<std::byte>& packet) {
  if (!socket_.send_to(patch_, packet)) throw std::runtime_error("the network refuses a packet");
}

std::optional<protocol::Message> LivePd::ask(const protocol::Message& question,
                                             const std::string& answer, double seconds) {
  send(protocol::encode(question));
  std::array<std::byte, 2048> buffer{};
  const double deadline = protocol::monotonic_now() + seconds;
  while (protocol::monotonic_now() < deadline) {
    const auto received = socket_.receive(buffer.data(), buffer.size(), 0.05);
    if (!received) continue;
    const auto decoded = protocol::decode(protocol::Bytes(buffer).first(received->size));
    if (decoded.packet.messages.size() != 1) continue;
    if (decoded.packet.messages[0].address == answer) return decoded.packet.messages[0];
  }
  return std::nullopt;
}

std::optional<protocol::SynthStatus> LivePd::status(double seconds) {
  const auto answer = ask({"/status", {}}, "/status.reply", seconds);
  return answer ? protocol::to_synth_status(*answer) : std::nullopt;
}

}  // namespace splash::pd
