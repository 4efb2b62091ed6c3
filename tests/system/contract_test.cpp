// SPDX-License-Identifier: MIT
// Both running programs are asked every command that protocol/README.md documents, and answer each
// as documented there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <memory>
#include <regex>

#include "protocol/address.hpp"
#include "protocol/control.hpp"
#include "protocol/time_tag.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/source_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::tests {
namespace {

using protocol::Message;

/// A row of the table of addresses in protocol/README.md.
struct Documented {
  std::string address;
  std::string direction;
  std::string reply;  ///< that the row promises
};

/// The rows of commands: those whose types end with the filling.
std::vector<Documented> documented_commands() {
  const std::string text = text_of(source_folder() / "protocol/README.md");
  const std::regex row(R"(\| `(/[^`]+)` \| `,[^`]*s\*` \| ([^|]+) \| ([^|]+) \|)");
  const std::regex promise("(?:nswered by|Asks for) (/[A-Za-z.]+)");
  std::vector<Documented> all;
  for (std::sregex_iterator found(text.begin(), text.end(), row), end; found != end; ++found) {
    const std::string meaning = (*found)[3];
    std::smatch reply;
    EXPECT_TRUE(std::regex_search(meaning, reply, promise)) << (*found)[0] << " names no reply";
    all.push_back({(*found)[1], (*found)[2], reply[1]});
  }
  return all;
}

/// Arguments that either program obeys; /notify 0, for the events of /notify 1 are no replies.
std::vector<protocol::Argument> example_of(const std::string& address) {
  using Arguments = std::vector<protocol::Argument>;
  const std::string row = "impact/q", threshold = "detect/impact_speed";
  static const std::map<std::string, Arguments> kExamples = {
      {"/notify", {0}},        {"/sync", {7}},  {"/mute", {1}},
      {"/set", {row, 2.5F}},   {"/get", {row}}, {"/preset", {std::string("calibrated"), 0.1F}},
      {"/tone", {1}},          {"/pause", {0}}, {"/body/grab", {0, 1}},
      {"/dumpOSC", {0}},       {"/error", {1}}, {"/ping", {protocol::TimeTag{5}}},
      {"/param", {threshold}},
  };
  const auto found = kExamples.find(address);
  return found == kExamples.end() ? Arguments{} : found->second;
}

/// Those of other scenes and rigs let the program begin anew (param_test.cpp).
bool ends_the_program(const std::string& address) {
  return address == "/quit" || address == "/scene" || address == "/rig";
}

class ContractTest : public testing::TestWithParam<std::string> {
 protected:
  ContractTest() {
    if (GetParam() == protocol::kSimProgram) {
      program_ = std::make_unique<Simulator>(Arguments{"--scene", scene_.path()});
    } else {
      program_ =
          std::make_unique<Synth>(Arguments{"--rig", rig_path("stereo.yaml"), "--device", "null"});
    }
  }

  [[nodiscard]] bool is_ours(const Documented& command) const {
    const bool is_sim = GetParam() == protocol::kSimProgram;
    return command.direction == "to either program" ||
           command.direction == (is_sim ? "to the simulator" : "to the synth");
  }
  /// The next reply, asked for again when it stays out. A port may ask 40 times at once.
  Message ask(const Message& command) {
    std::array<std::byte, 2048> buffer{};
    for (int tries = 0; tries < 10; ++tries) {
      socket_.send_to(program_->endpoint(), protocol::encode(command));
      const auto received = socket_.receive(buffer.data(), buffer.size(), 2.0);
      if (!received) continue;
      const auto read = protocol::decode(protocol::Bytes(buffer).first(received->size));
      if (!read.packet.messages.empty()) return read.packet.messages.front();
    }
    return {"nothing came", {}};
  }
  /// The first argument of /done and /fail: the command that they answer.
  static std::string subject(const Message& reply) {
    const auto* text =
        reply.arguments.empty() ? nullptr : std::get_if<std::string>(&reply.arguments[0]);
    return text == nullptr ? "" : *text;
  }

  SmallScene scene_{plunging()};
  std::unique_ptr<Daemon> program_;
  protocol::UdpSocket socket_{protocol::Endpoint{INADDR_LOOPBACK, 0}};
};

TEST_P(ContractTest, EveryDocumentedCommandIsAnsweredAsDocumented) {
  const auto commands = documented_commands();
  ASSERT_GE(commands.size(), 17U) << "the table of protocol/README.md was not read";
  for (const Documented& command : commands) {
    if (!is_ours(command) || ends_the_program(command.address)) continue;
    const Message reply = ask({command.address, example_of(command.address)});
    EXPECT_EQ(reply.address, command.reply) << command.address << ' ' << subject(reply);
    EXPECT_EQ(protocol::violation(reply), std::nullopt) << command.address;
    if (command.reply == "/done") {
      EXPECT_EQ(subject(reply), command.address);
    }
  }
  EXPECT_EQ(ask({"/quit", {}}), protocol::done("/quit"));
  EXPECT_EQ(program_->process().wait_for_end(), 0) << program_->process().output();
}

TEST_P(ContractTest, EveryCommandWithWrongArgumentsIsRefusedByName) {
  for (const Documented& command : documented_commands()) {
    const Message reply = ask({command.address, {0.5F, 0.5F, 0.5F}});
    EXPECT_EQ(reply.address, "/fail") << command.address;
    EXPECT_EQ(subject(reply), command.address);
    ASSERT_EQ(reply.arguments.size(), 2U) << command.address;
    EXPECT_THAT(std::get<std::string>(reply.arguments[1]),
                testing::HasSubstr(is_ours(command) ? "types are ,fff, expected ,"
                                                    : "not a command of " + GetParam()));
  }
  const Message unknown = ask({"/statsu", {}});
  EXPECT_EQ(unknown, protocol::fail("/statsu", "unknown command, did you mean /status?"));
  EXPECT_TRUE(program_->process().running());
}

INSTANTIATE_TEST_SUITE_P(Programs, ContractTest,
                         testing::Values(protocol::kSimProgram, protocol::kSynthProgram),
                         [](const auto& program) {
                           return program.param == protocol::kSimProgram ? "Simulator" : "Synth";
                         });

}  // namespace
}  // namespace splash::tests
