// SPDX-License-Identifier: MIT
// The scripts of examples/unity, compiled with mono and played by a console in Unity's place: a
// simulator of the test's own is asked for events, and gets the poses of a transform.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <variant>

#include "protocol/message.hpp"
#include "protocol/time_tag.hpp"
#include "protocol/udp_socket.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

bool has_mono() {
  return std::system("command -v mcs >/dev/null && command -v mono >/dev/null") == 0;
}

/// The console's program, or what the compiler says.
std::string compile(const std::string& program) {
  const std::string source = SPLASH_SOURCE_DIR;
  std::vector<std::string> arguments = {"mcs", "-langversion:6", "-warnaserror", "-out:" + program};
  for (const auto& file : fs::directory_iterator(source + "/examples/unity")) {
    if (file.path().extension() == ".cs") arguments.push_back(file.path());
  }
  arguments.push_back(source + "/tests/examples/UnityStub.cs");
  ChildProcess compiler(arguments);
  return compiler.wait_for_end() == 0 ? "" : compiler.output();
}

double number(const protocol::Message& message, std::size_t index) {
  return static_cast<double>(std::get<float>(message.arguments.at(index)));
}

TEST(Unity, HearsOnTheMainThreadAndMovesABody) {
  if (!has_mono()) GTEST_SKIP() << "mono is not installed (mono-mcs, mono-runtime)";
  const TemporaryFolder folder;
  const std::string program = folder / "unity.exe";
  ASSERT_EQ(compile(program), "");
  protocol::UdpSocket simulator({.address = INADDR_LOOPBACK, .port = 0});
  protocol::UdpSocket events({.address = INADDR_LOOPBACK, .port = 0});  // sim-server has two, too
  ChildProcess unity({"mono", program, std::to_string(simulator.local().port)});
  std::array<std::byte, 2048> buffer{};
  protocol::Message pose;
  int asked = 0;
  const double end = protocol::monotonic_now() + 60.0;
  while (unity.running() && protocol::monotonic_now() < end) {
    const auto received = simulator.receive(buffer.data(), buffer.size(), 0.2);
    if (!received) continue;
    const auto decoded = protocol::decode(protocol::Bytes(buffer).first(received->size));
    ASSERT_EQ(decoded.refusal, protocol::Refusal::none);
    for (const auto& message : decoded.packet.messages) {
      if (message.address == "/body/pose") pose = message;
      if (message.address != "/notify" || std::get<std::int32_t>(message.arguments[0]) == 0)
        continue;
      if (++asked > 1) continue;
      events.send_to(received->from,
                     protocol::encode(
                         protocol::TimeTag{1},
                         {{"/frame", {7, 0, 0, 30.0F}},
                          {"/impact", {0, 2, 1.25F, 1.0F, 0.5F, -0.25F, 0.125F, 10.0F, 0.0F, 0.0F}},
                          {"/bubble", {0, -1, 0.004F, 0.05F, 1.0F, 2.0F, 3.0F, 0.0F}},
                          {"/cavity", {0, 1, 0.05F, 0.05F, 1.0F, 2.0F, 3.0F, 5.0F, 0.0F}}}));
    }
  }
  ASSERT_EQ(unity.wait_for_end(), 0) << unity.output();
  EXPECT_GE(asked, 1) << "and again when nothing is heard";
  // Unity's x is splash's -y, its y splash's z, its z splash's x.
  EXPECT_THAT(unity.output(),
              HasSubstr("impact body 2 speed 1.25 radius 0.000 at 0.25 0.13 0.50 in 0.040 s main"));
  EXPECT_THAT(unity.output(),
              HasSubstr("bubble body -1 speed 0.00 radius 0.004 at -2.00 3.00 1.00"));
  EXPECT_THAT(unity.output(),
              HasSubstr("cavity body 1 speed 0.00 radius 0.050 at -2.00 3.00 1.00"));
  ASSERT_EQ(protocol::type_tags(pose), ",sfffffff") << unity.output();
  EXPECT_EQ(std::get<std::string>(pose.arguments[0]), "hand");
  // As those of tests/sim-server/bodies/motion/tracker_map_test.cpp, that come by VMC in Unity's
  // axes.
  const std::array<double, 7> wanted = {-0.75, -0.25, 1.5, 0.1, 0.1, -0.7, 0.7};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_NEAR(number(pose, i + 1), wanted[i], 1.0e-6) << i;
  }
}

}  // namespace
}  // namespace splash::tests
