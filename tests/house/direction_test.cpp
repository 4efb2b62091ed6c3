// SPDX-License-Identifier: MIT
// Dependencies point one way: every #include and every link against the house's plan.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/house/rooms.hpp"
#include "tests/house/source_tree.hpp"

namespace splash::house {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> include_complaints(const std::vector<SourceFile>& files) {
  std::vector<std::string> complaints;
  for (const SourceFile& file : files) {
    for (const std::string& header : includes_of(file)) {
      const std::string said = complaint(room_of(file.path), header);
      if (!said.empty()) complaints.push_back(file.path + ": " + said);
    }
  }
  return complaints;
}

std::vector<std::string> link_complaints(const std::vector<SourceFile>& cmake_files) {
  std::vector<std::string> complaints;
  const auto targets = targets_of(cmake_files);
  for (const auto& [name, target] : targets) {
    for (const std::string& link : target.links) {
      const auto linked = targets.find(link);
      if (linked == targets.end()) continue;  // an outer library: its headers are checked instead
      const std::string said = link_complaint(target.folder, linked->second.folder);
      if (!said.empty()) complaints.push_back(name + ": " + said);
    }
  }
  return complaints;
}

TEST(Direction, IncludesOfTheTreeFollowThePlan) {
  const auto files = read_files(SPLASH_SOURCE_DIR, {".hpp", ".cpp", ".h", ".cl"});
  ASSERT_GT(files.size(), 20U);
  EXPECT_THAT(include_complaints(files), IsEmpty());
}

TEST(Direction, LinksOfTheTreeFollowThePlan) {
  const auto files = read_files(SPLASH_SOURCE_DIR, {"CMakeLists.txt"});
  ASSERT_GT(targets_of(files).size(), 5U);
  EXPECT_THAT(link_complaints(files), IsEmpty());
}

TEST(Direction, ServersNeverKnowEachOther) {
  const SourceFile sim{"sim-server/main.cpp", {R"(#include "synth-server/render/engine.hpp")"}};
  const SourceFile synth{"synth-server/server.cpp", {"#include \"sim-server/scene/scene.hpp\""}};
  EXPECT_THAT(include_complaints({sim, synth}),
              ElementsAre(HasSubstr("may not know synth-server/render/engine.hpp"),
                          HasSubstr("may not know sim-server/scene/scene.hpp")));
}

TEST(Direction, ProtocolKnowsProgramAlone) {
  EXPECT_THAT(complaint("protocol", "program/write_error.hpp"), IsEmpty());
  EXPECT_THAT(complaint("program", "protocol/limits.hpp"), HasSubstr("may not know"));
  EXPECT_THAT(complaint("protocol", "sim-server/scene/scene.hpp"), HasSubstr("may not know"));
  EXPECT_THAT(complaint("protocol", "protocol/event.hpp"), IsEmpty());
  EXPECT_THAT(complaint("protocol", "oscpack/osc/OscTypes.h"), HasSubstr("may not use"));
}

TEST(Direction, RenderingKnowsEventsVoicesAndOutputOnly) {
  EXPECT_THAT(complaint("synth-server/render", "protocol/event.hpp"), IsEmpty());
  EXPECT_THAT(complaint("synth-server/render", "synth-server/voices/bubble_tone.hpp"), IsEmpty());
  EXPECT_THAT(complaint("synth-server/render", "protocol/udp_socket.hpp"),
              HasSubstr("may not know"));
  EXPECT_THAT(complaint("synth-server/render", "protocol/event_log.hpp"),
              HasSubstr("may not know"));
  EXPECT_THAT(complaint("synth-server/replay", "protocol/event_log.hpp"), IsEmpty());
  EXPECT_THAT(complaint("synth-server/render", "synth-server/audio/rtaudio_device.hpp"),
              HasSubstr("may not know"));
  EXPECT_THAT(complaint("synth-server/voices", "mutex"), HasSubstr("audio callback"));
  EXPECT_THAT(complaint("synth-server/voices", "sys/socket.h"), HasSubstr("audio callback"));
  EXPECT_THAT(complaint("synth-server/audio", "mutex"), IsEmpty());
}

TEST(Direction, FluidDoesNotKnowWhatIsFoundInIt) {
  EXPECT_THAT(complaint("sim-server/detect", "sim-server/fluid/fluid.hpp"), IsEmpty());
  EXPECT_THAT(complaint("sim-server/fluid", "sim-server/detect/bubbles.hpp"),
              HasSubstr("may not know"));
  EXPECT_THAT(complaint("sim-server/bodies", "sim-server/fluid/params/smoothing.hpp"), IsEmpty());
  EXPECT_THAT(complaint("sim-server/bodies", "sim-server/fluid/fluid.hpp"),
              HasSubstr("may not know"));
  EXPECT_THAT(complaint("sim-server/send", "sim-server/fluid/fluid.hpp"),
              HasSubstr("may not know"));
}

TEST(Direction, StagesKnowThoseBeforeThem) {
  EXPECT_THAT(complaint("sim-server/fluid/boundary", "sim-server/fluid/neighbours/near.h"),
              IsEmpty());
  EXPECT_THAT(complaint("sim-server/fluid/neighbours", "sim-server/fluid/boundary/walls.h"),
              HasSubstr("may not know"));
  EXPECT_THAT(complaint("sim-server/detect", "sim-server/fluid/boundary/walls.h"), IsEmpty());
}

TEST(Direction, TheAudioThreadKnowsNoSocket) {
  EXPECT_THAT(complaint("synth-server/play", "protocol/event.hpp"), IsEmpty());
  EXPECT_THAT(complaint("synth-server/play", "protocol/udp_socket.hpp"), HasSubstr("may not know"));
  EXPECT_THAT(complaint("synth-server/play", "synth-server/receive/intake.hpp"),
              HasSubstr("may not know"));
  EXPECT_THAT(complaint("synth-server/receive", "synth-server/play/command_queue.hpp"), IsEmpty());
}

TEST(Direction, FolderWithoutRowIsRefused) {
  EXPECT_THAT(complaint("sim-server/attic", "vector"), HasSubstr("has no row"));
  EXPECT_THAT(complaint("sim-server/fluid/attic", "vector"), HasSubstr("has no row"));
}

TEST(Direction, ReadsLinksOfEveryKindOfCall) {
  const SourceFile fluid{"sim-server/fluid/CMakeLists.txt",
                         {"splash_library(sim_fluid SOURCES a.cpp", "  LINK sim_device m)"}};
  const SourceFile device{"sim-server/device/CMakeLists.txt",
                          {"splash_library(sim_device SOURCES b.cpp)", "# LINK sim_fluid",
                           "target_link_libraries(sim_device PRIVATE sim_fluid)"}};
  EXPECT_THAT(targets_of({fluid, device}).at("sim_fluid").links, ElementsAre("sim_device", "m"));
  EXPECT_THAT(link_complaints({fluid, device}),
              ElementsAre("sim_device: sim-server/device may not link sim-server/fluid"));
}

}  // namespace
}  // namespace splash::house
