// SPDX-License-Identifier: MIT
// Arguments reach the parameters that they are named for, and nothing else is launched.
#include "sim-server/device/kernel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <initializer_list>
#include <stdexcept>
#include <utility>
#include <vector>

namespace splash::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

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
