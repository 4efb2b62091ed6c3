// SPDX-License-Identifier: MIT
// The table against the gate's rules, against itself, and against the README that is made of it.
#include "protocol/address.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "protocol/limits.hpp"
#include "tests/support/text_of.hpp"

namespace splash::protocol {
namespace {

Message example(const AddressRow& row, bool largest) {
  Message message{std::string(row.address), {}};
  for (const auto& argument : row.arguments) {
    const double value = largest ? argument.max : argument.min;
    if (argument.type == 'i') message.arguments.emplace_back(static_cast<std::int32_t>(value));
    if (argument.type == 'f') message.arguments.emplace_back(static_cast<float>(value));
    if (argument.type == 's') message.arguments.emplace_back(std::string(argument.fixed));
    if (argument.type == 't') message.arguments.emplace_back(TimeTag{1});
  }
  return message;
}

TEST(AddressTable, EveryRowKeepsTheWiresLimits) {
  for (const auto& row : address_table()) {
    SCOPED_TRACE(row.address);
    EXPECT_LE(row.arguments.size(), kMaxArguments);
    EXPECT_FALSE(row.meaning.empty());
    for (const bool largest : {false, true}) {
      const auto message = example(row, largest);
      EXPECT_EQ(decode(encode(message)).packet.messages.at(0), message);
      EXPECT_TRUE(conforms(message, row));
      EXPECT_FALSE(violation(message)) << *violation(message);
    }
    std::set<std::string_view> names;
    for (const auto& argument : row.arguments) {
      EXPECT_TRUE(names.insert(argument.name).second) << argument.name;
      EXPECT_FALSE(argument.meaning.empty()) << argument.name;
      EXPECT_LE(argument.min, argument.max) << argument.name;
    }
  }
}

// Vanilla Pd, Unity and others know no time tags as arguments: only control has them.
TEST(AddressTable, EventsUseOnlyIntegersAndFloats) {
  for (const auto& row : address_table()) {
    if (row.direction != Direction::to_synth) continue;
    EXPECT_EQ(type_tags(row).find_first_not_of(",if"), std::string::npos) << row.address;
  }
}

TEST(AddressTable, AMisreadMessageIsToldAllTypesOfItsAddress) {
  EXPECT_EQ(violation({"/body/pose", {1, 2}}), "types are ,ii, expected ,ifffffff or ,sfffffff");
  EXPECT_EQ(violation({"/body/pose", {300, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 1.0F}}),
            "body 300, allowed 0 to 255");
}

TEST(AddressTable, OneStepOutsideEachBoundIsAViolation) {
  int tried = 0;
  for (const auto& row : address_table()) {
    for (std::size_t i = 0; i < row.arguments.size(); ++i) {
      const char type = row.arguments[i].type;
      if (type != 'f' && type != 'i') continue;
      for (const bool largest : {false, true}) {
        auto message = example(row, largest);
        if (type == 'f') {
          const auto bound = std::get<float>(message.arguments[i]);
          message.arguments[i] = std::nextafter(bound, largest ? 1e30F : -1e30F);
        } else {
          const std::int64_t bound = std::get<std::int32_t>(message.arguments[i]);
          const std::int64_t beyond = bound + (largest ? 1 : -1);
          const auto sent = static_cast<std::int32_t>(beyond);
          if (sent != beyond) continue;  // every number is allowed
          message.arguments[i] = sent;
        }
        EXPECT_FALSE(conforms(message, row)) << row.address << ' ' << row.arguments[i].name;
        EXPECT_TRUE(violation(message)) << row.address << ' ' << row.arguments[i].name;
        ++tried;
      }
    }
  }
  EXPECT_GT(tried, 60);
}

// What fills a question up is text behind all the arguments of its row.
TEST(AddressTable, OnlyCommandsMayBeFilledUp) {
  int commands = 0;
  for (const auto& row : address_table()) {
    SCOPED_TRACE(row.address);
    commands += is_command(row) ? 1 : 0;
    auto message = example(row, false);
    while (message.arguments.size() < kMaxArguments) {
      message.arguments.emplace_back(std::string(kMaxString, 'x'));
      EXPECT_EQ(conforms(message, row), is_command(row));
      EXPECT_EQ(violation(message).has_value(), !is_command(row));
      for (const Argument& other : {Argument(1), Argument(1.0F), Argument(TimeTag{1})}) {
        auto wrong = message;
        wrong.arguments.back() = other;
        EXPECT_FALSE(conforms(wrong, row)) << type_tags(wrong);
        const bool sets = type_tags(wrong) == ",sf" && row.address == "/param";  // its other row
        EXPECT_EQ(violation(wrong).has_value(), !sets) << type_tags(wrong);
      }
    }
  }
  EXPECT_EQ(commands, 22) << "/notify /status /version /sync /clearSched /mute /set /get /preset "
                             "/tone /pause /reset /body/grab /param (two) /scene /rig (two) "
                             "/dumpOSC /error /quit /ping";
}

TEST(AddressTable, FillingDoesNotStandInForArguments) {
  EXPECT_TRUE(violation({"/sync", {std::string("x")}}));
  EXPECT_TRUE(violation({"/dumpOSC", {7, std::string("x")}})) << "out of range";
  EXPECT_FALSE(violation({"/dumpOSC", {3, std::string("x")}}));
}

TEST(Violation, SaysWhatIsAllowed) {
  auto message = to_message(Impact{1, 0, 120.0F, 1.0F, {}, 0.0F});
  EXPECT_EQ(violation(message), "speed 120 m/s, allowed 0 to 100");
  message.arguments[2] = 5;
  EXPECT_EQ(violation(message), "types are ,iiifffffff, expected ,iiffffffff");
  EXPECT_EQ(violation({"/impakt", {}}), "unknown address");
  EXPECT_EQ(violation({"/dumpOSC", {7}}), "level 7, allowed 0 to 3");
  EXPECT_FALSE(violation({"/done", {std::string("/quit")}}));
  EXPECT_FALSE(violation({"/done", {std::string("/notify"), 1}}));
  EXPECT_TRUE(violation({"/done", {}}));
}

TEST(Readme, HoldsTheReferenceAsThePrograms) {
  EXPECT_THAT(tests::text_of(SPLASH_SOURCE_DIR "/protocol/README.md"),
              testing::HasSubstr("<!-- begin: protocol-reference -->\n\n" + address_reference() +
                                 "\n<!-- end: protocol-reference -->\n"))
      << "run protocol-reference and put its output between the markers";
}

}  // namespace
}  // namespace splash::protocol
