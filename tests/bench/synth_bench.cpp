// SPDX-License-Identifier: MIT
// How many bubbles at what cost: the synth's engine beside scsynth and Pd, all in one run. Prints
// tables and writes CSV and PNG.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <string>

#include "synth-server/figure/gnuplot.hpp"
#include "synth-server/voices/pack_kernels.hpp"
#include "tests/bench/synth_charts.hpp"

namespace {

using namespace splash::bench;

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

void print(const EngineCase& c) {
  std::printf(
      "%-9s %7d voices %4d channels (%.1f per voice) blocks of %4d: %6.1f %% of a core,"
      " %7.0f voices would fill it\n",
      c.instructions.c_str(), c.voices, c.tiles > 0 ? c.tiles * c.tiles : 1, c.routes, c.block,
      100.0 * c.cost, c.voices_per_core());
}

void add(std::vector<EngineCase>& list, EngineCase wanted) {
  list.push_back(measure_engine(std::move(wanted)));
  print(list.back());
}

void measure_capacity(SynthFigures& figures) {
  std::printf("\nThe engine: events, pool, voices, mix, filters, limiters\n");
  for (const std::string& set : instruction_sets()) {
    for (const int tiles : {0, 6}) add(figures.capacity, {set, 16384, tiles, 64});
  }
}

void measure_floods() {
  std::printf(
      "\n10,000 bubbles a second on 36 channels: %.1f %% of a core, with everything %.1f %%",
      100.0 * measure_flood(false), 100.0 * measure_flood(true));
  std::printf("; pitches in clouds alone %.1f %%\n", 100.0 * measure_clouds());
}

void measure_engines(SynthFigures& figures) {
  for (const int voices : {256, 1024, 4096, 16384, 65536}) {
    add(figures.by_voices, {"best", voices, 0, 64});
  }
  for (const int tiles : {0, 2, 4, 6, 8, 12}) add(figures.by_channels, {"best", 16384, tiles, 64});
  for (const int block : {16, 32, 64, 100, 128, 256, 1024}) {
    add(figures.by_block, {"best", 16384, 0, block});
  }
  std::printf("\nOnsets: bubbles of 10 to 300 ms (60 dB)\n");
  for (const std::string& set : instruction_sets()) {
    for (const int tiles : {0, 6}) {
      figures.onsets.push_back(measure_onsets(set, tiles));
      std::printf("%-9s %2d channels: %8.0f per second and core\n", set.c_str(),
                  tiles > 0 ? tiles * tiles : 1, figures.onsets.back().onsets);
    }
  }
}

void measure_peers(SynthFigures& figures) {
  std::printf("\nOthers (44.1 kHz, one channel, one core; error of a bubble of 5 mm)\n");
  const splash::synth::ScratchFolder scratch;
  for (const auto& measure : {measure_scsynth, measure_pd}) {
    try {
      figures.peers.push_back(measure(scratch.path()));
      const Peer& peer = figures.peers.back();
      std::printf("%-10s %7.0f voices, %7.0f onsets per second, error %.1f dB\n", peer.name.c_str(),
                  peer.voices, peer.onsets, peer.error_db);
    } catch (const std::exception& error) {
      std::printf("left out: %s\n", error.what());
    }
  }
}

void print_ratios(const SynthFigures& figures) {
  std::printf("\n");
  for (std::size_t i = 0; i + 1 < figures.capacity.size(); i += 2) {
    const EngineCase& mono = figures.capacity[i];
    const EngineCase& spread = figures.capacity[i + 1];
    std::printf("%s: %d channels cost %.2f times one", mono.instructions.c_str(),
                spread.tiles * spread.tiles, spread.cost / mono.cost);
    for (const Peer& peer : figures.peers) {
      std::printf("; %.1f times %s", mono.voices_per_core() / peer.voices, peer.name.c_str());
    }
    std::printf("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path folder = "out/bench-synth";
  CLI::App app("Measures the synth beside scsynth and Pd.", "bench-synth");
  app.add_option("--out", folder, "Where tables and charts go")->capture_default_str();
  bool only_capacity = false;
  app.add_flag("--capacity", only_capacity,
               "Only what a core carries on one channel and on 36: some seconds");
  CLI11_PARSE(app, argc, argv);
  try {
    std::filesystem::create_directories(folder);
    std::printf("%s; best instruction set: %s\n", processor().c_str(),
                name_of(splash::synth::InstructionSet::best));
    SynthFigures figures;
    if (only_capacity) {
      measure_capacity(figures);
      measure_floods();
      print_ratios(figures);
      return 0;
    }
    measure_capacity(figures);
    measure_floods();
    measure_engines(figures);
    measure_peers(figures);
    print_ratios(figures);
    write_tables(figures, folder);
    draw_chart(figures, folder);
    std::printf("\ntables and charts: %s\n", folder.c_str());
  } catch (const std::exception& error) {
    std::cerr << "bench-synth: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
