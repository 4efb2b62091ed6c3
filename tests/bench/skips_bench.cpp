// SPDX-License-Identifier: MIT
// What a scene does not need and what leaving it out saves: the plunge and SPHERIC 2 with each skip
// on or off, and a settled pool of which a tenth moves, asleep and awake. Prints tables; with a
// folder's name, also leaves skips.csv there.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "tests/bench/skips_equality.hpp"
#include "tests/bench/stirred_pool.hpp"

namespace {

using namespace splash;
using namespace splash::bench;

void print(const SkipScene& scene, const SkipVariant& variant, const SkipRun& run,
           const SkipRun& all_off) {
  const SkipDifference d = difference(run, all_off);
  const sim::SkipTotals& skipped = run.totals.skipped;
  const auto frames = static_cast<double>(run.totals.frames);
  std::printf(
      "%-9s %-13s %6.2f  %6.2f  %6.2f  %7.2f  %4zu %5zu %4zu  %-4s  %3.0f %3.0f %3.0f %3.0f %3.0f  "
      "%d\n",
      scene.name.c_str(), variant.name.c_str(), run.processor, 1e3 * d.height_most,
      1e3 * d.height_rms, 100.0 * d.pressure_rms / d.pressure_size, run.found.impacts.size(),
      run.found.bubbles.size(), run.found.cavities.size(), d.same_events ? "yes" : "no",
      100.0 * skipped.asleep_sum / frames, 100.0 * static_cast<double>(skipped.idle) / frames,
      100.0 * static_cast<double>(skipped.contacts) / frames,
      100.0 * static_cast<double>(skipped.bubbles) / frames,
      100.0 * static_cast<double>(skipped.cavities) / frames, skipped.kernel_parts);
  std::fflush(stdout);
}

void compare(sim::Device& device) {
  std::printf(
      "\nEach skip on or off, against all off. Heights [mm] and pressures [rms of their own]\n"
      "scene     skips          CPU s    most     rms  pressure   impacts bubbles cavities  same  "
      "asleep idle contacts bubbles cavities %%  parts\n");
  for (const SkipScene& scene : skip_scenes()) {
    std::vector<SkipVariant> variants = skip_variants();
    const auto off = std::find_if(variants.begin(), variants.end(),
                                  [](const SkipVariant& v) { return v.name == "all off"; });
    const SkipRun all_off = run_with(device, scene, *off);
    for (const SkipVariant& variant : variants) {
      print(scene, variant, run_with(device, scene, variant), all_off);
    }
  }
}

void stir(sim::Device& device, const std::vector<int>& sizes) {
  std::printf(
      "\nA settled pool with a stirrer in one corner; the same frames with sleep on and off\n"
      "particles   awake   CPU ms/step asleep   awake    saved\n");
  for (const int particles : sizes) {
    const StirredPool pool = measure_stirred_pool(device, particles);
    std::printf("%9d  %5.1f %%  %18.3f  %6.3f  %5.1f %%\n", pool.particles, 100.0 * pool.awake,
                1e3 * pool.asleep_step, 1e3 * pool.awake_step,
                100.0 * (1.0 - pool.asleep_step / pool.awake_step));
    std::fflush(stdout);
    print_stages(pool);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("What skipping saves, and that it changes nothing.", "bench-skips");
  std::vector<std::string> parts = {"equality", "sleep"};
  std::vector<int> sizes = {15'000, 60'000};
  int chosen = -1;
  app.add_option("--part", parts, "Only these: equality, sleep (repeatable)")
      ->check(CLI::IsMember({"equality", "sleep"}));
  app.add_option("--particles", sizes, "Of the stirred pool (repeatable)");
  app.add_option("--device", chosen, "OpenCL device as sim-server --list-devices counts");
  CLI11_PARSE(app, argc, argv);
  const auto wants = [&](const char* part) {
    return std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  try {
    sim::Device device(chosen, true);
    std::printf("device: %s\n", describe(device.facts()).c_str());
    if (wants("equality")) compare(device);
    if (wants("sleep")) stir(device, sizes);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "bench-skips: " << error.what() << '\n';
    return 70;
  }
}
