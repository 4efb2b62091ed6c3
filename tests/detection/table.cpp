// SPDX-License-Identifier: MIT
#include "tests/detection/table.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace splash::detection {
namespace {

const char* const kColumns =
    " | impacts expected | detected | missed | false | moment, ms | approach, % | P / (m_a u) | "
    "cavities of an entry | stray (above) | closing / law | V / law | bubbles | faulty";
const char* const kBegin = "<!-- begin: detection-bench -->\n";
const char* const kEnd = "<!-- end: detection-bench -->\n";
const char* const kRule =
    " | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | ---";

/// "smallest / median / largest".
std::string spread(std::vector<double> values, double factor, const char* format) {
  if (values.empty()) return "";
  std::sort(values.begin(), values.end());
  char text[96];
  std::snprintf(text, sizeof text, format, factor * values.front(),
                factor * values[values.size() / 2], factor * values.back());
  return text;
}

std::string figures(const Score& s) {
  char counts[64];
  std::snprintf(counts, sizeof counts, " | %d | %d | %d | %d | ", s.wanted, s.hit, s.wanted - s.hit,
                s.untrue);
  char rest[64];
  std::snprintf(rest, sizeof rest, " | %d | %d (%d) | ", s.cavities, s.stray, s.stray_above);
  std::vector<double> percent = s.speed_error;
  return counts + spread(s.late_ms, 1.0, "%+.1f / %+.1f / %+.1f") + " | " +
         spread(percent, 100.0, "%+.0f / %+.0f / %+.0f") + " | " +
         spread(s.momentum, 1.0, "%.2f / %.2f / %.2f") + rest +
         spread(s.closing, 1.0, "%.2f / %.2f / %.2f") + " | " +
         spread(s.air, 1.0, "%.2f / %.2f / %.2f") + " | " + std::to_string(s.bubbles);
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
  return "| " + name + " | " + std::to_string(outcomes.size()) + figures(sum) + " | " +
         std::to_string(faulty) + " |\n";
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
    out << "\n## " << sweep << "\n\n| case" << kColumns
        << " | particles | processor time, s |\n| ---" << kRule << " | --- | --- |\n";
    for (const Outcome* outcome : of_sweep(outcomes, sweep)) {
      char effort[48];
      std::snprintf(effort, sizeof effort, " | %d | %.1f |\n", outcome->particles,
                    outcome->processor);
      out << "| " << outcome->item.name << figures(outcome->score) << " | "
          << (outcome->score.faults.empty() ? "" : "yes") << effort;
    }
    out << '\n';
    for (const Outcome* outcome : of_sweep(outcomes, sweep)) {
      for (const std::string& fault : outcome->score.faults) {
        out << "* " << outcome->item.name << ": " << fault << '\n';
      }
    }
  }
}

void write_csv(std::ostream& out, const std::vector<Outcome>& outcomes) {
  out << "sweep,case,wanted,told,missed,false,allowed,waves,cavities,stray,stray_above,bubbles,"
         "faults,late_ms,approach_error,momentum_ratio,closing_ratio,air_ratio,depth_ratio\n";
  const auto list = [&](const std::vector<double>& values) {
    out << ',';
    for (std::size_t k = 0; k < values.size(); ++k) out << (k > 0 ? " " : "") << values[k];
  };
  for (const Outcome& outcome : outcomes) {
    const Score& s = outcome.score;
    out << outcome.item.sweep << ",\"" << outcome.item.name << '"';
    for (const int count :
         {s.wanted, s.hit, s.wanted - s.hit, s.untrue, s.allowed, s.waves, s.cavities, s.stray,
          s.stray_above, s.bubbles, static_cast<int>(s.faults.size())}) {
      out << ',' << count;
    }
    list(s.late_ms);
    list(s.speed_error);
    list(s.momentum);
    list(s.closing);
    list(s.air);
    list(s.depth);
    out << '\n';
  }
}

std::string head() {
  return std::string("| sweep | runs") + kColumns + " |\n| --- | ---" + kRule + " |\n";
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
  std::ofstream csv(folder / "cases.csv");
  write_csv(csv, outcomes);
  if (!report.flush() || !csv.flush()) {
    throw std::runtime_error("cannot write into " + folder.string());
  }
}

}  // namespace splash::detection
