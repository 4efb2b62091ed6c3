// SPDX-License-Identifier: MIT
// The real programs on two hosts: several receivers, some of them not there, strangers, defaults.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "protocol/control.hpp"
#include "protocol/reply_budget.hpp"
#include "protocol/status.hpp"
#include "protocol/time_tag.hpp"
#include "tests/network/two_hosts.hpp"
#include "tests/support/median.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::network {
namespace {

using protocol::Message;
using testing::HasSubstr;
using tests::Arguments;

/// What a receiver of its own making got.
struct Heard {
  std::set<std::int32_t> sequences;
  std::uint64_t bundles = 0;
  std::uint64_t events = 0;
  std::vector<double> travel;  ///< arrival less sending, as the bundle tells it [s]
};

/// Listens until nothing has come for a second.
Heard listen(protocol::UdpSocket& socket) {
  Heard heard;
  std::array<std::byte, 2048> buffer{};
  while (const auto received = socket.receive(buffer.data(), buffer.size(), 1.0)) {
    const double arrival = protocol::unix_now();
    const auto packet = protocol::decode(protocol::Bytes(buffer).first(received->size)).packet;
    const auto frame = protocol::to_frame(packet.messages.at(0));
    if (!frame || !packet.time) continue;
    ++heard.bundles;
    heard.sequences.insert(frame->sequence);
    const double delay = 1e-3 * static_cast<double>(frame->delay_ms);
    heard.travel.push_back(arrival - (protocol::to_unix_seconds(*packet.time) - delay));
    for (const auto& message : packet.messages) heard.events += protocol::to_event(message) ? 1 : 0;
  }
  return heard;
}

/// Hosts that do not exist. Kernels whose sending buffers hold no more than what waits for the
/// address of one of them bear only one.
Arguments dead_hosts() {
  long most = 0;
  std::ifstream("/proc/sys/net/core/wmem_max") >> most;
  Arguments targets{"--target", "10.77.0.77:57310"};
  if (most >= (1 << 20)) targets.insert(targets.end(), {"--target", "10.77.0.78:57310"});
  return targets;
}

// Two live receivers, a port where nobody listens, and hosts that do not exist.
TEST_F(OnTwoHosts, EachReceiverGetsEveryEventWhateverTheOthersDo) {
  const tests::TemporaryFolder folder;
  const std::string report = folder / "hosts.json";
  auto synth = start_synth({"--listen", "10.77.0.2:57310", "--allow", "10.77.0.1"});
  protocol::UdpSocket receiver = hosts_.socket_on(kSynthHost, "10.77.0.2:57311");
  const tests::SmallScene scene(tests::plunging());
  Arguments arguments{"--scene",  scene.path(),     "--duration",  "2.5",      "--report",
                      report,     "--target",       "10.77.0.2:9", "--target", "10.77.0.2:57310",
                      "--target", "10.77.0.2:57311"};
  for (const std::string& word : dead_hosts()) arguments.push_back(word);
  auto simulator = start(kSimHost, "sim-server", arguments);
  ASSERT_TRUE(simulator->wait_for_text("running")) << simulator->output();
  const Heard heard = listen(receiver);
  EXPECT_EQ(simulator->wait_for_end(), 0) << simulator->output();

  EXPECT_EQ(synth->end(), 0);
  const auto told = nlohmann::json::parse(tests::text_of(report));
  const auto& kinds = told.at("events");
  const auto sent = kinds.at("impacts").get<std::uint64_t>() +
                    kinds.at("bubbles").get<std::uint64_t>() +
                    kinds.at("cavities").get<std::uint64_t>();
  ASSERT_GT(sent, 20U);
  EXPECT_EQ(heard.events, sent);
  EXPECT_EQ(heard.sequences.size(), heard.bundles) << "none came twice";
  EXPECT_EQ(*heard.sequences.rbegin() + 1, static_cast<std::int32_t>(heard.bundles));
  EXPECT_EQ(told.at("lost"), 0) << "the synth answered the simulator, and missed nothing";
  long accounted = tests::number_before(synth->output(), "too late");
  for (const char* kind : {"impacts", "bubbles", "cavities"}) {
    accounted += tests::number_before(synth->output(), kind);
  }
  EXPECT_EQ(accounted, static_cast<long>(sent)) << "played, or too late on a loaded machine:\n"
                                                << synth->output();
  EXPECT_THAT(simulator->output() + synth->output(), testing::Not(HasSubstr(" asked /")))
      << "neither asks the other in fewer bytes than the answer has";
  EXPECT_LT(std::abs(tests::median(heard.travel)), 0.05) << "tags and delays fit each other";
  std::cout << "events " << sent << ", late " << told.at("late") << ", median travel "
            << 1e3 * tests::median(heard.travel) << " ms\n";
}

TEST_F(OnTwoHosts, StrangersAreNotObeyed) {
  auto synth = start_synth({"--listen", "0.0.0.0:57310", "--allow", "10.77.0.1"});
  protocol::UdpSocket stranger = hosts_.socket_on(kSimHost, "10.77.0.3:0");
  protocol::UdpSocket friendly = hosts_.socket_on(kSimHost, "10.77.0.1:0");
  const std::string there = "10.77.0.2:57310";
  for (const char* command : {"/status", "/quit", "/clearSched", "/version"}) {
    EXPECT_EQ(answer_to({command, {}}, stranger, there, 0.1).address, "no answer");
  }
  EXPECT_EQ(answer_to({"/mute", {1}}, stranger, there, 0.1).address, "no answer");
  EXPECT_EQ(answer_to(protocol::ping({5}), stranger, there, 0.1).address, "no answer");
  const auto filled = [](const Message& message) { return protocol::filled_up(message, 256); };
  EXPECT_EQ(answer_to(filled({"/status", {}}), stranger, there, 0.1).address, "no answer");
  EXPECT_EQ(answer_to(filled({"/status", {}}), friendly, there, 20.0).address, "/status.reply");
  EXPECT_EQ(answer_to(filled({"/quit", {}}), friendly, there, 20.0).address, "/fail")
      << "not from afar";
  EXPECT_TRUE(synth->running());
}

// Whatever its targets are: none here, or one on its own host.
TEST_F(OnTwoHosts, TheSimulatorSendsEventsToAnotherHostThatAsked) {
  const tests::SmallScene scene(tests::plunging());
  for (const Arguments& targets : {Arguments{}, Arguments{"--target", "127.0.0.1:9"}}) {
    protocol::UdpSocket listener = hosts_.socket_on(kSynthHost, "10.77.0.2:0");
    Arguments arguments{"--scene",       scene.path(), "--listen",
                        "0.0.0.0:57300", "--allow",    "10.77.0.2"};
    arguments.insert(arguments.end(), targets.begin(), targets.end());
    auto simulator = start(kSimHost, "sim-server", arguments);
    ASSERT_TRUE(simulator->wait_for_text("running")) << simulator->output();
    const Message question = protocol::filled_up({"/notify", {1}}, protocol::kFilledQuestion);
    EXPECT_EQ(answer_to(question, listener, "10.77.0.1:57300", 20.0).address, "/done");
    std::array<std::byte, 2048> buffer{};
    EXPECT_TRUE(listener.receive(buffer.data(), buffer.size(), 5.0)) << "a heartbeat at least";
    EXPECT_EQ(simulator->end(), 0) << simulator->output();
  }
}

TEST_F(OnTwoHosts, BothListenToTheirOwnHostUnlessToldOtherwise) {
  auto synth = start_synth({});
  const tests::SmallScene scene(tests::plunging());
  auto simulator = start(kSynthHost, "sim-server", {"--scene", scene.path(), "--target", ":57310"});
  ASSERT_TRUE(simulator->wait_for_text("running")) << simulator->output();
  const auto listening = hosts_.listening_on(kSynthHost);
  EXPECT_GE(listening.size(), 4U) << "the synth; the simulator's control, events and questions";
  for (const std::string& local : listening) EXPECT_THAT(local, testing::StartsWith("0100007F:"));
  EXPECT_THAT(listening, testing::Contains("0100007F:DFDE")) << "57310";
  EXPECT_THAT(listening, testing::Contains("0100007F:DFD4")) << "57300";

  protocol::UdpSocket other_host = hosts_.socket_on(kSimHost, "10.77.0.1:0");
  for (const char* port : {"10.77.0.2:57310", "10.77.0.2:57300"}) {
    const Message question = protocol::filled_up({"/status", {}}, protocol::kFilledQuestion);
    EXPECT_EQ(answer_to(question, other_host, port, 0.1).address, "no answer");
  }
}

}  // namespace
}  // namespace splash::network
