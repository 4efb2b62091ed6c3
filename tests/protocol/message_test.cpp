// SPDX-License-Identifier: MIT
// Messages to bytes and back; events, frames and poses to messages and back.
#include "protocol/message.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <utility>
#include <variant>

#include "protocol/address.hpp"
#include "protocol/limits.hpp"
#include "tests/protocol/raw_packet.hpp"

namespace splash::protocol::test {
namespace {

const Impact kImpact{16777215, 1, 2.5F, 1.25F, {0.1F, -0.2F, 0.3F}, 3.5F, 0.43F, 0.003F};
const Bubble kBubble{42, -1, 0.0031F, 0.05F, {-1.0F, 2.0F, 0.0F}, 0.0F};
const Cavity kCavity{7, 0, 0.05F, 0.1F, {0.0F, 0.0F, 0.2F}, 9.0F, 0.15F};
const Frame kFrame{123456, 16777215, 77, 12.5F};
const BodyPose kPose{3, {1.0F, 2.0F, 3.0F}, 0.0F, 0.6F, 0.0F, 0.8F};

void expect_whole(const Message& message) {
  const auto* row = find_address(message.address);
  ASSERT_NE(row, nullptr) << message.address;
  EXPECT_EQ(message.arguments.size(), row->arguments.size()) << message.address;
}

template <std::size_t... kinds>
void expect_whole_events(std::index_sequence<kinds...> /*all*/) {
  const auto expect = [](const Event& event) {
    const Message message = to_message(event);
    expect_whole(message);
    EXPECT_TRUE(is_event(message.address));
  };
  (expect(std::variant_alternative_t<kinds, Event>()), ...);
}

// What has a row and no member, or the other way round, would be lost on the way.
TEST(Messages, HaveTheArgumentsOfTheirRow) {
  expect_whole_events(std::make_index_sequence<kEventKinds>());
  expect_whole(to_message(kFrame));
  expect_whole(to_message(kPose));
  EXPECT_FALSE(is_event("/frame"));
  EXPECT_FALSE(is_event("/impacts"));
}

TEST(Encode, BytesOfAnImpact) {
  const Raw expected = padded("/impact") + padded(",iiffffffff") + word(1) + word(2) +
                       word(0x3f800000) + word(0x3f000000) + word(0) + word(0x80000000) +
                       word(0x40000000) + word(0x3e800000) + word(0x40800000) + word(0);
  EXPECT_EQ(encode(to_message(Impact{1, 2, 1.0F, 0.5F, {0.0F, -0.0F, 2.0F}, 0.25F, 4.0F})),
            expected);
}

TEST(Encode, SizesAreToldBeforehand) {
  for (const std::size_t length : {0U, 1U, 3U, 4U, 7U, 64U}) {
    const Message one{"/a/bc", {1, 2.0F, std::string(length, 'x'), TimeTag{5}}};
    EXPECT_EQ(encode(one).size(), encoded_size(one)) << length;
    EXPECT_EQ(encode(TimeTag{9}, {one, one}).size(), 16 + 2 * (4 + encoded_size(one)));
  }
}

TEST(Encode, BundleComesBack) {
  const std::vector<Message> sent = {to_message(kFrame),
                                     to_message(kImpact),
                                     to_message(kBubble),
                                     {"/mixed", {1, -2.5F, std::string("text"), TimeTag{77}}}};
  const auto result = decode(encode(TimeTag{0x123456789abcdef0ULL}, sent));
  ASSERT_EQ(result.refusal, Refusal::none);
  EXPECT_EQ(result.packet.time, TimeTag{0x123456789abcdef0ULL});
  EXPECT_EQ(result.packet.messages, sent);
}

TEST(Encode, BareMessageAndEmptyBundleComeBack) {
  const auto bare = decode(encode(to_message(kPose)));
  EXPECT_FALSE(bare.packet.time);
  EXPECT_EQ(bare.packet.messages, std::vector<Message>{to_message(kPose)});
  const auto empty = decode(encode(kImmediately, {}));
  EXPECT_EQ(empty.refusal, Refusal::none);
  EXPECT_EQ(empty.packet.time, kImmediately);
  EXPECT_TRUE(empty.packet.messages.empty());
}

TEST(Encode, RefusesWhatTheGateWould) {
  const std::vector<Message> wrong = {
      {"impact", {}},
      {"/im pact", {}},
      {"/impact*", {}},
      {"/" + std::string(64, 'a'), {}},
      {"/a", {std::numeric_limits<float>::quiet_NaN()}},
      {"/a", {std::numeric_limits<float>::infinity()}},
      {"/a", {std::string(65, 'x')}},
      {"/a", {std::string("\n")}},
      {"/a", {std::string("x\0y", 3), 1}},
      {"/a", std::vector<Argument>(25, Argument{1})},
  };
  for (const auto& one : wrong) {
    EXPECT_THROW((void)encode(one), std::length_error) << one.address;
    EXPECT_THROW((void)encode(kImmediately, {one}), std::length_error) << one.address;
  }
  EXPECT_THROW((void)encode(kImmediately, std::vector<Message>(65, {"/a", {}})), std::length_error);
  EXPECT_THROW((void)encode(kImmediately, std::vector<Message>(27, to_message(kBubble))),
               std::length_error);
}

TEST(Encode, TwentyFiveBubblesAndAFrameFitADatagram) {
  std::vector<Message> messages(25, to_message(kBubble));
  messages.insert(messages.begin(), to_message(kFrame));
  EXPECT_LE(encode(kImmediately, messages).size(), kMaxDatagram);
}

TEST(Encode, ErrorSaysWhatAndWhy) {
  EXPECT_THAT(
      [] {
        (void)encode(Message{"/a", {std::numeric_limits<float>::infinity()}});
      },
      testing::ThrowsMessage<std::length_error>(
          "cannot send message '/a' (12 bytes): a number is NaN or infinite"));
}

TEST(Decode, SaysWhyAndGivesNothing) {
  const auto result = decode(bytes("hello"));
  EXPECT_EQ(result.refusal, Refusal::not_aligned);
  EXPECT_TRUE(result.packet.messages.empty());
  EXPECT_FALSE(result.packet.time);
}

TEST(EventMessage, EventsComeBack) {
  for (const Event& event : {Event{kImpact}, Event{kBubble}, Event{kCavity}}) {
    const auto decoded = decode(encode(to_message(event)));
    ASSERT_EQ(decoded.packet.messages.size(), 1U);
    EXPECT_EQ(to_event(decoded.packet.messages[0]), event);
    EXPECT_FALSE(to_frame(decoded.packet.messages[0]));
    EXPECT_FALSE(to_body_pose(decoded.packet.messages[0]));
  }
  EXPECT_EQ(to_frame(to_message(kFrame)), kFrame);
  EXPECT_EQ(to_body_pose(to_message(kPose)), kPose);
  EXPECT_FALSE(to_event(to_message(kFrame)));
}

// Logs and senders that do not know the later fields leave them out.
TEST(EventMessage, FieldsAtTheEndMayBeMissing) {
  Message impact = to_message(kImpact);
  impact.arguments.resize(8);
  Impact known = kImpact;
  known.momentum = known.rise = 0.0F;
  EXPECT_EQ(to_event(impact), Event{known});
  Message cavity = to_message(kCavity);
  cavity.arguments.resize(8);
  Cavity without_life = kCavity;
  without_life.life = 0.0F;
  EXPECT_EQ(to_event(cavity), Event{without_life});
  impact.arguments.pop_back();
  EXPECT_FALSE(to_event(impact));
}

TEST(EventMessage, WrongTypesAndCountsAreRefused) {
  const Message right = to_message(kBubble);
  for (std::size_t i = 0; i < right.arguments.size(); ++i) {
    Message wrong = right;
    if (std::holds_alternative<float>(wrong.arguments[i])) {
      wrong.arguments[i] = 1;
    } else {
      wrong.arguments[i] = 1.0F;
    }
    EXPECT_FALSE(to_event(wrong)) << i;
  }
  Message shorter = right;
  shorter.arguments.pop_back();
  EXPECT_FALSE(to_event(shorter));
  Message longer = right;
  longer.arguments.emplace_back(1.0F);
  EXPECT_FALSE(to_event(longer));
  Message other = right;
  other.address = "/bubbles";
  EXPECT_FALSE(to_event(other));
}

// What an event is checked by before it is sent is what its receiver checks its message by.
TEST(EventMessage, AnEventConformsWhenItsMessageDoes) {
  const Impact impact{1, 0, 3.0F, 2.0F, {0.1F, 0.2F, 0.3F}, 1.5F, 4.0F, 0.01F};
  const Bubble bubble{1, -1, 0.005F, 0.1F, {0.1F, 0.2F, 0.3F}, 1.5F};
  const Cavity cavity{1, 2, 0.05F, 0.1F, {0.1F, 0.2F, 0.3F}, 1.5F, 0.2F};
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  std::vector<Event> events = {impact, bubble, cavity};
  for (const float wrong : {-1.0e9F, 1.0e9F, kNan, std::numeric_limits<float>::infinity()}) {
    for (float Impact::*const field : {&Impact::speed, &Impact::approach, &Impact::offset_ms,
                                       &Impact::momentum, &Impact::rise}) {
      Impact changed = impact;
      changed.*field = wrong;
      events.emplace_back(changed);
    }
    for (float Bubble::*const field : {&Bubble::radius, &Bubble::epsilon, &Bubble::offset_ms}) {
      Bubble changed = bubble;
      changed.*field = wrong;
      events.emplace_back(changed);
    }
    for (float Vec3::*const axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
      Cavity changed = cavity;
      changed.position.*axis = wrong;
      events.emplace_back(changed);
    }
    Cavity changed = cavity;
    changed.life = wrong;
    events.emplace_back(changed);
  }
  Impact numbered = impact;
  numbered.body = 256;
  events.emplace_back(numbered);
  int good = 0;
  for (const Event& event : events) {
    EXPECT_EQ(conforms(event), to_event(to_message(event)).has_value()) << good;
    good += conforms(event) ? 1 : 0;
  }
  EXPECT_EQ(good, 3) << "of " << events.size();
}

TEST(EventMessage, TheOffsetIsSetInTheMessage) {
  for (Event event : {Event(Impact()), Event(Bubble()), Event(Cavity())}) {
    Message message = to_message(event);
    set_offset(message, 12.5F);
    std::visit([](auto& record) { record.offset_ms = 12.5F; }, event);
    EXPECT_EQ(message, to_message(event));
  }
}

TEST(EventMessage, AFrameOfSessionZeroIsRefused) {
  EXPECT_FALSE(to_frame(to_message(Frame{0, 1, 1, 0.0F})));
  EXPECT_FALSE(to_frame(to_message(Frame{1, 1, 1, 10001.0F})));
}

TEST(EventMessage, AQuaternionThatIsNoRotationIsRefused) {
  BodyPose pose = kPose;
  pose.qw = 0.0F;
  EXPECT_FALSE(to_body_pose(to_message(pose)));
  pose = {1, {}, 0.0F, 0.0F, 0.0F, 0.0F};
  EXPECT_FALSE(to_body_pose(to_message(pose)));
  pose = {1, {}, 0.0F, 0.0F, 0.0F, 1.005F};
  EXPECT_TRUE(to_body_pose(to_message(pose)));
  pose = {1, {}, 0.5F, 0.5F, 0.5F, 0.7F};
  EXPECT_FALSE(to_body_pose(to_message(pose)));
}

TEST(EventMessage, AQuaternionThatIsALittleOffIsBroughtToUnitLength) {
  for (const float size : {0.91F, 0.98F, 1.02F, 1.09F}) {
    const auto pose =
        to_body_pose(to_message(BodyPose{1, {}, 0.0F, 0.6F * size, 0.0F, 0.8F * size}));
    ASSERT_TRUE(pose) << size;
    EXPECT_NEAR(pose->qy, 0.6F, 1.0e-6F);
    EXPECT_NEAR(pose->qw, 0.8F, 1.0e-6F);
  }
  EXPECT_TRUE(to_body_pose(to_message(BodyPose{1, {}, 0.0F, 0.0F, 0.0F, 1.09F})));
  EXPECT_FALSE(to_body_pose(to_message(BodyPose{1, {}, 0.0F, 0.0F, 0.0F, 0.89F})));
}

}  // namespace
}  // namespace splash::protocol::test
