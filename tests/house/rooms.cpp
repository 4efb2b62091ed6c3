// SPDX-License-Identifier: MIT
#include "tests/house/rooms.hpp"

#include <algorithm>

namespace splash::house {
namespace {

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

const Room* find_room(std::string_view folder) {
  const auto found = std::find_if(rooms().begin(), rooms().end(),
                                  [&](const Room& room) { return room.folder == folder; });
  return found == rooms().end() ? nullptr : &*found;
}

bool is_ours(std::string_view header) {
  return lies_in_any(
      header, {"protocol", "sim-server", "synth-server", "view-server", "pd-patches", "tests"});
}

}  // namespace

const std::vector<Room>& rooms() {
  static const std::vector<Room> kRooms = {
      {"protocol", {}, {"yaml-cpp/"}},
      {"sim-server/scene", {"protocol"}, {}},
      {"sim-server/device", {}, {"CL/"}},
      // Trackers tell their poses in messages: as plain values, whatever brought them.
      {"sim-server/tracking",
       {"protocol/config.hpp", "protocol/message.hpp", "sim-server/scene"},
       {"Eigen/"}},
      {"sim-server/fluid", {"sim-server/scene", "sim-server/device"}, {"Random123/"}},
      // What the fluid gives a body to be sampled with, not the solver.
      {"sim-server/bodies",
       {"sim-server/scene", "sim-server/tracking", "sim-server/fluid/boundary_point.hpp",
        "sim-server/fluid/fluid_params.h", "sim-server/fluid/smoothing.hpp"},
       {}},
      {"sim-server/detect",
       {"sim-server/scene", "sim-server/device", "sim-server/bodies", "sim-server/fluid"},
       {}},
      {"sim-server/gauge",
       {"sim-server/scene", "sim-server/device", "sim-server/tracking", "sim-server/bodies",
        "sim-server/fluid", "protocol/write_error.hpp"},
       {}},
      {"sim-server/send", {"protocol"}, {"lo/", "nlohmann/"}},
      {"sim-server/show",
       {"protocol", "sim-server/scene", "sim-server/tracking", "sim-server/fluid",
        "sim-server/device"},
       {"nlohmann/"}},
      {"sim-server", {"protocol", "sim-server"}, {"CLI/"}},
      {"synth-server/voices", {"protocol/event.hpp"}, {}},
      {"synth-server/sound", {"protocol/config.hpp", "synth-server/voices"}, {}},
      {"synth-server/output",
       {"protocol/event.hpp", "protocol/config.hpp", "protocol/write_error.hpp"},
       {}},
      {"synth-server/render",
       {"protocol/event.hpp", "synth-server/voices", "synth-server/output"},
       {}},
      {"synth-server/replay",
       {"protocol/event_log.hpp", "synth-server/render", "synth-server/output"},
       {"boost/"}},
      {"synth-server/receive", {"protocol"}, {"oscpack/", "boost/"}},
      {"synth-server/audio",
       {"protocol/time_tag.hpp"},
       {"RtAudio", "rtaudio/", "jack/", "alsa/", "boost/"}},
      {"synth-server/figure", {}, {"kissfft/", "kiss_fft", "CLI/"}},
      {"synth-server", {"protocol", "synth-server"}, {"CLI/", "boost/", "nlohmann/"}},
      {"view-server", {"protocol"}, {"CLI/", "boost/"}},
      {"pd-patches", {"protocol"}, {"CLI/"}},
      {"tests", {"protocol", "sim-server", "synth-server", "view-server", "pd-patches"}, {}},
  };
  return kRooms;
}

std::vector<std::string_view> guarded_libraries() {
  std::vector<std::string_view> all;
  for (const Room& room : rooms()) {
    all.insert(all.end(), room.libraries.begin(), room.libraries.end());
  }
  return all;
}

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

bool renders(std::string_view room) {
  return room == "synth-server/voices" || room == "synth-server/render";
}

std::string complaint(std::string_view room, std::string_view header) {
  const Room* row = find_room(room);
  if (row == nullptr) {
    return "the folder " + std::string(room) + " has no row in tests/house/rooms.cpp";
  }
  if (is_ours(header)) {
    if (lies_in(header, room) || lies_in_any(header, row->knows)) return {};
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

std::string link_complaint(std::string_view room, std::string_view other) {
  const Room* row = find_room(room);
  if (row == nullptr) {
    return "the folder " + std::string(room) + " has no row in tests/house/rooms.cpp";
  }
  const bool known = std::any_of(row->knows.begin(), row->knows.end(), [&](std::string_view name) {
    return lies_in(other, name) || lies_in(name, other);
  });
  if (room == other || known) return {};
  return std::string(room) + " may not link " + std::string(other);
}

}  // namespace splash::house
