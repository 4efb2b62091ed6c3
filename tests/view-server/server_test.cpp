// SPDX-License-Identifier: MIT
// The web server at the hands of a browser that the test plays, byte by byte.
#include "view-server/server.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "protocol/control.hpp"
#include "protocol/frame_stream.hpp"
#include "protocol/limits.hpp"
#include "protocol/message.hpp"
#include "tests/support/browser.hpp"
#include "tests/support/waiting.hpp"
#include "view-server/holds.hpp"

namespace splash::view {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using tests::Browser;
using tests::eventually;
using tests::upgrade;

/// A whole message of a client, its mask zero.
std::string message(char opcode, const std::string& text) {
  std::string frame = {static_cast<char>(0x80 | opcode)};
  if (text.size() < 126) {
    frame += static_cast<char>(0x80 | text.size());
  } else {
    frame += static_cast<char>(0xfe);
    frame += static_cast<char>(text.size() >> 8U);
    frame += static_cast<char>(text.size() & 255U);
  }
  return frame + std::string(4, '\0') + text;
}

std::string osc(const protocol::Message& said) {
  const auto bytes = protocol::encode(said);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

protocol::ViewFrame frame_of(std::string_view kind, std::string_view text) {
  protocol::FrameWriter writer(kind, 0.0);
  writer.text(text);
  return std::move(writer).take();
}

class ViewServer : public testing::Test {
 protected:
  ViewServer()
      : water_({}, frame_of(protocol::kSceneFrame,
                            R"({"scene": "the scene", "bodies": [{}, {}, {"name": "duck"}]})")),
        sound_({.listen = {}, .allowed = {}, .most_asked = 16},
               frame_of(protocol::kRigFrame, "the rig")),
        sim_(protocol::Endpoint{}),
        synth_(protocol::Endpoint{}),
        server_({.listen = {},
                 .sim = sim_.local(),
                 .synth = synth_.local(),
                 .sim_show = water_.local(),
                 .synth_show = sound_.local(),
                 .origins = {}}),
        thread_([this] { server_.run(); }) {}
  ~ViewServer() override {
    server_.stop();
    thread_.join();
  }

  [[nodiscard]] std::string host() const { return protocol::to_string(server_.local()); }
  [[nodiscard]] std::unique_ptr<Browser> open() const {
    auto browser = std::make_unique<Browser>(server_.local());
    browser->say(upgrade(host(), "http://" + host()));
    EXPECT_THAT(browser->hear("the scene"), HasSubstr("101 Switching"));
    return browser;
  }
  /// Whether a program gets this message within five seconds.
  static bool gets(protocol::UdpSocket& program, const std::string& address) {
    std::array<std::byte, protocol::kMaxDatagram> buffer;
    for (int i = 0; i < 100; ++i) {
      const auto got = program.receive(buffer.data(), buffer.size(), 5.0);
      if (!got) return false;
      const auto read = protocol::decode({buffer.data(), got->size});
      if (!read.packet.messages.empty() && read.packet.messages[0].address == address) return true;
    }
    return false;
  }

  /// The next body that the simulator is told to take or let go; -1: it is told a pose first, or
  /// nothing.
  int next_grab() {
    std::array<std::byte, protocol::kMaxDatagram> buffer;
    for (int i = 0; i < 100; ++i) {
      const auto got = sim_.receive(buffer.data(), buffer.size(), 5.0);
      if (!got) return -1;
      const auto said = protocol::decode({buffer.data(), got->size}).packet.messages.at(0);
      if (said.address == "/body/pose") return -1;
      if (said.address == "/body/grab") return std::get<std::int32_t>(said.arguments[0]);
    }
    return -1;
  }

  protocol::FrameStream water_;
  protocol::FrameStream sound_;
  protocol::UdpSocket sim_;
  protocol::UdpSocket synth_;
  Server server_;
  std::thread thread_;
};

TEST_F(ViewServer, ServesItsPageAndRefusesForeigners) {
  const auto ask = [&](const std::string& path, const std::string& host_name) {
    Browser browser(server_.local());
    browser.say("GET " + path + " HTTP/1.1\r\nHost: " + host_name + "\r\n\r\n");
    return browser.hear("\r\n\r\n");
  };
  const std::string page = ask("/", host());
  EXPECT_THAT(page, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(page, HasSubstr("Content-Security-Policy: default-src 'none'; script-src 'self'; "));
  EXPECT_THAT(ask("/../main.cpp", host()), StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(ask("/", "evil.example"), StartsWith("HTTP/1.1 403"));
  Browser foreign(server_.local());
  foreign.say(upgrade(host(), "http://evil.example"));
  EXPECT_THAT(foreign.hear("\r\n\r\n"), StartsWith("HTTP/1.1 403"));
}

TEST_F(ViewServer, PassesFramesOnWhenThePageAsks) {
  const auto page = open();
  EXPECT_FALSE(water_.wanted()) << "the page has not asked";
  page->say(message(2, ""));
  ASSERT_TRUE(eventually([&] { return water_.wanted(); }));
  water_.offer(frame_of(protocol::kStateFrame, "first state."));
  EXPECT_THAT(page->hear("first state."), HasSubstr("SPS1"));
  usleep(50'000);
  EXPECT_FALSE(water_.wanted()) << "nothing is fetched for a page that does not draw";
}

TEST_F(ViewServer, APageThatDoesNotReadHasOneStateWaiting) {
  const auto page = open();
  for (int i = 0; i < 50; ++i) page->say(message(2, ""));
  const std::string large(1 << 20, 's');
  int fetched = 0;
  for (int turns = 0; turns < 200 && fetched < 50; ++turns) {
    if (water_.wanted()) {
      water_.offer(frame_of(protocol::kStateFrame, large));
      ++fetched;
      turns = 0;
    }
    page->say(message(2, ""));
    usleep(5000);
  }
  EXPECT_GE(fetched, 1);
  EXPECT_LT(fetched, 10) << "what fits into the kernel's buffers, and one more";
  // It reads on: it gets a new one.
  for (int i = 0; i < 1000 && !water_.wanted(); ++i) page->hear("never", 200);
  EXPECT_TRUE(water_.wanted());
}

// Else it would wait for ever, for it asks again when it has got one.
TEST_F(ViewServer, AStateReachesAPageForWhomMuchElseWaits) {
  const auto page = open();
  const std::string large(1 << 16, 's');
  for (int turns = 0, sent = 0; turns < 1000 && sent < 100; ++turns) {
    if (sound_.wanted()) {
      sound_.offer(frame_of(protocol::kSoundFrame, large));
      ++sent;
    }
    usleep(2000);
  }
  page->say(message(2, ""));
  ASSERT_TRUE(eventually([&] { return water_.wanted(); }));
  water_.offer(frame_of(protocol::kStateFrame, "this state."));
  usleep(100'000);
  EXPECT_NE(page->hear("this state.").find("SPS1"), std::string::npos);
}

TEST_F(ViewServer, CommandsReachTheProgramsAndWhatWasGrabbedIsLetGo) {
  {
    const auto page = open();
    page->say(message(2, osc({"/mute", {1}})));
    EXPECT_TRUE(gets(synth_, "/mute"));
    page->say(message(2, osc({"/body/grab", {2, 1}})));
    EXPECT_TRUE(gets(sim_, "/body/grab"));
    page->say(message(2, osc({"/quit", {}})));
    EXPECT_THAT(page->hear("a page may not say this"), HasSubstr("/quit"));
  }
  EXPECT_TRUE(gets(sim_, "/body/grab")) << "the page has gone";
}

// To the simulator both are one sender.
TEST_F(ViewServer, ABodyIsHeldByOneVisitorAtATime) {
  const auto pose = [](float x) {
    return osc(
        protocol::to_message(protocol::BodyPose{2, {x, 0.0F, 0.4F}, 0.0F, 0.0F, 0.0F, 1.0F}));
  };
  auto first = open();
  const auto second = open();
  first->say(message(2, osc({"/body/grab", {2, 1}})));
  EXPECT_THAT(second->hear("[2]"), HasSubstr(R"("held":[2])"));
  first->say(message(2, pose(0.1F)));
  EXPECT_TRUE(gets(sim_, "/body/pose"));
  second->say(message(2, osc({"/body/grab", {2, 1}})));
  EXPECT_THAT(second->hear("another visitor"), HasSubstr("another visitor holds body 2"));
  second->say(message(2, pose(0.2F)));
  second->say(message(2, osc({"/body/grab", {2, 0}})));
  second->say(message(2, osc({"/body/grab", {3, 1}})));
  EXPECT_EQ(next_grab(), 3) << "the body that is held elsewhere hears nothing of the second one";
  first.reset();
  EXPECT_EQ(next_grab(), 2) << "let go by the server, since its visitor is gone";
  EXPECT_THAT(second->hear("[]"), HasSubstr(R"("held":[])"));
  second->say(message(2, osc({"/body/grab", {2, 1}})));
  EXPECT_EQ(next_grab(), 2);
}

// Names are looked up in the scene's frame. Holding one body does not block the other bodies.
TEST_F(ViewServer, ABodyIsHeldByOneVisitorWhetherItsPosesGiveItsNumberOrItsName) {
  const auto pose = [](const std::string& name) {
    return osc({"/body/pose", {name, 0.1F, 0.0F, 0.4F, 0.0F, 0.0F, 0.0F, 1.0F}});
  };
  const auto first = open();
  const auto second = open();
  first->say(message(2, osc({"/body/grab", {2, 1}})));
  EXPECT_THAT(second->hear("[2]"), HasSubstr(R"("held":[2])"));
  second->say(message(2, pose("duck")));
  second->say(message(2, osc({"/body/grab", {3, 1}})));
  EXPECT_EQ(next_grab(), 2);
  EXPECT_EQ(next_grab(), 3) << "a pose of the body that is held elsewhere came before";
  second->say(message(2, pose("hand")));
  EXPECT_TRUE(gets(sim_, "/body/pose"));
  first->say(message(2, pose("duck")));
  EXPECT_TRUE(gets(sim_, "/body/pose"));
}

TEST(Holds, ASilentVisitorLosesItsBodyToTheNextWhoTakesIt) {
  const int one = 0;
  const int other = 0;
  Holds holds;
  EXPECT_TRUE(holds.take(0, &one, 0.0));
  EXPECT_TRUE(holds.moves(0, &one, 1.0));
  EXPECT_FALSE(holds.take(0, &other, 1.4));
  EXPECT_TRUE(holds.take(0, &other, 1.6));
  EXPECT_FALSE(holds.moves(0, &one, 1.7));
  EXPECT_FALSE(holds.let_go(0, &one));
  EXPECT_THAT(holds.of_others(&one), testing::ElementsAre(0));
  EXPECT_THAT(holds.of_others(&other), testing::IsEmpty());
}

/// The JSON that comes for a path.
std::string asked(const protocol::Endpoint& server, const std::string& path) {
  Browser browser(server);
  browser.say("GET " + path + " HTTP/1.1\r\nHost: " + protocol::to_string(server) +
              "\r\nAccept: */*\r\n\r\n");
  return browser.hear("}\n");  // never: to the end
}

TEST_F(ViewServer, TellsItsTreeWithoutFetchingAFrame) {
  EXPECT_THAT(asked(server_.local(), "/?HOST_INFO"), HasSubstr("\"OSC_PORT\":"));
  EXPECT_THAT(asked(server_.local(), "/synth/status/voices"),
              HasSubstr("\"FULL_PATH\":\"/synth/status/voices\""));
  EXPECT_THAT(asked(server_.local(), "/synth/nothing"), StartsWith("HTTP/1.1 404"));
  EXPECT_FALSE(water_.wanted() || sound_.wanted());
}

TEST_F(ViewServer, TakesOscAtItsAddressesAndTellsWhoListens) {
  protocol::UdpSocket client(protocol::Endpoint{INADDR_LOOPBACK, 0});
  client.send_to(server_.local(), protocol::encode({"/synth/impact/q", {7.0F}}));
  EXPECT_TRUE(gets(synth_, "/set"));
  client.send_to(server_.local(), protocol::encode({"/sim/pause", {1}}));
  EXPECT_TRUE(gets(sim_, "/pause"));
  Browser listener(server_.local());
  std::string hello = upgrade(host(), "http://" + host());
  listener.say(hello.replace(hello.find("/view"), 5, "/"));
  EXPECT_THAT(listener.hear("\r\n\r\n"), HasSubstr("101 Switching"));
  listener.say(message(1, R"({"COMMAND": "LISTEN", "DATA": "/synth/impact/q"})"));
  listener.say(message(2, osc({"/synth/mute", {1}})));
  EXPECT_TRUE(gets(synth_, "/mute")) << "what it said before has been heard, too";
  std::array<std::byte, protocol::kMaxDatagram> buffer;
  std::optional<protocol::Endpoint> talks;
  while (!talks) {
    const auto got = synth_.receive(buffer.data(), buffer.size(), 5.0);
    ASSERT_TRUE(got);
    if (protocol::decode({buffer.data(), got->size}).packet.messages[0].address == "/status") {
      talks = got->from;
    }
  }
  synth_.send_to(*talks, protocol::encode(protocol::value_of("impact/frequency", 300.0)));
  synth_.send_to(*talks, protocol::encode(protocol::value_of("impact/q", 7.0)));
  EXPECT_THAT(listener.hear("/synth/impact/q"), testing::Not(HasSubstr("frequency")));
}

// The test and the server share their descriptors: what waits cannot be accepted.
TEST_F(ViewServer, WithoutADescriptorLeftItWaitsInPeace) {
  const Browser early(server_.local());
  const int waiting = socket(AF_INET, SOCK_STREAM, 0);
  rlimit usual{};
  getrlimit(RLIMIT_NOFILE, &usual);
  const rlimit few{std::min<rlim_t>(usual.rlim_cur, 256), usual.rlim_max};
  setrlimit(RLIMIT_NOFILE, &few);
  std::vector<int> taken;
  for (int copy = dup(waiting); copy >= 0; copy = dup(waiting)) taken.push_back(copy);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(server_.local().address);
  address.sin_port = htons(server_.local().port);
  EXPECT_EQ(connect(waiting, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  const std::clock_t before = std::clock();  // processor time
  usleep(1'000'000);
  EXPECT_LT(std::clock() - before, CLOCKS_PER_SEC / 5);
  for (const int descriptor : taken) close(descriptor);
  close(waiting);
  setrlimit(RLIMIT_NOFILE, &usual);
  EXPECT_NE(open(), nullptr) << "served as soon as there is room";
}

/// Mutated frames of a client, many to a connection.
void send_mutants(const protocol::Endpoint& server, int frames) {
  std::mt19937 random(1);
  const std::string host = protocol::to_string(server);
  const std::array<std::string, 5> seeds = {message(2, ""), message(2, osc({"/mute", {1}})),
                                            message(2, osc({"/body/grab", {0, 1}})),
                                            message(1, "{}"), message(9, std::string(200, 'x'))};
  for (int sent = 0; sent < frames;) {
    const Browser browser(server);
    browser.say(upgrade(host, "http://" + host));
    for (int i = 0; i < 50; ++i, ++sent) {
      std::string frame = seeds[random() % seeds.size()];
      for (unsigned change = random() % 4; change > 0; --change) {
        frame[random() % frame.size()] = static_cast<char>(random());
      }
      if (random() % 8 == 0) frame.resize(random() % frame.size());
      if (!browser.say(frame)) break;
    }
  }
}

TEST_F(ViewServer, LivesThroughMutatedFrames) {
  send_mutants(server_.local(), 20'000);
  EXPECT_NE(open(), nullptr) << "it serves the next page as if nothing was";
}

TEST_F(ViewServer, LivesThroughAMillionMutatedFrames) {
  send_mutants(server_.local(), 1'000'000);
  EXPECT_NE(open(), nullptr);
}

}  // namespace
}  // namespace splash::view
