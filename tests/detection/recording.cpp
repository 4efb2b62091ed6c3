// SPDX-License-Identifier: MIT
#include "tests/detection/recording.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "program/text.hpp"
#include "tests/support/scene_text.hpp"

namespace splash::detection {
namespace {

constexpr double kMillimetres = 1000.0;

template <class Visit>
void for_each_place(sim::MarkerRecording& recording, Visit visit) {
  for (auto& frame : recording.frames) {
    for (auto& place : frame) {
      if (place) visit(*place);
    }
  }
}

}  // namespace

sim::MarkerRecording played(sim::MarkerRecording recording, const Play& play) {
  if (play.backwards) std::reverse(recording.frames.begin(), recording.frames.end());
  if (play.mirrored) for_each_place(recording, [](sim::Vector3& place) { place[1] = -place[1]; });
  if (play.over) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for_each_place(recording, [&](const sim::Vector3& place) {
      low = std::min(low, place[2]);
      high = std::max(high, place[2]);
    });
    // Half a turn about x, so that right and left hands stay what they are.
    for_each_place(recording, [&](sim::Vector3& place) {
      place = {place[0], -place[1], low + high - place[2]};
    });
  }
  recording.rate *= play.pace;
  const double first = recording.times.front();
  for (double& time : recording.times) time = (time - first) / play.pace;
  return recording;
}

void write_trc(const sim::MarkerRecording& recording, const std::filesystem::path& path) {
  std::ofstream file(path);
  file << "PathFileType\t4\t(X/Y/Z)\t" << path.filename().string()
       << "\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
          "OrigNumFrames\n"
       << program::format("%.9g\t%.9g\t%zu\t%zu\tmm\t%.9g\t1\t%zu\n", recording.rate,
                          recording.rate, recording.frames.size(), recording.names.size(),
                          recording.rate, recording.frames.size())
       << "Frame#\tTime";
  for (const std::string& name : recording.names) file << '\t' << name << "\t\t";
  file << "\n\t";
  for (std::size_t k = 1; k <= recording.names.size(); ++k) {
    file << "\tX" << k << "\tY" << k << "\tZ" << k;
  }
  file << "\n\n";
  for (std::size_t k = 0; k < recording.frames.size(); ++k) {
    file << program::format("%zu\t%.6f", k + 1, recording.times[k]);
    for (const auto& place : recording.frames[k]) {
      if (place) {
        file << program::format("\t%.4f\t%.4f\t%.4f", kMillimetres * (*place)[0],
                                kMillimetres * (*place)[2], -kMillimetres * (*place)[1]);
      } else {
        file << "\t\t\t";
      }
    }
    file << '\n';
  }
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

Region region_of(const sim::MarkerRecording& recording, const std::vector<std::string>& markers) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Region region = {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (std::size_t m = 0; m < recording.names.size(); ++m) {
    if (std::find(markers.begin(), markers.end(), recording.names[m]) == markers.end()) continue;
    for (const auto& frame : recording.frames) {
      if (!frame[m]) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        region.lower[axis] = std::min(region.lower[axis], (*frame[m])[axis]);
        region.upper[axis] = std::max(region.upper[axis], (*frame[m])[axis]);
      }
    }
  }
  if (region.lower[0] > region.upper[0]) {
    throw std::invalid_argument("the recording shows none of the markers named");
  }
  return region;
}

Walk own_walk() {
  Walk walk;
  walk.file = tests::scene_folder() / "walk.trc";
  for (const char* place :
       {"Heel", "Toe.Tip", "Toe.Lat", "Toe.Med", "Midfoot.Sup", "Midfoot.Lat"}) {
    walk.left.push_back(std::string("L.") + place);
    walk.right.push_back(std::string("R.") + place);
  }
  walk.contacts = tests::source_folder() / "tests" / "data" / "walk_contacts.csv";
  return walk;
}

}  // namespace splash::detection
