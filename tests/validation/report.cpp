// SPDX-License-Identifier: MIT
#include "tests/validation/report.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "program/text.hpp"
#include "sim-server/scene/solver_choice.hpp"
#include "tests/bench/plot.hpp"
#include "tests/bench/tables.hpp"

namespace splash::validation {

namespace {

std::string resolution(const Result& result) {
  return program::format("%s/dp = %.0f", result.item->size_name.c_str(),
                         result.item->size / result.spacing);
}

/// With the solver's name, where there are several.
std::string heading(const Result& result, const std::vector<const Result*>& all) {
  const bool several = std::any_of(
      all.begin(), all.end(), [&](const Result* other) { return other->solver != result.solver; });
  return several ? name_of(result.solver) + ", " + resolution(result) : resolution(result);
}

std::string gate(const Figure& figure) {
  if (!figure.has_gate()) return "";
  if (figure.lowest == 0.0) return "<= " + bench::number(figure.highest);
  if (figure.lowest == -figure.highest) return "+-" + bench::number(figure.highest);
  return bench::number(figure.lowest) + " .. " + bench::number(figure.highest);
}

std::string table(const std::vector<const Result*>& results) {
  const Case& item = *results.front()->item;
  bench::Row head = {"figure", "unit", "wanted"};
  for (const Result* result : results) head.push_back(heading(*result, results));
  std::vector<bench::Row> rows = {head};
  for (std::size_t k = 0; k < results.front()->outcome.figures.size(); ++k) {
    const Figure& first = results.front()->outcome.figures[k];
    bench::Row row = {first.name, first.unit, gate(first)};
    for (const Result* result : results) {
      const Figure& figure = result->outcome.figures[k];
      const std::string mark = figure.has_gate() && !figure.passes() ? "**" : "";
      row.push_back(mark + bench::number(figure.value) + mark);
    }
    rows.push_back(row);
  }
  const auto add = [&](const std::string& name, const std::string& unit, auto value) {
    bench::Row row = {name, unit, ""};
    for (const Result* result : results) row.push_back(bench::number(value(*result)));
    rows.push_back(row);
  };
  add("particles, thousands", "1", [](const Result& r) { return 1e-3 * r.particles; });
  add("simulated", "s", [](const Result& r) { return r.simulated; });
  add("run time", "s", [](const Result& r) { return r.all.wall; });
  add("processor time", "s", [](const Result& r) { return r.all.processor; });
  return "### " + item.name + ": " + item.title + "\n\n" + bench::markdown(rows) + "\n";
}

/// The results that there are, case by case.
std::vector<std::vector<const Result*>> by_case(const std::vector<Result>& results) {
  std::vector<std::vector<const Result*>> cases;
  for (const Result& result : results) {
    if (cases.empty() || cases.back().front()->item != result.item) cases.emplace_back();
    cases.back().push_back(&result);
  }
  return cases;
}

/// What was measured or is known, and the runs at each resolution.
void draw_case(const std::filesystem::path& folder, const std::vector<const Result*>& results) {
  const Case& item = *results.front()->item;
  bench::Plot plot(folder / (item.name + ".png"), 1000, 640);
  plot.script() << "set key at screen 0.5, 0.02 bottom center horizontal maxrows 2 noenhanced \\\n"
                << "  textcolor rgb ink samplen 2\nset bmargin 7\n"
                << "set title \"" << item.title << "\" noenhanced textcolor rgb ink\n"
                << "set xlabel \"" << item.x_label << "\" noenhanced textcolor rgb ink\n"
                << "set ylabel \"" << item.y_label << "\" noenhanced textcolor rgb ink\n";
  std::size_t number = 0;
  const auto add = [&](const Curve& curve, const std::string& title, const std::string& style) {
    plot.add({curve.x, curve.y}, "with " + style + " title \"" + title + '"');
  };
  for (const Result* result : results) {
    for (const Curve& curve : result->outcome.curves) {
      add(curve, curve.title + heading(*result, results),
          std::string("lines linewidth 1.6 linecolor rgb \"") + bench::colour(number++) + '"');
    }
  }
  for (const Curve& curve : item.reference()) {
    // Few points are a line or marks as measured; many are a line.
    const bool marks = curve.x.size() > 2 && curve.x.size() < 60;
    add(curve, curve.title,
        marks ? "points pointtype 7 pointsize 0.8 linecolor rgb \"#000000\""
              : "lines dashtype 2 linecolor rgb \"#000000\"");
  }
  plot.draw();
}

std::vector<bench::Row> figure_rows(const std::vector<Result>& results) {
  std::vector<bench::Row> rows = {{"case", "solver", "spacing_m", "size_over_spacing", "particles",
                                   "simulated_s", "wall_s", "processor_s", "figure", "unit",
                                   "value", "lowest", "highest", "passes"}};
  const auto exact = [](double value) { return bench::number(value, 6); };
  for (const Result& r : results) {
    for (const Figure& figure : r.outcome.figures) {
      rows.push_back({r.item->name, name_of(r.solver), exact(r.spacing),
                      exact(r.item->size / r.spacing), std::to_string(r.particles),
                      exact(r.simulated), exact(r.all.wall), exact(r.all.processor), figure.name,
                      figure.unit, exact(figure.value), exact(figure.lowest), exact(figure.highest),
                      figure.has_gate() ? (figure.passes() ? "1" : "0") : ""});
    }
  }
  return rows;
}

}  // namespace

Result run_case(sim::Device& device, const Case& item, const Setting& setting,
                const std::filesystem::path& series_folder,
                const std::function<void(double)>& progress) {
  Result result;
  result.item = &item;
  result.solver = setting.solver;
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
      run.gauges.write(series_folder /
                       (scene + "-" + bench::number(1e3 * setting.spacing) + "mm.csv"));
    }
  }
  result.outcome = item.evaluate(runs);
  return result;
}

std::string tables(const std::vector<Result>& results) {
  std::string text;
  for (const auto& mine : by_case(results)) text += table(mine);
  return text;
}

void write_report(const std::filesystem::path& folder, const std::string& device,
                  const std::vector<Result>& results) {
  std::ofstream out(folder / "report.md");
  out << "# Validation\n\nDevice: " << device
      << ". Bold: outside the range that is wanted. dp is the particle spacing; no parameter but "
         "it differs from the shipped defaults.\n\n";
  for (const auto& mine : by_case(results)) {
    out << table(mine);
    const std::string& name = mine.front()->item->name;
    try {
      draw_case(folder, mine);
      out << "![" << name << "](" << name << ".png)\n\n";
    } catch (const synth::GnuplotError& error) {
      out << "No picture: " << error.what() << ".\n\n";
    }
  }
  if (!out) throw std::runtime_error("cannot write " + (folder / "report.md").string());
  bench::write_csv(folder / "figures.csv", figure_rows(results));
}

}  // namespace splash::validation
