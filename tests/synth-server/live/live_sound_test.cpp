// SPDX-License-Identifier: MIT
// The real program's sound is changed while it plays: over OSC, by a preset's name, and by SIGHUP.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <string>

#include "tests/support/programs.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/waiting.hpp"

namespace splash::synth {
namespace {

using protocol::Message;
using testing::HasSubstr;

class LiveSound : public testing::Test {
 protected:
  LiveSound() {
    folder_.write("splash/sounds/dull.yaml", "name: dull\nimpact: {frequency: 90, q: 2}\n");
    write_q(3);
  }
  void write_q(int q) const {
    folder_.write("mine.yaml", "name: mine\nimpact: {q: " + std::to_string(q) + "}\n");
  }
  static Message set(const std::string& name, float value) { return {"/set", {name, value}}; }
  static Message preset(const std::string& name) { return {"/preset", {name, 0.1F}}; }
  static float value(tests::Synth& synth, const std::string& name) {
    const Message reply = synth.ask({"/get", {name}}, "/value");
    return reply.arguments.size() == 2 ? std::get<float>(reply.arguments[1]) : -1.0F;
  }
  /// Waits until the number is that.
  static void expect_value(tests::Synth& synth, const std::string& name, float wanted) {
    EXPECT_TRUE(tests::eventually([&] { return value(synth, name) == wanted; }, 20.0, 0.1)) << name;
  }

  const tests::TemporaryFolder folder_;
  const std::string file_ = folder_ / "mine.yaml";
};

TEST_F(LiveSound, IsSetAndPresetAndReadAgain) {
  tests::Synth synth(
      {"--rig", tests::rig_path("handheld.yaml"), "--device", "null", "--sound", file_},
      {{"XDG_CONFIG_HOME", folder_.path().string()}});
  EXPECT_THAT(synth.process().output(), HasSubstr("sound: mine\n"));
  EXPECT_EQ(value(synth, "impact/q"), 3.0F);
  EXPECT_EQ(synth.ask(set("impact/q", 4.0F), "/value"),
            (Message{"/value", {std::string("impact/q"), 4.0F}}));
  EXPECT_EQ(synth.ask(set("rig/hand/gain_db", -6.0F), "/value").arguments.size(), 2U);
  const Message refused = synth.ask(set("impact/q", 99.0F), "/fail");
  EXPECT_THAT(std::get<std::string>(refused.arguments.at(1)), HasSubstr("allowed 0.6 to 50"));

  EXPECT_EQ(synth.ask(preset("dull"), "/done").address, "/done");
  EXPECT_EQ(value(synth, "impact/frequency"), 90.0F);
  EXPECT_EQ(value(synth, "rig/hand/gain_db"), -6.0F) << "levels stay";
  EXPECT_EQ(synth.ask(preset("../sounds/dull"), "/fail").address, "/fail") << "no paths";
  EXPECT_EQ(synth.ask(preset(file_.substr(0, 60)), "/fail").address, "/fail");

  write_q(8);
  synth.process().signal(SIGHUP);
  expect_value(synth, "impact/q", 8.0F);
  write_q(800);
  synth.process().signal(SIGHUP);
  EXPECT_TRUE(synth.process().wait_for_text(file_ + ":2:13: error: key 'impact.q'"));
  EXPECT_EQ(value(synth, "impact/q"), 8.0F) << "a wrong file changes nothing";
  synth.process().signal(SIGTERM);
  ASSERT_EQ(synth.process().wait_for_end(), 0) << synth.process().output();
}

TEST_F(LiveSound, ClientsAreToldOfEachChange) {
  tests::Synth synth({"--rig", tests::rig_path("handheld.yaml"), "--device", "null"});
  EXPECT_EQ(synth.ask({"/notify", {1}}, "/done").address, "/done");
  protocol::UdpSocket other({INADDR_LOOPBACK, 0});
  other.send_to(synth.endpoint(), protocol::encode(set("bubble/pitch", 0.5F)));
  const Message told = synth.ask({"/sync", {1}}, "/value");
  EXPECT_EQ(told, (Message{"/value", {std::string("bubble/pitch"), 0.5F}}));
}

}  // namespace
}  // namespace splash::synth
