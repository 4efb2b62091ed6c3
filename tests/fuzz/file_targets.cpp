// SPDX-License-Identifier: MIT
// Files that people write or are sent: event logs, scenes, rigs, meshes.
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "program/config.hpp"
#include "protocol/event_log.hpp"
#include "sim-server/scene/mesh/mesh_distance.hpp"
#include "sim-server/scene/mesh/mesh_file.hpp"
#include "sim-server/scene/mesh/mesh_mass.hpp"
#include "sim-server/scene/mesh/soundness.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "synth-server/output/rig_reader.hpp"
#include "tests/fuzz/target.hpp"

namespace splash::fuzz {
namespace {

/// The most a person reads; longer values are cut in the text.
constexpr std::size_t kLongestComplaint = 2000;

std::string text_of(Bytes input) {
  return {reinterpret_cast<const char*>(input.data()), input.size()};
}

/// A complaint names its file, fits a screen and cannot write on the terminal but letters.
void check_complaint(const std::string& said, const std::string& file) {
  promise(said.find(file) != std::string::npos, "the file is not named: " + said);
  promise(said.size() <= kLongestComplaint,
          "a complaint of " + std::to_string(said.size()) + " characters: " + said.substr(0, 200));
  for (const char c : said) {
    const auto byte = static_cast<unsigned char>(c);
    promise(byte >= 0x20 && byte != 0x7f, "a control character in: " + said);
  }
}

template <class Read>
bool reads(const std::string& file, Read&& read) {
  try {
    read();
    return true;
  } catch (const program::ConfigError& error) {
    promise(error.place().line >= 1 && error.place().column >= 1,
            "no place: " + std::string(error.what()));
    promise(std::string(error.what()).starts_with(file + ':'),
            "no file: " + std::string(error.what()));
    check_complaint(error.what(), file);
    return false;
  }
}

bool positive(double value) {
  return std::isfinite(value) && value > 0.0;
}

}  // namespace

bool try_log(Bytes input) {
  std::istringstream stream(text_of(input));
  std::vector<protocol::LogEntry> log;
  try {
    log = protocol::read_log(stream, input.size(), "fuzzed.osc");
  } catch (const std::runtime_error& error) {
    check_complaint(error.what(), "fuzzed.osc");
    return false;
  }
  double last = 0.0;
  std::size_t bytes = 0;
  for (const auto& [seconds, messages] : log) {
    promise(seconds >= last, "time goes back in an accepted log");
    last = seconds;
    bytes += 4 + protocol::encode(protocol::to_score_tag(0.0), messages).size();
  }
  promise(bytes == input.size(), "an accepted log lost something");
  return true;
}

bool try_scene(Bytes input) {
  // As if it lay beside the built-in scenes: the motions they name are there.
  const std::string file = std::string(SPLASH_SOURCE_DIR) + "/configs/scenes/fuzzed.yaml";
  return reads(file, [&] {
    const sim::Scene scene = sim::parse_scene(text_of(input), file);
    promise(positive(sim::particle_spacing(scene)), "a spacing that is none");
    promise(positive(sim::water_volume(scene)), "a volume of water that is none");
    promise(positive(sim::scene_sound_speed(scene)), "a speed of sound that is none");
  });
}

bool try_mesh(Bytes input) {
  const std::string bytes = text_of(input);
  const bool stl = sim::is_binary_stl(bytes) || bytes.starts_with("solid");
  const std::string file = stl ? "fuzzed.stl" : "fuzzed.obj";
  return reads(file, [&] {
    const sim::TriangleMesh mesh = sim::parse_mesh(bytes, file, 0.1);
    sim::check_soundness(mesh);
    const sim::MeshMass mass = sim::mesh_mass(mesh);
    promise(positive(mass.volume), "a volume that is none");
    for (std::size_t k = 0; k < 3; ++k) {
      promise(std::isfinite(mass.centre[k]), "a centre that is nowhere");
      promise(positive(mass.inertia[k]), "a moment of inertia that is none");
    }
    const sim::MeshDistance distance(mesh);
    for (const sim::Vector3& place : mesh.vertices) {
      promise(std::abs(distance.nearest(place).distance) < 1.0e-6, "a vertex off its surface");
    }
  });
}

bool try_rig(Bytes input) {
  return reads("fuzzed.yaml", [&] {
    const synth::Rig rig = synth::parse_rig(text_of(input), "fuzzed.yaml");
    promise(synth::channel_count(rig) >= 1, "a rig without channels");
    promise(synth::channel_names(rig).size() == static_cast<std::size_t>(channel_count(rig)),
            "a channel without a name");
  });
}

}  // namespace splash::fuzz
