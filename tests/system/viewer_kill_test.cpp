// SPDX-License-Identifier: MIT
// view-server killed again and again while a page listens: the synth's output does not notice.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <string>

#include "protocol/time_tag.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/recording.hpp"
#include "tests/support/waiting.hpp"

namespace splash::tests {
namespace {

/// A page that is open, and gets what its server sends.
class OpenPage {
 public:
  explicit OpenPage(const protocol::Endpoint& server) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(server.address);
    address.sin_port = htons(server.port);
    EXPECT_EQ(connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    const std::string host = protocol::to_string(server);
    const std::string hello = "GET /view HTTP/1.1\r\nHost: " + host + "\r\nOrigin: http://" + host +
                              "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                              "Sec-WebSocket-Version: 13\r\n"
                              "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
    EXPECT_EQ(send(socket_, hello.data(), hello.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(hello.size()));
  }
  ~OpenPage() { close(socket_); }
  OpenPage(const OpenPage&) = delete;
  OpenPage& operator=(const OpenPage&) = delete;

  /// Whether this comes within ten seconds.
  bool hears(const std::string& text) {
    pollfd readable{socket_, POLLIN, 0};
    while (heard_.find(text) == std::string::npos) {
      std::array<char, 65536> bytes{};
      if (poll(&readable, 1, 10'000) <= 0) return false;
      const ssize_t count = recv(socket_, bytes.data(), bytes.size(), 0);
      if (count <= 0) return false;
      heard_.append(bytes.data(), static_cast<std::size_t>(count));
    }
    heard_.clear();
    return true;
  }

 private:
  int socket_;
  std::string heard_;
};

protocol::Message cavity(int id) {
  protocol::Cavity event;
  event.id = id;
  event.radius = 0.03F;
  event.epsilon = 0.1F;
  return protocol::to_message(event);
}

// What the synth says that it started gives the same samples where nobody has ever looked.
TEST(ViewServerKilled, ChangesNoSampleOfTheSynth) {
  const std::string wav = temporary_path("watched.wav");
  const std::string log = temporary_path("watched.osc");
  const std::string again = temporary_path("unwatched.wav");
  {
    Synth synth({"--rig", rig_path("stereo.yaml"), "--device", "null", "--show", "127.0.0.1:0",
                 "--record-audio", wav, "--record-events", log});
    const std::string said = synth.process().output();
    const auto begin = said.find("viewers: ") + 9;
    const std::string show = said.substr(begin, said.find('\n', begin) - begin);
    for (int round = 0; round < 8; ++round) {
      Daemon view("view-server", {"--synth", protocol::to_string(synth.endpoint()), "--synth-show",
                                  show, "--sim", "127.0.0.1:9", "--sim-show", "127.0.0.1:9"});
      OpenPage page(view.endpoint());
      EXPECT_TRUE(page.hears("SPA1")) << "sound of round " << round;
      for (int i = 0; i < 3; ++i) {
        synth.send(protocol::encode(protocol::to_time_tag(protocol::unix_now() + 0.05),
                                    {cavity(3 * round + i)}));
        sleep(0.07);
      }
      view.process().signal(SIGKILL);
      view.process().wait_for_end();
      sleep(0.2);
    }
    synth.process().signal(SIGTERM);
    ASSERT_EQ(synth.process().wait_for_end(), 0) << synth.process().output();
  }
  const auto [code, text] = run_program(
      "synth-server",
      {"--rig", rig_path("stereo.yaml"), "--replay", log, "--render", again, "--fade-in", "2"});
  ASSERT_EQ(code, 0) << text;
  const Recording watched = read_recording(wav);
  const Recording unwatched = read_recording(again);
  for (const std::string& file : {wav, log, again}) std::filesystem::remove(file);
  constexpr std::size_t kFade = 2400;  // both end with one
  const std::size_t common =
      std::min(watched.channels[0].size(), unwatched.channels[0].size()) - kFade;
  constexpr std::size_t kOpening = 100'000;  // its steps are rounded on another way
  float peak = 0.0F;
  for (const std::size_t channel : {0U, 1U}) {
    for (std::size_t i = 0; i < common; ++i) {
      const float sample = watched.channels[channel][i];
      peak = std::max(peak, std::abs(sample));
      const float error = std::abs(sample - unwatched.channels[channel][i]);
      ASSERT_LE(error, i < kOpening ? 1e-6F : 0.0F) << "sample " << i;
    }
  }
  EXPECT_GT(common, 3 * kOpening / 2);
  EXPECT_GT(peak, 0.01F);
}

}  // namespace
}  // namespace splash::tests
