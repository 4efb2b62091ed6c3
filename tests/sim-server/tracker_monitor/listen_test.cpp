// SPDX-License-Identifier: MIT
// The lines that are offered for a message move a body as the message says, in a scene that is read
// like any other; and the program offers them for what it hears.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "sim-server/bodies/motion/tracker_map.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/tracker_monitor/heard.hpp"
#include "sim-server/tracker_monitor/obstacles.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::sim {
namespace {

using protocol::Message;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// The one pose that messages make in a scene with the lines offered for the first of them, and
/// what a user adds to its source.
std::optional<MappedPose> pose_by(const std::vector<Message>& messages,
                                  const std::string& more = "") {
  std::string lines = mapping_lines(messages.front());
  const std::size_t at = lines.find("BODY");
  if (at == std::string::npos) return std::nullopt;
  const Scene scene = parse_scene(
      "fluid: {particles: 500}\ntank: {lower: [0, 0, 0], upper: [1, 1, 1]}\n"
      "water: [{lower: [0, 0, 0], upper: [1, 1, 0.5]}]\nbodies:\n"
      "  - {name: hand, shape: {size: [0.1, 0.1, 0.1]}, motion: {kind: osc}, "
      "rest: {position: [0, 0, 1]}}\n" +
          lines.insert(lines.find('}', at), more).replace(at, 4, "hand"),
      "offered.yaml");
  TrackerMap map(scene);
  std::optional<MappedPose> found;
  for (const Message& message : messages) {
    map.take(message, {}, [&](const MappedPose& pose) { found = pose; });
  }
  return found;
}

void expect_at(const std::optional<MappedPose>& pose, const Vector3& place) {
  ASSERT_TRUE(pose.has_value());
  EXPECT_EQ(pose->refusal, PoseRefusal::none);
  EXPECT_LT(length(pose->position - place), 1.0e-6);
}

TEST(Listen, OffersThePresetOfACommonSender) {
  const Message vmc = {"/VMC/Ext/Tra/Pos",
                       {std::string("LHR-1A"), 1.0F, 2.0F, 3.0F, 0.0F, 0.0F, 0.0F, 1.0F}};
  EXPECT_THAT(mapping_lines(vmc), HasSubstr("preset: vmc, name: 'LHR-1A'"));
  expect_at(pose_by({vmc}), {3.0, -1.0, 2.0});
  const Message place = {"/tracking/trackers/2/position", {1.0F, 2.0F, 3.0F}};
  const Message turn = {"/tracking/trackers/2/rotation", {0.0F, 0.0F, 0.0F}};
  EXPECT_THAT(mapping_lines(place), HasSubstr("preset: vrchat, name: '2'"));
  expect_at(pose_by({place, turn}), {3.0, -1.0, 2.0});
  expect_at(pose_by({turn, place}), {3.0, -1.0, 2.0});
  const Message quat = {"/rigidbody", {7, std::string("quat"), 0.0F, 0.0F, 0.0F, 1.0F}};
  const Message moved = {"/rigidbody", {7, std::string("position"), 1.0F, 2.0F, 3.0F}};
  expect_at(pose_by({quat, moved}), {1.0, -3.0, 2.0});
}

TEST(Listen, SpellsOutWhatNoPresetKnows) {
  expect_at(pose_by({{"/phone", {1.0F, 2.0F, 3.0F}}}), {1.0, 2.0, 3.0});
  const std::optional<MappedPose> turned =
      pose_by({{"/head", {std::string("it's"), 4, 1.0F, 2.0F, 3.0F, 0.0F, 0.6F, 0.0F, 0.8F}}});
  expect_at(turned, {1.0, 2.0, 3.0});
  EXPECT_NEAR(turned->rotation[1], 0.6, 1.0e-6);
  expect_at(pose_by({{"/mm", {1000.0F, 2000.0F, 300.0F}}}), {1.0, 2.0, 0.3});
  EXPECT_THAT(mapping_lines({"/button", {1}}), HasSubstr("no position"));
  EXPECT_THAT(mapping_lines({"/phone", {1000, 2000, 300}}), HasSubstr("let it write 1.0"));
  EXPECT_THAT(
      mapping_lines({"/wand", {1.0F, 2.0F, 3.0F, 1.0F, 0.0F, 0.0F, 0.0F}}),
      AllOf(HasSubstr("rotation: [3, 4, 5, 6]"), HasSubstr("begins with w it is [4, 5, 6, 3]")));
  EXPECT_THAT(mapping_lines({"/body/pose", {0, 1.0F}}), HasSubstr("needs no line"));
}

// The axes that are named for a sender with y up put what it sends where it is, to the left as to
// the right.
TEST(Listen, NamesTheAxesOfSendersWithYUp) {
  const Message message = {"/wand", {1.0F, 2.0F, 3.0F}};
  const std::string words = mapping_lines(message);
  EXPECT_THAT(words, AllOf(HasSubstr("[x, -z, y] has y up,"),
                           HasSubstr("[x, z, y] has\n# y up and is mirrored")));
  expect_at(pose_by({message}, ", axes: [x, -z, y]"), {1.0, -3.0, 2.0});
  expect_at(pose_by({message}, ", axes: [x, z, y]"), {1.0, 3.0, 2.0});
}

TEST(Listen, SaysWhatOfTuioIsNotRead) {
  const auto set = [](float x, float y) {
    return mapping_lines({"/tuio/2Dcur", {std::string("set"), 3, x, y, 0.0F, 0.0F, 0.0F}});
  };
  EXPECT_THAT(set(0.2F, 1.0F), HasSubstr("see alive"));
  EXPECT_THAT(set(0.2F, 480.0F), HasSubstr("beyond 0 to 1"));
  EXPECT_THAT(set(-0.2F, 0.5F), HasSubstr("beyond 0 to 1"));
  const Message object = {"/tuio/2Dobj", {std::string("set"), 3, 40, 0.5F, 0.5F, 3.0F}};
  EXPECT_THAT(mapping_lines(object), HasSubstr("see alive")) << "angles are no places";
  EXPECT_THAT(mapping_lines({"/tuio/3Dcur", {std::string("alive"), 3}}),
              HasSubstr("only /tuio/2Dcur"));
}

TEST(Listen, TellsOnceHowEachIsMappedAndHowOftenItComes) {
  Heard heard;
  const auto packet = protocol::encode(Message{"/phone", {1.0F, 2.0F, 3.0F}});
  const protocol::Endpoint phone = {.address = 0xC0A8001EU, .port = 4000};
  for (int k = 0; k <= 30; ++k) heard.take(packet, phone, 57300, k / 60.0);
  EXPECT_THAT(heard.report(0.5),
              AllOf(HasSubstr("/phone  from 192.168.0.30:4000 at port 57300  62.0/s"),
                    HasSubstr(",fff 1.000 2.000 3.000"), HasSubstr("address: /phone"),
                    HasSubstr("--listen 0.0.0.0:57300 --allow 192.168.0.30")));
  EXPECT_EQ(heard.report(1.0), "");
  Heard just;
  just.take(packet, phone, 57300, 0.0);
  EXPECT_THAT(just.report(0.001), HasSubstr("2.0/s")) << "one came";
  heard.take(packet, phone, 57300, 1.1);
  EXPECT_THAT(heard.report(1.5), AllOf(HasSubstr("2.0/s"), Not(HasSubstr("tracking:"))));
  heard.take(protocol::encode(Message{"/phone", {0, 2.0F, 3.0F}}), phone, 57300, 1.6);
  heard.take(packet, phone, 57300, 1.6);
  EXPECT_THAT(heard.report(2.0), AllOf(HasSubstr(",iff 0 2.000 3.000\n        # no position"),
                                       HasSubstr(",fff 1.000 2.000 3.000")));
}

TEST(Listen, TellsWhatTheGateRefuses) {
  Heard heard;
  const std::string name = "/rigid body/1";
  heard.take(std::as_bytes(std::span(name.c_str(), 16)), {}, 57300, 0.0);
  EXPECT_THAT(heard.report(0.5),
              AllOf(HasSubstr("refused from 127.0.0.1: 1 datagrams"), HasSubstr("/rigid body/1")));
}

TEST(Listen, SaysWhatAFirewallNeeds) {
  const tests::TemporaryFolder folder;
  const auto ufw = folder.write("ufw.conf", "# a comment\nENABLED=yes\n");
  SystemFiles files = {.ufw = ufw, .firewalld = "/nowhere", .counters = "/nowhere"};
  EXPECT_THAT(obstacles({9000}, {}, files), HasSubstr("sudo ufw allow 9000/udp"));
  folder.write("ufw.conf",
               "ENABLED=no\n"
               "Ip: Forwarding InReceives InHdrErrors InDelivers\nIp: 2 100 1 90\n"
               "Udp: InDatagrams NoPorts InErrors\nUdp: 5 17 0\nUdpLite: NoPorts\nUdpLite: 4\n");
  files.counters = ufw;
  EXPECT_EQ(obstacles({9000}, {}, files), "");
  EXPECT_THAT(obstacles({9000}, {.unwanted = 3}, files), HasSubstr("3 datagrams came for ports"));
  EXPECT_THAT(obstacles({9000, 3333}, {.filtered = 4}, files),
              AllOf(HasSubstr("4 packets reached this host and were not let in: a firewall"),
                    HasSubstr("UDP is wanted at 9000 3333")));
  EXPECT_EQ(missed(files).unwanted, 17U);
  EXPECT_EQ(missed(files).filtered, 9U);
  files.counters = "/nowhere";
  EXPECT_EQ(missed(files).unwanted + missed(files).filtered, 0U);
}

TEST(Listen, TheProgramHearsASender) {
  std::uint16_t port = 0;
  {
    const protocol::UdpSocket free({.address = INADDR_LOOPBACK, .port = 0});
    port = free.local().port;
  }
  tests::ChildProcess listener(tests::command("splash-listen", {std::to_string(port)}));
  ASSERT_TRUE(listener.wait_for_text("listening at UDP port")) << listener.output();
  protocol::UdpSocket sender({.address = INADDR_LOOPBACK, .port = 0});
  sender.send_to({.port = port}, protocol::encode(Message{"/phone", {1.0F, 2.0F, 3.0F}}));
  EXPECT_TRUE(listener.wait_for_text("- {body: BODY, address: /phone, position: [0, 1, 2]}"))
      << listener.output();
  EXPECT_THAT(listener.output(),
              HasSubstr("at one port only: for this one, start it with --listen 127.0.0.1:" +
                        std::to_string(port)));
  listener.signal(SIGINT);
  EXPECT_EQ(listener.wait_for_end(), 0) << listener.output();
}

}  // namespace
}  // namespace splash::sim
