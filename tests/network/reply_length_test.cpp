// SPDX-License-Identifier: MIT
// Bytes that another host gets back from the real programs, against the bytes it sent: never more,
// for each command of the address table, short or filled up, alone or in a bundle.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>
#include <regex>

#include "protocol/address.hpp"
#include "protocol/control.hpp"
#include "protocol/limits.hpp"
#include "protocol/reply_budget.hpp"
#include "protocol/status.hpp"
#include "protocol/time_tag.hpp"
#include "tests/network/two_hosts.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/text_of.hpp"
#include "tests/support/waiting.hpp"

namespace splash::network {
namespace {

using protocol::Message;
using testing::HasSubstr;
using tests::eventually;

constexpr std::size_t kHeaders = 28;  // of IPv4 and UDP [bytes]
constexpr double kPrompt = 0.05;      // for one reply more than expected [s]
constexpr double kByFrame = 0.15;     // the same of the simulator, which replies between frames [s]
constexpr double kLong = 20.0;        // for those expected; a pass waits no longer than they take

/// A command with 1 where it is allowed; /notify 0, since the events of /notify 1 are no replies.
Message example(const protocol::AddressRow& row) {
  Message message{std::string(row.address), {}};
  for (const auto& argument : row.arguments) {
    const int value = row.address == "/notify" ? 0 : 1;
    if (argument.type == 't') {
      message.arguments.emplace_back(protocol::TimeTag{5});
    } else {
      message.arguments.emplace_back(value);
    }
  }
  return message;
}

/// As many as go into a datagram.
std::vector<std::byte> bundle_of(const Message& message) {
  const std::size_t room = (protocol::kMaxDatagram - 16) / (protocol::encoded_size(message) + 4);
  return protocol::encode(protocol::kImmediately,
                          std::vector<Message>(std::min(room, protocol::kMaxMessages), message));
}

constexpr double kPause = 0.12;  ///< ten questions a second at most [s]

struct Drawn {
  std::size_t bytes = 0;      ///< of all replies, without headers
  std::size_t datagrams = 0;  ///< replies
};

class Talk {
 public:
  Talk(protocol::UdpSocket socket, protocol::Endpoint to, double timeout = kPrompt)
      : socket_(std::move(socket)), to_(to), timeout_(timeout) {}

  /// `expected`: so many replies are waited for longer than for others.
  Drawn drawn_by(const std::vector<std::byte>& datagram, std::size_t expected = 0) {
    socket_.send_to(to_, datagram);
    return drawn(expected);
  }
  /// What else comes.
  Drawn drawn(std::size_t expected = 0) {
    Drawn drawn;
    std::array<std::byte, 2048> buffer{};
    while (const auto received = socket_.receive(buffer.data(), buffer.size(),
                                                 drawn.datagrams < expected ? kLong : timeout_)) {
      drawn.bytes += received->size;
      ++drawn.datagrams;
    }
    return drawn;
  }

 private:
  protocol::UdpSocket socket_;
  protocol::Endpoint to_;
  double timeout_;  // for one reply more than expected [s]
};

void expect_no_more(const char* what, std::string_view command, std::size_t sent, Drawn drawn) {
  EXPECT_LE(drawn.bytes, sent) << command << ' ' << what;
  EXPECT_LE(drawn.bytes + kHeaders * drawn.datagrams, sent + kHeaders) << command << ' ' << what;
  std::printf("  %-7s %4zu bytes drew %4zu in %zu\n", what, sent, drawn.bytes, drawn.datagrams);
}

/// Every command to a program, from its own host and from afar.
void try_commands(Talk& home, Talk& afar) {
  for (const auto& row : protocol::address_table()) {
    if (!protocol::is_command(row)) continue;
    const Message message = example(row);
    const auto bare = protocol::encode(message);
    // Its own host may end it, nobody else.
    const Drawn answer = row.address == "/quit" ? Drawn{24, 1} : home.drawn_by(bare, 1);
    std::printf("%s: its answer has %zu bytes\n", message.address.c_str(), answer.bytes);
    EXPECT_EQ(answer.datagrams, 1U) << row.address;
    // A refusal whose reason is cut short may fit where the answer does not.
    const std::size_t cut = protocol::encoded_size(protocol::fail(message.address, ""));
    const std::size_t expected = std::min(answer.bytes, cut) <= bare.size() ? 1 : 0;
    const Drawn short_one = afar.drawn_by(bare, expected);
    expect_no_more("bare", row.address, bare.size(), short_one);
    EXPECT_EQ(short_one.datagrams, expected) << row.address;
    const auto filled = protocol::encode(protocol::filled_up(message, answer.bytes));
    const Drawn exact = afar.drawn_by(filled, answer.datagrams);
    expect_no_more("filled", row.address, filled.size(), exact);
    EXPECT_EQ(exact.datagrams, answer.datagrams) << row.address;
    const auto bundle = bundle_of(message);
    expect_no_more("bundle", row.address, bundle.size(), afar.drawn_by(bundle));
  }
}

TEST_F(OnTwoHosts, NoReplyOfTheSynthIsLongerThanItsRequest) {
  auto synth = start_synth({"--listen", "0.0.0.0:57310", "--allow", "10.77.0.1"});
  Talk home(hosts_.socket_on(kSynthHost, "127.0.0.1:0"), {INADDR_LOOPBACK, 57310});
  Talk afar(hosts_.socket_on(kSimHost, "10.77.0.1:0"),
            protocol::parse_endpoint("10.77.0.2:57310", 0));
  afar.drawn_by(protocol::encode(Message{"/status", {}}));
  EXPECT_TRUE(
      synth->wait_for_text("asked /status in a datagram of 12 bytes; the reply has 116 bytes"));
  try_commands(home, afar);
}

TEST_F(OnTwoHosts, NoReplyOfTheSimulatorIsLongerThanItsRequest) {
  const tests::SmallScene scene(tests::tracked());
  auto simulator = start(kSimHost, "sim-server",
                         {"--scene", scene.path(), "--target", "10.77.0.2:57310", "--listen",
                          "0.0.0.0:57300", "--allow", "10.77.0.2"});
  ASSERT_TRUE(simulator->wait_for_text("running")) << simulator->output();
  Talk home(hosts_.socket_on(kSimHost, "127.0.0.1:0"), {INADDR_LOOPBACK, 57300}, kByFrame);
  Talk afar(hosts_.socket_on(kSynthHost, "10.77.0.2:0"),
            protocol::parse_endpoint("10.77.0.1:57300", 0), kByFrame);
  try_commands(home, afar);
  EXPECT_TRUE(
      simulator->wait_for_text("asked /status in a datagram of 12 bytes; the reply has 108 bytes"));
}

// The patch in the synth's place answers /status alone, to whoever asks.
TEST_F(OnTwoHosts, NoReplyOfThePdPatchIsLongerThanItsRequest) {
  const std::string patch = std::string(SPLASH_SOURCE_DIR) + "/pd-patches/splash-stereo.pd";
  tests::ChildProcess pd(
      hosts_.command_on(kSynthHost, {"pd", "-nogui", "-noprefs", "-stderr", "-noaudio", "-open",
                                     patch, "-send", "splash-host 0.0.0.0"}));
  Talk home(hosts_.socket_on(kSynthHost, "127.0.0.1:0"), {INADDR_LOOPBACK, 57310});
  Talk afar(hosts_.socket_on(kSimHost, "10.77.0.1:0"),
            protocol::parse_endpoint("10.77.0.2:57310", 0));
  const Message status{"/status", {}};
  const auto bare = protocol::encode(status);
  ASSERT_TRUE(eventually([&] { return home.drawn_by(bare).bytes == 116; }, 20.0, kPause))
      << pd.output();
  EXPECT_EQ(afar.drawn_by(bare).datagrams, 0U);
  EXPECT_EQ(afar.drawn_by(protocol::encode(protocol::filled_up(status, 112))).datagrams, 0U);
  EXPECT_EQ(afar.drawn_by(protocol::encode(protocol::filled_up(status, 116)), 1).bytes, 116U);
  const auto bundle = bundle_of(status);
  const std::size_t room = (bundle.size() + kHeaders) / (116 + kHeaders);
  const Drawn drawn = afar.drawn_by(bundle, room);
  expect_no_more("bundle", "/status", bundle.size(), drawn);
  EXPECT_EQ(drawn.datagrams, room);
  EXPECT_EQ(home.drawn_by(bare, 1).datagrams, 1U);
}

/// The lines of protocol/README.md that ask a synth on 192.168.0.20, for ours.
std::string example_of_the_readme() {
  const std::string text = tests::text_of(std::string(SPLASH_SOURCE_DIR) + "/protocol/README.md");
  const auto begin = text.find("exec 3<>/dev/udp/192.168.0.20");
  const auto end = text.find("```", begin);
  if (end == std::string::npos) return {};
  return std::regex_replace(text.substr(begin, end - begin), std::regex("192\\.168\\.0\\.20"),
                            "10.77.0.2");
}

TEST_F(OnTwoHosts, TheReadmesExampleIsAnswered) {
  auto synth = start_synth({"--listen", "0.0.0.0:57310", "--allow", "10.77.0.1"});
  const std::string example = example_of_the_readme();
  ASSERT_THAT(example, HasSubstr("10.77.0.2"));
  tests::ChildProcess bash(hosts_.command_on(kSimHost, {"bash", "-c", example}));
  bash.wait_for_end(20.0);
  EXPECT_THAT(bash.output(), HasSubstr("s   t   a   t   u   s   .   r   e   p")) << bash.output();
}

TEST_F(OnTwoHosts, TheGoodbyeIsPaidForWhenItIsAskedFor) {
  auto synth = start_synth({"--listen", "0.0.0.0:57310", "--allow", "10.77.0.1"});
  const auto there = protocol::parse_endpoint("10.77.0.2:57310", 0);
  Talk brief(hosts_.socket_on(kSimHost, "10.77.0.1:0"), there);
  Talk generous(hosts_.socket_on(kSimHost, "10.77.0.1:0"), there);
  const auto filled = protocol::encode(protocol::filled_up({"/notify", {1}}, 72));
  EXPECT_EQ(brief.drawn_by(protocol::encode(Message{"/notify", {1}})).datagrams, 0U);
  const Drawn done = generous.drawn_by(filled, 1);
  EXPECT_EQ(done.datagrams, 1U);
  EXPECT_EQ(synth->end(), 0);
  EXPECT_EQ(brief.drawn().datagrams, 0U);
  const Drawn goodbye = generous.drawn(1);
  EXPECT_EQ(goodbye.datagrams, 1U);
  EXPECT_LE(done.bytes + goodbye.bytes + 2 * kHeaders, filled.size() + kHeaders);
}

// Why a program's own host may be exempt: under its address nothing comes from outside, while any
// other address can be forged.
TEST_F(OnTwoHosts, NobodyOutsideCanForgeAProgramsOwnHost) {
  auto synth = start_synth({"--listen", "0.0.0.0:57310"});
  const auto there = protocol::parse_endpoint("10.77.0.2:57310", 0);
  auto asker = hosts_.socket_on(kSynthHost, "127.0.0.1:0");
  const auto refused = [&] {
    const auto status = answer_to({"/status", {}}, asker, "127.0.0.1:57310", 20.0);
    return protocol::to_synth_status(status).value_or(protocol::SynthStatus{}).refused;
  };
  const std::vector<std::byte> garbage(3);  // is refused, and counted
  // Without it the first forged datagram would ask for the other host's Ethernet address in the
  // name of 127.0.0.1, which is not answered, so that none would cross the cable.
  hosts_.socket_on(kSimHost, "10.77.0.1:0").send_to(there, garbage);
  ASSERT_TRUE(eventually([&] { return refused() == 1; }, 20.0, kPause))
      << "an honest datagram arrives";
  constexpr std::uint64_t kForged = 5;
  const auto before = hosts_.received_on(kSynthHost);
  for (std::uint64_t i = 0; i < kForged; ++i) {
    hosts_.send_forged(kSimHost, {INADDR_LOOPBACK, 9}, there, garbage);
  }
  EXPECT_TRUE(
      eventually([&] { return hosts_.received_on(kSynthHost) >= before + kForged; }, 20.0, kPause))
      << "they do cross the cable";
  EXPECT_EQ(refused(), 1U);
  for (std::uint64_t i = 0; i < kForged; ++i) {
    hosts_.send_forged(kSimHost, protocol::parse_endpoint("10.77.0.9:9", 0), there, garbage);
  }
  EXPECT_TRUE(eventually([&] { return refused() == 1 + kForged; }, 20.0, kPause))
      << "a forged address of the network does";
}

}  // namespace
}  // namespace splash::network
