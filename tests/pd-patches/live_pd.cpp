// SPDX-License-Identifier: MIT
#include "tests/pd-patches/live_pd.hpp"

#include <unistd.h>

#include <array>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace splash::pd {
namespace {

constexpr double kTimeout = 60.0;    ///< to come up on a busy machine [s]
constexpr double kRecording = 30.0;  ///< longest [s]

void pause(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

/// A port that is free now. Between this and pd's bind another program may take it; then pd does
/// not answer, and the test says so.
protocol::Endpoint free_endpoint() {
  return protocol::UdpSocket({INADDR_LOOPBACK, 0}).local();
}

}  // namespace

LivePd::LivePd()
    : socket_({INADDR_LOOPBACK, 0}),
      patch_(free_endpoint()),
      server_("splash-pd-" + std::to_string(getpid())) {
  start_jack();
  start_pd();
}

void LivePd::start_jack() {
  jackd_ = std::make_unique<tests::ChildProcess>(
      std::vector<std::string>{"jackd", "--no-realtime", "-n", server_, "-d", "dummy", "-C", "0",
                               "-P", std::to_string(kTiles36), "-r",
                               std::to_string(static_cast<int>(kRate)), "-p",
                               std::to_string(kPeriod)},
      tests::ChildProcess::Environment{{"JACK_NO_AUDIO_RESERVATION", "1"}});
  const double deadline = protocol::monotonic_now() + kTimeout;
  while (recorder_ == nullptr) {
    try {
      recorder_ = std::make_unique<JackRecorder>(server_, kTiles36, kRecording);
    } catch (const std::runtime_error& error) {
      if (jackd_->wait(0.2) || protocol::monotonic_now() > deadline) {
        throw std::runtime_error(std::string(error.what()) + ": " + jackd_->output());
      }
    }
  }
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
                               "-send",        "splash-gain 1"},
      tests::ChildProcess::Environment{{"JACK_NO_AUDIO_RESERVATION", "1"},
                                       {"JACK_DEFAULT_SERVER", server_}});
  const double deadline = protocol::monotonic_now() + kTimeout;
  while (!recorder_->connect("splash-pd:output_") || !status(0.2)) {
    if (pd_->wait(0.05) || protocol::monotonic_now() > deadline) {
      throw std::runtime_error("pd does not come up: " + pd_->output() + jackd_->output());
    }
  }
  pause(0.2);  // splash-gain has reached 1
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
