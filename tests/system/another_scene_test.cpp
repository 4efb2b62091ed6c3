// SPDX-License-Identifier: MIT
// A program that is asked for another scene or rig goes over to it in its own place: the same
// process, the same ports.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "protocol/control.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"
#include "tests/support/waiting.hpp"
#include "tests/system/notify_socket.hpp"

namespace splash::tests {
namespace {

using protocol::Message;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double kTimeout = 60.0;  ///< [s]

/// A folder for $XDG_CONFIG_HOME in which a scene and a rig are called "other".
class OwnConfigs {
 public:
  OwnConfigs() {
    folder_.write("splash/scenes/other.yaml", text_of(SmallScene(tracked(), 2).path()));
    folder_.write("splash/scenes/wrong.yaml", "name: wrong\n");
    folder_.write("splash/rigs/other.yaml", text_of(rig_path("shoes.yaml")));
  }
  [[nodiscard]] ChildProcess::Environment environment() const {
    return {{"XDG_CONFIG_HOME", folder_.path().string()}};
  }

 private:
  TemporaryFolder folder_;
};

/// Whether the program, which is the same process, answers at its port again.
bool answers(Daemon& daemon) {
  for (int i = 0; i < 300; ++i) {
    if (daemon.ask({"/sync", {7}}, "/synced").address == "/synced") return true;
    sleep(0.2);
  }
  return false;
}

TEST(AnotherScene, IsGoneOverToInTheSameProcess) {
  const OwnConfigs own;
  const SmallScene scene(plunging());
  NotifySocket manager;
  auto environment = own.environment();
  environment.emplace_back("NOTIFY_SOCKET", manager.address());
  environment.emplace_back("WATCHDOG_USEC", "20000000");
  Simulator simulator({"--scene", scene.path(), "--show=127.0.0.1:0"}, environment);
  EXPECT_NE(manager.wait_for("READY=1\nSTATUS=small", kTimeout), "");
  for (const char* name : {"../scenes/other", "/etc/passwd", "nothing", "wrong", ""}) {
    EXPECT_EQ(simulator.ask({"/scene", {name}}, "/fail").address, "/fail") << name;
  }
  EXPECT_TRUE(simulator.process().running());
  EXPECT_EQ(simulator.ask({"/scene", {"other"}}, "/done"), protocol::done("/scene"));
  EXPECT_NE(manager.wait_for("WATCHDOG_USEC=600000000", kTimeout), "") << "it may take long";
  EXPECT_THAT(manager.wait_for("", kTimeout), testing::Not(StartsWith("STOPPING")));
  EXPECT_NE(manager.wait_for("WATCHDOG_USEC=20000000", kTimeout), "") << "and not after that";
  EXPECT_NE(manager.wait_for("READY=1\nSTATUS=small", kTimeout), "");
  EXPECT_TRUE(answers(simulator));
  EXPECT_NE(manager.wait_for("WATCHDOG=1", kTimeout), "");
  EXPECT_EQ(simulator.end(), 0) << simulator.process().output();
  EXPECT_NE(manager.wait_for("STOPPING=1", kTimeout), "");
  const std::string said = simulator.process().output();
  const auto first = said.find("viewers: ");
  const auto second = said.rfind("viewers: ");
  ASSERT_NE(first, second) << said;
  EXPECT_EQ(said.substr(first, said.find('\n', first) - first),
            said.substr(second, said.find('\n', second) - second));
}

TEST(AnotherScene, IsNotForARunThatWritesOrEnds) {
  const OwnConfigs own;
  const SmallScene scene(tracked());
  const TemporaryFolder folder;
  const std::string log = folder / "kept.osc";
  for (const auto& [arguments, word] :
       {std::pair<Arguments, std::string>{{"--record", log}, "writes a file"},
        std::pair<Arguments, std::string>{{"--duration", "1000"}, "--duration"}}) {
    Arguments all = {"--scene", scene.path()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    Simulator simulator(all, own.environment());
    const Message reply = simulator.ask({"/scene", {"other"}}, "/fail");
    ASSERT_EQ(reply.arguments.size(), 2U);
    EXPECT_THAT(std::get<std::string>(reply.arguments[1]), HasSubstr(word));
  }
}

TEST(AnotherRig, IsGoneOverToInTheSameProcess) {
  const OwnConfigs own;
  Synth synth({"--rig", rig_path("stereo.yaml"), "--device", "null", "--middle=1,1,0"},
              own.environment());
  for (const char* name : {"../rigs/other", "nothing"}) {
    EXPECT_EQ(synth.ask({"/rig", {name}}, "/fail").address, "/fail") << name;
  }
  EXPECT_EQ(synth.ask({"/rig", {"other"}}, "/done"), protocol::done("/rig"));
  EXPECT_TRUE(synth.process().wait_for_text("rig: shoes", kTimeout)) << synth.process().output();
  EXPECT_TRUE(answers(synth));
  // The same rig, around another middle.
  EXPECT_EQ(synth.ask({"/rig", {"", 0.5F, 0.25F, -1.0F}}, "/done"), protocol::done("/rig"));
  EXPECT_TRUE(answers(synth));
  EXPECT_EQ(synth.end(), 0) << synth.process().output();
}

TEST(AnotherRig, IsNotForASynthThatRecords) {
  const TemporaryFolder folder;
  const std::string wav = folder / "kept.wav";
  Synth synth({"--rig", rig_path("stereo.yaml"), "--device", "null", "--record-audio", wav});
  const Message reply = synth.ask({"/rig", {"shoes"}}, "/fail");
  ASSERT_EQ(reply.arguments.size(), 2U);
  EXPECT_THAT(std::get<std::string>(reply.arguments[1]), HasSubstr("records"));
  EXPECT_EQ(synth.end(), 0);
}

}  // namespace
}  // namespace splash::tests
