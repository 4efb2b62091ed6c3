// SPDX-License-Identifier: MIT
// How many bubbles at what cost: the synth's engine beside scsynth and Pd, all in one run.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "synth-server/voices/pack_kernels.hpp"
#include "tests/bench/plot.hpp"
#include "tests/bench/report.hpp"
#include "tests/bench/synth_engine.hpp"
#include "tests/bench/synth_peers.hpp"
#include "tests/bench/synth_timing.hpp"

namespace {

using namespace splash::bench;

std::string whole(double value) {
  return std::to_string(static_cast<long long>(value));
}

std::string percent(double share) {
  return number(100.0 * share);
}

int channels(int tiles) {
  return tiles > 0 ? tiles * tiles : 1;
}

/// Of one core, on one channel and on 36.
struct Capacity {
  std::string instructions;
  EngineCase mono, spread;
};

std::vector<Capacity> measure_capacity(Bench& bench) {
  auto table = bench.table(
      "capacity.csv", {"instruction set", "one channel [% of a core]", "36 channels [%]", "ratio",
                       "voices that fill a core", "on 36 channels"});
  std::vector<Capacity> all;
  for (const std::string& set : instruction_sets()) {
    all.push_back({set, measure_engine({set, 16384, 0, 64}), measure_engine({set, 16384, 6, 64})});
    const auto& [name, mono, spread] = all.back();
    table.add({name, percent(mono.cost), percent(spread.cost), number(spread.cost / mono.cost),
               whole(mono.voices_per_core()), whole(spread.voices_per_core())});
  }
  bench.tell(
      "16,384 voices through the whole engine at 44.1 kHz, in blocks of 64, processor time:");
  bench.tell(table);
  return all;
}

void measure_floods(Bench& bench) {
  constexpr double kAll = 1e6;
  constexpr double kSingles = 1e4;  // as the shipped sounds have it
  const auto middle = [](int births, double singles, bool everything) {
    const int runs = births > 10000 ? 3 : 5;
    std::vector<double> costs;
    for (int run = 0; run < runs; ++run) {
      costs.push_back(measure_flood(births, singles, everything));
    }
    return percent(median(costs));
  };
  auto table = bench.table("floods.csv", {"bubbles a second", "all of them voices [% of a core]",
                                          "10,000 a second voices, all others noise [%]",
                                          "the same with everything on [%]"});
  for (const int births : {10000, 40000, 100000}) {
    table.add({whole(births), middle(births, kAll, false), middle(births, kSingles, false),
               middle(births, kSingles, true)});
  }
  bench.tell(
      "Bubbles of 3 to 30 mm on 36 channels up to 20 kHz; everything: coupled clouds, pitch from "
      "place, fine water, water under the foot, a gain:");
  bench.tell(table);
  bench.tell("Pitches of 10,000 bubbles a second in a cloud alone: " + percent(measure_clouds()) +
             " % of a core.");
}

void measure_onsets_of_all(Bench& bench) {
  auto table = bench.table("onsets.csv",
                           {"instruction set", "onsets/s, one channel", "onsets/s, 36 channels"});
  for (const std::string& set : instruction_sets()) {
    table.add({set, whole(measure_onsets(set, 0).onsets), whole(measure_onsets(set, 6).onsets)});
  }
  bench.tell("Bubbles of 10 to 300 ms (60 dB) that one core starts and plays:");
  bench.tell(table);
}

/// Cost against voices, channels and block.
void measure_engines(Bench& bench) {
  std::vector<std::vector<EngineCase>> sweeps(3);
  for (const int voices : {256, 1024, 4096, 16384, 65536}) {
    sweeps[0].push_back(measure_engine({"best", voices, 0, 64}));
  }
  for (const int tiles : {0, 2, 4, 6, 8, 12}) {
    sweeps[1].push_back(measure_engine({"best", 16384, tiles, 64}));
  }
  for (const int block : {16, 32, 64, 100, 128, 256, 1024}) {
    sweeps[2].push_back(measure_engine({"best", 16384, 0, block}));
  }
  auto table = bench.table("engine.csv",
                           {"voices", "channels", "block", "channels per voice", "of a core [%]"});
  Plot plot(bench.out() / "engine.png", 1500, 500);
  plot.script() << "unset key\nset multiplot layout 1,3\nset logscale x 2\n"
                   "set ylabel 'of one core [%]'\n";
  const std::vector<std::string> axes = {
      "set logscale y\nset xtics 1,4\nset xlabel 'voices (one channel)'\n",
      "unset logscale y\nset yrange [0:*]\nset xtics autofreq\n"
      "set xlabel 'channels (16384 voices)'\n",
      "set xlabel 'block [frames] (16384 voices, one channel)'\n"};
  for (std::size_t sweep = 0; sweep < sweeps.size(); ++sweep) {
    std::vector<double> x;
    std::vector<double> y;
    for (const EngineCase& c : sweeps[sweep]) {
      const double by[] = {c.voices + 0.0, channels(c.tiles) + 0.0, c.block + 0.0};
      x.push_back(by[sweep]);
      y.push_back(100.0 * c.cost);
      table.add({whole(c.voices), whole(channels(c.tiles)), whole(c.block), number(c.routes),
                 percent(c.cost)});
    }
    plot.script() << axes[sweep];
    plot.add({x, y}, "with linespoints");
    plot.panel();
  }
  plot.draw();
  std::printf("%s\n", (bench.out() / "engine.png").c_str());
}

void measure_peers(Bench& bench, const std::vector<Capacity>& ours) {
  auto table = bench.table("peers.csv", {"engine", "voices", "onsets/s", "error at 5 mm [dB]",
                                         "ours carries so many times its voices"});
  const splash::synth::ScratchFolder scratch;
  for (const auto& measure : {measure_scsynth, measure_pd}) {
    try {
      const Peer peer = measure(scratch.path());
      std::string times;
      for (const Capacity& c : ours) {
        times += (times.empty() ? "" : ", ") + number(c.mono.voices_per_core() / peer.voices) +
                 " (" + c.instructions + ")";
      }
      table.add({peer.name, whole(peer.voices), whole(peer.onsets), number(peer.error_db), times});
    } catch (const std::exception& error) {
      std::printf("left out: %s\n", error.what());
    }
  }
  bench.tell("Others, one channel, one core:");
  bench.tell(table);
}

}  // namespace

int main(int argc, char** argv) {
  Bench bench("synth", "performance.md", "The synth", "Measures the synth beside scsynth and Pd.");
  bool only_capacity = false;
  bench.options().add_flag("--capacity", only_capacity,
                           "Only what a core carries on one channel and on 36: some seconds");
  return bench.run(argc, argv, [&] {
    std::printf("best instruction set: %s\n", name_of(splash::synth::InstructionSet::best));
    const std::vector<Capacity> ours = measure_capacity(bench);
    measure_floods(bench);
    if (only_capacity) return true;
    measure_onsets_of_all(bench);
    measure_peers(bench, ours);
    measure_engines(bench);
    return true;
  });
}
