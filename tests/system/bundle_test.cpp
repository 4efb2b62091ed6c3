// SPDX-License-Identifier: MIT
// The bundle, moved away from where it was made; what its programs start with on hosts that are
// folders of stand-ins; and its check of a device, whose programs are played by scripts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/programs.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::tests {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

const fs::path kScripts = fs::path(SPLASH_SOURCE_DIR) / "bundle";

class Bundle : public testing::Test {
 protected:
  static void write(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  static void write_program(const fs::path& file, const std::string& body) {
    write(file, "#!/bin/sh\n" + body + "\n");
    fs::permissions(file, fs::perms::owner_all);
  }
  static Ended run(const Arguments& words, const ChildProcess::Environment& environment = {}) {
    return run_command(words, 300.0, environment);
  }
  const fs::path& folder() const { return folder_.path(); }
  /// A PATH with bash and what it may call of coreutils.
  std::pair<std::string, std::string> bare_path() const {
    const fs::path tools = folder() / "tools";
    fs::create_directories(tools);
    for (const char* name :
         {"bash", "basename", "cat", "cksum", "date", "dirname", "du", "ln", "mkdir", "mktemp",
          "mv", "nproc", "readlink", "rm", "sleep", "tail", "timeout", "uname"}) {
      if (!fs::exists(tools / name)) fs::create_symlink(fs::path("/usr/bin") / name, tools / name);
    }
    return {"PATH", tools.string()};
  }
  /// Of a user who has started nothing yet.
  std::pair<std::string, std::string> new_cache() const {
    return {"XDG_CACHE_HOME", (folder() / "cache").string()};
  }

 private:
  TemporaryFolder folder_;
};

// --- As it is made ----------------------------------------------------------------------------

class MadeBundle : public Bundle {
 protected:
  void make(const fs::path& tarball) const {
    const Ended made = run({kScripts / "make.sh", fs::path(SPLASH_BINARY_DIR).parent_path(), "9.8",
                            tarball, "sim-server"});
    ASSERT_EQ(made.code, 0) << made.text;
  }
};

// What ./splash bundle gives to make.sh has each program that is installed.
TEST_F(MadeBundle, IsAskedForEveryProgram) {
  const std::string launcher = text_of(kScripts.parent_path() / "splash");
  const std::size_t list = launcher.find("readonly kBundled=(");
  ASSERT_NE(list, std::string::npos);
  const std::string bundled = launcher.substr(list, launcher.find(')', list) - list);
  for (const char* room : {"sim-server", "synth-server", "synth-server/figure", "view-server"}) {
    const std::string file = text_of(kScripts.parent_path() / room / "CMakeLists.txt");
    const std::string begins = "install(TARGETS ";
    const std::size_t name = file.find(begins);
    ASSERT_NE(name, std::string::npos) << room;
    const std::size_t first = name + begins.size();
    EXPECT_THAT(bundled, HasSubstr(file.substr(first, file.find(' ', first) - first))) << room;
  }
}

/// Of each row "package | version | files | licence", in full.
void expect_licences(const fs::path& top) {
  std::ifstream rows(top / "share/libraries.txt");
  std::string row;
  std::string files;
  std::getline(rows, row);  // the heading
  while (std::getline(rows, row)) {
    const std::string package = row.substr(0, row.find(' '));
    EXPECT_GT(fs::file_size(top / "share/licences" / package), 100U) << row;
    EXPECT_THAT(row, ContainsRegex("^[^ ]+ . [0-9][^ ]* . [^|]+ . ")) << row;
    files += row;
  }
  EXPECT_THAT(files, AllOf(HasSubstr(" libOpenCL.so.1 "), HasSubstr("ld-linux-x86-64.so.2 "),
                           HasSubstr(" libstdc++.so.6 "), HasSubstr("(compiled in)")));
}

TEST_F(MadeBundle, IsTheSameBytesTwiceAndRunsFromAnotherPlace) {
  fs::create_directories(folder() / "moved here");
  make(folder() / "once.tar");
  make(folder() / "twice.tar");
  EXPECT_TRUE(text_of(folder() / "once.tar") == text_of(folder() / "twice.tar"));
  ASSERT_EQ(run({"tar", "xf", folder() / "once.tar", "-C", folder() / "moved here"}).code, 0);
  const fs::path top = folder() / "moved here" / "splash-9.8-x86_64";

  const std::string files = run({"tar", "tf", folder() / "once.tar"}).text;
  for (const char* wanted : {"bin/sim-server", "lib/libOpenCL.so.1", "lib/libstdc++.so.6",
                             "lib/glibc/ld-linux-x86-64.so.2", "lib/glibc/libpthread.so.0",
                             "share/splash/configs/scenes/pool.yaml", "README.txt", "LICENSE"}) {
    EXPECT_THAT(files, HasSubstr(std::string("/") + wanted + "\n"));
  }
  EXPECT_THAT(files, Not(ContainsRegex("lib/lib(c|m|GL|cuda|nvidia)[.-]")));
  expect_licences(top);

  const Ended check = run({top / "bin/sim-server", "--scene", "pool", "--check"});
  EXPECT_EQ(check.code, 0);
  EXPECT_THAT(check.text, HasSubstr("scene   pool: two feet"));
  // A device is tested by the program started anew, under the same loader. Compiled kernels are
  // kept for the next time, not who stood the test.
  const fs::path cache = fs::path(SPLASH_BINARY_DIR).parent_path() / "bundle-cache";
  fs::remove(cache / "splash-devices");
  const Ended scene =
      run({top / "bin/sim-server", "--scene", "rest", "--duration", "0.2", "--listen",
           "127.0.0.1:0", "--faster-than-real-time"},
          {{"POCL_DEVICES", "basic pthread"}, {"POCL_CACHE_DIR", cache.string()}, new_cache()});
  EXPECT_EQ(scene.code, 0) << scene.text;
  EXPECT_THAT(scene.text, AllOf(ContainsRegex("0.2. s simulated"), Not(HasSubstr("passed over"))));
  EXPECT_THAT(text_of(cache / "splash-devices"), HasSubstr("Portable Computing Language"));
}

// --- How it starts ----------------------------------------------------------------------------

/// A bundle of empty files, with glibc 2.36 and g++ 12's library, and a host of others.
class StartOfABundle : public Bundle {
 protected:
  StartOfABundle() {
    fs::create_directories(bundle_ / "bin");
    fs::create_directories(bundle_ / "lib/programs");
    fs::copy_file(kScripts / "start.sh", bundle_ / "lib/start");
    fs::create_symlink("../lib/start", bundle_ / "bin/program");
    write_program(bundle_ / "lib/programs/program", "");
    write(bundle_ / "lib/glibc/version", "2.36\n");
    library(bundle_ / "lib", "libstdc++.so.6", ".0.30");
    library(bundle_ / "lib", "libyaml-cpp.so.0.7", ".0");
    write(bundle_ / "lib/libgcc_s.so.1", "");
  }
  static void library(const fs::path& folder, const std::string& name, const std::string& rest) {
    write(folder / (name + rest), "");
    fs::create_symlink(name + rest, folder / name);
  }
  void host_glibc(const std::string& version) const {
    write_program(host_ / "lib64/ld-linux-x86-64.so.2",
                  "echo 'GNU C Library (Some GLIBC) stable release version " + version + ".'");
    write(host_ / "lib64/libc.so.6", "");
  }
  /// What it would do.
  std::string start(const ChildProcess::Environment& more = {}) const {
    ChildProcess::Environment environment{
        {"SPLASH_START", "show"}, {"SPLASH_HOST", host_.string()}, new_cache()};
    environment.insert(environment.end(), more.begin(), more.end());
    const Ended shown = run({bundle_ / "bin/program"}, environment);
    EXPECT_EQ(shown.code, 0) << shown.text;
    return shown.text;
  }

  fs::path bundle_ = folder() / "bundle";
  fs::path host_ = folder() / "host";
};

TEST_F(StartOfABundle, TakesItsOwnCLibraryWhereTheHostsIsOlder) {
  host_glibc("2.31");
  library(host_ / "usr/lib/x86_64-linux-gnu", "libstdc++.so.6", ".0.28");
  EXPECT_THAT(start(), AllOf(HasSubstr("the bundle's C library, 2.36: the host's is 2.31\n"),
                             HasSubstr("which are newer: none\n"),
                             HasSubstr((bundle_ / "lib/glibc/ld-linux-x86-64.so.2").string() +
                                       " --library-path " + (bundle_ / "lib/glibc").string() + ":" +
                                       (bundle_ / "lib").string() + " ")));
}

TEST_F(StartOfABundle, TakesItsOwnWhereThereIsNone) {
  EXPECT_THAT(start(), HasSubstr("the bundle's C library, 2.36: the host has no glibc\n"));
}

TEST_F(StartOfABundle, LeavesToNewerHostsWhatIsNewerThere) {
  host_glibc("2.101");
  library(host_ / "usr/lib64", "libstdc++.so.6", ".0.33");
  library(host_ / "usr/lib64", "libyaml-cpp.so.0.7", ".0");
  const std::string said = start();
  EXPECT_THAT(said, AllOf(HasSubstr("the host's C library, 2.101: the bundle's is 2.36\n"),
                          HasSubstr("which are newer: libstdc++.so.6 libgcc_s.so.1"),
                          HasSubstr((host_ / "lib64/ld-linux-x86-64.so.2").string() +
                                    " --library-path " + (folder() / "cache").string())));
  const std::string path = said.substr(said.find("--library-path ") + 15);
  const fs::path links = path.substr(0, path.find(' '));
  EXPECT_TRUE(fs::exists(links / "libyaml-cpp.so.0.7"));
  EXPECT_FALSE(fs::exists(links / "libstdc++.so.6"));
  EXPECT_FALSE(fs::exists(links / "libgcc_s.so.1"));
  EXPECT_EQ(start(), said) << "the second start finds the folder of the first";
}

TEST_F(StartOfABundle, FindsDriversWithAndWithoutAWordInEtc) {
  EXPECT_THAT(start(), HasSubstr("OpenCL drivers: none\n"));
  write(host_ / "etc/OpenCL/vendors/pocl.icd", "libpocl.so.2\n");
  const fs::path nvidia = host_ / "usr/local/nvidia/lib64/libnvidia-opencl.so.1";
  const fs::path amd = host_ / "opt/rocm-6.2.0/lib/libamdocl64.so";
  write(nvidia, "");
  write(amd, "");
  write(bundle_ / "lib/pocl/libpocl.so.2", "");
  const std::string both = nvidia.string() + " " + amd.string();
  EXPECT_THAT(start(), AllOf(HasSubstr("OpenCL drivers: libpocl.so.2 " + both + "\n"),
                             HasSubstr(":" + nvidia.parent_path().string() + ":")));
  // The bundle's own PoCL is for hosts without one.
  fs::remove(host_ / "etc/OpenCL/vendors/pocl.icd");
  EXPECT_THAT(start(), HasSubstr("OpenCL drivers: " + both + " " +
                                 (bundle_ / "lib/pocl/libpocl.so.2").string() + "\n"));
  // What /etc names is not taken a second time.
  write(host_ / "etc/OpenCL/vendors/nvidia.icd", "libnvidia-opencl.so.1\n");
  EXPECT_THAT(start(), HasSubstr("OpenCL drivers: libnvidia-opencl.so.1 " + amd.string() + " "));
  EXPECT_THAT(start({{"OCL_ICD_VENDORS", "/some/folder"}}),
              HasSubstr("OpenCL drivers: as $OCL_ICD_VENDORS says\n"));
}

TEST_F(StartOfABundle, GivesTheLoaderOfOpenClAFileForEachDriver) {
  write_program(
      host_ / "lib64/ld-linux-x86-64.so.2",
      "case $1 in *libc.so.6) echo 'release version 2.36';; "
      "*) cat \"$OCL_ICD_VENDORS\"/*.icd; echo \"$SPLASH_PROGRAM\"; shift 2; echo \"$@\";; esac");
  write(host_ / "lib64/libc.so.6", "");
  const fs::path nvidia = host_ / "usr/lib/x86_64-linux-gnu/libnvidia-opencl.so.1";
  write(nvidia, "");
  const Ended ran = run({bundle_ / "bin/program", "one", "two words"},
                        {{"SPLASH_HOST", host_.string()}, new_cache()});
  EXPECT_EQ(ran.text, nvidia.string() + "\n" + (bundle_ / "bin/program").string() +
                          "\n--library-path " + (bundle_ / "lib").string() + ":" +
                          nvidia.parent_path().string() + " " +
                          (bundle_ / "lib/programs/program").string() + " one two words\n");
}

TEST_F(StartOfABundle, NeedsBashAndCoreutilsAlone) {
  host_glibc("2.40");
  library(host_ / "usr/lib64", "libstdc++.so.6", ".0.33");
  write(host_ / "etc/OpenCL/vendors/any.icd", "libany.so\n");
  const std::string usual = start();
  fs::remove_all(folder() / "cache");
  EXPECT_EQ(start({bare_path()}), usual);
}

TEST_F(StartOfABundle, ThatIsNotWholeSaysSo) {
  fs::remove(bundle_ / "lib/programs/program");
  const Ended ran = run({bundle_ / "bin/program"});
  EXPECT_EQ(ran.code, 69);
  EXPECT_THAT(ran.text, HasSubstr("lib/programs/program is missing; unpack the bundle anew"));
}

// --- Its check of a device --------------------------------------------------------------------

class CheckOfADevice : public Bundle {
 protected:
  CheckOfADevice() {
    fs::create_directories(bin_);
    fs::copy_file(kScripts / "device_check.sh", bin_ / "splash-device-check");
    write_program(
        bin_ / "sim-server",
        "case \"$*\" in *--device\\ none*) echo 'sim-server: there is no such device' >&2; "
        "exit 69;; *--list-devices*) echo '3: Some GPU (GPU, 5 units)';; esac");
    for (const char* name : {"synth-server", "bench-fluid", "bench-scenes", "stress_test"}) {
      write_program(bin_ / name, "echo \"$SPLASH_DEVICE $*\"");
    }
    for (const char* name : {"sim_fluid_test", "sim_free_bodies_test", "sim_detect_test",
                             "sim_gauge_test", "validation"}) {
      write_program(bin_ / name, "echo '[       OK ] Some.Test (1 ms)'");
    }
  }
  Ended check(Arguments more = {}) const {
    write(folder() / "share/libraries.txt", "libsome | 1.2 | libsome.so | Zlib\n");
    more.insert(more.begin(), {bin_ / "splash-device-check", "--out", out_});
    return run(more, {bare_path()});
  }
  std::string report() const { return text_of(out_ / "report.md"); }

  fs::path bin_ = folder() / "bin";
  fs::path out_ = folder() / "report";
};

TEST_F(CheckOfADevice, ThatHoldsAllEndsWithZero) {
  const Ended checked = check();
  EXPECT_EQ(checked.code, 0) << checked.text;
  EXPECT_THAT(checked.text, HasSubstr("Taken: 3: Some GPU"));
  EXPECT_THAT(report(), AllOf(HasSubstr("# Some GPU\n"), HasSubstr("| self-test | held |"),
                              ContainsRegex("kernels . held . 0:0. . 4 tests passed "),
                              HasSubstr("\n3 --seconds "), ContainsRegex("\n[0-9]+ MB unpacked"),
                              HasSubstr("\nlibsome | 1.2 | ")));
}

TEST_F(CheckOfADevice, GoesOnAfterAFailureAndSaysWhat) {
  write_program(bin_ / "sim_detect_test",
                "echo '[       OK ] Good.One (1 ms)'; echo '[  FAILED  ] Bad.One (2 ms)'; exit 1");
  write_program(bin_ / "bench-scenes", "exit 70");
  const Ended checked = check();
  EXPECT_EQ(checked.code, 1);
  EXPECT_THAT(report(),
              AllOf(ContainsRegex(
                        "kernels . FAILED .1. . 0:0. . 4 tests passed, 1 failed: Bad.One .2 ms. "),
                    HasSubstr("| scenes | FAILED (70) |"), HasSubstr("| stages | held |")));
}

TEST_F(CheckOfADevice, KeepsItsTimeAndNamesWhatDidNotFit) {
  write_program(bin_ / "sim-server",
                "case \"$*\" in *--list*) echo '0: Slow (CPU)';; *--check*) sleep 100;; esac");
  const Ended checked = check({"--minutes", "1"});
  EXPECT_EQ(checked.code, 2) << checked.text;
  EXPECT_THAT(report(),
              AllOf(HasSubstr("| self-test | cut off | 0:1"), HasSubstr("| size | held |")));
}

TEST_F(CheckOfADevice, DoesThePartsThatAreAskedForAnewEachTime) {
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(check({"--part", "kernels", "--part", "size"}).code, 0);
    EXPECT_THAT(report(), AllOf(HasSubstr("| kernels |"), HasSubstr("| 4 tests passed |"),
                                HasSubstr("| size |"), Not(HasSubstr("| scenes |"))));
  }
}

TEST_F(CheckOfADevice, RefusesWhatIsNoPartNoTimeAndNoDevice) {
  EXPECT_EQ(check({"--part", "nonsense"}).code, 64);
  EXPECT_EQ(check({"--minutes", "0"}).code, 64);
  EXPECT_EQ(check({"--nonsense"}).code, 64);
  const Ended nowhere = check({"--device", "none"});
  EXPECT_EQ(nowhere.code, 69);
  EXPECT_THAT(nowhere.text, HasSubstr("there is no such device"));
}

}  // namespace
}  // namespace splash::tests
