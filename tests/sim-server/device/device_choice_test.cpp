// SPDX-License-Identifier: MIT
// Which device is taken, and what is said about it, on machines that are made up.
#include "sim-server/device/device_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace splash::sim {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

DeviceFacts device(int index, const std::string& name, DeviceKind kind, unsigned units) {
  DeviceFacts facts;
  facts.index = index;
  facts.name = name;
  facts.kind = kind;
  facts.compute_units = units;
  return facts;
}

const DeviceFacts kCpu = device(0, "EPYC", DeviceKind::cpu, 64);
const DeviceFacts kSmallCpu = device(1, "Core", DeviceKind::cpu, 4);
const DeviceFacts kCard = device(2, "NVIDIA H200", DeviceKind::gpu, 132);
const DeviceFacts kChip = device(3, "Intel UHD 770", DeviceKind::gpu, 512);
const DeviceFacts kBoard = device(4, "FPGA", DeviceKind::accelerator, 1);
const std::vector<DeviceFacts> kAll = {kCpu, kSmallCpu, kCard, kChip, kBoard};

std::vector<int> meant(const std::string& wish) {
  std::vector<int> indices;
  for (const DeviceFacts& facts : meant_devices(kAll, wish)) indices.push_back(facts.index);
  return indices;
}

TEST(MeantDevices, AreByKindAndThenByUnits) {
  EXPECT_THAT(meant(""), ElementsAre(3, 2, 4, 0, 1));
}

TEST(MeantDevices, AreNumberNameOrKind) {
  EXPECT_THAT(meant("2"), ElementsAre(2));
  EXPECT_THAT(meant("h200"), ElementsAre(2));
  EXPECT_THAT(meant("Uhd 770"), ElementsAre(3));
  EXPECT_THAT(meant("cpu"), ElementsAre(0, 1));
  EXPECT_THAT(meant("GPU"), ElementsAre(3, 2));
}

TEST(MeantDevices, AreListedWhenNoneIs) {
  for (const char* wish : {"5", "-1", "20", "Voodoo"}) {
    EXPECT_THAT([wish] { static_cast<void>(meant_devices(kAll, wish)); },
                ThrowsMessage<std::runtime_error>(
                    AllOf(HasSubstr(std::string("--device ") + wish + ": there is no such"),
                          HasSubstr("NVIDIA H200"), HasSubstr("EPYC"), HasSubstr("gpu or cpu"))));
  }
}

/// Tests that end as they are told to; those that are not named here must not be asked for.
class Choices : public ::testing::Test {
 protected:
  Choice choose(const std::string& wish, const std::vector<DeviceFacts>& all = kAll) {
    tested_.clear();
    return choose_device(meant_devices(all, wish), !wish.empty(), [this](const DeviceFacts& facts) {
      tested_.push_back(facts.index);
      return trials_.at(facts.index);
    });
  }

  std::map<int, Trial> trials_;
  std::vector<int> tested_;
};

TEST_F(Choices, TakeTheOnlyDeviceWithoutATest) {
  const Choice choice = choose("", {kCpu});
  EXPECT_EQ(choice.device.name, "EPYC");
  EXPECT_EQ(choice.reason, "the only device");
  EXPECT_THAT(choose("cpu", {kCard, kCpu}).reason, "asked for");
  EXPECT_THAT(choose("h200").reason, "asked for");
  EXPECT_THAT(tested_, IsEmpty());
}

TEST_F(Choices, TakeAGpuBeforeACpu) {
  trials_ = {{2, {0.001, ""}}};
  const Choice choice = choose("", {kCpu, kCard});
  EXPECT_EQ(choice.device.index, 2);
  EXPECT_EQ(choice.reason, "a GPU comes before others");
  EXPECT_THAT(choice.passed_over, IsEmpty());
}

TEST_F(Choices, TakeTheFastestOfSeveralGpus) {
  trials_ = {{2, {0.0002, ""}}, {3, {0.004, ""}}};
  const Choice choice = choose("");
  EXPECT_EQ(choice.device.index, 2);
  EXPECT_THAT(choice.reason,
              AllOf(HasSubstr("fastest GPU, 0.20 ms"), HasSubstr("device 3 takes 4.00 ms")));
  EXPECT_EQ(choose("gpu").device.index, 2);
  EXPECT_EQ(choose("gpu", {kChip, kCard}).device.index, 2);
  EXPECT_THAT(tested_, ElementsAre(3, 2));
}

TEST_F(Choices, PassOverWhatFails) {
  trials_ = {{2, {0.0002, ""}}, {3, {0.0, "it hangs"}}};
  const Choice choice = choose("");
  EXPECT_EQ(choice.device.index, 2);
  EXPECT_EQ(choice.reason, "a GPU comes before others");
  EXPECT_THAT(choice.passed_over,
              ElementsAre(AllOf(HasSubstr("3: Intel UHD 770"), HasSubstr("it hangs"))));
}

TEST_F(Choices, EndAtACpuWhenNoGpuStands) {
  trials_ = {{2, {0.0, "wrong"}}, {3, {0.0, "it hangs"}}, {4, {0.0, "no"}}, {0, {0.002, ""}}};
  const Choice choice = choose("");
  EXPECT_EQ(choice.device.index, 0);
  EXPECT_THAT(choice.reason, HasSubstr("no GPU that can be used"));
  EXPECT_EQ(choice.passed_over.size(), 3U);
  trials_[0].failure = "wrong";
  EXPECT_EQ(choose("").device.index, 1) << "the last one is taken as it is";
  EXPECT_EQ(choose("").reason, "no other is left");
}

TEST_F(Choices, TakeTheLastGpuWhereNothingElseIs) {
  trials_ = {{2, {0.0, "wrong"}}, {3, {0.0, "wrong"}}};
  const Choice choice = choose("", {kChip, kCard});
  EXPECT_EQ(choice.device.index, 2);
  EXPECT_EQ(choice.reason, "no other is left");
  EXPECT_THAT(tested_, ElementsAre(3));
}

}  // namespace
}  // namespace splash::sim
