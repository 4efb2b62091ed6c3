// SPDX-License-Identifier: MIT
// How long from sending an event to its first sample: the real synth-server on a JACK server
// without a device, over loopback, at several periods. The sample's time is that of JACK's cycle
// plus its place in it; a sound card adds the playback latency of its own that JACK reports.
#include <jack/jack.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/message.hpp"
#include "protocol/udp_socket.hpp"
#include "tests/bench/plot.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/jack.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/waiting.hpp"

namespace {

using namespace splash;
using tests::sleep;

constexpr int kRate = 48000;
constexpr int kEvents = 200;
constexpr double kSeconds = 14.0;    ///< recorded
constexpr double kOpening = 4.0;     ///< the gate opens slowly, the clock settles [s]
constexpr double kMargin = 0.0002;   ///< over one block, for events with a time tag [s]
constexpr double kLongest = 0.030;   ///< an onset later than this belongs to no event [s]
constexpr double kDistance = 0.031;  ///< between events, at least [s]

/// A JACK client that keeps what the synth plays on its first channel, and the cycles' times.
class Recorder {
 public:
  Recorder() : samples_(static_cast<std::size_t>(kSeconds * kRate)) {
    client_ = jack_client_open("splash-bench", JackNoStartServer, nullptr);
    if (client_ == nullptr) throw std::runtime_error("no JACK server");
    starts_.reserve(samples_.size() / 16);
    port_ = jack_port_register(client_, "in", JACK_DEFAULT_AUDIO_TYPE, JackPortIsInput, 0);
    jack_set_process_callback(client_, &Recorder::process, this);
    jack_set_xrun_callback(client_, &Recorder::note_xrun, this);
    if (jack_activate(client_) != 0) throw std::runtime_error("JACK refuses to activate a client");
    if (jack_connect(client_, "synth-server:outport 0", jack_port_name(port_)) != 0) {
      throw std::runtime_error("synth-server has no port 'outport 0'");
    }
  }
  ~Recorder() { jack_client_close(client_); }
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  [[nodiscard]] bool full() const { return filled_ + 4096 > samples_.size(); }
  void stop() { jack_deactivate(client_); }
  [[nodiscard]] int xruns() const { return xruns_; }
  [[nodiscard]] const std::vector<float>& samples() const { return samples_; }
  /// When a sample's block came here, plus its place in the block [s, monotonic].
  [[nodiscard]] double time_of(std::size_t sample) const {
    const auto after =
        std::upper_bound(starts_.begin(), starts_.end(), sample,
                         [](std::size_t at, const Start& s) { return at < s.first; });
    const Start& start = *std::prev(after);
    return start.time + static_cast<double>(sample - start.first) / kRate;
  }

 private:
  struct Start {
    std::size_t first = 0;
    double time = 0.0;  ///< [s, monotonic]
  };
  static int note_xrun(void* self) {
    ++static_cast<Recorder*>(self)->xruns_;
    return 0;
  }
  static int process(jack_nframes_t frames, void* self) {
    static_cast<Recorder*>(self)->keep(frames);
    return 0;
  }
  void keep(jack_nframes_t frames) {
    if (full() || starts_.size() == starts_.capacity()) return;
    starts_.push_back({filled_, protocol::monotonic_now()});
    const auto* in = static_cast<const float*>(jack_port_get_buffer(port_, frames));
    std::copy_n(in, frames, samples_.begin() + static_cast<std::ptrdiff_t>(filled_));
    filled_ += frames;
  }

  jack_client_t* client_ = nullptr;
  jack_port_t* port_ = nullptr;
  std::vector<float> samples_;
  std::vector<Start> starts_;
  std::atomic<std::size_t> filled_{0};
  std::atomic<int> xruns_{0};
};

struct Mode {
  std::string name;
  bool tagged = false;
};

struct Result {
  std::vector<double> latencies;  ///< [s], rising
  int unheard = 0;
  int xruns = 0;

  [[nodiscard]] double quantile(double part) const {
    return latencies.at(static_cast<std::size_t>(part * static_cast<double>(latencies.size() - 1)));
  }
};

/// Sends the events; when each was sent [s, monotonic].
std::vector<double> send_events(const protocol::Endpoint& synth, bool tagged) {
  protocol::UdpSocket socket(protocol::Endpoint{INADDR_LOOPBACK, 0});
  std::mt19937 random(1);
  std::uniform_real_distribution<double> extra(0.0, 0.012);
  std::vector<double> sent;
  for (int id = 0; id < kEvents; ++id) {
    sleep(kDistance + extra(random));
    const auto message =
        protocol::to_message(protocol::Bubble{id, 0, 0.0004F, 0.5F, {0.0F, 0.0F, 0.0F}, 0.0F});
    const double now = protocol::monotonic_now();
    const auto bytes =
        tagged ? protocol::encode(protocol::to_time_tag(protocol::unix_now()), {message})
               : protocol::encode(message);
    socket.send_to(synth, bytes);
    sent.push_back(now);
  }
  return sent;
}

Result match(const std::vector<double>& sent, const Recorder& recorder) {
  const auto& samples = recorder.samples();
  const float loudest = *std::max_element(samples.begin(), samples.end());
  Result result;
  result.xruns = recorder.xruns();
  std::size_t at = 0;
  for (const double moment : sent) {
    while (at < samples.size() && recorder.time_of(at) < moment) ++at;
    std::size_t onset = at;
    while (onset < samples.size() && std::abs(samples[onset]) < 0.02F * loudest) ++onset;
    const double latency = onset < samples.size() ? recorder.time_of(onset) - moment : kLongest;
    if (latency < kLongest) {
      result.latencies.push_back(latency);
    } else {
      ++result.unheard;
    }
  }
  std::sort(result.latencies.begin(), result.latencies.end());
  return result;
}

Result measure(int period, const Mode& mode, bool realtime) {
  const tests::JackServer jackd("bench", {.period = period, .rate = kRate, .realtime = realtime});
  tests::Arguments arguments = {"--rig", tests::rig_path("stereo.yaml"), "--api", "jack"};
  if (mode.tagged) {
    const double latency = static_cast<double>(period) / kRate + kMargin;
    arguments.insert(arguments.end(), {"--latency-ms", std::to_string(1e3 * latency)});
  }
  tests::Synth synth(arguments);
  sleep(kOpening);
  Recorder recorder;
  const std::vector<double> sent = send_events(synth.endpoint(), mode.tagged);
  sleep(0.2);
  recorder.stop();
  return match(sent, recorder);
}

/// How many events took how long, a curve for each period.
void draw(const std::filesystem::path& png, const std::vector<Mode>& modes,
          const std::vector<std::vector<Result>>& results, const std::vector<int>& periods) {
  constexpr double kBin = 0.1;  // [ms]
  constexpr std::size_t kBins = 80;
  bench::Plot plot(png, 1000, 800);
  plot.script() << "set multiplot layout " << modes.size() << ",1\nset ylabel 'events'\n"
                << "set xlabel 'from sending to sample [ms]'\n";
  for (std::size_t mode = 0; mode < modes.size(); ++mode) {
    for (std::size_t k = 0; k < periods.size(); ++k) {
      std::vector<double> x(kBins);
      std::vector<double> y(kBins, 0.0);
      for (std::size_t bin = 0; bin < kBins; ++bin) x[bin] = kBin * static_cast<double>(bin);
      for (const double latency : results[mode][k].latencies) {
        y[std::min(kBins - 1, static_cast<std::size_t>(1e3 * latency / kBin))] += 1.0;
      }
      plot.add({x, y}, std::string("with steps linewidth 1.6 linecolor rgb '") + bench::colour(k) +
                           "' title '" + std::to_string(periods[k]) + " frames'");
    }
    plot.script() << "set title '" << modes[mode].name << "'\n";
    plot.panel();
  }
  plot.draw();
}

void run(bench::Bench& bench, bool realtime) {
  const std::vector<int> periods{64, 128, 256};
  const std::vector<Mode> modes{{"no time tag", false}, {"time tag of now", true}};
  bench.say(std::to_string(kEvents) + " events each over loopback; JACK without a device at " +
            std::to_string(kRate) + " Hz" + (realtime ? ", at real-time priority." : "."));
  auto table = bench.table("latency.csv", {"sent with", "frames", "median [ms]", "5 % [ms]",
                                           "95 % [ms]", "most [ms]", "unheard", "xruns"});
  std::vector<std::vector<Result>> results(modes.size());
  for (std::size_t mode = 0; mode < modes.size(); ++mode) {
    for (const int period : periods) {
      const Result r = measure(period, modes[mode], realtime);
      if (r.latencies.empty()) throw std::runtime_error("no event was heard");
      table.add({modes[mode].name, std::to_string(period), bench::number(1e3 * r.quantile(0.5)),
                 bench::number(1e3 * r.quantile(0.05)), bench::number(1e3 * r.quantile(0.95)),
                 bench::number(1e3 * r.latencies.back()), std::to_string(r.unheard),
                 std::to_string(r.xruns)});
      results[mode].push_back(r);
    }
  }
  bench.tell(table);
  draw(bench.out() / "latency.png", modes, results, periods);
}

}  // namespace

int main(int argc, char** argv) {
  bench::Bench bench("latency", "performance.md", "From an event to its sample",
                     "Measures how long an event takes to its first sample.");
  bool realtime = false;
  bench.options().add_flag("--realtime", realtime,
                           "JACK at real-time priority, which not everybody may ask for");
  return bench.run(argc, argv, [&] {
    run(bench, realtime);
    return true;
  });
}
