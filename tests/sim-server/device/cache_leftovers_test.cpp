// SPDX-License-Identifier: MIT
// What a start takes out of PoCL's cache.
#include "sim-server/device/cache.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace splash::sim {
namespace {

namespace fs = std::filesystem;

class Leftovers : public ::testing::Test {
 protected:
  ~Leftovers() override { fs::remove_all(folder_); }

  void write(const std::string& name, std::chrono::hours ago = std::chrono::hours{0}) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << "code";
    fs::last_write_time(folder_ / name, fs::file_time_type::clock::now() - ago);
  }
  [[nodiscard]] bool has(const std::string& name) const { return fs::exists(folder_ / name); }

  fs::path folder_ =
      fs::path(::testing::TempDir()) / ("splash-leftovers-" + std::to_string(getpid()));
};

TEST_F(Leftovers, AreProgramsThatNobodyAskedForInAMonth) {
  constexpr std::chrono::hours kDay{24};
  write("AB/CD/program.bc", 400 * kDay);
  write("AB/CD/last_accessed", 29 * kDay);
  write("AB/EF/program.bc", 31 * kDay);
  write("AB/EF/last_accessed", 31 * kDay);
  write("GH/IJ/program.bc");
  EXPECT_EQ(remove_leftovers(folder_), 1);
  EXPECT_TRUE(has("AB/CD/program.bc")) << "old, and used";
  EXPECT_FALSE(has("AB/EF"));
  EXPECT_TRUE(has("GH/IJ/program.bc")) << "new, and not marked yet";
  EXPECT_EQ(remove_leftovers(folder_), 0);
}

TEST_F(Leftovers, AreDraftsOfEveryStart) {
  write("tempfile_a1B2c3");
  write("tempfile_d4E5f6");
  write("AB/CD/program.bc");
  write("notes.txt", std::chrono::hours{10'000});
  EXPECT_EQ(remove_leftovers(folder_), 0);
  EXPECT_FALSE(has("tempfile_a1B2c3"));
  EXPECT_FALSE(has("tempfile_d4E5f6"));
  EXPECT_TRUE(has("AB/CD/program.bc"));
  EXPECT_TRUE(has("notes.txt")) << "not PoCL's";
}

TEST_F(Leftovers, OfAFolderThatIsNotThereAreNone) {
  EXPECT_EQ(remove_leftovers(folder_ / "nowhere"), 0);
}

}  // namespace
}  // namespace splash::sim
