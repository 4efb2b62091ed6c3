// SPDX-License-Identifier: MIT
#include "tests/detection/table.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "program/text.hpp"
#include "tests/bench/tables.hpp"

namespace splash::detection {
namespace {

const bench::Row kColumns = {
    "impacts expected", "detected",      "missed",      "false",
    "moment, ms",       "approach, %",   "P / (m_a u)", "cavities of an entry",
    "stray (above)",    "closing / law", "V / law",     "bubbles"};
const char* const kBegin = "<!-- begin: detection-bench -->\n";
const char* const kEnd = "<!-- end: detection-bench -->\n";

bench::Row joined(const bench::Row& first, const bench::Row& middle, const bench::Row& last) {
  bench::Row row = first;
  row.insert(row.end(), middle.begin(), middle.end());
  row.insert(row.end(), last.begin(), last.end());
  return row;
}

/// "smallest / median / largest", each as `one` has it.
std::string spread(std::vector<double> values, double factor, const char* one) {
  if (values.empty()) return "";
  std::sort(values.begin(), values.end());
  const auto text = [&](double value) { return program::format(one, factor * value); };
  return text(values.front()) + " / " + text(values[values.size() / 2]) + " / " +
         text(values.back());
}

bench::Row figures(const Score& s) {
  return {std::to_string(s.wanted),
          std::to_string(s.hit),
          std::to_string(s.wanted - s.hit),
          std::to_string(s.untrue),
          spread(s.late_ms, 1.0, "%+.1f"),
          spread(s.speed_error, 100.0, "%+.0f"),
          spread(s.momentum, 1.0, "%.2f"),
          std::to_string(s.cavities),
          program::format("%d (%d)", s.stray, s.stray_above),
          spread(s.closing, 1.0, "%.2f"),
          spread(s.air, 1.0, "%.2f"),
          std::to_string(s.bubbles)};
}

/// In the order of their first case.
std::vector<std::string> sweeps_of(const std::vector<Outcome>& outcomes) {
  std::vector<std::string> names;
  for (const Outcome& outcome : outcomes) {
    if (std::find(names.begin(), names.end(), outcome.item.sweep) == names.end()) {
      names.push_back(outcome.item.sweep);
    }
  }
  return names;
}

std::string row(const std::string& name, const std::vector<const Outcome*>& outcomes) {
  Score sum;
  int faulty = 0;
  for (const Outcome* outcome : outcomes) {
    add(sum, outcome->score);
    if (!outcome->score.faults.empty()) ++faulty;
  }
  return bench::markdown(
      joined({name, std::to_string(outcomes.size())}, figures(sum), {std::to_string(faulty)}));
}

std::vector<const Outcome*> of_sweep(const std::vector<Outcome>& outcomes,
                                     const std::string& sweep) {
  std::vector<const Outcome*> mine;
  for (const Outcome& outcome : outcomes) {
    if (sweep.empty() || outcome.item.sweep == sweep) mine.push_back(&outcome);
  }
  return mine;
}

void write_cases(std::ostream& out, const std::vector<Outcome>& outcomes) {
  for (const std::string& sweep : sweeps_of(outcomes)) {
    std::vector<bench::Row> rows = {
        joined({"case"}, kColumns, {"faulty", "particles", "processor time, s"})};
    for (const Outcome* outcome : of_sweep(outcomes, sweep)) {
      rows.push_back(
          joined({outcome->item.name}, figures(outcome->score),
                 {outcome->score.faults.empty() ? "" : "yes", std::to_string(outcome->particles),
                  program::format("%.1f", outcome->processor)}));
    }
    out << "\n## " << sweep << "\n\n" << bench::markdown(rows) << '\n';
    for (const Outcome* outcome : of_sweep(outcomes, sweep)) {
      for (const std::string& fault : outcome->score.faults) {
        out << "* " << outcome->item.name << ": " << fault << '\n';
      }
    }
  }
}

std::vector<bench::Row> csv_rows(const std::vector<Outcome>& outcomes) {
  std::vector<bench::Row> rows = {{"sweep", "case", "wanted", "told", "missed", "false", "allowed",
                                   "waves", "cavities", "stray", "stray_above", "bubbles", "faults",
                                   "late_ms", "approach_error", "momentum_ratio", "closing_ratio",
                                   "air_ratio", "depth_ratio"}};
  for (const Outcome& outcome : outcomes) {
    const Score& s = outcome.score;
    bench::Row row = {outcome.item.sweep, outcome.item.name};
    for (const int count :
         {s.wanted, s.hit, s.wanted - s.hit, s.untrue, s.allowed, s.waves, s.cavities, s.stray,
          s.stray_above, s.bubbles, static_cast<int>(s.faults.size())}) {
      row.push_back(std::to_string(count));
    }
    for (const auto* values :
         {&s.late_ms, &s.speed_error, &s.momentum, &s.closing, &s.air, &s.depth}) {
      std::string list;
      for (const double value : *values) {
        list += (list.empty() ? "" : " ") + bench::number(value, 6);
      }
      row.push_back(list);
    }
    rows.push_back(row);
  }
  return rows;
}

std::string head() {
  const bench::Row names = joined({"sweep", "runs"}, kColumns, {"faulty"});
  return bench::markdown(names) + bench::markdown(bench::Row(names.size(), "---"));
}

/// A sweep is one row; its recordings, which all differ, are a row each.
std::vector<std::string> rows_of(const std::vector<Outcome>& outcomes) {
  std::vector<std::string> rows;
  for (const std::string& sweep : sweeps_of(outcomes)) {
    std::vector<const Outcome*> scripted;
    for (const Outcome* outcome : of_sweep(outcomes, sweep)) {
      if (outcome->item.tracker.empty()) {
        scripted.push_back(outcome);
      } else {
        rows.push_back(row(sweep + ": " + outcome->item.name, {outcome}));
      }
    }
    if (!scripted.empty()) rows.push_back(row(sweep, scripted));
  }
  return rows;
}

/// The first cell of a row.
std::string name_of(const std::string& row) {
  return row.substr(0, row.find(" |"));
}

}  // namespace

std::string with_rows(const std::string& text, const std::vector<Outcome>& outcomes, bool all) {
  const std::size_t begin = text.find(kBegin);
  const std::size_t end = text.find(kEnd);
  if (begin == std::string::npos || end == std::string::npos || end < begin) {
    throw std::runtime_error("no lines " + std::string(kBegin) + "and " + kEnd);
  }
  const std::size_t from = begin + std::string(kBegin).size();
  std::vector<std::string> rows;
  std::istringstream old(text.substr(from, end - from));
  for (std::string line; !all && std::getline(old, line);) {
    if (line.starts_with("| ") && !line.starts_with("| sweep") && !line.starts_with("| ---")) {
      rows.push_back(line + "\n");
    }
  }
  for (const std::string& row : rows_of(outcomes)) {
    const auto same = std::find_if(rows.begin(), rows.end(), [&](const std::string& other) {
      return name_of(other) == name_of(row);
    });
    if (same == rows.end()) {
      rows.push_back(row);
    } else {
      *same = row;
    }
  }
  std::string table = "\n" + head();
  for (const std::string& row : rows) table += row;
  return text.substr(0, from) + table + "\n" + text.substr(end);
}

std::string summary(const std::vector<Outcome>& outcomes) {
  std::string text = head();
  for (const std::string& sweep : sweeps_of(outcomes)) {
    text += row(sweep, of_sweep(outcomes, sweep));
  }
  return text + row("all", of_sweep(outcomes, ""));
}

void write_report(const std::filesystem::path& folder, const std::string& device,
                  const std::vector<Outcome>& outcomes) {
  double processor = 0.0;
  for (const Outcome& outcome : outcomes) processor += outcome.processor;
  std::ofstream report(folder / "report.md");
  report << "# Detection against closed-form truth\n\n"
         << outcomes.size() << " runs on " << device << " in " << static_cast<int>(processor)
         << " s of processor time. Three figures are the smallest, the median and the largest.\n\n"
         << summary(outcomes);
  write_cases(report, outcomes);
  if (!report.flush()) throw std::runtime_error("cannot write into " + folder.string());
  bench::write_csv(folder / "cases.csv", csv_rows(outcomes));
}

}  // namespace splash::detection
