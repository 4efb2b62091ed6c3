// SPDX-License-Identifier: MIT
#include "tests/stress/stability_map.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "tests/bench/plot.hpp"
#include "tests/bench/tables.hpp"

namespace splash::stress {
namespace {

constexpr double kFactors[] = {0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0};
constexpr double kFixedSound[] = {0.9, 1.0, 1.05, 1.1, 1.15, 1.2, 1.25, 1.3, 1.4, 1.5, 2.0};
constexpr double kSpeeds[] = {0.5, 1.0, 2.0, 5.0, 10.0, 20.0};                 // [m/s]
constexpr double kViscosities[] = {0.0, 1.0e-6, 1.0e-4, 1.0e-3, 1.0e-2, 0.1};  // [m2/s]
constexpr double kSpacings[] = {0.05, 0.035, 0.025};                           // [m]
constexpr double kMapSpacing = 0.04;                                           // [m]

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
    char tic[48];
    std::snprintf(tic, sizeof tic, "%s\"%g\" %zu", k == 0 ? "" : ", ", all[k], k);
    text += tic;
  }
  return "(" + text + ")";
}

void draw(const Map& map, const std::filesystem::path& file) {
  const std::vector<double> xs = values(map, &Cell::x);
  const std::vector<double> ys = values(map, &Cell::y);
  const auto index = [](const std::vector<double>& all, double value) {
    return std::find(all.begin(), all.end(), value) - all.begin();
  };
  bench::Plot plot(file, 900, 600);
  std::ostream& out = plot.script();
  out << "set palette maxcolors 4 defined (0 \"#009e73\", 1 \"#f0e442\", 2 \"#e69f00\", 3 "
         "\"#d55e00\")\nset cbrange [-0.5:3.5]\n"
         "set cbtics (\"sound\" 0, \"rough\" 1, \"again\" 2, \"given up\" 3)\n"
      << "set title \"" << map.title << "\"\nset xlabel \"" << map.x_label << "\"\nset ylabel \""
      << map.y_label << "\"\nset xtics " << tics(xs) << "\nset ytics " << tics(ys)
      << "\nset xrange [-0.5:" << static_cast<double>(xs.size()) - 0.5
      << "]\nset yrange [-0.5:" << static_cast<double>(ys.size()) - 0.5 << "]\n$map << EOD\n";
  for (const Cell& c : map.cells) {
    out << index(xs, c.x) << ' ' << index(ys, c.y) << ' ' << static_cast<int>(grade_of(c.verdict))
        << '\n';
  }
  out << "EOD\nplot $map with image notitle\n";
  plot.draw();
}

const Trial& named(const std::vector<Trial>& all, const std::string& name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Trial& t) { return t.name == name; });
  if (found == all.end()) throw std::logic_error("no trial is called " + name);
  return *found;
}

Cell run_cell(sim::Device& device, const std::string& map, const Trial& trial,
              const Settings& settings, double x, double y) {
  Cell cell{x, y, run_trial(device, trial, settings)};
  std::printf("%-24s %8g %8g  grade %d\n", map.c_str(), x, y,
              static_cast<int>(grade_of(cell.verdict)));
  std::fflush(stdout);
  return cell;
}

Map speed_map(sim::Device& device, sim::PressureKind solver) {
  Map map{std::string("step-speed-") + short_name_of(solver),
          std::string("A ball plunges, ") + short_name_of(solver),
          "time step (in the default)",
          "speed of the body (m/s)",
          {}};
  const std::vector<Trial> all = all_trials();
  for (const double speed : kSpeeds) {
    const Trial& trial = named(all, "plunge at " + std::to_string(speed).substr(0, 4) + " m/s");
    for (const double factor : kFactors) {
      map.cells.push_back(
          run_cell(device, map.name, trial, {solver, kMapSpacing, factor}, factor, speed));
    }
  }
  return map;
}

/// Longer steps without slower sound, which no scene can ask for: how far from its end the default
/// is.
Map margin_map(sim::Device& device, sim::PressureKind solver) {
  Map map{std::string("margin-") + short_name_of(solver),
          std::string("A ball plunges, or lies in still water (0); sound stays as fast, ") +
              short_name_of(solver),
          "time step (in the default)",
          "speed of the body (m/s)",
          {}};
  const std::vector<Trial> all = all_trials();
  for (const double factor : kFixedSound) {
    const Settings settings = {solver, kMapSpacing, factor, true};
    map.cells.push_back(
        run_cell(device, map.name, named(all, "rest, sunk"), settings, factor, 0.0));
    for (const double speed : kSpeeds) {
      const Trial& trial = named(all, "plunge at " + std::to_string(speed).substr(0, 4) + " m/s");
      map.cells.push_back(run_cell(device, map.name, trial, settings, factor, speed));
    }
  }
  return map;
}

Map viscosity_map(sim::Device& device, sim::PressureKind solver) {
  Map map{std::string("viscosity-spacing-") + short_name_of(solver),
          std::string("A dam breaks at twice the default step, ") + short_name_of(solver),
          "kinematic viscosity (m2/s)",
          "particle spacing (m)",
          {}};
  const std::vector<Trial> all = all_trials();
  for (const double nu : kViscosities) {
    Trial trial = named(all, "dam break");
    trial.seconds = nu > 0.05 ? 0.1 : 0.5;
    trial.scene = [inner = trial.scene, nu](double s) {
      sim::Scene scene = inner(s);
      scene.fluid.viscosity = nu;
      return scene;
    };
    for (const double spacing : kSpacings) {
      map.cells.push_back(run_cell(device, map.name, trial, {solver, spacing, 2.0}, nu, spacing));
    }
  }
  return map;
}

}  // namespace

const char* short_name_of(sim::PressureKind solver) noexcept {
  switch (solver) {
    case sim::PressureKind::weakly_compressible:
      return "WCSPH";
    case sim::PressureKind::grid_projected:
      break;
  }
  return "grid";
}

void draw_maps(sim::Device& device, const std::filesystem::path& out) {
  const auto leave = [&](const Map& map) {
    bench::Table table({map.x_label, map.y_label, "grade", "fastest", "mean_excess", "max_excess",
                        "retried", "calmed", "resets"},
                       out / ("map-" + map.name + ".csv"));
    for (const Cell& c : map.cells) {
      const Verdict& v = c.verdict;
      table.add({bench::number(c.x), bench::number(c.y),
                 std::to_string(static_cast<int>(grade_of(v))), bench::number(v.fastest),
                 bench::number(v.mean_excess), bench::number(v.max_excess),
                 std::to_string(v.retried), std::to_string(v.calmed), std::to_string(v.resets)});
    }
    draw(map, out / ("map-" + map.name + ".png"));
    std::printf("map: %s\n", (out / ("map-" + map.name + ".png")).c_str());
  };
  for (const auto make : {speed_map, viscosity_map, margin_map}) {
    leave(make(device, sim::PressureKind::weakly_compressible));
  }
}

}  // namespace splash::stress
