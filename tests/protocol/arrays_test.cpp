// SPDX-License-Identifier: MIT
// Arrays of OSC are read as their elements, in messages and bundles, and what is no packet stays
// what it is.
#include "protocol/arrays.hpp"

#include <gtest/gtest.h>

#include <string>

namespace splash::protocol {
namespace {

using namespace std::string_literals;

Bytes bytes(const std::string& text) {
  return std::as_bytes(std::span(text));
}

std::string text(const std::optional<std::vector<std::byte>>& packet) {
  if (!packet) return "none";
  std::string text;
  for (const std::byte byte : *packet) text += static_cast<char>(byte);
  return text;
}

const std::string kArray = "/a\0\0,[ff]\0\0\0\x3f\x80\0\0\x40\0\0\0"s;
const std::string kPlain = "/a\0\0,ff\0\x3f\x80\0\0\x40\0\0\0"s;

TEST(Arrays, AreTheirElements) {
  EXPECT_EQ(text(without_arrays(bytes(kArray))), kPlain);
  EXPECT_EQ(text(without_arrays(bytes("/a\0\0,[[]]\0\0\0"s))), "/a\0\0,\0\0\0"s);
  const std::string head = "#bundle\0\0\0\0\0\0\0\0\1"s;
  EXPECT_EQ(text(without_arrays(bytes(head + "\0\0\0\x14"s + kArray + "\0\0\0\x10"s + kPlain))),
            head + "\0\0\0\x10"s + kPlain + "\0\0\0\x10"s + kPlain);
}

TEST(Arrays, AreReadWhereTheGateKnowsNone) {
  EXPECT_EQ(decode(bytes(kArray)).refusal, Refusal::bad_tags);
  const DecodeResult read = decode_with_arrays(bytes(kArray));
  EXPECT_EQ(read.refusal, Refusal::none);
  EXPECT_EQ(read.packet.messages, decode(bytes(kPlain)).packet.messages);
}

TEST(Arrays, WhatHasNoneOrIsNoPacketIsLeft) {
  EXPECT_FALSE(without_arrays(bytes(kPlain)));
  EXPECT_FALSE(without_arrays({}));
  EXPECT_FALSE(without_arrays(bytes("/a[b"s)));
  EXPECT_FALSE(without_arrays(bytes("/a\0\0[f]\0"s)));
  EXPECT_FALSE(without_arrays(bytes("/a\0\0,][\0"s)));
  EXPECT_FALSE(without_arrays(bytes("/a\0\0,[[]\0\0\0\0"s)));
  EXPECT_FALSE(without_arrays(bytes("#bundle[")));
  EXPECT_FALSE(without_arrays(bytes("#bundle\0\0\0\0\0\0\0\0\1\0\0\0\x18"s + kArray)));
  EXPECT_FALSE(without_arrays(bytes("#bundle\0\0\0\0\0\0\0\0\1\0\0\0\0"s + kArray)));
  for (std::size_t size = 0; size < kArray.size(); ++size) {
    EXPECT_NE(decode_with_arrays(bytes(kArray.substr(0, size))).refusal, Refusal::none) << size;
  }
  EXPECT_EQ(decode_with_arrays(bytes("/a\0\0,[T]\0\0\0\0"s)).refusal, Refusal::bad_tags);
}

}  // namespace
}  // namespace splash::protocol
