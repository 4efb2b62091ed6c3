// SPDX-License-Identifier: MIT
// What can be wrong with OpenCL and its cache: each ends in a sentence with a cure, or is mended.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::tests {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class OpenClFault : public testing::Test {
 protected:
  [[nodiscard]] fs::path cache() const { return folder_ / "cache"; }
  [[nodiscard]] Ended simulate(const ChildProcess::Environment& environment) const {
    return tests::simulate(scene_.path(), 0.1, {}, environment);
  }
  /// The same behind a line of the shell that limits what it may take.
  [[nodiscard]] Ended simulate_limited(const std::string& limits) const {
    Arguments shell{"/bin/sh", "-c", limits + "; exec \"$0\" \"$@\""};
    const Arguments program = command(
        "sim-server",
        on_some_port({"--scene", scene_.path(), "--duration", "0.1", "--faster-than-real-time"}));
    shell.insert(shell.end(), program.begin(), program.end());
    return run_command(shell, 120.0, {{"POCL_CACHE_DIR", cache().string()}});
  }
  [[nodiscard]] Ended simulate_with_cache() const {
    return simulate({{"POCL_CACHE_DIR", cache().string()}});
  }
  /// Files below the cache whose names end so.
  [[nodiscard]] std::vector<fs::path> cached(const std::string& ending) const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(cache())) {
      if (entry.path().filename().string().ends_with(ending)) files.push_back(entry.path());
    }
    return files;
  }

 private:
  SmallScene scene_{plunging()};
  TemporaryFolder folder_;
};

TEST_F(OpenClFault, NoPlatformNamesThePackage) {
  fs::create_directory(cache());  // a folder without any platform in it
  const auto [code, text] = simulate({{"OCL_ICD_VENDORS", cache().string()}});
  EXPECT_EQ(code, 69);
  EXPECT_THAT(text, AllOf(HasSubstr("no OpenCL platform found in " + cache().string() +
                                    ", which $OCL_ICD_VENDORS names; unset that"),
                          HasSubstr("apt install pocl-opencl-icd")));
}

TEST_F(OpenClFault, UnwritableCacheIsNamed) {
  const auto [code, text] = simulate({{"POCL_CACHE_DIR", "/dev/null/kernels"}});
  EXPECT_EQ(code, 69);
  EXPECT_THAT(text, AllOf(HasSubstr("/dev/null/kernels"), HasSubstr("set POCL_CACHE_DIR")));
}

/// A limit on the size of files is what a full disk is to LLVM, which then calls exit(). 256 KiB
/// are more than the kernels' text, which PoCL writes first, and less than LLVM's files.
TEST_F(OpenClFault, FullDiskWhileCompilingIsSaid) {
  const auto [code, text] = simulate_limited("trap '' XFSZ; ulimit -f 512");
  EXPECT_EQ(code, 69);
  EXPECT_THAT(text, AllOf(HasSubstr("OpenCL ended the program"), HasSubstr(cache().string()),
                          HasSubstr("POCL_CACHE_DIR")));
}

/// The compiler throws then, past PoCL's locks: nothing may wait for those.
TEST_F(OpenClFault, TooLittleMemoryWhileCompilingIsSaid) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take address space of their own";
#endif
  const auto [code, text] = simulate_limited("ulimit -v 400000");
  EXPECT_EQ(code, 69) << text;
  EXPECT_THAT(text, HasSubstr("(ulimit -v)"));
}

/// PoCL aborts where the linker of its compiler fails, and LLVM has taken that signal before.
TEST_F(OpenClFault, ALinkerThatFailsIsSaid) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a crash is the sanitizer's to report here";
#endif
  const auto [code, text] =
      simulate({{"POCL_CACHE_DIR", cache().string()}, {"PATH", cache().string()}});
  EXPECT_EQ(code, 69);
  EXPECT_THAT(text,
              AllOf(HasSubstr("\"ld\" doesn't exist"), HasSubstr("OpenCL ended the program")));
}

/// On a machine's first start a splash would wait for it else.
TEST_F(OpenClFault, NothingIsCompiledOnceTimeRuns) {
  const SmallScene by_count(plunging() + "\ndetect: {cavity_by_count: true}");  // on the device
  ChildProcess simulator(command("sim-server", on_some_port({"--scene", by_count.path(),
                                                             "--duration", "2",  // the disc plunges
                                                             "--faster-than-real-time"})),
                         {{"POCL_CACHE_DIR", cache().string()}});
  ASSERT_TRUE(simulator.wait_for_text("running", 300.0)) << simulator.output();
  const std::vector<fs::path> before = cached(".so");
  EXPECT_EQ(simulator.wait_for_end(120.0), 0);
  for (const char* none : {" 0 impacts,", " 0 bubbles,", " 0 cavities"}) {
    EXPECT_THAT(simulator.output(), Not(HasSubstr(none)));
  }
  EXPECT_THAT(cached(".so"), testing::UnorderedElementsAreArray(before));
}

/// The last of the programs in `files`, whose others stay as they are.
fs::path last_of(std::vector<fs::path> files) {
  return files.empty() ? fs::path() : *std::max_element(files.begin(), files.end());
}

/// PoCL 3.1 crashes on each: file too short, SIGBUS, an assertion that fails.
TEST_F(OpenClFault, DamagedCacheIsCompiledAgain) {
  ASSERT_EQ(simulate_with_cache().code, 0);
  EXPECT_THAT(simulate_with_cache().text, Not(HasSubstr("damaged"))) << "the seal is right";
  const fs::path stats = last_of(cached("reduce_stats.so"));
  ASSERT_FALSE(stats.empty());
  const auto expect_mended = [&](int programs) {
    const auto [code, text] = simulate_with_cache();
    EXPECT_EQ(code, 0) << text;
    EXPECT_THAT(text,
                HasSubstr(std::to_string(programs) + " compiled programs in " + cache().string() +
                          " were damaged or left unfinished; they are compiled again"));
  };
  const fs::path program = stats.parent_path().parent_path().parent_path() / "program.bc";
  const fs::path other = last_of(cached("touch_water.so"));  // of another program
  ASSERT_FALSE(other.empty());
  std::ofstream(stats) << "garbage";
  fs::resize_file(other, 5000);
  expect_mended(2);
  fs::resize_file(program, 100);
  fs::remove(stats);
  expect_mended(1);
  // Without a seal nothing tells what is damaged: the first start fails and says so, the next one
  // mends it.
  fs::remove(cache() / "splash-sums");
  fs::resize_file(program, 0);
  const Ended without_seal = simulate_with_cache();
  EXPECT_EQ(without_seal.code, 69) << without_seal.text;
  EXPECT_THAT(without_seal.text, HasSubstr("start again"));
  EXPECT_EQ(simulate_with_cache().code, 0);
  EXPECT_THAT(simulate_with_cache().text, Not(HasSubstr("damaged")));
}

}  // namespace
}  // namespace splash::tests
