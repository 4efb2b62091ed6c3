// SPDX-License-Identifier: MIT
// Kernels are built from several files, and an error is one of the file it is in.
#include "sim-server/device/kernel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "sim-server/device/buffer.hpp"

namespace splash::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const KernelSource kHelper = {"some/helper.h", "static int twice(int a) {\n  return 2 * a;\n}\n"};

TEST(Programs, JoinTheirFilesAndConstants) {
  Device device;
  const KernelSource kernel = {"some/fill.cl",
                               "kernel void fill(int count, global int* out) {\n"
                               "  const int i = get_global_id(0);\n"
                               "  if (i < count) out[i] = twice(i) + OFFSET;\n}\n"};
  const cl::Program program = build_program(device, {kHelper, kernel}, {"OFFSET=100"});
  Kernel fill(program, "fill");
  // Fewer than a work-group, whole groups and a rest; never one past the end.
  for (const int count : {1, 63, 64, 65, 1000}) {
    const Buffer<int> out(device, 1100);
    fill.run(device.queue(), static_cast<std::size_t>(count), {{"count", count}, {"out", out}});
    const std::vector<int> values = out.read(device, 1100);
    for (int i = 0; i < 1100; ++i) {
      ASSERT_EQ(values[static_cast<std::size_t>(i)], i < count ? 2 * i + 100 : 0)
          << i << " of " << count;
    }
  }
}

TEST(Programs, TellHowManyOfTheirKernelsHaveRun) {
  Device device;
  const cl::Program program = build_program(
      device, {{"some/two.cl", "kernel void a(int n) {}\nkernel void b(int n) {}\n"}}, {});
  std::vector<KernelCount> told;
  Kernel a(program, "a");
  Kernel b(program, "b");
  tell_of_kernels([&](const KernelCount& count) { told.push_back(count); });
  a.run(device.queue(), 1, {{"n", 1}});
  a.run(device.queue(), 100, {{"n", 100}});
  b.run(device.queue(), 1, {{"n", 1}});
  tell_of_kernels({});
  Kernel(program, "a").run(device.queue(), 1, {{"n", 1}});
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[1].ready, told[0].ready + 1);
  EXPECT_GE(told[0].all, 2);
}

TEST(Programs, RunNothingOfNothingAndElseWholeGroups) {
  Device device;
  const KernelSource kernel = {"some/count.cl",
                               "kernel void count(global int* out) {\n"
                               "  out[get_global_id(0)] = 1000 * get_local_size(0) + 1;\n}\n"};
  Kernel count(build_program(device, {kernel}, {}), "count", 24);
  const Buffer<int> out(device, 100);
  count.run(device.queue(), 0, {{"out", out}});
  count.run_teams(device.queue(), 0, {{"out", out}});
  EXPECT_EQ(out.read(device, 100), std::vector<int>(100, 0));
  std::vector<int> expected(100, 0);
  count.run(device.queue(), 1, {{"out", out}});
  std::fill(expected.begin(), expected.begin() + 24, 24001);
  EXPECT_EQ(out.read(device, 100), expected);
  count.run_teams(device.queue(), 2, {{"out", out}});
  std::fill(expected.begin(), expected.begin() + 48, 24001);
  EXPECT_EQ(out.read(device, 100), expected);
  count.run(device.queue(), 49, {{"out", out}});  // a third group for one more
  std::fill(expected.begin() + 48, expected.begin() + 72, 24001);
  EXPECT_EQ(out.read(device, 100), expected);
}

// A device may allow fewer work-items to a group than a kernel would like.
TEST(Programs, TakeNoLargerGroupsThanTheKernelAllows) {
  Device device;
  const KernelSource kernel = {"some/size.cl",
                               "kernel void size(global int* out) {\n"
                               "  out[get_global_id(0)] = get_local_size(0);\n}\n"};
  const std::size_t limit = device.handle().getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
  Kernel size(build_program(device, {kernel}, {}), "size", 4 * limit);
  const Buffer<int> out(device, limit);
  size.run_teams(device.queue(), 1, {{"out", out}});
  EXPECT_EQ(out.read(device, limit), std::vector<int>(limit, static_cast<int>(limit)));
}

TEST(Programs, AnErrorNamesItsFileAndLine) {
  const Device device;
  const KernelSource broken = {"some/broken.cl",
                               "// fine\nkernel void k(int a) {\n  a = wrong;\n}\n"};
  EXPECT_THAT(
      [&] {
        static_cast<void>(build_program(device, {kHelper, broken}, {}));
      },
      ThrowsMessage<std::runtime_error>(
          AllOf(HasSubstr("the kernels do not build on " + device.facts().name),
                HasSubstr("some/broken.cl:3"), HasSubstr("wrong"))));
}

TEST(Programs, KnowHowTheyAreBuilt) {
  const Device device(-1, false, 8);
  const KernelSource check = {"some/check.cl",
                              "#if LANES != 8\n#error lanes\n#endif\n"
                              "#if WANTED != 1\n#error defines\n#endif\n"
                              "kernel void k(int a) {}\n"};
  EXPECT_NO_THROW(static_cast<void>(build_program(device, {check}, {"WANTED=1"})));
  EXPECT_THROW(static_cast<void>(build_program(device, {check}, {"WANTED=0"})), std::runtime_error);
}

}  // namespace
}  // namespace splash::sim
