// SPDX-License-Identifier: MIT
// Which devices there are, which is taken, and what buffers on it can hold.
#include "sim-server/device/device.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>

#include "sim-server/device/buffer.hpp"
#include "sim-server/device/device_choice.hpp"

namespace splash::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(Devices, AreListedWithTheirFacts) {
  const auto list = list_devices();
  ASSERT_FALSE(list.empty());
  for (std::size_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(list[i].index, static_cast<int>(i));
    EXPECT_FALSE(list[i].name.empty());
    EXPECT_FALSE(list[i].platform.empty());
    EXPECT_GT(list[i].compute_units, 0U);
    EXPECT_GT(list[i].allocation, 1U << 20);
    EXPECT_GE(list[i].memory, list[i].allocation);
  }
}

TEST(Devices, AreDescribedOnOneLine) {
  DeviceFacts facts;
  facts.index = 3;
  facts.name = "Abacus";
  facts.platform = "Wood";
  facts.driver = "1.5";
  facts.kind = DeviceKind::cpu;
  facts.compute_units = 7;
  facts.memory = std::size_t{5} << 30;
  EXPECT_EQ(describe(facts), "3: Abacus (CPU, 7 compute units, 5120 MiB, Wood, driver 1.5)");
  facts.kind = DeviceKind::gpu;
  EXPECT_THAT(describe(facts), HasSubstr("(GPU, "));
  facts.kind = DeviceKind::accelerator;
  EXPECT_THAT(describe(facts), HasSubstr("(accelerator, "));
}

TEST(Devices, TheDefaultIsTheFirstOfThoseMeant) {
  const char* wish = std::getenv("SPLASH_DEVICE");
  const Device device;
  const auto meant = meant_devices(list_devices(), wish != nullptr ? wish : "");
  EXPECT_EQ(device.facts().index, meant.front().index);
  EXPECT_EQ(Device(device.facts().index).facts().name, device.facts().name);
}

TEST(Devices, HaveTheKernelsOfGpusWhereTheEnvironmentAsksForThem) {
  const int usual = Device().lanes();
  setenv("SPLASH_SCALAR", "1", 1);
  const int scalar = Device().lanes();
  const int asked_for = Device(-1, false, 8).lanes();
  unsetenv("SPLASH_SCALAR");
  EXPECT_EQ(scalar, 1);
  EXPECT_EQ(asked_for, 8) << "who names a width gets it";
  EXPECT_EQ(Device().lanes(), usual);
}

TEST(Devices, OutOfRangeIsAnsweredWithThoseThereAre) {
  const auto list = list_devices();
  for (const int index : {static_cast<int>(list.size()), 1000}) {
    EXPECT_THAT([index] { Device device(index); },
                ThrowsMessage<std::runtime_error>(
                    AllOf(HasSubstr("--device " + std::to_string(index) +
                                    ": there is no such OpenCL device; there " +
                                    (list.size() == 1 ? "is only 0: " : "are 0: ")),
                          HasSubstr(describe(list.back())))));
  }
}

TEST(Devices, AProfileSuitsTheDeviceUnlessChosen) {
  const Device device;
  const bool wide = device.handle().getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>() >= 16;
  EXPECT_EQ(device.lanes(), device.facts().kind != DeviceKind::cpu ? 1 : wide ? 16 : 8);
  EXPECT_EQ(Device(-1, false, 8).lanes(), 8);
  const Profile scalar = Device(-1, false, 1).profile();
  EXPECT_EQ(scalar.sort_chunks, 0);
  EXPECT_EQ(scalar.team, scalar.group);
  EXPECT_EQ(cpu_profile(0).sort_chunks, 1);
  EXPECT_EQ(cpu_profile(1000).sort_chunks, 64);
}

TEST(Buffers, BeginAsZerosAndKeepWhatIsWritten) {
  Device device;
  Buffer<int> buffer(device, 1000);
  EXPECT_EQ(buffer.size(), 1000U);
  EXPECT_EQ(buffer.read(device, 1000), std::vector<int>(1000, 0));
  std::vector<int> values(100);
  std::iota(values.begin(), values.end(), 5);
  buffer.write(device, values, 300);
  const std::vector<int> all = buffer.read(device, 1000);
  EXPECT_EQ(all[299], 0);
  EXPECT_EQ(all[300], 5);
  EXPECT_EQ(all[399], 104);
  EXPECT_EQ(all[400], 0);
  std::vector<int> some(2);
  buffer.read(device, std::span<int>(some), 398);
  EXPECT_EQ(some, (std::vector<int>{103, 104}));
}

TEST(Buffers, OfNothingAreAllowed) {
  Device device;
  Buffer<float> buffer(device, 0);
  EXPECT_EQ(buffer.size(), 0U);
  EXPECT_TRUE(buffer.read(device, 0).empty());
  EXPECT_NO_THROW(buffer.write(device, {}));
}

TEST(Buffers, TooLargeAreRefusedWithBothSizes) {
  Device device;
  const std::size_t allowed = device.facts().allocation;
  const std::size_t wanted = allowed + (std::size_t{16} << 20);
  EXPECT_THAT([&] { Buffer<char> buffer(device, wanted); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("buffer of " + std::to_string(wanted >> 20) + " MiB"),
                        HasSubstr("allows " + std::to_string(allowed >> 20) + " MiB"),
                        HasSubstr("lower the scene's particles"))));
}

}  // namespace
}  // namespace splash::sim
