// SPDX-License-Identifier: MIT
// How long from sending an event to its first sample: the real synth-server on a JACK server
// without a device, over loopback, at several periods. The sample's time is that of JACK's cycle
// plus its place in it; a sound card adds the playback latency of its own that JACK reports. Prints
// a table; with a folder's name, also writes latency.csv and the histogram latency.png.
#include <jack/jack.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "protocol/message.hpp"
#include "protocol/udp_socket.hpp"
#include "synth-server/figure/gnuplot.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/process_use.hpp"

namespace {

using namespace splash;
using tests::ChildProcess;
using tests::sleep;

constexpr int kRate = 48000;
constexpr int kEvents = 200;
constexpr double kSeconds = 14.0;  ///< recorded
constexpr double kOpening = 4.0;   ///< the gate opens slowly, the clock settles [s]
constexpr double kTimeout = 20.0;
constexpr double kMargin = 0.0002;   ///< over one block, for events with a time tag [s]
constexpr double kLongest = 0.030;   ///< an onset later than this belongs to no event [s]
constexpr double kDistance = 0.031;  ///< between events, at least [s]

void ignore(const char* /*text*/) {}

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

std::unique_ptr<ChildProcess> start_jack(const std::string& name, int period, bool realtime) {
  setenv("JACK_DEFAULT_SERVER", name.c_str(), 1);
  setenv("JACK_NO_AUDIO_RESERVATION", "1", 1);
  jack_set_error_function(ignore);
  jack_set_info_function(ignore);
  auto jackd = std::make_unique<ChildProcess>(std::vector<std::string>{
      "jackd", realtime ? "--realtime" : "--no-realtime", "-S", "-n", name, "-d", "dummy", "-C",
      "0", "-P", "2", "-r", std::to_string(kRate), "-p", std::to_string(period)});
  for (double waited = 0.0; waited < kTimeout && jackd->running(); waited += 0.1) {
    if (auto* probe = jack_client_open("probe", JackNoStartServer, nullptr)) {
      jack_client_close(probe);
      return jackd;
    }
    sleep(0.1);
  }
  throw std::runtime_error("jackd did not start; is it installed (apt-get install jackd2)?\n" +
                           jackd->output());
}

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

protocol::Endpoint listening(ChildProcess& synth) {
  const std::string label = "listening: ";
  if (!synth.wait_for_text(label, kTimeout)) throw std::runtime_error(synth.output());
  sleep(0.1);
  const std::string text = synth.output();
  const auto from = text.find(label) + label.size();
  return protocol::parse_endpoint(text.substr(from, text.find('\n', from) - from), 0);
}

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
  const auto jackd = start_jack("splash-bench-" + std::to_string(getpid()), period, realtime);
  std::vector<std::string> command{std::string(SPLASH_BINARY_DIR) + "/synth-server",
                                   "--rig",
                                   std::string(SPLASH_SOURCE_DIR) + "/configs/rigs/stereo.yaml",
                                   "--api",
                                   "jack",
                                   "--listen",
                                   "127.0.0.1:0"};
  if (mode.tagged) {
    const double latency = static_cast<double>(period) / kRate + kMargin;
    command.insert(command.end(), {"--latency-ms", std::to_string(1e3 * latency)});
  }
  ChildProcess synth(command);
  const protocol::Endpoint endpoint = listening(synth);
  sleep(kOpening);
  Recorder recorder;
  const std::vector<double> sent = send_events(endpoint, mode.tagged);
  sleep(0.2);
  recorder.stop();
  return match(sent, recorder);
}

void draw(const std::filesystem::path& folder, const std::vector<int>& periods,
          const std::vector<Mode>& modes) {
  const auto script = folder / "latency.gp";
  const std::string csv = (folder / "latency.csv").string();
  std::ofstream out(script);
  out << "set terminal pngcairo size 1000,800 font 'Sans,11'\nset output '"
      << (folder / "latency.png").string() << "'\n"
      << "set datafile separator ','\nset multiplot layout " << modes.size() << ",1\n"
      << "set style fill solid 0.6\nset xrange [0:8]\nset xlabel 'from sending to sample [ms]'\n"
      << "set ylabel 'events'\nwidth = 0.1\nbin(x) = width * (floor(x / width) + 0.5)\n";
  for (const Mode& mode : modes) {
    out << "set title '" << mode.name << "'\nplot ";
    for (std::size_t i = 0; i < periods.size(); ++i) {
      out << (i == 0 ? "" : ", ") << "'" << csv << "' using (strcol(1) eq '" << periods[i]
          << "' && strcol(2) eq '" << mode.name << "' ? bin($3) : NaN):(1) smooth frequency "
          << "with boxes title '" << periods[i] << " frames'";
    }
    out << '\n';
  }
  out.close();
  synth::run_gnuplot(script);
  std::filesystem::remove(script);
  std::filesystem::remove(folder / "latency.log");
}

void bench(const std::filesystem::path& folder, bool realtime) {
  const std::vector<int> periods{64, 128, 256};
  const std::vector<Mode> modes{{"without a time", false}, {"time tag of now", true}};
  std::ofstream csv;
  if (!folder.empty()) {
    std::filesystem::create_directories(folder);
    csv.open(folder / "latency.csv");
    csv << "frames,mode,latency_ms\n";
  }
  std::printf("%d events each over loopback; JACK without a device at %d Hz, %s\n\n", kEvents,
              kRate, realtime ? "at real-time priority" : "no realtime");
  std::printf("frames  sent with         median     5 %%    95 %%     max  [ms]  unheard  xruns\n");
  for (const int period : periods) {
    for (const Mode& mode : modes) {
      const Result r = measure(period, mode, realtime);
      if (r.latencies.empty()) throw std::runtime_error("no event was heard");
      std::printf("%6d  %-15s  %7.2f %7.2f %7.2f %7.2f        %7d  %5d\n", period,
                  mode.name.c_str(), 1e3 * r.quantile(0.5), 1e3 * r.quantile(0.05),
                  1e3 * r.quantile(0.95), 1e3 * r.latencies.back(), r.unheard, r.xruns);
      std::fflush(stdout);
      for (const double latency : r.latencies) {
        if (csv) csv << period << ',' << mode.name << ',' << 1e3 * latency << '\n';
      }
    }
  }
  csv.close();
  if (!folder.empty()) draw(folder, periods, modes);
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path folder;
  bool realtime = false;
  CLI::App app("Measures how long an event takes to its first sample.", "bench-latency");
  app.add_option("folder", folder, "Where latency.csv and latency.png go");
  app.add_flag("--realtime", realtime,
               "JACK at real-time priority, which not everybody may ask for");
  CLI11_PARSE(app, argc, argv);
  try {
    bench(folder, realtime);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "bench-latency: " << error.what() << '\n';
    return 70;
  }
}
