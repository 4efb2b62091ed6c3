// SPDX-License-Identifier: MIT
// Run time against error: validation cases with each solver, with half the time step and with the
// reference kernels, beside two other programs. Prints each run and writes CSV and PNG.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "sim-server/device/device.hpp"
#include "sim-server/scene/solver_choice.hpp"
#include "tests/bench/error_sweep.hpp"
#include "tests/bench/plot.hpp"
#include "tests/bench/report.hpp"

namespace {

using namespace splash;
using namespace splash::bench;

/// The time on the picture's horizontal axis.
enum class Clock {
  wall,      ///< those that passed: on a machine with nothing else to do
  processor  ///< those of processors, as if shared evenly among all cores
};

struct ChartSettings {
  Clock clock = Clock::wall;
  unsigned cores = 1;  ///< of the device
  std::string device;  ///< its name, for the title
};

/// Particles and steps per second of the paper's section 6: 15,000 in the pool and on the beach,
/// 7,000 in the basin.
const std::vector<std::vector<double>> kPaper = {{15000, 15000, 7000}, {152, 147, 240}};

/// What two other programs took; about_peers() has how.
struct Peer {
  const char* item;   // the case
  const char* name;   // of the program
  double resolution;  // size over particle spacing
  double cost;        // seconds by the clock per simulated second
  double error;       // [%]
};
constexpr const char* kDfsph = "SPlisHSPlasH 2.16 (DFSPH), on another CPU";
constexpr const char* kDual = "DualSPHysics 5.4, on another CPU";
constexpr Peer kPeers[] = {
    {"standing_wave", kDfsph, 20.0, 5.9, 0.5}, {"standing_wave", kDual, 20.0, 16.0, 3.5},
    {"spheric2", kDfsph, 13.75, 5.45, 4.62},   {"spheric2", kDfsph, 18.33, 20.4, 4.35},
    {"spheric2", kDual, 13.75, 40.7, 6.15},    {"float", kDfsph, 4.0, 10.1, 0.9},
    {"float", kDual, 4.0, 33.0, 1.7}};

std::string style(const Quality& q) {
  const bool scalar = q.kernels == sim::KernelKind::reference;
  std::ostringstream text;
  text << "linecolor rgb \"" << colour(static_cast<std::size_t>(q.solver))
       << "\" linewidth 1.6 dashtype "
       << (scalar                     ? 3
           : q.time_step_factor < 1.0 ? 2
           : q.time_step_factor > 1.0 ? 4
                                      : 1)
       << " pointtype "
       << (scalar                      ? 4
           : q.time_step_factor == 1.0 ? 7
                                       : 6)
       << " pointsize 1";
  return text.str();
}

std::string peer_style(const std::string& name) {
  return name == kDfsph ? "linecolor rgb \"#56b4e9\" linewidth 1.6 pointtype 9 pointsize 1.4"
                        : "linecolor rgb \"#e69f00\" linewidth 1.6 pointtype 11 pointsize 1.4";
}

double cost(const SweepPoint& point, const ChartSettings& settings) {
  return settings.clock == Clock::wall ? point.wall_cost() : point.processor_cost(settings.cores);
}

double resolution(const SweepPoint& point) {
  return point.result.item->size / point.result.spacing;
}

std::vector<Quality> qualities_of(const std::vector<SweepPoint>& points) {
  std::vector<Quality> list;
  for (const SweepPoint& point : points) {
    if (std::find(list.begin(), list.end(), point.quality) == list.end()) {
      list.push_back(point.quality);
    }
  }
  return list;
}

std::vector<const SweepCase*> cases_of(const std::vector<SweepPoint>& points) {
  std::vector<const SweepCase*> list;
  for (const SweepPoint& point : points) {
    if (std::find(list.begin(), list.end(), point.item) == list.end()) list.push_back(point.item);
  }
  return list;
}

/// The points of one quality; of a case, or all of them when null.
std::vector<const SweepPoint*> points_of(const std::vector<SweepPoint>& points,
                                         const SweepCase* item, const Quality& quality) {
  std::vector<const SweepPoint*> list;
  for (const SweepPoint& point : points) {
    if ((item == nullptr || point.item == item) && point.quality == quality) list.push_back(&point);
  }
  return list;
}

void draw_case(Plot& plot, const std::vector<SweepPoint>& points, const SweepCase& item,
               const std::vector<Quality>& qualities, const ChartSettings& settings) {
  for (const Quality& quality : qualities) {
    std::vector<std::vector<double>> columns(3);  // seconds, error, what is written beside it
    for (const SweepPoint* point : points_of(points, &item, quality)) {
      columns[0].push_back(cost(*point, settings));
      columns[1].push_back(std::max(point->error(), 1.0e-3));
      columns[2].push_back(resolution(*point));
    }
    plot.add(columns, "with linespoints " + style(quality));
    if (!(quality == qualities.front())) continue;
    plot.add(columns,
             "using 1:2:(sprintf(\"%.3g\", $3)) with labels offset 0,0.9 font \",9\" "
             "textcolor rgb ink");
  }
  for (const char* name : {kDfsph, kDual}) {
    std::vector<std::vector<double>> columns(2);
    for (const Peer& peer : kPeers) {
      if (item.name != peer.item || std::string(peer.name) != name) continue;
      columns[0].push_back(peer.cost);
      columns[1].push_back(peer.error);
    }
    if (!columns[0].empty()) plot.add(columns, "with linespoints " + peer_style(name));
  }
  plot.script() << "set title \"" << item.name << ": " << item.figure << " [%]\" noenhanced\n"
                << "set arrow 1 from 1, graph 0 to 1, graph 1 nohead linecolor rgb \"#cc79a7\" "
                   "linewidth 1.6\n";
  plot.panel();
  plot.script() << "unset arrow 1\n";
}

void draw_rates(Plot& plot, const std::vector<SweepPoint>& points,
                const std::vector<Quality>& qualities, const ChartSettings& settings) {
  for (const Quality& quality : qualities) {
    std::vector<std::vector<double>> columns(2);
    for (const SweepPoint* point : points_of(points, nullptr, quality)) {
      const double seconds = cost(*point, settings) * point->result.simulated;
      columns[0].push_back(point->result.particles);
      columns[1].push_back(static_cast<double>(point->result.steps) / seconds);
    }
    plot.add(columns, "with points " + style(quality));
  }
  plot.add(kPaper, "with points pointtype 3 pointsize 2 linewidth 2 linecolor rgb \"#000000\"");
  plot.script() << "set title \"Steps per second; stars: the paper\"\nset xlabel \"particles\"\n"
                << "set ylabel \"steps per second of computing\"\n";
  plot.panel();
}

void draw_legend(Plot& plot, const std::vector<Quality>& qualities) {
  plot.script() << "unset border\nunset tics\nunset grid\nunset xlabel\nunset ylabel\n"
                   "unset title\nunset logscale\nset key center center reverse Left samplen 3\n"
                   "set xrange [0:1]\nset yrange [0:1]\n";
  const auto add = [&](const std::string& style, const std::string& title) {
    plot.add("NaN with " + style + " title \"" + title + "\"");
  };
  for (const Quality& quality : qualities) add("linespoints " + style(quality), quality.name());
  for (const char* name : {kDfsph, kDual}) add("linespoints " + peer_style(name), name);
  add("lines linewidth 1.6 linecolor rgb \"#cc79a7\"", "real time");
  add("points pointtype 3 linewidth 2 linecolor rgb \"#000000\"",
      "Cirio et al. 2013, a laptop's GPU");
  plot.panel();
}

void draw(const std::filesystem::path& folder, const ChartSettings& settings,
          const std::vector<SweepPoint>& points) {
  const std::vector<Quality> qualities = qualities_of(points);
  const std::vector<const SweepCase*> cases = cases_of(points);
  const std::size_t panels = cases.size() + 2;
  const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(panels)));
  const std::size_t rows = (panels + columns - 1) / columns;
  Plot plot(folder / "error.png", static_cast<int>(450 * columns), static_cast<int>(500 * rows));
  plot.script() << "set termoption font \"DejaVu Sans,11\"\nset logscale xy\n"
                << "set format xy \"%g\"\n"
                << "set offsets graph 0.12, graph 0.25, graph 0.15, graph 0.15\nunset key\n"
                << "set multiplot layout " << rows << ',' << columns
                << " title \"Run time against error: " << settings.device
                << "; numbers: size over particle spacing\" noenhanced\n"
                << "set xlabel \"seconds of "
                << (settings.clock == Clock::wall ? "computing" : "processor per core")
                << " per simulated second\"\nset ylabel \"error [%]\"\n";
  for (const SweepCase* item : cases) draw_case(plot, points, *item, qualities, settings);
  draw_rates(plot, points, qualities, settings);
  draw_legend(plot, qualities);
  plot.draw();
}

std::vector<Row> csv_rows(const std::vector<SweepPoint>& points) {
  std::vector<Row> rows = {{"case", "figure", "size_over_spacing", "particles", "solver",
                            "time_step_factor", "kernels", "simulated_s", "steps", "wall_s",
                            "processor_s", "error_percent", "mean_density_error", "iterations",
                            "most_iterations", "given_up"}};
  for (const SweepPoint& p : points) {
    const Quality& q = p.quality;
    const validation::Result& r = p.result;
    rows.push_back({p.item->name, p.item->figure, number(resolution(p), 6),
                    std::to_string(r.particles), sim::name_of(q.solver), number(q.time_step_factor),
                    q.kernels == sim::KernelKind::reference ? "reference" : "vector",
                    number(r.simulated, 6), std::to_string(r.steps), number(r.steps_alone.wall, 6),
                    number(r.steps_alone.processor, 6), number(p.error(), 6),
                    number(r.mean_density_error, 6), "", "", ""});
    if (r.work.solves == 0) continue;
    rows.back()[13] = number(p.iterations(), 6);
    rows.back()[14] = std::to_string(r.work.most);
    rows.back()[15] = std::to_string(r.work.given_up);
  }
  return rows;
}

/// What the picture and the table show: a paragraph.
std::string explanation(const ChartSettings& settings) {
  return std::string(
             "Each case's error, in percent of the size of its figure, and the seconds of ") +
         (settings.clock == Clock::wall ? "computing" : "processor per core") +
         " that one simulated second takes. Sleep and the search for bubbles are off; set-up, "
         "settling and gauges are left out. \"dt x 0.5\" has half the safe time step; the "
         "reference kernels look at one particle at a time. The last panel has the steps per "
         "second of all "
         "runs beside the paper's three points, which have no error.";
}

/// A row for each case and resolution, with error and seconds of each quality.
std::vector<Row> error_table(const ChartSettings& settings, const std::vector<SweepPoint>& points) {
  const std::vector<Quality> qualities = qualities_of(points);
  Row head = {"case", "error of", "size / dp"};
  for (const Quality& quality : qualities) {
    head.push_back(quality.name() + " [%]");
    head.emplace_back("[s]");
  }
  std::vector<Row> rows = {head};
  for (const SweepPoint& p : points) {
    if (p.quality == qualities.front()) {
      rows.push_back({p.item->name, p.item->figure, number(resolution(p))});
    }
    rows.back().push_back(number(p.error()));
    rows.back().push_back(number(cost(p, settings), 2));
  }
  return rows;
}

/// How the other programs were run: a paragraph, and the figures.
std::string about_peers() {
  return "Two other programs with the same lattice and mass of water: SPlisHSPlasH 2.16.0 (DFSPH: "
         "the settings of its own dam break, density within 0.05 %, divergence 0.1 %, steps of up "
         "to 5 ms; the wave without its viscosity of 0.01) and DualSPHysics 5.4.355 (Verlet, h/dp "
         "1.2, DBC), measured on 23 November 2026 on two cores of an AMD EPYC with AVX-512, by the "
         "clock; this command does not have them. Points of walls and bodies were off the surface "
         "by 0.64 and 0.5 spacings, which is kinder than their own tools: with points on the "
         "surface the cuboid floats 28 % of its height too high in SPlisHSPlasH.";
}

std::vector<Row> peer_table() {
  std::vector<Row> rows = {{"case", "program", "size / dp", "error [%]", "by the clock [s]"}};
  for (const Peer& peer : kPeers) {
    rows.push_back(
        {peer.item, peer.name, number(peer.resolution, 4), number(peer.error), number(peer.cost)});
  }
  return rows;
}

struct Options {
  std::vector<std::string> cases;  ///< empty: all
  std::size_t resolutions = 2;
  bool all = false;
  Clock clock = Clock::wall;
  int device = -1;
};

SweepPlan plan_of(const Options& options) {
  SweepPlan plan;
  plan.resolutions = options.all ? 100 : options.resolutions;
  plan.qualities = options.all ? all_qualities() : quick_qualities();
  for (const SweepCase& item : sweep_cases()) {
    if (is_wanted(options.cases, item.name)) plan.cases.push_back(&item);
  }
  return plan;
}

bool run(Bench& bench, const Options& options) {
  const sim::DeviceFacts facts = sim::Device(options.device).facts();
  bench.set_device(describe(facts));
  const ChartSettings chart = {options.clock, facts.compute_units, facts.name};
  // After every run, so that a sweep that is broken off leaves what it found.
  const auto points =
      sweep(plan_of(options), options.device, [&](const std::vector<SweepPoint>& so_far) {
        write_csv(bench.out() / "error.csv", csv_rows(so_far));
        draw(bench.out(), chart, so_far);
      });
  bench.tell(explanation(chart));
  bench.show("error.png", "Run time against error");
  bench.tell(markdown(error_table(chart, points)));
  bench.tell(about_peers());
  bench.tell(markdown(peer_table()));
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Bench bench("error", "accuracy.md", "Run time against error",
              "What the water's errors are for the time that it takes.");
  std::vector<std::string> cases;
  for (const SweepCase& item : sweep_cases()) cases.push_back(item.name);
  CLI::App& app = bench.options();
  app.add_option("--case", options.cases, "Only this case (repeatable)")
      ->check(CLI::IsMember(cases));
  app.add_option("--resolutions", options.resolutions, "Only so many, coarse ones first")
      ->capture_default_str()
      ->check(CLI::Range(1, 100));
  app.add_flag("--all", options.all,
               "All combinations, longer steps and all resolutions: hours instead of minutes");
  const std::map<std::string, Clock> clocks = {{"wall", Clock::wall},
                                               {"processor", Clock::processor}};
  app.add_option("--clock", options.clock,
                 "What the chart is drawn over: wall, or processor where others are at work, too")
      ->transform(CLI::CheckedTransformer(clocks));
  bench.add_device_option(options.device);
  return bench.run(argc, argv, [&] { return run(bench, options); });
}
