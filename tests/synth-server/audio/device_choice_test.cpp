// SPDX-License-Identifier: MIT
#include "synth-server/audio/device_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace splash::synth {
namespace {

const std::vector<DeviceDescription> kDevices = {
    {"jack", "system", 36, false, 48000},
    {"alsa", "hw:UMC1820,0", 12, true, 44100},
    {"alsa", "hw:UMC404,0", 4, false, 44100},
};

TEST(ChooseDevice, FindsByNameByPartAndByDefault) {
  EXPECT_EQ(choose_device(kDevices, "system", ""), 0U);
  EXPECT_EQ(choose_device(kDevices, "UMC404", ""), 2U);
  EXPECT_EQ(choose_device(kDevices, "", ""), 1U);
}

TEST(ChooseDevice, ListsTheNamesWhenItCannotTell) {
  for (const char* wanted : {"UMC", "Fireface"}) {
    EXPECT_THAT([&] { (void)choose_device(kDevices, wanted, ""); },
                testing::ThrowsMessage<UnknownDevice>(testing::AllOf(
                    testing::HasSubstr(wanted), testing::HasSubstr("hw:UMC1820,0"))));
  }
}

TEST(ChooseDevice, HavingNoneIsNotTheUsersFault) {
  try {
    (void)choose_device({}, "system", "jack");
    FAIL();
  } catch (const UnknownDevice&) {
    FAIL() << "waiting may help";
  } catch (const DeviceError& error) {
    EXPECT_THAT(error.what(),
                testing::StartsWith("there is no device 'system': no JACK server is running"));
  }
}

TEST(ChooseDevice, EachApiNamesWhatToStart) {
  EXPECT_THAT(why_no_device("jack"), testing::HasSubstr("jackd -d alsa"));
  EXPECT_THAT(why_no_device("pulse"), testing::HasSubstr("pulseaudio --start"));
  EXPECT_THAT(why_no_device("alsa"), testing::HasSubstr("aplay -l"));
  EXPECT_THAT(why_no_device(""), testing::HasSubstr("there is no sound device: no JACK server"));
}

TEST(ListDevices, RefusesAnApiThatIsNotThere) {
  EXPECT_THROW((void)list_devices("wavetable"), UnknownDevice);
}

}  // namespace
}  // namespace splash::synth
