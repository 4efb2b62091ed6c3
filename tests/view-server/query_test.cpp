// SPDX-License-Identifier: MIT
// The tree as a client of OSCQuery reads it, which knows nothing of splash.
#include "view-server/query.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "protocol/address.hpp"
#include "protocol/status.hpp"
#include "tests/support/text_of.hpp"
#include "view-server/admission.hpp"

namespace splash::view {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kPort = 8080;

Known known() {
  Known all;
  note_rig(R"({"rows": [{"name": "impact/q", "min": 0.6, "max": 50, "value": 5, "unit": "1",
                         "meaning": "its sharpness"},
                        {"name": "rig/floor/gain_db", "min": -60, "max": 60, "value": -6.5,
                         "unit": "dB", "meaning": "of all channels"}, {"name": 7}]})",
           all);
  note_scene(R"({"rows": [{"name": "detect/bubble_speed", "min": 0, "max": 100, "value": 0.5,
                           "unit": "m/s", "meaning": "slower ones make none"}]})",
             all);
  protocol::SimStatus status;
  status.particles = 6960;
  all.sim = protocol::to_message(status);
  return all;
}

Json get(std::string_view path, std::string_view attribute = "") {
  const Answer answer = query(known(), path, attribute, kPort);
  EXPECT_EQ(answer.status, 200) << path;
  return Json::parse(answer.json, nullptr, false);
}

/// Every node has what the proposal requires, and lies where its path says.
int check(const Json& node, const std::string& path) {
  EXPECT_EQ(node.at("FULL_PATH"), path.empty() ? "/" : path);
  EXPECT_EQ(get(path.empty() ? "/" : path), node) << "the same, asked for alone";
  int leaves = 0;
  if (node.contains("TYPE")) {
    ++leaves;
    const auto types = node.at("TYPE").get<std::string>();
    EXPECT_EQ(node.at("RANGE").size(), types.size()) << path;
    EXPECT_THAT(node.at("DESCRIPTION").get<std::string>(), testing::Not(IsEmpty())) << path;
    EXPECT_GT(node.at("ACCESS").get<int>(), 0) << path;
    EXPECT_THAT(types, testing::MatchesRegex("[ifs]*")) << path;
  }
  if (!node.contains("CONTENTS")) return leaves;
  for (const auto& [name, child] : node.at("CONTENTS").items()) {
    leaves += check(child, path + '/' + name);
  }
  return leaves;
}

TEST(Query, TheTreeIsWhole) {
  // Commands and events, the fields of both statuses, and the rows.
  const std::size_t fields =
      protocol::sim_status_fields().size() + protocol::synth_status_fields().size() - 2;
  EXPECT_EQ(check(get("/"), ""), static_cast<int>(9 + 3 + fields + 3));
}

TEST(Query, ANumberHasItsRangeUnitAndValue) {
  const Json node = get("/synth/impact/q");
  EXPECT_EQ(node.at("TYPE"), "f");
  EXPECT_EQ(node.at("ACCESS"), 3);
  EXPECT_EQ(node.at("VALUE"), Json({5.0}));
  EXPECT_EQ(node.at("RANGE"), Json::parse(R"([{"MIN": 0.6, "MAX": 50.0}])"));
  EXPECT_EQ(node.at("DESCRIPTION"), "its sharpness");
  EXPECT_EQ(get("/synth/rig/floor/gain_db", "VALUE"), Json::parse(R"({"VALUE": [-6.5]})"));
  EXPECT_EQ(get("/sim/status/particles", "VALUE"), Json::parse(R"({"VALUE": [6960]})"));
  EXPECT_EQ(get("/sim/detect/bubble_speed").at("RANGE"),
            Json::parse(R"([{"MIN": 0.0, "MAX": 100.0}])"));
  EXPECT_EQ(get("/sim/detect/bubble_speed").at("VALUE"), Json({0.5}));
  EXPECT_EQ(get("/sim/pause").at("RANGE"), Json::parse(R"([{"MIN": 0.0, "MAX": 1.0}])"));
}

TEST(Query, TellsWhatItCanAndWhatItHasNot) {
  const Json info = get("/synth", "HOST_INFO");
  EXPECT_EQ(info.at("OSC_PORT"), kPort);
  EXPECT_TRUE(info.at("EXTENSIONS").at("RANGE").get<bool>());
  EXPECT_FALSE(info.at("EXTENSIONS").at("PATH_CHANGED").get<bool>());
  EXPECT_EQ(query(known(), "/synth/impact/z", "", kPort).status, 404);
  EXPECT_EQ(query(known(), "/synth/impact", "VALUE", kPort).status, 204) << "a folder";
  EXPECT_EQ(query(known(), "/synth/impact/q", "COLOUR", kPort).status, 400);
  EXPECT_EQ(query(known(), "//", "", kPort).status, 404);
  EXPECT_THAT(query(Known(), "/synth/impact/q", "", kPort).json, IsEmpty()) << "no synth has told";
}

TEST(Query, WhatCanBeWrittenGoesWhereItBelongs) {
  EXPECT_EQ(meant({"/synth/impact/q", {7.0F}}), (protocol::Message{"/set", {"impact/q", 7.0F}}));
  EXPECT_EQ(meant({"/synth/impact/q", {7}}), (protocol::Message{"/set", {"impact/q", 7.0F}}));
  EXPECT_EQ(meant({"/sim/detect/bubble_speed", {0.7F}}),
            (protocol::Message{"/param", {"detect/bubble_speed", 0.7F}}));
  EXPECT_FALSE(meant({"/synth/detect/bubble_speed", {0.7F}}));
  EXPECT_FALSE(meant({"/sim/impact/q", {0.7F}}));
  EXPECT_EQ(told_as({"/value", {"detect/bubble_speed", 0.7F}}), "/sim/detect/bubble_speed");
  EXPECT_EQ(meant({"/sim/pause", {1}}), (protocol::Message{"/pause", {1}}));
  EXPECT_FALSE(meant({"/pause", {1}}));
  EXPECT_FALSE(meant({"/sim/quit", {}}));
  EXPECT_FALSE(meant({"/synth/quit", {}}));
  EXPECT_FALSE(meant({"/simpause", {1}}));
  EXPECT_EQ(told_as({"/value", {"impact/q", 7.0F}}), "/synth/impact/q");
  EXPECT_EQ(told_as({"/impact", {}}), "/sim/impact");
  EXPECT_EQ(told_as({"/frame", {}}), "");
  // What the tree says can be written is what a page may say.
  for (const protocol::AddressRow& row : protocol::address_table()) {
    for (const char* program : {"/sim", "/synth"}) {
      const std::string path = program + std::string(row.address);
      const Answer answer = query(known(), path, "ACCESS", kPort);
      if (answer.status != 200 || Json::parse(answer.json).at("ACCESS") != 2) continue;
      EXPECT_NE(admit(protocol::encode(protocol::Message{std::string(row.address), {}})).reason,
                "a page may not say this")
          << path;
    }
  }
}

TEST(Query, ABrokenRigSaysNothing) {
  Known all;
  for (const char* text : {"", "{", "[]", "{\"rows\": 3}", "{\"rows\": [[]]}"}) {
    note_rig(text, all);
    EXPECT_THAT(all.rows, IsEmpty()) << text;
  }
}

// The page draws each kind by its address.
TEST(Page, DrawsRingsForEachKindOfEvent) {
  for (const char* name : {"main.js", "rings.js"}) {
    const std::string text =
        tests::text_of(std::filesystem::path(SPLASH_SOURCE_DIR) / "view-server/page" / name);
    std::vector<int> lists;  // in which each kind stands
    for (const protocol::KindNames& kind : protocol::kKindNames) {
      const std::string entry = "'" + std::string(kind.address) + "': ";
      int count = 0;
      for (std::size_t at = text.find(entry); at != std::string::npos; ++count) {
        at = text.find(entry, at + 1);
      }
      lists.push_back(count);
    }
    EXPECT_GT(lists.front(), 0) << name;
    EXPECT_THAT(lists, testing::Each(lists.front())) << name;
  }
}

}  // namespace
}  // namespace splash::view
