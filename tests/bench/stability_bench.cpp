// SPDX-License-Identifier: MIT
// The stability suite: every trial with each solver at three resolutions, at the default time step
// and at twice that; faults at a hundred places; where it ends, as maps; and endurance.
#include <algorithm>
#include <concepts>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "program/text.hpp"
#include "sim-server/scene/solver_choice.hpp"
#include "tests/bench/plot.hpp"
#include "tests/bench/report.hpp"
#include "tests/stress/endurance.hpp"
#include "tests/stress/faults.hpp"
#include "tests/stress/trial.hpp"

namespace {

using namespace splash;
using namespace splash::stress;
using sim::PressureKind;

/// In a few letters.
const char* short_name_of(PressureKind solver) noexcept {
  return solver == PressureKind::weakly_compressible ? "WCSPH" : "grid";
}

constexpr double kFactors[] = {0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0};
constexpr double kFixedSound[] = {0.9, 1.0, 1.05, 1.1, 1.15, 1.2, 1.25, 1.3, 1.4, 1.5, 2.0};
constexpr double kSpeeds[] = {0.5, 1.0, 2.0, 5.0, 10.0, 20.0};                 // [m/s]
constexpr double kViscosities[] = {0.0, 1.0e-6, 1.0e-4, 1.0e-3, 1.0e-2, 0.1};  // [m2/s]
constexpr double kSpacings[] = {0.05, 0.035, 0.025};                           // [m]
constexpr double kMapSpacing = 0.04;                                           // [m]
/// The maps' solver.
constexpr PressureKind kMapped = PressureKind::weakly_compressible;

/// How a cell went.
enum class Grade { sound, rough, again, given_up };

Grade grade_of(const Verdict& verdict) {
  if (verdict.particles == 0 || verdict.calmed + verdict.resets > 0) return Grade::given_up;
  if (verdict.retried > 0) return Grade::again;
  return verdict.passes() ? Grade::sound : Grade::rough;
}

struct Cell {
  double x = 0.0;  ///< along the map
  double y = 0.0;  ///< up the map
  Verdict verdict;
};

struct Map {
  std::string name;
  std::string title, x_label, y_label;
  std::vector<Cell> cells;
};

std::vector<double> values(const Map& map, double Cell::*axis) {
  std::vector<double> all;
  for (const Cell& cell : map.cells) all.push_back(cell.*axis);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::string tics(const std::vector<double>& all) {
  std::string text;
  for (std::size_t k = 0; k < all.size(); ++k) {
    text += program::format("%s\"%g\" %zu", k == 0 ? "" : ", ", all[k], k);
  }
  return "(" + text + ")";
}

void draw(const Map& map, const std::filesystem::path& file) {
  const std::vector<double> xs = values(map, &Cell::x);
  const std::vector<double> ys = values(map, &Cell::y);
  const auto index = [](const std::vector<double>& all, double value) {
    return static_cast<double>(std::find(all.begin(), all.end(), value) - all.begin());
  };
  bench::Plot plot(file, 900, 600);
  plot.script()
      << "set palette maxcolors 4 defined (0 \"#009e73\", 1 \"#f0e442\", 2 \"#e69f00\", 3 "
         "\"#d55e00\")\nset cbrange [-0.5:3.5]\n"
         "set cbtics (\"sound\" 0, \"rough\" 1, \"again\" 2, \"given up\" 3)\n"
      << "set title \"" << map.title << "\"\nset xlabel \"" << map.x_label << "\"\nset ylabel \""
      << map.y_label << "\"\nset xtics " << tics(xs) << "\nset ytics " << tics(ys)
      << "\nset xrange [-0.5:" << static_cast<double>(xs.size()) - 0.5
      << "]\nset yrange [-0.5:" << static_cast<double>(ys.size()) - 0.5 << "]\n";
  std::vector<std::vector<double>> columns(3);
  for (const Cell& c : map.cells) {
    columns[0].push_back(index(xs, c.x));
    columns[1].push_back(index(ys, c.y));
    columns[2].push_back(static_cast<double>(grade_of(c.verdict)));
  }
  plot.add(columns, "with image notitle");
  plot.draw();
}

const Trial& plunge_at(double speed) {
  return trial_named("plunge at " + std::to_string(speed).substr(0, 4) + " m/s");
}

void run_cell(sim::Device& device, Map& map, const Trial& trial, const Settings& settings, double x,
              double y) {
  map.cells.push_back({x, y, run_trial(device, trial, settings)});
  std::printf("%-24s %8g %8g  grade %d\n", map.name.c_str(), x, y,
              static_cast<int>(grade_of(map.cells.back().verdict)));
  std::fflush(stdout);
}

Map speed_map(sim::Device& device) {
  Map map{"step-speed-WCSPH",
          "A ball plunges, WCSPH",
          "time step (in the default)",
          "speed of the body (m/s)",
          {}};
  for (const double speed : kSpeeds) {
    for (const double factor : kFactors) {
      run_cell(device, map, plunge_at(speed), {kMapped, kMapSpacing, factor}, factor, speed);
    }
  }
  return map;
}

/// Longer steps without slower sound, which no scene can ask for: how far from its end the default
/// is.
Map margin_map(sim::Device& device) {
  Map map{"margin-WCSPH",
          "A ball plunges, or lies in still water (0); sound stays as fast, WCSPH",
          "time step (in the default)",
          "speed of the body (m/s)",
          {}};
  for (const double factor : kFixedSound) {
    const Settings settings = {kMapped, kMapSpacing, factor, true};
    run_cell(device, map, trial_named("rest, sunk"), settings, factor, 0.0);
    for (const double speed : kSpeeds) {
      run_cell(device, map, plunge_at(speed), settings, factor, speed);
    }
  }
  return map;
}

Map viscosity_map(sim::Device& device) {
  Map map{"viscosity-spacing-WCSPH",
          "A dam breaks at twice the default step, WCSPH",
          "kinematic viscosity (m2/s)",
          "particle spacing (m)",
          {}};
  for (const double nu : kViscosities) {
    Trial trial = trial_named("dam break");
    trial.seconds = nu > 0.05 ? 0.1 : 0.5;
    trial.scene = [inner = trial.scene, nu](double s) {
      sim::Scene scene = inner(s);
      scene.fluid.viscosity = nu;
      return scene;
    };
    for (const double spacing : kSpacings) {
      run_cell(device, map, trial, {kMapped, spacing, 2.0}, nu, spacing);
    }
  }
  return map;
}

/// Where the water stops being sound, over time step and speed, viscosity and resolution: runs all
/// cells, telling each, and leaves map-*.csv and map-*.png.
void draw_maps(bench::Bench& bench, sim::Device& device) {
  const auto leave = [&](const Map& map) {
    auto table = bench.table("map-" + map.name + ".csv",
                             {map.x_label, map.y_label, "grade", "fastest", "mean_excess",
                              "max_excess", "retried", "calmed", "resets"});
    for (const Cell& c : map.cells) {
      const Verdict& v = c.verdict;
      table.add({bench::number(c.x), bench::number(c.y),
                 std::to_string(static_cast<int>(grade_of(v))), bench::number(v.fastest),
                 bench::number(v.mean_excess), bench::number(v.max_excess),
                 std::to_string(v.retried), std::to_string(v.calmed), std::to_string(v.resets)});
    }
    const std::filesystem::path picture = bench.out() / ("map-" + map.name + ".png");
    draw(map, picture);
    std::printf("map: %s\n", picture.c_str());
  };
  for (const auto make : {speed_map, viscosity_map, margin_map}) {
    leave(make(device));
  }
}

struct Options {
  std::vector<std::string> parts;
  std::vector<int> groups;
  std::vector<double> spacings = {0.05, 0.035, 0.025};
  std::vector<double> factors = {1.0, 2.0};
  int places = 100;
  Endurance endurance;
  std::vector<PressureKind> solvers = {PressureKind::weakly_compressible,
                                       PressureKind::grid_projected};
  int device = -1;
};

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : "; ") + word;
  std::replace(text.begin(), text.end(), ',', ' ');
  return text;
}

std::string whole(std::integral auto count) {
  return std::to_string(count);
}

std::string passed(int failed, int done) {
  return whole(done - failed) + " of " + whole(done) + " passed.";
}

/// Returns how many did not pass.
int run_trials(bench::Bench& bench, sim::Device& device, const Options& options) {
  using bench::number;
  auto table = bench.table(
      "trials.csv", {"trial", "group", "solver", "spacing [m]", "factor", "particles", "steps",
                     "fastest [m/s]", "mean_excess", "max_excess", "events", "retried", "calmed",
                     "resets", "least_step", "calm [m/s]", "drift [m]", "inside", "broken"});
  int failed = 0;
  int done = 0;
  for (const Trial& trial : all_trials()) {
    const auto& groups = options.groups;
    if (!groups.empty() && std::find(groups.begin(), groups.end(), trial.group) == groups.end()) {
      continue;
    }
    for (const PressureKind solver : options.solvers) {
      for (const double spacing : options.spacings) {
        if (spacing < trial.finest) continue;
        for (const double factor : options.factors) {
          const Verdict v = run_trial(device, trial, {solver, spacing, factor});
          table.add({trial.name, whole(trial.group), short_name_of(solver), number(spacing),
                     number(factor), whole(v.particles), whole(v.steps), number(v.fastest),
                     number(v.mean_excess), number(v.max_excess), whole(v.events), whole(v.retried),
                     whole(v.calmed), whole(v.resets), number(v.least_step), number(v.calm),
                     number(v.drift), number(v.inside), join(v.broken)});
          ++done;
          failed += !v.passes();
          if (!v.passes() && !v.step_fault.empty()) std::printf("      %s\n", v.step_fault.c_str());
        }
      }
    }
  }
  bench.tell("Trials at the spacings and steps asked for, each solver: " + passed(failed, done));
  return failed;
}

int run_injections(bench::Bench& bench, sim::Device& device, const Options& options) {
  auto table = bench.table("faults.csv", {"fault", "water", "places", "seen", "events told",
                                          "ill for at most [s]", "finite"});
  int failed = 0;
  int total = 0;
  for (const PressureKind solver : options.solvers) {
    const std::string name = sim::name_of(solver);
    sim::Simulation simulation(device, still_scene(solver, 0.35), {});
    for (const Injection& injection : injections()) {
      const auto outcomes = run_faults(simulation, {injection}, options.places, 2026);
      int seen = 0;
      std::size_t told = 0;
      double longest = 0.0;
      bool finite = true;
      for (const Outcome& o : outcomes) {
        seen += o.seen;
        told += o.told;
        longest = std::max(longest, o.ill_for);
        finite = finite && o.finite;
        failed += !o.passes();
      }
      total += static_cast<int>(outcomes.size());
      table.add({injection.name, name, whole(outcomes.size()), whole(seen), whole(told),
                 bench::number(longest), finite ? "yes" : "NO"});
    }
  }
  bench.tell("Faults put into the water, " + whole(injections().size()) + " kinds, " +
             whole(options.places) + " places each, each solver: " + passed(failed, total));
  return failed;
}

bool run(bench::Bench& bench, const Options& options) {
  sim::Device device(options.device);
  bench.set_device(describe(device.facts()));
  const auto wants = [&](const char* part) { return bench::is_wanted(options.parts, part); };
  int failed = 0;
  if (wants("faults")) failed += run_injections(bench, device, options);
  if (wants("trials")) failed += run_trials(bench, device, options);
  if (wants("maps")) draw_maps(bench, device);
  if (wants("endurance")) {
    const int lost = endure(device, options.endurance, bench.out());
    bench.tell("Endurance, " + whole(options.endurance.steps) + " steps of each scene: " +
               (lost == 0 ? "nothing lost, no reset, memory flat." : whole(lost) + " failed."));
    failed += lost;
  }
  std::printf("%s\n", failed == 0 ? "all passed" : (std::to_string(failed) + " failed").c_str());
  return failed == 0;
}

void add_endurance(CLI::App& app, Options& options) {
  app.add_option("--steps", options.endurance.steps, "Of each scene in the endurance run")
      ->check(CLI::Range(100, 100000000));
  app.add_option("--scene", options.endurance.scenes, "Endures (repeatable); else all do");
  app.add_option("--coarser", options.endurance.coarser,
                 "Spacings of the endurance run, in the scene's")
      ->check(CLI::Range(1.0, 4.0));
  app.add_option("--minutes", options.endurance.minutes,
                 "The endurance run ends after these; the next one goes on from there")
      ->check(CLI::Range(0.0, 1.0e5));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  bench::Bench bench("stability", "robustness.md", "What the water survives",
                     "What the water survives: faults, trials, maps of where it ends, endurance.");
  CLI::App& app = bench.options();
  app.add_option("--part", options.parts,
                 "Only this part (repeatable): faults trials maps endurance")
      ->check(CLI::IsMember({"faults", "trials", "maps", "endurance"}));
  app.add_option("--group", options.groups, "Only trials of this group (repeatable)")
      ->check(CLI::Range(0, 13));
  app.add_option("--spacing", options.spacings, "Particle spacings of the trials [m]")
      ->check(CLI::Range(0.01, 0.1))
      ->capture_default_str();
  app.add_option("--factor", options.factors, "Time steps of the trials, in the default")
      ->check(CLI::Range(0.05, 2.0))
      ->capture_default_str();
  app.add_option("--places", options.places, "Of each fault")->check(CLI::Range(1, 100000));
  add_endurance(app, options);
  bench.add_choice("--solver", options.solvers,
                   {PressureKind::weakly_compressible, PressureKind::grid_projected},
                   "Only with this one: weakly_compressible or grid_projected "
                   "(repeatable); endurance with the first");
  bench.add_device_option(options.device);
  return bench.run(argc, argv, [&] {
    options.endurance.solver = options.solvers.front();
    return run(bench, options);
  });
}
