// SPDX-License-Identifier: MIT
// Every program of examples/README.md, as it stands there: one hears an impact that it is told of,
// the other moves a body where the page says.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "protocol/message.hpp"
#include "protocol/time_tag.hpp"
#include "protocol/udp_socket.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::tests {
namespace {

const std::string kSource = SPLASH_SOURCE_DIR;
constexpr double kLowest = 0.65 - 0.003 * 99;  ///< where the page moves the hand to [m]

/// The first block in a language below a heading of the page.
std::string block(const std::string& heading, const std::string& language) {
  const std::string page = text_of(kSource + "/examples/README.md");
  const std::size_t below = page.find("\n## " + heading + "\n");
  const std::string fence = "```" + language + "\n";
  const std::size_t found = page.find(fence, below);
  if (below == std::string::npos || found == std::string::npos) return {};
  const std::size_t begin = found + fence.size();
  return page.substr(begin, page.find("```", begin) - begin);
}

std::string at_port(std::string text, std::uint16_t port) {
  for (std::size_t at = text.find("57300"); at != std::string::npos; at = text.find("57300")) {
    text.replace(at, 5, std::to_string(port));
  }
  return text;
}

bool has(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null").c_str()) == 0;
}

/// A program of the page, ready to be started.
struct Program {
  std::vector<std::string> arguments;
  ChildProcess::Environment environment;
};

/// `folder`: for its files.
std::optional<Program> make(const TemporaryFolder& folder, const std::string& heading,
                            const std::string& language, std::uint16_t port) {
  Program program;
  if (language == "pd") {
    const std::string patch = heading.starts_with("Hear") ? "hear" : "move";
    const std::string text = text_of(kSource + "/examples/pd/" + patch + ".pd");
    if (text.empty()) return std::nullopt;
    program.arguments = {"pd", "-nogui", "-noprefs", "-noaudio",
                         folder.write(patch + ".pd", at_port(text, port))};
    return program;
  }
  const std::string code = at_port(block(heading, language), port);
  if (code.empty()) return std::nullopt;
  if (language == "python") {
    program.arguments = {"python3", "-B", "-u", "-c", code};
    program.environment = {{"PYTHONPATH", kSource + "/examples/python"}};
  } else if (language == "supercollider") {
    program.arguments = {"sclang", folder.write("page.scd", code)};
    program.environment = {{"QT_QPA_PLATFORM", "offscreen"}, {"QTWEBENGINE_DISABLE_SANDBOX", "1"}};
  } else {
    const std::string source = folder.write("page.cpp", code);
    const std::string binary = folder / "page";
    std::vector<std::string> compile = {"g++",  "-std=c++17", "-Wall", "-Wextra", "-I" + kSource,
                                        source, "-o",         binary,  "-pthread"};
    if (code.find("lo/lo.h") != std::string::npos) compile.emplace_back("-llo");
    ChildProcess compiler(compile);
    if (compiler.wait_for_end(120.0) != 0) {
      ADD_FAILURE() << compiler.output();
      return std::nullopt;
    }
    program.arguments = {"stdbuf", "-oL", binary};
  }
  return program;
}

class Page : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() == "supercollider" && !has("sclang")) {
      GTEST_SKIP() << "sclang is not installed (apt-get install supercollider-language)";
    }
  }

  TemporaryFolder folder_;
};

const protocol::Message kImpact = {"/impact",
                                   {0, 2, 1.25F, 1.0F, 0.5F, -0.25F, 0.125F, 10.0F, 0.0F, 0.0F}};

TEST_P(Page, HearsAnImpact) {
  protocol::UdpSocket simulator({.address = INADDR_LOOPBACK, .port = 0});
  protocol::UdpSocket events({.address = INADDR_LOOPBACK, .port = 0});  // sim-server has two, too
  const auto program = make(folder_, "Hear an impact", GetParam(), simulator.local().port);
  ASSERT_TRUE(program) << "the page has none";
  ChildProcess ear(program->arguments, program->environment);
  std::array<std::byte, 2048> buffer{};
  const double end = protocol::monotonic_now() + 60.0;
  bool heard = false;
  while (!heard && ear.running() && protocol::monotonic_now() < end) {
    const auto received = simulator.receive(buffer.data(), buffer.size(), 0.2);
    heard = ear.output().find("1.25") != std::string::npos;
    if (!received) continue;
    const auto decoded = protocol::decode(protocol::Bytes(buffer).first(received->size));
    ASSERT_EQ(decoded.refusal, protocol::Refusal::none);
    const protocol::Message& asked = decoded.packet.messages.at(0);
    ASSERT_EQ(asked.address, "/notify");
    ASSERT_EQ(asked.arguments, (std::vector<protocol::Argument>{1}));
    events.send_to(received->from,
                   protocol::encode(protocol::TimeTag{1}, {{"/frame", {7, 0, 0, 30.0F}}, kImpact}));
    heard = ear.wait_for_text("1.25", 10.0);
  }
  EXPECT_TRUE(heard) << ear.output();
}

TEST_P(Page, MovesABody) {
  protocol::UdpSocket simulator({.address = INADDR_LOOPBACK, .port = 0});
  const auto program = make(folder_, "Move a body", GetParam(), simulator.local().port);
  ASSERT_TRUE(program) << "the page has none";
  ChildProcess hand(program->arguments, program->environment);
  std::array<std::byte, 2048> buffer{};
  const double end = protocol::monotonic_now() + 60.0;
  double height = 1.0;
  int poses = 0;
  while (height > kLowest + 1.0e-4 && protocol::monotonic_now() < end) {
    const auto received = simulator.receive(buffer.data(), buffer.size(), 0.2);
    if (!received) continue;
    const auto decoded = protocol::decode(protocol::Bytes(buffer).first(received->size));
    ASSERT_EQ(decoded.refusal, protocol::Refusal::none);
    for (const protocol::Message& message : decoded.packet.messages) {
      if (message.address != "/body/pose") continue;
      ASSERT_EQ(message.arguments.size(), 8U);
      const auto number = [&](std::size_t index) {
        return static_cast<double>(std::get<float>(message.arguments[index]));
      };
      const auto* name = std::get_if<std::string>(&message.arguments[0]);
      EXPECT_TRUE(name != nullptr ? *name == "hand"
                                  : std::get<std::int32_t>(message.arguments[0]) == 0);
      EXPECT_EQ(number(7), 1.0);
      EXPECT_LT(number(3), height);
      height = number(3);
      ++poses;
    }
  }
  EXPECT_NEAR(height, kLowest, 0.004) << hand.output();
  EXPECT_GE(poses, 90);
}

INSTANTIATE_TEST_SUITE_P(Languages, Page, testing::Values("python", "cpp", "pd", "supercollider"),
                         [](const auto& one) { return one.param; });

}  // namespace
}  // namespace splash::tests
