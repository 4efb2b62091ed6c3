// SPDX-License-Identifier: MIT
// A recorded walk through the water: an impact for each foot contact that the force plates beside
// the cameras saw, and few others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "sim-server/device/device.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"

namespace splash::sim {
namespace {

const std::filesystem::path kSource = SPLASH_SOURCE_DIR;
constexpr double kTwoFrames = 2.0 / 60.0;  ///< of the tracker [s]
/// Of the water's surface: as in the plunge, a tenth of a spacing. A foot that glides in at a tenth
/// of a metre per second takes 13 ms over it [m].
constexpr double kRoughness = 0.1 * 0.0158;
/// False impacts that are accepted: "What it cannot do" in sim-server/detect/README.md.
constexpr std::size_t kMostFalse = 1;
constexpr double kEnd = 2.5;  ///< of the recording [s]

struct Contact {
  std::string foot;
  double seconds = 0.0;
};

/// Rising edges of the plates' vertical force. The first, at 0 s, is that of a foot which the
/// recording finds on the floor already.
std::vector<Contact> read_contacts() {
  std::ifstream file(kSource / "tests" / "data" / "walk_contacts.csv");
  std::vector<Contact> contacts;
  for (std::string line; std::getline(file, line);) {
    std::istringstream row(line);
    Contact contact;
    std::getline(row, contact.foot, ',');
    if (row >> contact.seconds && contact.seconds > 0.0) contacts.push_back(contact);
  }
  return contacts;
}

TEST(Walk, EachFootContactOfTheForcePlatesIsOneImpact) {
  const std::vector<Contact> contacts = read_contacts();
  ASSERT_EQ(contacts.size(), 4U);
  const Scene scene = read_scene(kSource / "configs" / "scenes" / "walk.yaml");
  Device device;
  Simulation simulation(device, scene, kSource / "configs" / "scenes" / "walk.trc");
  std::vector<DetectedImpact> impacts;
  while (simulation.seconds() < kEnd) {
    const FrameResult frame = simulation.advance();
    impacts.insert(impacts.end(), frame.found.impacts.begin(), frame.found.impacts.end());
  }
  // The foot that the recording finds on its heel puts its ball down first: another part of it.
  std::erase_if(impacts, [&](const DetectedImpact& impact) {
    return scene.bodies[static_cast<std::size_t>(impact.body)].name == "foot_left" &&
           impact.time < contacts.front().seconds - kTwoFrames;
  });
  for (const Contact& contact : contacts) {
    const auto is_its = [&](const DetectedImpact& impact) {
      const std::string& body = scene.bodies[static_cast<std::size_t>(impact.body)].name;
      return body == "foot_" + contact.foot &&
             std::abs(impact.time - contact.seconds) <= kTwoFrames + kRoughness / impact.approach;
    };
    const auto first = std::find_if(impacts.begin(), impacts.end(), is_its);
    ASSERT_NE(first, impacts.end()) << contact.foot << " foot at " << contact.seconds << " s";
    std::printf("%s foot at %.4f s: %+.1f ms\n", contact.foot.c_str(), contact.seconds,
                1e3 * (first->time - contact.seconds));
    EXPECT_EQ(std::erase_if(impacts, is_its), 1U) << contact.foot << " at " << contact.seconds;
  }
  EXPECT_LE(impacts.size(), kMostFalse);
  EXPECT_EQ(simulation.totals().resets, 0U);
}

}  // namespace
}  // namespace splash::sim
