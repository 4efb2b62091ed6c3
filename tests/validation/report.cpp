// SPDX-License-Identifier: MIT
#include "tests/validation/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "synth-server/figure/gnuplot.hpp"
#include "tests/validation/picture.hpp"

namespace splash::validation {

namespace {

std::string text(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.3g", value);
  return digits;
}

std::string resolution(const Result& result) {
  char digits[64];
  std::snprintf(digits, sizeof digits, "%s/dp = %.0f", result.item->size_name.c_str(),
                result.item->size / result.spacing);
  return digits;
}

std::string gate(const Figure& figure) {
  if (!figure.has_gate()) return "";
  if (figure.lowest == 0.0) return "<= " + text(figure.highest);
  if (figure.lowest == -figure.highest) return "+-" + text(figure.highest);
  return text(figure.lowest) + " .. " + text(figure.highest);
}

/// The results of one case, in their order.
std::vector<const Result*> of_case(const std::vector<Result>& results, const Case& item) {
  std::vector<const Result*> mine;
  for (const Result& result : results) {
    if (result.item == &item) mine.push_back(&result);
  }
  return mine;
}

void write_table(std::ostream& out, const std::vector<const Result*>& results) {
  const Case& item = *results.front()->item;
  out << "## " << item.name << ": " << item.title << "\n\n| figure | unit | wanted |";
  for (const Result* result : results) out << ' ' << resolution(*result) << " |";
  out << "\n| --- | --- | --- |";
  for (std::size_t k = 0; k < results.size(); ++k) out << " --- |";
  for (std::size_t k = 0; k < results.front()->outcome.figures.size(); ++k) {
    const Figure& first = results.front()->outcome.figures[k];
    out << "\n| " << first.name << " | " << first.unit << " | " << gate(first) << " |";
    for (const Result* result : results) {
      const Figure& figure = result->outcome.figures[k];
      const bool missed = figure.has_gate() && !figure.passes();
      out << ' ' << (missed ? "**" : "") << text(figure.value) << (missed ? "**" : "") << " |";
    }
  }
  const auto row = [&](const std::string& name, const std::string& unit, auto value) {
    out << "\n| " << name << " | " << unit << " | |";
    for (const Result* result : results) out << ' ' << text(value(*result)) << " |";
  };
  row("particles, thousands", "1", [](const Result& r) { return 1e-3 * r.particles; });
  row("simulated", "s", [](const Result& r) { return r.simulated; });
  row("run time, settling and gauges included", "s", [](const Result& r) { return r.all.wall; });
  row("processor time of it", "s", [](const Result& r) { return r.all.processor; });
  out << "\n\n";
}

void draw_case(const std::filesystem::path& folder, const std::vector<const Result*>& results) {
  std::vector<Curve> curves;
  for (const Result* result : results) {
    for (Curve curve : result->outcome.curves) {
      curve.title += resolution(*result);
      curves.push_back(std::move(curve));
    }
  }
  const Case& item = *results.front()->item;
  draw(folder / (item.name + ".png"), item, curves);
}

void write_figures(const std::filesystem::path& path, const std::vector<Result>& results) {
  std::ofstream out(path);
  out << "case,spacing_m,size_over_spacing,particles,simulated_s,wall_s,processor_s,figure,unit,"
         "value,lowest,highest,passes\n";
  for (const Result& r : results) {
    for (const Figure& figure : r.outcome.figures) {
      out << r.item->name << ',' << r.spacing << ',' << r.item->size / r.spacing << ','
          << r.particles << ',' << r.simulated << ',' << r.all.wall << ',' << r.all.processor
          << ",\"" << figure.name << "\"," << figure.unit << ',' << figure.value << ','
          << figure.lowest << ',' << figure.highest << ','
          << (figure.has_gate() ? (figure.passes() ? "1" : "0") : "") << '\n';
    }
  }
  if (!out) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

Result run_case(sim::Device& device, const Case& item, const Setting& setting,
                const std::filesystem::path& series_folder,
                const std::function<void(double)>& progress) {
  Result result;
  result.item = &item;
  result.spacing = setting.spacing;
  std::vector<Run> runs;
  const double scenes = static_cast<double>(item.scenes.size());
  for (const std::string& scene : item.scenes) {
    const double done = static_cast<double>(runs.size()) / scenes;
    runs.push_back(run_scene(device, scene, setting, item.seconds, [&](double share) {
      if (progress) progress(done + share / scenes);
    }));
    const Run& run = runs.back();
    result.particles = std::max(result.particles, run.particles);
    result.simulated += run.simulated;
    result.steps += run.steps;
    result.all += run.all;
    result.steps_alone += run.steps_alone;
    result.work = run.work;
    result.mean_density_error = run.totals.mean_excess_sum /
                                static_cast<double>(std::max<std::int64_t>(run.totals.frames, 1));
    if (!series_folder.empty()) {
      run.gauges.write(series_folder / (scene + "-" + text(1e3 * setting.spacing) + "mm.csv"));
    }
  }
  result.outcome = item.evaluate(runs);
  return result;
}

void write_report(const std::filesystem::path& folder, const std::string& device,
                  const std::vector<Result>& results) {
  std::ofstream out(folder / "report.md");
  out << "# Validation\n\nDevice: " << device
      << ". Bold: outside the range that is wanted. dp is the particle spacing; no parameter but "
         "it differs from the shipped defaults.\n\n";
  for (const Case& item : all_cases()) {
    const auto mine = of_case(results, item);
    if (mine.empty()) continue;
    write_table(out, mine);
    try {
      draw_case(folder, mine);
      out << "![" << item.name << "](" << item.name << ".png)\n\n";
    } catch (const synth::GnuplotError& error) {
      out << "No picture: " << error.what() << ".\n\n";
    }
  }
  if (!out) throw std::runtime_error("cannot write " + (folder / "report.md").string());
  write_figures(folder / "figures.csv", results);
}

}  // namespace splash::validation
