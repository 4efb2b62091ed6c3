// SPDX-License-Identifier: MIT
// Which compiled programs a start trusts, and what it takes out of PoCL's cache.
#include "sim-server/device/cache.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace splash::sim {
namespace {

namespace fs = std::filesystem;

/// A cache that holds what a test writes.
class Cache : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const { cache_.write(name, text); }
  [[nodiscard]] bool has(const std::string& name) const { return fs::exists(folder_ / name); }

  tests::TemporaryFolder cache_;
  fs::path folder_ = cache_.path();
};

class Seal : public Cache {
 protected:
  /// Three programs, sealed; then a simulator adds a kernel to the second and a fourth program.
  void fill() const {
    for (const char* program : {"AB/CD", "AB/EF", "ZZ/YY"}) {
      write(std::string(program) + "/program.bc", "code");
      write(std::string(program) + "/density/1-1-1/density.so", "machine code");
    }
    CacheSeal(folder_).renew();
    write("AB/EF/reduce_stats/1-1-1/reduce_stats.so", "machine code");
    write("GH/IJ/program.bc", "code");
  }
};

TEST_F(Seal, OfAWholeCacheRemovesNothing) {
  fill();
  write("AB/CD/last_accessed", "PoCL writes it at every start");
  EXPECT_EQ(remove_damaged_programs(folder_), 0);
  EXPECT_TRUE(has("GH/IJ/program.bc")) << "what is in no seal is trusted: nobody died";
}

TEST_F(Seal, SeesWhatIsCutChangedOrGone) {
  fill();
  write("AB/CD/program.bc", "");
  write("AB/EF/density/1-1-1/density.so", "machine kode");
  fs::remove(folder_ / "ZZ/YY/program.bc");
  EXPECT_EQ(remove_damaged_programs(folder_), 3);
  for (const char* gone : {"AB/CD", "AB/EF", "ZZ/YY"}) EXPECT_FALSE(has(gone)) << gone;
  EXPECT_TRUE(has("GH/IJ"));
}

TEST_F(Seal, TrustsNothingMoreOfASimulatorThatDied) {
  fill();
  write("splash-at-work-77", "");
  EXPECT_EQ(remove_damaged_programs(folder_), 2) << "one with a new kernel, one new";
  EXPECT_FALSE(has("AB/EF"));
  EXPECT_FALSE(has("GH/IJ"));
  EXPECT_TRUE(has("AB/CD"));
  EXPECT_EQ(remove_damaged_programs(folder_), 0) << "it is buried once";
}

TEST_F(Seal, TrustsNothingMoreWhereTheDeviceFailed) {
  fill();
  CacheSeal(folder_).doubt();
  EXPECT_EQ(remove_damaged_programs(folder_), 2);
  EXPECT_TRUE(has("AB/CD"));
}

// What a power cut leaves of a file that was not on the disk yet.
TEST_F(Seal, ThatLostWhatItSaidIsTrustedInNothing) {
  fill();
  write("splash-sums", "");
  EXPECT_EQ(remove_damaged_programs(folder_), 4);
}

TEST_F(Seal, IsNotRenewedFromWhatCannotBeRead) {
  fill();
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  {
    const CacheSeal seal(folder_);
    rlimit few = before;
    few.rlim_cur = static_cast<rlim_t>(dup(0));  // the next free descriptor
    close(static_cast<int>(few.rlim_cur));
    // No folder can be listed; then those in it cannot; then their files cannot be read.
    for (int free = 0; free < 4; ++free, ++few.rlim_cur) {
      setrlimit(RLIMIT_NOFILE, &few);
      EXPECT_NO_THROW(seal.renew()) << free;
      EXPECT_NO_THROW(static_cast<void>(seal.has_new())) << free;
    }
    setrlimit(RLIMIT_NOFILE, &before);
  }
  EXPECT_EQ(remove_damaged_programs(folder_), 0) << "the old seal is whole";
  EXPECT_TRUE(has("AB/CD"));
}

TEST_F(Seal, KnowsWhatWasCompiledSince) {
  const CacheSeal seal(folder_);
  fill();
  EXPECT_TRUE(seal.has_new());
  seal.renew();
  EXPECT_FALSE(seal.has_new());
  write("AB/CD/last_accessed", "PoCL writes it at every start");
  EXPECT_FALSE(seal.has_new());
  write("AB/CD/integrate/1-1-1/integrate.so", "machine code");
  EXPECT_TRUE(seal.has_new());
}

/// Bits anywhere in a file count, also in its last bytes, and where words are only exchanged.
TEST_F(Seal, SeesEveryChangeOfALongFile) {
  std::string text(200'003, 'a');
  text.replace(64, 8, "exchange");
  const auto sealed = [&] {
    write("AB/CD/program.bc", text);
    fs::remove(folder_ / "splash-sums");
    CacheSeal(folder_).renew();
  };
  for (const std::size_t at : {std::size_t{0}, std::size_t{65'535}, text.size() - 1}) {
    sealed();
    std::string changed = text;
    changed[at] ^= 1;
    write("AB/CD/program.bc", changed);
    EXPECT_EQ(remove_damaged_programs(folder_), 1) << "bit of byte " << at;
  }
  sealed();
  std::string moved = text;
  moved.replace(64, 8, "aaaaaaaa").replace(72, 8, "exchange");
  write("AB/CD/program.bc", moved);
  EXPECT_EQ(remove_damaged_programs(folder_), 1);
  sealed();
  write("AB/CD/program.bc", text + '\0');
  EXPECT_EQ(remove_damaged_programs(folder_), 1) << "longer by a zero";
}

TEST_F(Seal, MarksItsWorkWhileItLasts) {
  const std::string mark = "splash-at-work-" + std::to_string(getpid());
  {
    const CacheSeal seal(folder_);
    EXPECT_TRUE(has(mark));
  }
  EXPECT_FALSE(has(mark));
}

TEST_F(Seal, LeavesWhatIsNotPoclsAlone) {
  fill();
  write("notes.txt", "mine");
  write("ab/cd/file", "mine");
  write("splash-at-work-77", "");
  remove_damaged_programs(folder_);
  EXPECT_TRUE(has("notes.txt"));
  EXPECT_TRUE(has("ab/cd/file"));
  EXPECT_EQ(remove_damaged_programs(folder_ / "nowhere"), 0);
}

class Leftovers : public Cache {
 protected:
  void write(const std::string& name, std::chrono::hours ago = std::chrono::hours{0}) const {
    Cache::write(name, "code");
    fs::last_write_time(folder_ / name, fs::file_time_type::clock::now() - ago);
  }
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
