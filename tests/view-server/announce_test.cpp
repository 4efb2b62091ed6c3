// SPDX-License-Identifier: MIT
// Announcing, with a program in avahi-publish's place that writes down what it was told.
#include "view-server/announce.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.hpp"
#include "tests/support/waiting.hpp"

namespace splash::view {
namespace {

class Announce : public testing::Test {
 protected:
  Announce() {
    const std::string folder = folder_.path();
    std::filesystem::permissions(
        folder_.write("avahi-publish", "#!/bin/sh\ncd " + folder +
                                           "\necho \"$@\" >told.part\necho $$ >process\n"
                                           "mv told.part told\nexec sleep 60\n"),
        std::filesystem::perms::owner_all);
    setenv("PATH", (folder + ":" + path_).c_str(), 1);
  }
  ~Announce() override { setenv("PATH", path_.c_str(), 1); }
  /// Its first line, once it is there.
  [[nodiscard]] std::string line_of(const std::string& name) const {
    std::string line;
    tests::eventually([&] {
      std::ifstream file(folder_ / name);
      return static_cast<bool>(std::getline(file, line));
    });
    return line;
  }

  tests::TemporaryFolder folder_;
  std::string path_ = std::getenv("PATH");
};

TEST_F(Announce, TellsTheNetworkWhatItCanReachUntilTheEnd) {
  int process = 0;
  {
    const Announcement announcement(protocol::Endpoint{INADDR_ANY, 8080});
    EXPECT_TRUE(announcement.is_made());
    const std::string told = line_of("told");
    EXPECT_EQ(told.substr(0, 13), "-s splash on ");
    EXPECT_TRUE(told.ends_with(" _oscjson._tcp 8080")) << told;
    process = std::stoi(line_of("process"));
    EXPECT_EQ(kill(process, 0), 0);
  }
  EXPECT_NE(kill(process, 0), 0) << "it has ended";
}

TEST_F(Announce, SaysNothingOfAServerOnLoopbackNorWithoutAvahi) {
  EXPECT_FALSE(Announcement(protocol::Endpoint{INADDR_LOOPBACK, 8080}).is_made());
  setenv("PATH", "/nowhere", 1);
  EXPECT_FALSE(Announcement(protocol::Endpoint{INADDR_ANY, 8080}).is_made());
}

}  // namespace
}  // namespace splash::view
