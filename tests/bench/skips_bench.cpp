// SPDX-License-Identifier: MIT
// What a scene does not need and what leaving it out saves: the plunge and SPHERIC 2 with each skip
// on or off, and a settled pool of which a tenth moves, asleep and awake.
#include <algorithm>
#include <string>
#include <vector>

#include "tests/bench/report.hpp"
#include "tests/bench/skips_equality.hpp"
#include "tests/bench/stirred_pool.hpp"

namespace {

using namespace splash;
using namespace splash::bench;

struct Options {
  std::vector<std::string> parts = {"equality", "sleep"};
  std::vector<int> sizes = {15'000, 60'000};
  int device = -1;

  [[nodiscard]] bool wants(const char* part) const {
    return std::find(parts.begin(), parts.end(), part) != parts.end();
  }
};

Row row(const SkipScene& scene, const SkipVariant& variant, const SkipRun& run,
        const SkipRun& all_off) {
  const SkipDifference d = difference(run, all_off);
  const sim::SkipTotals& skipped = run.totals.skipped;
  const auto percent = [&](double frames) {
    return number(100.0 * frames / static_cast<double>(run.totals.frames));
  };
  return {scene.name,
          variant.name,
          number(run.processor),
          number(1e3 * d.height_most),
          number(1e3 * d.height_rms),
          number(100.0 * d.pressure_rms / d.pressure_size),
          std::to_string(run.found.impacts.size()),
          std::to_string(run.found.bubbles.size()),
          std::to_string(run.found.cavities.size()),
          d.same_events ? "yes" : "no",
          percent(skipped.asleep_sum),
          percent(static_cast<double>(skipped.idle)),
          percent(static_cast<double>(skipped.contacts)),
          percent(static_cast<double>(skipped.bubbles)),
          percent(static_cast<double>(skipped.cavities))};
}

void compare(Bench& bench, sim::Device& device) {
  const std::string what =
      "Each skip on or off, against all off; the noise is all off with steps shorter by a "
      "thousandth. Pressures by the rms of their own; the last five columns are shares of "
      "particles asleep and of frames without the work. \"Same\": each event, bit by bit.";
  std::printf("\n%s\n", what.c_str());
  auto table = bench.table("skips.csv",
                           {"scene", "skips", "processors [s]", "heights, most [mm]", "rms [mm]",
                            "pressures [%]", "impacts", "bubbles", "cavities", "same", "asleep [%]",
                            "idle [%]", "no contacts [%]", "no bubbles [%]", "no cavities [%]"});
  for (const SkipScene& scene : skip_scenes()) {
    std::vector<SkipVariant> variants = skip_variants();
    const auto off = std::find_if(variants.begin(), variants.end(),
                                  [](const SkipVariant& v) { return v.name == "all off"; });
    const SkipRun all_off = run_with(device, scene, *off);
    for (const SkipVariant& variant : variants) {
      table.add(row(scene, variant, run_with(device, scene, variant), all_off));
    }
  }
  bench.tell(what);
  bench.tell(table.text());
}

void measure_sleep(Bench& bench, sim::Device& device, const std::vector<int>& sizes) {
  const std::string what =
      "A settled pool (state equation) with a paddle in one corner that keeps about a tenth of it "
      "moving; the same frames with sleep on and off, processor time per step:";
  std::printf("\n%s\n", what.c_str());
  auto table = bench.table(
      "sleep.csv", {"particles", "awake [%]", "with sleep [ms]", "without [ms]", "saved [%]"});
  for (const int particles : sizes) {
    const StirredPool pool = measure_stirred_pool(device, particles);
    table.add({std::to_string(pool.particles), number(100.0 * pool.awake),
               number(1e3 * pool.asleep_step), number(1e3 * pool.awake_step),
               number(100.0 * (1.0 - pool.asleep_step / pool.awake_step))});
    print_stages(pool);
  }
  bench.tell(what);
  bench.tell(table.text());
}

bool run(Bench& bench, const Options& options) {
  sim::Device device(options.device, true);
  bench.set_device(describe(device.facts()));
  if (options.wants("equality")) compare(bench, device);
  if (options.wants("sleep")) measure_sleep(bench, device, options.sizes);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Bench bench("skips", "performance.md", "What skipping saves",
              "What skipping saves, and that it changes nothing.");
  CLI::App& app = bench.options();
  app.add_option("--part", options.parts, "Only these: equality, sleep (repeatable)")
      ->check(CLI::IsMember({"equality", "sleep"}));
  app.add_option("--particles", options.sizes, "In the pool that a paddle moves (repeatable)");
  app.add_option("--device", options.device, "OpenCL device as sim-server --list-devices counts");
  return bench.run(argc, argv, [&] { return run(bench, options); });
}
