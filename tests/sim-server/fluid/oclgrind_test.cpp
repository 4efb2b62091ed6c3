// SPDX-License-Identifier: MIT
// Every kernel of the simulator under oclgrind, which interprets them and sees each access: no data
// race, no access out of bounds, no misuse of the interface. And that it is every kernel. Two steps
// each; SPLASH_OCLGRIND_STEPS=20 in the environment makes it as many, which takes minutes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/programs.hpp"
#include "tests/support/text_of.hpp"

namespace splash {
namespace {

/// The first group of each match.
std::set<std::string> found_in(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) {
    found.insert((*it)[1].str());
  }
  return found;
}

/// A small program and the kernels that it runs.
struct Watched {
  const char* name;
  const char* command;
  const char* says;
  std::set<std::string> kernels;
};

void PrintTo(const Watched& watched, std::ostream* out) {
  *out << watched.name;
}

using Kernels = std::set<std::string>;

Kernels join(std::initializer_list<Kernels> parts) {
  Kernels all;
  for (const Kernels& part : parts) all.insert(part.begin(), part.end());
  return all;
}

// Sorts, by vectors and scalar.
const Kernels kRuns = {"count_cells", "sum_blocks", "place_cells", "sort_points", "sort_few"};
const Kernels kRanks = {"count_points", "sum_cells", "start_cells", "gather_cells", "rank_points"};
const Kernels kStep = {"place_bodies", "gather_body_volumes", "compute_density", "keep_awake",
                       "reduce_stats", "check_health",        "spread_activity", "put_back"};
const Kernels kTurn = {"turn_water"};
/// Where pressure pushes pairs of particles.
const Kernels kPairs = {"compute_acceleration", "integrate"};
const Kernels kGrid = {"cut_cells",      "see_space",      "fill_beside_solids", "find_deviation",
                       "move_particles", "project_faces",  "find_spacing",       "sample_pressure",
                       "solve_pressure", "push_faces",     "lay_system",         "let_fall",
                       "grip_water",     "push_bodies",    "tie_bodies",         "tell_tugs",
                       "entrain_water",  "weigh_pressure", "mark_faces",         "weigh_faces",
                       "weigh_given",    "sum_given",      "open_areas",         "share_at_surface",
                       "sharpen_faces",  "ask_for_answer", "ask_for_room",       "find_shift"};
/// Where air may be shut in, which is for CPUs.
const Kernels kPockets = {"find_pockets"};
/// From particles to its faces, on CPUs and on GPUs.
const Kernels kScatter = {"scatter_to_faces", "add_up_faces"};
const Kernels kGather = {"gather_faces"};
/// Of a scene with bodies that the water moves.
const Kernels kMoved = {"weigh_water", "answer_bodies", "carry_water", "keep_out_of_free",
                        "move_bodies"};
/// Where particles push them.
const Kernels kFree =
    join({kMoved, {"reach_bodies", "measure_rims", "press_films", "sum_films", "sum_pushes"}});
const Kernels kDetect = {"place_bodies",  "gather_body_volumes",  "compute_density",
                         "integrate",     "compute_acceleration", "touch_water",
                         "spawn_bubbles", "carry_bubbles",        "seed_cavities",
                         "grow_cavities", "push_by_walls",        "fold_air",
                         "find_fastest",  "average_density"};

const std::vector<Watched> kWatched = {
    // The interpreter's own counter of instructions breaks its heap here, with no other option,
    // too; scalar_free_bodies counts the same kernels but the tank's turn.
    {"scalar", "sim_fluid_two_steps 1 0 0", "Oclgrind: 251 particles", {}},
    {"vector", "sim_fluid_two_steps 16 0 0", "Oclgrind: 251 particles",
     join({kRuns, kStep, kPairs, kTurn})},
    {"grid_projected", "sim_fluid_two_steps 16 1 1", "Oclgrind: 251 particles",
     join({kRuns, kStep, kGrid, kPockets, kScatter, kMoved})},
    {"scalar_grid_projected", "sim_fluid_two_steps 1 1 1", "Oclgrind: 251 particles",
     join({kRanks, kStep, kGrid, kGather, kMoved})},
    {"free_bodies", "sim_fluid_two_steps 16 0 1", "Oclgrind: 251 particles",
     join({kRuns, kStep, kPairs, kFree})},
    {"scalar_free_bodies", "sim_fluid_two_steps 1 0 1", "Oclgrind: 251 particles",
     join({kRanks, kStep, kPairs, kFree})},
    {"detectors", "sim_detect_two_frames 16", "Oclgrind: 230 particles", join({kRuns, kDetect})},
    {"scalar_detectors", "sim_detect_two_frames 1", "Oclgrind: 230 particles",
     join({kRanks, kDetect})}};

class Oclgrind : public ::testing::TestWithParam<Watched> {};

TEST_P(Oclgrind, FindsNothing) {
  if (tests::run_command({"oclgrind", "--version"}, 10.0).code != 0)
    GTEST_SKIP() << "oclgrind is not installed";
  // Its compiler's optimiser makes instructions that its interpreter does not know.
  const char* asked = std::getenv("SPLASH_OCLGRIND_STEPS");
  const int steps = asked != nullptr ? std::max(std::atoi(asked), 2) : 2;
  const std::string command =
      "timeout " + std::to_string(600 * steps) + " oclgrind --data-races --check-api " +
      (GetParam().kernels.empty() ? "" : "--inst-counts ") + "--build-options -cl-opt-disable " +
      std::string(SPLASH_BINARY_DIR) + "/" + GetParam().command + " " + std::to_string(steps);
  const tests::Ended ended = tests::run_command({"sh", "-c", command}, 660.0 * steps);
  static const std::regex kRan("Instructions executed for kernel '([a-z_]+)'");
  EXPECT_EQ(ended.code, 0) << ended.text;
  EXPECT_THAT(ended.text, ::testing::HasSubstr(GetParam().says));
  EXPECT_EQ(found_in(ended.text, kRan), GetParam().kernels);
  for (const char* report : {"Invalid", "race", "error", "ERROR", "CL_"}) {
    EXPECT_THAT(ended.text, ::testing::Not(::testing::HasSubstr(report)));
  }
}

std::string name_of(const ::testing::TestParamInfo<Watched>& watched) {
  return watched.param.name;
}

INSTANTIATE_TEST_SUITE_P(Programs, Oclgrind, ::testing::ValuesIn(kWatched), name_of);

TEST(OclgrindTable, HasEveryKernel) {
  std::set<std::string> watched;
  for (const Watched& one : kWatched) watched.insert(one.kernels.begin(), one.kernels.end());
  std::set<std::string> kernels;
  static const std::regex kKernel("kernel void ([a-z_]+)");
  const auto root = std::filesystem::path(SPLASH_SOURCE_DIR) / "sim-server";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".cl") continue;
    kernels.merge(found_in(splash::tests::text_of(entry.path()), kKernel));
  }
  EXPECT_GE(kernels.size(), 20U);
  EXPECT_EQ(kernels, watched);
}

}  // namespace
}  // namespace splash
