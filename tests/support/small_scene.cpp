// SPDX-License-Identifier: MIT
#include "tests/support/small_scene.hpp"

#include <filesystem>
#include <fstream>

namespace splash::tests {
namespace {

constexpr const char* kText = R"(
name: small
description: a disc in a little water

tank:
  lower: [-0.2, -0.2, 0.0]
  upper: [0.2, 0.2, 0.5]

water:
  - lower: [-0.2, -0.2, 0.0]
    upper: [0.2, 0.2, 0.2]

bodies:
  - name: disc
    shape: {kind: cylinder, size: [0.15, 0.15, 0.05]}
)";

int scenes = 0;

}  // namespace

SmallScene::SmallScene(const std::string& motion, int seed, const std::string& solver)
    : path_(temporary_path("small-" + std::to_string(++scenes) + ".yaml")) {
  std::ofstream(path_) << "seed: " << seed << "\nfluid: {particles: 1400, solver: " << solver << "}"
                       << kText << "    motion: " << motion << '\n';
}

SmallScene::~SmallScene() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

Ended simulate(const std::string& scene, double seconds, const Arguments& further,
               const ChildProcess::Environment& environment) {
  Arguments arguments = {"--scene", scene, "--duration", std::to_string(seconds),
                         "--faster-than-real-time"};
  arguments.insert(arguments.end(), further.begin(), further.end());
  return run_program("sim-server", on_some_port(arguments), 300.0, environment);
}

std::string plunging() {
  return "{kind: script, repeat: true, keyframes: [{time: 0.0, position: [0, 0, 0.35]}, "
         "{time: 0.4, position: [0, 0, 0.10]}, {time: 0.6, position: [0, 0, 0.10]}, "
         "{time: 1.0, position: [0, 0, 0.35]}]}";
}

std::string tracked() {
  return "{kind: osc}\n    rest: {position: [0, 0, 0.35]}";
}

}  // namespace splash::tests
