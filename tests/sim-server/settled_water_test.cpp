// SPDX-License-Identifier: MIT
// Water that is taken up from a file is, to the bit, that which came to rest; a file that is not
// what it should be is refused and stays as it is.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include <limits>
#include <string>

#include "program/failure.hpp"
#include "sim-server/scene/scene_reader.hpp"
#include "sim-server/simulation/simulation.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::sim {
namespace {

namespace fs = std::filesystem;

/// Behind the mark: key, sum and size.
constexpr std::size_t kMark = 23, kHeader = kMark + 24;

class SettledWater : public ::testing::TestWithParam<const char*> {
 protected:
  /// A tank with a float; `depth` of the water [m].
  static Scene scene(double depth) {
    return parse_scene("fluid: {spacing: 0.025, solver: " + std::string(GetParam()) +
                           "}\n"
                           "tank: {lower: [0, 0, 0], upper: [0.25, 0.25, 0.4]}\n"
                           "water: [{lower: [0, 0, 0], upper: [0.25, 0.25, " +
                           std::to_string(depth) +
                           "]}]\n"
                           "bodies:\n"
                           "  - name: float\n"
                           "    shape: {kind: box, size: [0.1, 0.1, 0.06]}\n"
                           "    rest: {position: [0.125, 0.125, 0.16]}\n"
                           "    motion: {kind: free, density: 500}\n",
                       "settled.yaml");
  }

  /// Starts and runs for a while; the settling's calls, whether the file was used, the water.
  struct Start {
    int settling = 0;
    bool took_up = false;
    Snapshot water;
  };
  Start start(double depth, const fs::path& file) {
    Start all;
    Simulation simulation(
        device_, scene(depth), {}, [&](double) { ++all.settling; }, file);
    all.took_up = simulation.took_up_water();
    for (int k = 0; k < 20; ++k) static_cast<void>(simulation.advance());
    all.water = simulation.fluid().snapshot();
    return all;
  }

  static void expect_same(const Snapshot& a, const Snapshot& b) {
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.velocity, b.velocity);
    EXPECT_EQ(a.peak_density, b.peak_density);
  }

  void expect_refused(const std::string& bytes, const std::string& why) {
    folder_.write("settled.water", bytes);
    try {
      start(0.15, file_);
      ADD_FAILURE() << "taken up: " << why;
    } catch (const program::DataError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(file_.string()), std::string::npos);
    }
    EXPECT_TRUE(tests::text_of(file_) == bytes) << "the file stays as it is: " << why;
  }

  /// With the sum that suits its body, as a program that writes nonsense would leave it.
  static std::string sealed(std::string bytes) {
    std::uint64_t sum = 14695981039346656037ULL;
    for (std::size_t i = kHeader; i < bytes.size(); ++i) {
      sum = (sum ^ static_cast<unsigned char>(bytes[i])) * 1099511628211ULL;
    }
    const std::uint64_t size = bytes.size() - kHeader;
    std::memcpy(&bytes[kMark + 8], &sum, sizeof sum);
    std::memcpy(&bytes[kMark + 16], &size, sizeof size);
    return bytes;
  }

  tests::TemporaryFolder folder_;
  const fs::path file_ = folder_ / "settled.water";
  Device device_;
};

TEST_P(SettledWater, IsTheSameToTheBit) {
  const Start alone = start(0.15, {});
  const Start first = start(0.15, file_);
  const Start second = start(0.15, file_);
  EXPECT_FALSE(first.took_up);
  EXPECT_TRUE(second.took_up);
  EXPECT_GT(first.settling, 10);
  EXPECT_EQ(second.settling, 0);
  expect_same(alone.water, first.water);
  expect_same(first.water, second.water);
}

TEST_P(SettledWater, OfAnotherSceneIsWrittenAnew) {
  static_cast<void>(start(0.15, file_));
  const std::string before = tests::text_of(file_);
  EXPECT_FALSE(start(0.175, file_).took_up);
  EXPECT_FALSE(tests::text_of(file_) == before);
  EXPECT_TRUE(start(0.175, file_).took_up);
}

TEST_P(SettledWater, IsRefusedWhenTheFileIsNotWhatItShouldBe) {
  static_cast<void>(start(0.15, file_));
  const std::string sound = tests::text_of(file_);
  ASSERT_EQ(sealed(sound), sound);
  expect_refused("", "no settled water");
  expect_refused("name: pool\n", "no settled water");
  expect_refused(sound.substr(0, kMark + 5), "ends too early");
  for (const std::size_t size : {kHeader, kHeader + 4, sound.size() / 2, sound.size() - 1}) {
    expect_refused(sound.substr(0, size), "ends too early");
  }
  expect_refused(sound + '\n', "damaged");
  for (const std::size_t at :
       {kMark + 8, kHeader, kHeader + 9, sound.size() / 2, sound.size() - 1}) {
    std::string other = sound;
    other[at] = static_cast<char>(other[at] ^ 4);
    expect_refused(other, "damaged");
  }
  std::string other = sound;
  other[kMark - 2] = '2';
  expect_refused(other, "another version");
  other = sound;
  const float wrong = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(&other[kHeader + 8], &wrong, sizeof wrong);
  expect_refused(sealed(other), "none of water");
  other = sound;
  other[kHeader] = static_cast<char>(other[kHeader] ^ 4);
  expect_refused(sealed(other), "another size");
  expect_refused(sealed(sound + "more"), "too long");
  folder_.write("settled.water", sound);
  EXPECT_TRUE(start(0.15, file_).took_up);
}

TEST_P(SettledWater, ThatCannotBeWrittenEndsTheStart) {
  EXPECT_THROW(start(0.15, "/nowhere/at/all.water"), program::Failure);
}

INSTANTIATE_TEST_SUITE_P(Solvers, SettledWater,
                         ::testing::Values("weakly_compressible", "grid_projected"),
                         [](const auto& solver) { return std::string(solver.param); });

}  // namespace
}  // namespace splash::sim
