// SPDX-License-Identifier: MIT
// The three engines on the same logs: what of the difference to synth-server's own rendering falls
// into which band, for scsynth (non-real-time) and for Pd (offline). Prints a table; with a
// folder's name, also writes crosscheck.csv and the chart crosscheck.png.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <variant>
#include <vector>

#include "synth-server/figure/gnuplot.hpp"
#include "synth-server/output/band_filter.hpp"
#include "tests/pd-patches/rendering.hpp"
#include "tests/supercollider/comparison.hpp"

namespace {

using namespace splash;
using Samples = std::vector<float>;

constexpr double kRate = 48000.0;
constexpr std::int64_t kFrames = 216000;
/// Lower ends of the bands [Hz]; the last is an upper end.
constexpr std::array kEdges = {20.0, 40.0, 80.0, 160.0, 320.0, 640.0, 1280.0, 5120.0};
constexpr std::size_t kBands = kEdges.size() - 1;
using Energies = std::array<double, kBands>;

/// Adds the energy of a - b in each band.
void add_energy(const Samples& a, const Samples& b, Energies& energies) {
  for (std::size_t band = 0; band < kBands; ++band) {
    synth::BandFilter filter({kEdges[band], kEdges[band + 1]}, kRate);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double out = filter.process(static_cast<double>(a[i]) - static_cast<double>(b[i]));
      energies[band] += out * out;
    }
  }
}

struct Comparison {
  std::string engine;
  std::string scene;
  Energies signal{};
  Energies residual{};
  double worst = 0.0;  ///< largest difference over the largest sample [dB]
};

Comparison compare(const std::string& engine, const std::string& scene, const pd::Channels& ours,
                   const pd::Channels& theirs) {
  Comparison c{engine, scene};
  double peak = 0.0;
  for (std::size_t channel = 0; channel < ours.size(); ++channel) {
    add_energy(ours[channel], Samples(ours[channel].size()), c.signal);
    add_energy(ours[channel], theirs[channel], c.residual);
    for (const float sample : ours[channel]) {
      peak = std::max(peak, std::abs(static_cast<double>(sample)));
    }
  }
  c.worst = pd::decibels(pd::largest_difference(ours, theirs, 0, kFrames) / peak);
  return c;
}

/// Impacts are noise, which no two engines draw alike.
std::vector<protocol::LogEntry> tones(std::vector<protocol::LogEntry> log) {
  for (protocol::LogEntry& entry : log) {
    std::erase_if(entry.messages, [](const protocol::Message& message) {
      const auto event = protocol::to_event(message);
      return !event || std::holds_alternative<protocol::Impact>(*event);
    });
  }
  return log;
}

std::vector<Comparison> compare_all() {
  std::vector<Comparison> all;
  for (const char* scene : supercollider::kScenes) {
    const auto log = tones(supercollider::scene_log(scene));
    const auto both =
        supercollider::render_both(log, kFrames, supercollider::loud_gain(log, kFrames));
    all.push_back(compare("scsynth", scene, {both.synth}, {both.scsynth}));
    all.push_back(compare("pd", scene, pd::render_with_synth(log, pd::kTiles, kFrames),
                          pd::render_with_pd(log, pd::kTiles, kFrames)));
  }
  return all;
}

double level(double part, double whole) {
  return 10.0 * std::log10(std::max(part, 1e-30) / std::max(whole, 1e-30));
}

void print(const std::vector<Comparison>& all) {
  std::printf("residual over signal [dB], bands from their lower end [Hz]\n\n%-8s %-7s", "engine",
              "scene");
  for (std::size_t band = 0; band < kBands; ++band) std::printf(" %7.0f", kEdges[band]);
  std::printf("   largest sample\n");
  for (const Comparison& c : all) {
    std::printf("%-8s %-7s", c.engine.c_str(), c.scene.c_str());
    for (std::size_t band = 0; band < kBands; ++band) {
      std::printf(" %7.1f", level(c.residual[band], c.signal[band]));
    }
    std::printf(" %8.1f\n", c.worst);
  }
}

void draw(const std::vector<Comparison>& all, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const auto csv = folder / "crosscheck.csv";
  std::ofstream table(csv);
  table << "engine,scene,from_hz,residual_db\n";
  for (const Comparison& c : all) {
    for (std::size_t band = 0; band < kBands; ++band) {
      table << c.engine << ',' << c.scene << ',' << kEdges[band] << ','
            << level(c.residual[band], c.signal[band]) << '\n';
    }
  }
  table.close();
  const auto script = folder / "crosscheck.gp";
  std::ofstream plot(script);
  plot << "set terminal pngcairo size 1000,600 font 'Sans,11'\nset datafile separator ','\n"
       << "set output '" << (folder / "crosscheck.png").string() << "'\n"
       << "set logscale x 2\nset xtics (20,40,80,160,320,640,1280)\nset yrange [-140:0]\n"
       << "set xlabel 'band, from [Hz]'\nset ylabel 'residual over signal [dB]'\nset key outside\n"
       << "set title 'The same log by three engines: difference to synth-server'\nplot ";
  for (std::size_t i = 0; i < all.size(); ++i) {
    plot << (i == 0 ? "" : ", ") << '\'' << csv.string() << "' using (strcol(1) eq '"
         << all[i].engine << "' && strcol(2) eq '" << all[i].scene
         << "' ? $3 : NaN):4 with linespoints title '" << all[i].engine << ", " << all[i].scene
         << '\'';
  }
  plot << '\n';
  plot.close();
  synth::run_gnuplot(script);
  std::filesystem::remove(script);
  std::filesystem::remove(folder / "crosscheck.log");
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path folder;
  CLI::App app("Renders logs with synth-server, scsynth and Pd and compares them.",
               "bench-crosscheck");
  app.add_option("folder", folder, "Where tables and charts go");
  CLI11_PARSE(app, argc, argv);
  try {
    const auto all = compare_all();
    print(all);
    if (!folder.empty()) draw(all, folder);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "bench-crosscheck: " << error.what() << '\n';
    return 70;
  }
}
