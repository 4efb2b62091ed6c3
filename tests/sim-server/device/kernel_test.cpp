// SPDX-License-Identifier: MIT
// Kernels are built from several files, and an error is one of the file it is in; arguments reach
// the parameters that they are named for, and nothing else is launched.
#include "sim-server/device/kernel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <initializer_list>
#include <stdexcept>
#include <utility>
#include <vector>

#include "sim-server/device/buffer.hpp"

namespace splash::sim {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
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

const KernelSource kLine = {"some/line.cl",
                            "kernel void line(int count, float rise,\n"
                            "                 global const float* x,\n"
                            "                 constant int* shift, global float* y) {\n"
                            "  const int i = get_global_id(0);\n"
                            "  if (i < count) y[i] = rise * x[i] + shift[0];\n}\n"};

class Arguments : public ::testing::Test {
 protected:
  void run(std::initializer_list<KernelArg> args) { line_.run(device_.queue(), 3, args); }
  void expect_refused(std::initializer_list<KernelArg> args, const char* words) {
    EXPECT_THAT([&] { run(args); }, ThrowsMessage<std::logic_error>(HasSubstr(words)));
  }
  std::vector<float> result() { return y_.read(device_, 3); }

  Device device_;
  Kernel line_{build_program(device_, {kLine}, {}), "line"};
  Buffer<float> x_{device_, std::vector<float>{1.0F, 2.0F, 3.0F}};
  Buffer<float> other_{device_, std::vector<float>{5.0F, 6.0F, 7.0F}};
  Buffer<int> shift_{device_, std::vector<int>{10}};
  Buffer<float> y_{device_, 3};
};

TEST_F(Arguments, AreTakenByTheirNamesInAnyOrder) {
  run({{"y", y_}, {"shift", shift_}, {"x", x_}, {"rise", 2.0F}, {"count", 3}});
  EXPECT_THAT(result(), ElementsAre(12.0F, 14.0F, 16.0F));
}

TEST_F(Arguments, MayComeInSeveralLists) {
  const std::array<KernelArg, 2> more = {{{"x", x_}, {"shift", shift_}}};
  line_.run(device_.queue(), 3, {{"count", 3}, {"rise", 2.0F}, {"y", y_}}, more);
  EXPECT_THAT(result(), ElementsAre(12.0F, 14.0F, 16.0F));
}

// From launch to launch only what differs is set.
TEST_F(Arguments, AreThoseOfTheLaunchNotOfAnEarlierOne) {
  const std::function<void(const Buffer<float>&, float)> launch = [this](const auto& x,
                                                                         float rise) {
    run({{"count", 3}, {"rise", rise}, {"x", x}, {"shift", shift_}, {"y", y_}});
  };
  launch(x_, 1.0F);
  launch(other_, 1.0F);
  EXPECT_THAT(result(), ElementsAre(15.0F, 16.0F, 17.0F));
  launch(other_, 2.0F);
  EXPECT_THAT(result(), ElementsAre(20.0F, 22.0F, 24.0F));
  std::swap(x_, other_);
  launch(other_, 2.0F);
  EXPECT_THAT(result(), ElementsAre(12.0F, 14.0F, 16.0F));
  x_ = Buffer<float>(device_, std::vector<float>{0.0F, 0.0F, 1.0F});  // where the old one was?
  launch(x_, 2.0F);
  EXPECT_THAT(result(), ElementsAre(10.0F, 10.0F, 12.0F));
  run({{"y", y_}, {"x", x_}, {"rise", 3.0F}, {"count", 3}, {"shift", shift_}});
  EXPECT_THAT(result(), ElementsAre(10.0F, 10.0F, 13.0F));
}

TEST_F(Arguments, OfAnotherNameAreRefused) {
  expect_refused({{"count", 3}, {"raise", 2.0F}, {"x", x_}, {"shift", shift_}, {"y", y_}},
                 "the kernel line has no parameter raise");
}

TEST_F(Arguments, OfAnotherTypeAreRefused) {
  expect_refused({{"count", 3}, {"rise", 2}, {"x", x_}, {"shift", shift_}, {"y", y_}},
                 "the parameter rise of the kernel line is float, and was given int");
  expect_refused({{"count", 3}, {"rise", 2.0F}, {"x", shift_}, {"shift", x_}, {"y", y_}},
                 "the parameter x of the kernel line is float*, and was given int*");
  expect_refused({{"count", 3}, {"rise", 2.0F}, {"x", 1.0F}, {"shift", shift_}, {"y", y_}},
                 "is float*, and was given float");
}

// A launch that differs from the one before in this alone.
TEST_F(Arguments, OfANumberWhereABufferWasAreRefused) {
  run({{"count", 3}, {"rise", 2.0F}, {"x", x_}, {"shift", shift_}, {"y", y_}});
  expect_refused({{"count", 3}, {"rise", 2.0F}, {"x", 1.0F}, {"shift", shift_}, {"y", y_}},
                 "is float*, and was given float");
}

TEST_F(Arguments, AreAllThereAndOnce) {
  for (int again = 0; again < 2; ++again) {
    expect_refused({{"count", 3}, {"rise", 2.0F}, {"x", x_}, {"y", y_}},
                   "the parameter shift of the kernel line was given nothing");
  }
  expect_refused({{"count", 3}, {"rise", 2.0F}, {"x", x_}, {"shift", shift_}, {"y", y_}, {"x", x_}},
                 "the parameter x of the kernel line was given twice");
  run({{"count", 3}, {"rise", 2.0F}, {"x", x_}, {"shift", shift_}, {"y", y_}});
  EXPECT_THAT(result(), ElementsAre(12.0F, 14.0F, 16.0F));
}

// Not all devices tell what a kernel's parameters are called.
TEST_F(Arguments, AreKnownFromTheSourceAsFromTheDevice) {
  const std::vector<KernelParameter> expected = {
      {"count", "int"}, {"rise", "float"}, {"x", "float*"}, {"shift", "int*"}, {"y", "float*"}};
  EXPECT_EQ(parameters_in(kLine.text, "line"), expected);
  EXPECT_EQ(line_.parameters(), expected);
  EXPECT_TRUE(parameters_in(kLine.text, "lin").empty());
}

}  // namespace
}  // namespace splash::sim
