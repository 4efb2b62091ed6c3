// SPDX-License-Identifier: MIT
// Recordings, as they were made and otherwise: walks in water of several depths, hands.
#include <algorithm>
#include <cmath>

#include "sim-server/bodies/motion/make_motion.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "tests/detection/script.hpp"
#include "tests/detection/sweeps.hpp"
#include "tests/support/scene_text.hpp"

namespace splash::detection {
namespace {

constexpr double kLongest = 10.0;    ///< more of a recording is not played [s]
constexpr double kUnderFeet = 0.03;  ///< of water below the floor, to give way [m]

struct Manner {
  std::string name;
  Play play;
};

double duration(const sim::MarkerRecording& recording) {
  return std::min(recording.times.back() - recording.times.front(), kLongest);
}

std::string list(const std::vector<std::string>& names) {
  std::string text = "[";
  for (const std::string& name : names) text += (text.size() > 1 ? ", " : "") + name;
  return text + "]";
}

std::string tracked(const std::vector<std::string>& markers, bool sole) {
  return std::string("{kind: trc, sole: ") + (sole ? "true" : "false") +
         ", markers: " + list(markers) + "}";
}

/// Fine enough to tell steps apart where water is thin, as coarse as it must be where there is
/// much.
double spacing_for(double volume, double finest, double most) {
  return std::max(finest, std::cbrt(volume / most));
}

/// A pool of the region, wide enough for what moves in it.
Pool around(const Region& region, double margin, double floor, double level) {
  return {{region.lower[0] - margin, region.lower[1] - margin, floor},
          {region.upper[0] + margin, region.upper[1] + margin, level}};
}

double volume_of(const Pool& place) {
  double volume = 1.0;
  for (std::size_t k = 0; k < 3; ++k) volume *= place.upper[k] - place.lower[k];
  return volume;
}

Case walk_case(const Walk& walk, const sim::MarkerRecording& recording,
               const std::filesystem::path& file, double depth, double length) {
  std::vector<std::string> markers = walk.left;
  markers.insert(markers.end(), walk.right.begin(), walk.right.end());
  Pool place = around(region_of(recording, markers), 0.2, -kUnderFeet, depth);
  place.spacing = spacing_for(volume_of(place), depth < 0.03 ? 0.016 : 0.02, 11000.0);
  sim::Shape shoe = box({length, 0.1, 0.07});
  shoe.rocker = 0.03;
  shoe.flat = 0.5;
  Case item = {"walk", digits(100.0 * depth) + " cm, shoe " + digits(100.0 * length) + " cm",
               place.scene({body_text("foot_left", shape_text(shoe), tracked(walk.left, true)),
                            body_text("foot_right", shape_text(shoe), tracked(walk.right, true))}),
               duration(recording)};
  item.feet = true;
  item.tracker = file;
  if (depth >= 0.16) item.wishes.cavities = Count{0, 0};
  return item;
}

std::filesystem::path play_to(const std::filesystem::path& folder, const std::string& name,
                              const sim::MarkerRecording& recording) {
  std::string plain = name;
  std::replace(plain.begin(), plain.end(), ' ', '_');
  std::filesystem::path file = folder / (plain + ".trc");
  write_trc(recording, file);
  return file;
}

void add_walks(std::vector<Case>& all, const Material& material) {
  const Walk& walk = material.walk;
  const sim::MarkerRecording recording = played(sim::read_markers(walk.file), {});
  const auto plain = play_to(material.folder, "walk", recording);
  for (const double depth : {0.01, 0.02, 0.05, 0.1, 0.17}) {
    for (const double length : {0.25, 0.29}) {
      all.push_back(walk_case(walk, recording, plain, depth, length));
      all.back().quick = depth == 0.05 && length == 0.25;
    }
  }
  const std::vector<Manner> manners = {{"mirrored", {.mirrored = true}},
                                       {"backwards", {.backwards = true}},
                                       {"faster", {.pace = 1.4}},
                                       {"slower", {.pace = 0.7}}};
  for (const Manner& manner : manners) {
    const sim::MarkerRecording other = played(recording, manner.play);
    const auto file = play_to(material.folder, "walk " + manner.name, other);
    for (const double depth : {0.05, 0.17}) {
      all.push_back(walk_case(walk, other, file, depth, 0.25));
      all.back().name = manner.name + ", " + all.back().name;
    }
  }
  if (walk.contacts.empty()) return;
  Case shipped_walk = {"walk", "walk.yaml, against force plates", tests::scene_text("walk.yaml"),
                       duration(recording)};
  shipped_walk.feet = true;
  shipped_walk.tracker = plain;
  shipped_walk.truth = walk.contacts;
  all.push_back(shipped_walk);
  // Splashes are chaotic: other steps and spacings are other runs.
  const auto add = [&](const std::string& other, const std::string& from, const std::string& to) {
    all.push_back(shipped_walk);
    all.back().name += ", " + other;
    all.back().scene = tests::changed(shipped_walk.scene, from, to);
  };
  for (const char* factor : {"0.999", "0.998", "0.997", "0.996"}) {
    const std::string other = std::string("time_step_factor: ") + factor;
    add(other, "fluid:\n", "fluid:\n  " + other + "\n");
  }
  for (const char* other : {"particles: 9000", "particles: 16000"}) {
    add(other, "particles: 12000", other);
  }
}

/// Between the lowest and the highest that its underside is.
double middle_height(const HandRecording& hand, const std::filesystem::path& file, double seconds) {
  sim::BodySettings body;
  body.name = "hand";
  body.shape = box(hand.size);
  body.motion.kind = sim::MotionKind::trc;
  body.motion.file = file;
  body.motion.markers = hand.markers;
  const auto motion = sim::make_motion(body, {});
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  for (double t = 0.0; t < seconds; t += 0.005) {
    const double z = lowest_point(body.shape, motion->at(t))[2];
    low = std::min(low, z);
    high = std::max(high, z);
  }
  return 0.5 * (low + high);
}

void add_hand(std::vector<Case>& all, const HandRecording& hand,
              const std::filesystem::path& folder, std::size_t number) {
  const sim::MarkerRecording recording = sim::read_markers(hand.file);
  const std::vector<Manner> manners = {
      {"as recorded", {}},
      {"upside down", {.over = true}},
      {"upside down and backwards", {.backwards = true, .over = true}},
      {"upside down and faster", {.over = true, .pace = 1.5}},
      {"upside down and slower", {.over = true, .pace = 0.7}}};
  for (const Manner& manner : manners) {
    const sim::MarkerRecording other = played(recording, manner.play);
    const std::string name = "hand " + std::to_string(number) + " " + manner.name;
    const auto file = play_to(folder, name, other);
    const double level = middle_height(hand, file, duration(other));
    const Region region = region_of(other, hand.markers);
    Pool place = around(region, 0.25, std::min(region.lower[2], level) - 0.15, level);
    place.spacing = spacing_for(volume_of(place), 0.02, 9000.0);
    Case item = {
        "hand", name.substr(5),
        place.scene({body_text("hand", shape_text(box(hand.size)), tracked(hand.markers, false))}),
        duration(other)};
    item.tracker = file;
    item.quick = manner.name == "upside down";
    all.push_back(item);
  }
}

}  // namespace

std::vector<Case> recorded_cases(const Material& material) {
  std::vector<Case> all;
  add_walks(all, material);
  for (std::size_t k = 0; k < material.hands.size(); ++k) {
    add_hand(all, material.hands[k], material.folder, k + 1);
  }
  return all;
}

std::vector<Case> all_cases(const Material& material) {
  std::vector<Case> all = plunge_cases(material.folder);
  for (const auto& more : {repeated_cases(), silent_cases(), cavity_cases(),
                           recorded_cases(material), scene_cases()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace splash::detection
