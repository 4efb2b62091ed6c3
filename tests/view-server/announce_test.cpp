// SPDX-License-Identifier: MIT
// Announcing, with a program in avahi-publish's place that writes down what it was told.
#include "view-server/announce.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace splash::view {
namespace {

class Announce : public testing::Test {
 protected:
  Announce() : folder_(testing::TempDir() + "announce-" + std::to_string(getpid())) {
    std::filesystem::create_directories(folder_);
    const std::string program = folder_ + "/avahi-publish";
    std::ofstream(program) << "#!/bin/sh\necho \"$@\" >" << folder_ << "/told.part\necho $$ >"
                           << folder_ << "/process\nmv " << folder_ << "/told.part " << folder_
                           << "/told\nexec sleep 60\n";
    chmod(program.c_str(), 0755);
    setenv("PATH", (folder_ + ":" + path_).c_str(), 1);
  }
  ~Announce() override {
    setenv("PATH", path_.c_str(), 1);
    std::filesystem::remove_all(folder_);
  }
  [[nodiscard]] std::string line_of(const std::string& name, int tries) const {
    std::string line;
    for (int i = 0; i < tries && line.empty(); ++i) {
      std::ifstream file(folder_ + '/' + name);
      std::getline(file, line);
      if (line.empty()) usleep(20'000);
    }
    return line;
  }

  std::string folder_;
  std::string path_ = std::getenv("PATH");
};

TEST_F(Announce, TellsTheNetworkWhatItCanReachUntilTheEnd) {
  int process = 0;
  {
    const Announcement announcement(protocol::Endpoint{INADDR_ANY, 8080});
    EXPECT_TRUE(announcement.is_made());
    const std::string told = line_of("told", 500);
    EXPECT_EQ(told.substr(0, 13), "-s splash on ");
    EXPECT_TRUE(told.ends_with(" _oscjson._tcp 8080")) << told;
    process = std::stoi(line_of("process", 500));
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
