// SPDX-License-Identifier: MIT
// Dependencies point one way: every #include and every link against the house's plan.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "tests/house/source_tree.hpp"

namespace splash::house {
namespace {

/// A folder of sources, without those below it; the folders (with a / at the end: and all below
/// them) or single headers it may include besides its own; and the outer libraries (by the start of
/// their header names) it may use besides the C++ library.
struct Room {
  std::string_view folder;
  std::vector<std::string_view> knows;
  std::vector<std::string_view> libraries;
};

/// "a/b/c.hpp" lies in the folder "a/b", in "a/" with all that is below it, and is "a/b/c.hpp".
bool is_meant(std::string_view path, std::string_view name) {
  if (name.ends_with('/')) return path.starts_with(name);
  return path == name || path.substr(0, path.rfind('/')) == name;
}

/// "a/b" lies in "a", in "a/b" and nowhere else.
bool lies_in(std::string_view path, std::string_view folder) {
  return path == folder ||
         (path.starts_with(folder) && path.size() > folder.size() && path[folder.size()] == '/');
}

bool lies_in_any(std::string_view path, const std::vector<std::string_view>& folders) {
  return std::any_of(folders.begin(), folders.end(),
                     [&](std::string_view folder) { return lies_in(path, folder); });
}

bool starts_with_any(std::string_view header, const std::vector<std::string_view>& starts) {
  return std::any_of(starts.begin(), starts.end(),
                     [&](std::string_view start) { return header.starts_with(start); });
}

bool is_ours(std::string_view header) {
  return lies_in_any(header, {"program", "protocol", "sim-server", "synth-server", "view-server",
                              "pd-patches", "tests"});
}

/// The rows, in the order in which data flows.
const std::vector<Room>& rooms() {
  static const std::vector<Room> kRooms = {
      {"program", {}, {"CLI/", "yaml-cpp/"}},
      {"protocol", {"program"}, {}},

      {"sim-server/scene",
       {"program", "protocol", "sim-server/scene/keys", "sim-server/scene/mesh"},
       {}},
      {"sim-server/scene/keys", {}, {}},
      {"sim-server/scene/mesh", {"program", "sim-server/scene"}, {}},
      {"sim-server/device", {"program"}, {"CL/"}},
      // Trackers tell their poses in messages: as plain values, whatever brought them.
      {"sim-server/bodies/motion", {"program", "protocol/message.hpp", "sim-server/scene"}, {}},
      {"sim-server/bodies",
       {"sim-server/scene/", "sim-server/bodies/motion", "sim-server/fluid/params"},
       {}},
      // The stages of a step know the fluid that they work on, and the stages before them.
      {"sim-server/fluid",
       {"sim-server/scene", "sim-server/device", "sim-server/fluid/"},
       {"Random123/"}},
      {"sim-server/fluid/params",
       {"sim-server/scene", "sim-server/device", "sim-server/fluid/lanes"},
       {}},
      {"sim-server/fluid/lanes", {}, {}},
      {"sim-server/fluid/neighbours",
       {"sim-server/device", "sim-server/fluid/params", "sim-server/fluid/lanes"},
       {}},
      {"sim-server/fluid/boundary",
       {"sim-server/scene/", "sim-server/device", "sim-server/fluid", "sim-server/fluid/params",
        "sim-server/fluid/lanes", "sim-server/fluid/neighbours"},
       {}},
      {"sim-server/fluid/sleep",
       {"sim-server/device", "sim-server/fluid/params", "sim-server/fluid/lanes",
        "sim-server/fluid/neighbours", "sim-server/fluid/boundary"},
       {}},
      {"sim-server/fluid/pressure",
       {"sim-server/scene", "sim-server/device", "sim-server/fluid", "sim-server/fluid/params",
        "sim-server/fluid/lanes", "sim-server/fluid/neighbours", "sim-server/fluid/boundary",
        "sim-server/fluid/sleep", "sim-server/fluid/pressure/grid_projected"},
       {}},
      {"sim-server/fluid/pressure/grid_projected",
       {"sim-server/scene", "sim-server/device", "sim-server/fluid", "sim-server/fluid/params",
        "sim-server/fluid/lanes", "sim-server/fluid/neighbours", "sim-server/fluid/boundary",
        "sim-server/fluid/pressure"},
       {}},
      {"sim-server/fluid/free_bodies",
       {"sim-server/scene", "sim-server/device", "sim-server/fluid", "sim-server/fluid/params",
        "sim-server/fluid/lanes", "sim-server/fluid/neighbours", "sim-server/fluid/boundary"},
       {}},
      {"sim-server/fluid/health",
       {"sim-server/device", "sim-server/fluid", "sim-server/fluid/params",
        "sim-server/fluid/lanes", "sim-server/fluid/neighbours", "sim-server/fluid/boundary",
        "sim-server/fluid/sleep"},
       {}},
      {"sim-server/fluid/air", {"sim-server/scene", "sim-server/fluid/params"}, {}},
      {"sim-server/detect",
       {"protocol/event.hpp", "sim-server/scene", "sim-server/device", "sim-server/bodies",
        "sim-server/fluid/"},
       {}},
      {"sim-server/gauge",
       {"program", "sim-server/scene", "sim-server/device", "sim-server/bodies/",
        "sim-server/fluid/"},
       {}},
      {"sim-server/simulation/recovery",
       {"sim-server/scene", "sim-server/bodies", "sim-server/fluid/"},
       {}},
      {"sim-server/start",
       {"program", "sim-server/scene", "sim-server/device", "sim-server/bodies/",
        "sim-server/fluid/", "sim-server/simulation/recovery"},
       {}},
      {"sim-server/simulation",
       {"sim-server/scene", "sim-server/device", "sim-server/bodies/", "sim-server/fluid/",
        "sim-server/detect", "sim-server/start", "sim-server/simulation/recovery"},
       {}},
      {"sim-server/send", {"protocol"}, {"lo/"}},
      {"sim-server/listen", {"program", "protocol", "sim-server/send"}, {}},
      {"sim-server/show",
       {"program", "protocol", "sim-server/scene/", "sim-server/bodies/motion", "sim-server/fluid"},
       {"nlohmann/"}},
      {"sim-server/tracker_monitor", {"program", "protocol", "sim-server/scene"}, {"CLI/"}},
      {"sim-server/serve", {"program", "protocol", "sim-server/"}, {"nlohmann/"}},
      {"sim-server", {"program", "protocol", "sim-server/"}, {"CLI/"}},

      {"synth-server/voices", {"protocol/event.hpp"}, {}},
      {"synth-server/sound", {"program", "synth-server/voices"}, {}},
      {"synth-server/output", {"program", "protocol/event.hpp"}, {}},
      {"synth-server/render",
       {"protocol/event.hpp", "synth-server/voices", "synth-server/output"},
       {}},
      {"synth-server/replay",
       {"program", "protocol/event_log.hpp", "protocol/force_changes.hpp", "synth-server/render",
        "synth-server/output"},
       {"boost/"}},
      {"synth-server/audio",
       {"program", "protocol/time_tag.hpp"},
       {"RtAudio", "rtaudio/", "jack/", "alsa/", "boost/"}},
      // What runs on the audio thread: of the wire it knows events and their moments, no socket.
      {"synth-server/play",
       {"protocol/event.hpp", "protocol/time_tag.hpp", "synth-server/audio", "synth-server/render",
        "synth-server/output"},
       {"boost/lockfree/"}},
      {"synth-server/receive",
       {"program", "protocol", "synth-server/play"},
       {"oscpack/", "boost/"}},
      {"synth-server/figure", {"protocol/event_log.hpp"}, {"kissfft/", "kiss_fft", "CLI/"}},
      {"synth-server/serve",
       {"program", "protocol", "synth-server/options.hpp", "synth-server/voice_options.hpp",
        "synth-server/sound", "synth-server/output", "synth-server/render", "synth-server/replay",
        "synth-server/audio", "synth-server/play", "synth-server/receive"},
       {"boost/", "nlohmann/"}},
      {"synth-server/calibrate",
       {"program", "synth-server/options.hpp", "synth-server/output", "synth-server/audio",
        "synth-server/play", "synth-server/figure/wav_reader.hpp", "synth-server/serve"},
       {}},
      {"synth-server/pd_sound",
       {"program", "synth-server/sound", "synth-server/output", "synth-server/render"},
       {}},
      {"synth-server", {"program", "protocol", "synth-server/"}, {"CLI/", "boost/", "nlohmann/"}},

      {"view-server", {"program", "protocol"}, {"CLI/", "boost/", "nlohmann/"}},
      {"pd-patches", {"program", "protocol"}, {"CLI/"}},
      {"tests",
       {"program", "protocol", "sim-server/", "synth-server/", "view-server", "pd-patches"},
       {}},
  };
  return kRooms;
}

const Room* find_room(std::string_view folder) {
  const auto found = std::find_if(rooms().begin(), rooms().end(),
                                  [&](const Room& room) { return room.folder == folder; });
  return found == rooms().end() ? nullptr : &*found;
}

/// Outer libraries that belong to some rooms only: a room whose row does not name one may not
/// include it. Kept from the rows above.
std::vector<std::string_view> guarded_libraries() {
  std::vector<std::string_view> all;
  for (const Room& room : rooms()) {
    all.insert(all.end(), room.libraries.begin(), room.libraries.end());
  }
  return all;
}

/// Headers that stand for the operating system, threads, locks or streams: none of them may be
/// known where audio is rendered.
const std::vector<std::string_view>& banned_while_rendering() {
  static const std::vector<std::string_view> kBanned = {
      "thread",  "mutex",      "shared_mutex", "condition_variable",
      "future",  "semaphore",  "iostream",     "fstream",
      "sstream", "filesystem", "cstdio",       "stdio.h",
      "sys/",    "unistd.h",   "pthread.h",    "signal.h",
      "csignal", "netinet/",   "arpa/",        "regex",
      "chrono",  "random"};
  return kBanned;
}

/// True for the rooms whose code runs inside the audio callback.
bool renders(std::string_view room) {
  return room == "synth-server/voices" || room == "synth-server/render";
}

/// Empty when `room` may include `header`, else the sentence that says why not.
std::string complaint(std::string_view room, std::string_view header) {
  const Room* row = find_room(room);
  if (row == nullptr) {
    return "the folder " + std::string(room) + " has no row in tests/house/direction_test.cpp";
  }
  if (is_ours(header)) {
    const auto knows = [&](std::string_view name) { return is_meant(header, name); };
    if (knows(room) || std::any_of(row->knows.begin(), row->knows.end(), knows)) return {};
    if (room == "tests" && lies_in(header, room)) return {};
    return std::string(room) + " may not know " + std::string(header);
  }
  if (room == "tests") return {};
  if (starts_with_any(header, guarded_libraries()) && !starts_with_any(header, row->libraries)) {
    return std::string(room) + " may not use the library of <" + std::string(header) + ">";
  }
  const std::vector<std::string_view>& banned = banned_while_rendering();
  const bool is_banned = std::any_of(banned.begin(), banned.end(), [&](std::string_view name) {
    return name.ends_with('/') ? header.starts_with(name) : header == name;
  });
  if (renders(room) && is_banned) {
    return "<" + std::string(header) + "> has no place inside the audio callback";
  }
  return {};
}

/// Empty when a target of `room` may link a target that `other` defines, else why not.
std::string link_complaint(std::string_view room, std::string_view other) {
  const Room* row = find_room(room);
  if (row == nullptr) {
    return "the folder " + std::string(room) + " has no row in tests/house/direction_test.cpp";
  }
  const bool known = std::any_of(row->knows.begin(), row->knows.end(), [&](std::string_view name) {
    const std::string_view folder =
        name.substr(0, name.ends_with('/') ? name.size() - 1 : name.size());
    return lies_in(other, folder) || lies_in(folder, other);
  });
  if (room == other || known) return {};
  return std::string(room) + " may not link " + std::string(other);
}

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
  const auto files = read_files(SPLASH_SOURCE_DIR, {".hpp", ".cpp", ".def", ".h", ".cl"});
  ASSERT_GT(files.size(), 20U);
  EXPECT_THAT(include_complaints(files), IsEmpty());
}

TEST(Direction, LinksOfTheTreeFollowThePlan) {
  const auto files = read_files(SPLASH_SOURCE_DIR, {"CMakeLists.txt"});
  ASSERT_GT(targets_of(files).size(), 5U);
  EXPECT_THAT(link_complaints(files), IsEmpty());
}

}  // namespace
}  // namespace splash::house
