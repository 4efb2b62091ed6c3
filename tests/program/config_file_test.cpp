// SPDX-License-Identifier: MIT
// Scenes and rigs by name: a file goes before a name, one's own before what is shipped.
#include "program/config_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "program/failure.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::program {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// A user's folder with the rigs "mine" and "stereo", and an empty folder to stand in.
class ConfigFile : public testing::Test {
 protected:
  ConfigFile() {
    fs::create_directories(own());
    fs::create_directories(here());
    for (const char* name : {"mine.yaml", "stereo.yaml"}) touch(own() / name);
    setenv("XDG_CONFIG_HOME", (folder_ / "config").c_str(), 1);
    fs::current_path(here());
  }
  ~ConfigFile() override {
    fs::current_path(before_);
    unsetenv("XDG_CONFIG_HOME");
  }
  [[nodiscard]] fs::path own() const { return folder_ / "config/splash/rigs"; }
  [[nodiscard]] fs::path here() const { return folder_ / "here"; }
  static void touch(const fs::path& path) { std::ofstream(path) << "name: x\n"; }
  static fs::path find(const fs::path& wanted) { return find_config("--rig", "rigs", wanted); }
  static std::string refusal(const fs::path& wanted) {
    try {
      return find(wanted).string();
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), kExitNoInput);
      return failure.what();
    }
  }

 private:
  fs::path before_ = fs::current_path();
  tests::TemporaryFolder folder_;
};

TEST_F(ConfigFile, OnesOwnGoesBeforeTheShippedOne) {
  EXPECT_EQ(find("mine"), fs::canonical(own() / "mine.yaml"));
  EXPECT_EQ(find("stereo"), fs::canonical(own() / "stereo.yaml"));
  EXPECT_EQ(find("tiles36"), fs::path(SPLASH_SOURCE_DIR) / "configs/rigs/tiles36.yaml");
}

TEST_F(ConfigFile, AFileGoesBeforeAName) {
  touch(here() / "stereo");
  EXPECT_EQ(find("stereo"), "stereo");
  touch(here() / "tiles36.yaml");
  EXPECT_EQ(find("tiles36.yaml"), "tiles36.yaml");
  fs::create_directory(here() / "mine");
  EXPECT_EQ(find("mine"), fs::canonical(own() / "mine.yaml")) << "a folder is no file";
}

TEST_F(ConfigFile, TheHomeFolderServesWhereNoOtherIsNamed) {
  unsetenv("XDG_CONFIG_HOME");
  const std::string home = std::getenv("HOME") == nullptr ? "" : std::getenv("HOME");
  setenv("HOME", "/somewhere", 1);
  EXPECT_EQ(config_folders("scenes").at(0), "/somewhere/.config/splash/scenes");
  setenv("HOME", home.c_str(), 1);
}

TEST_F(ConfigFile, SaysWhatThereIsAndWhatMayBeMeant) {
  EXPECT_THAT(refusal("tile36"),
              AllOf(HasSubstr("--rig tile36: there is no such file in " + here().string()),
                    HasSubstr("did you mean tiles36?"), HasSubstr("There are: glove handheld"),
                    HasSubstr(" mine ")));
  EXPECT_THAT(refusal("trombone"), testing::Not(HasSubstr("did you mean")));
  EXPECT_THAT(refusal("a\nb"), HasSubstr("a\\x0ab"));
  fs::create_directory(here() / "drum");
  EXPECT_THAT(refusal("drum"), HasSubstr("--rig drum: it is a folder"));
  EXPECT_THAT(refusal("no/where"), HasSubstr("--rig no/where: there is no such file in"));
}

}  // namespace
}  // namespace splash::program
