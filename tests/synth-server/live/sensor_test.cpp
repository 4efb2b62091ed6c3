// SPDX-License-Identifier: MIT
// The real program measures a transducer through JACK: what it plays comes back through a filter
// that is known, on an input, and the response that it prints is the filter's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <jack/jack.h>

#include <cerrno>
#include <stdexcept>
#include <string>
#include <vector>

#include "synth-server/output/rig_reader.hpp"
#include "tests/support/jack.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/waiting.hpp"
#include "tests/synth-server/live/transducer.hpp"

namespace splash::synth {
namespace {

constexpr double kRate = 48000.0;
constexpr int kPeriod = 8192;  ///< so long that a busy machine is seldom late [frames]
constexpr int kMostTakes = 4;

/// A shaker with a resonance and a dip.
Transducer transducer() {
  return {kRate, {peak(95.0, 14.0, 2.5, kRate), peak(220.0, -8.0, 1.5, kRate)}};
}

/// A cord with a transducer and a sensor at its end.
class Cord {
 public:
  Cord() : client_(jack_client_open("splash-cord", JackNoStartServer, nullptr)) {
    if (client_ == nullptr) throw std::runtime_error("no JACK server");
    in_ = jack_port_register(client_, "in", JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0);
    out_ = jack_port_register(client_, "out", JACK_DEFAULT_AUDIO_TYPE, JackPortIsOutput, 0);
    jack_set_process_callback(client_, &Cord::process, this);
    jack_activate(client_);
  }
  ~Cord() { jack_client_close(client_); }
  Cord(const Cord&) = delete;
  Cord& operator=(const Cord&) = delete;

  /// From the synth's `channel` to its input `sensor`, both from 0, as soon as it plays.
  bool plug(int channel, int sensor) {
    const std::string from = "synth-server:outport " + std::to_string(channel);
    const std::string to = "synth-server:inport " + std::to_string(sensor);
    const auto connects = [&](const std::string& a, const std::string& b) {
      const int result = jack_connect(client_, a.c_str(), b.c_str());
      return result == 0 || result == EEXIST;
    };
    return tests::eventually(
        [&] { return connects(from, jack_port_name(in_)) && connects(jack_port_name(out_), to); },
        10.0, 0.005);
  }

 private:
  static int process(jack_nframes_t frames, void* self) {
    auto& cord = *static_cast<Cord*>(self);
    const auto* in = static_cast<const float*>(jack_port_get_buffer(cord.in_, frames));
    auto* out = static_cast<float*>(jack_port_get_buffer(cord.out_, frames));
    for (jack_nframes_t n = 0; n < frames; ++n) {
      out[n] = static_cast<float>(0.3 * cord.transducer_.process(static_cast<double>(in[n])));
    }
    return 0;
  }

  jack_client_t* client_;
  jack_port_t* in_ = nullptr;
  jack_port_t* out_ = nullptr;
  Transducer transducer_ = transducer();
};

/// What the program prints, once it was given no samples too late.
std::string measured() {
  std::string text;
  for (int take = 0; take < kMostTakes; ++take) {
    Cord cord;
    tests::ChildProcess synth(
        tests::command("synth-server", {"--rig", tests::rig_path("handheld+stereo.yaml"), "--api",
                                        "jack", "--sweep", "1", "--sensor", "2"}));
    EXPECT_TRUE(cord.plug(0, 1)) << synth.output();
    const auto code = synth.wait_for_end(60.0);
    text = synth.output();
    if (code == 0) break;
    EXPECT_THAT(text, testing::HasSubstr("the device lost samples"));
  }
  return text;
}

TEST(Sensor, MeasuresAKnownFilterThroughTheDevice) {
  const tests::JackServer server("sensor", {3, kPeriod, 48000, 2});
  const std::string text = measured();
  EXPECT_THAT(text, testing::HasSubstr("heard by input 2"));
  const auto lines = text.find("    equalisers:");
  ASSERT_NE(lines, std::string::npos) << text;
  const Rig rig = parse_rig(
      "name: r\noutputs:\n  - name: hand\n    kind: single\n    band: {low: 20, high: 750}\n" +
          text.substr(lines),
      "r.yaml");
  transducer().expect_measured(rig.outputs.at(0).equalisers.at(0).response, 0.3);
}

TEST(Sensor, ThatIsNotThereIsRefused) {
  const tests::JackServer server("sensor", {3, kPeriod, 48000, 2});
  const auto [code, text] =
      tests::run_program("synth-server", {"--rig", tests::rig_path("handheld+stereo.yaml"), "--api",
                                          "jack", "--sweep", "1", "--sensor", "3"});
  EXPECT_EQ(code, 69) << text;
  EXPECT_THAT(text, testing::HasSubstr("has 2 inputs"));
  const auto null =
      tests::run_program("synth-server", {"--rig", tests::rig_path("handheld+stereo.yaml"),
                                          "--device", "null", "--sweep", "1", "--sensor", "1"});
  EXPECT_EQ(null.code, 69) << null.text;
  EXPECT_THAT(null.text, testing::HasSubstr("--sensor needs a sound device"));
}

}  // namespace
}  // namespace splash::synth
