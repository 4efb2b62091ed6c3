// SPDX-License-Identifier: MIT
#include "tests/fuzz/target.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace splash::fuzz {
namespace {

namespace fs = std::filesystem;

fs::path here(const std::string& name) {
  return fs::path(SPLASH_SOURCE_DIR) / "tests/fuzz" / name;
}
fs::path configs(const std::string& name) {
  return fs::path(SPLASH_SOURCE_DIR) / "configs" / name;
}

std::vector<std::byte> read_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read the seed " + path.string());
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

}  // namespace

const std::vector<Target>& targets() {
  static const fs::path kOsc = here("osc.dict");
  static const fs::path kYaml = here("yaml.dict");
  static const std::vector<Target> kTargets = {
      {"gate", try_gate, 1600, {here("seeds/packet")}, kOsc, 0.30},
      {"packet", try_packet, 1600, {here("seeds/packet")}, kOsc, 0.25},
      {"intake", try_intake, 3000, {here("seeds/intake")}, kOsc, 0.05},
      {"log", try_log, 4000, {here("seeds/log")}, kOsc, 0.10},
      {"scene", try_scene, 3000, {here("seeds/scene"), configs("scenes")}, kYaml, 0.05},
      {"rig", try_rig, 3000, {here("seeds/rig"), configs("rigs")}, kYaml, 0.05},
      {"mesh", try_mesh, 3000, {here("seeds/mesh")}, here("mesh.dict"), 0.05},
      {"tracker", try_tracker, 1600, {here("seeds/tracker")}, kOsc, 0.05},
      {"tuio", try_tuio, 3000, {here("seeds/tuio")}, kOsc, 0.05},
      {"pressure", try_pressure, 3000, {here("seeds/pressure")}, kOsc, 0.05},
  };
  return kTargets;
}

std::vector<std::vector<std::byte>> read_seeds(const Target& target) {
  std::vector<fs::path> paths;
  for (const fs::path& folder : target.seeds) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.is_regular_file() && entry.file_size() <= target.longest) {
        paths.push_back(entry.path());
      }
    }
  }
  std::sort(paths.begin(), paths.end());
  std::vector<std::vector<std::byte>> seeds;
  for (const fs::path& path : paths) seeds.push_back(read_bytes(path));
  return seeds;
}

}  // namespace splash::fuzz
