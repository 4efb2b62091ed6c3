// SPDX-License-Identifier: MIT
// ./splash bench link: all 45 cells of loss, duplication and reordering over a link with jitter and
// an outage, each with several seeds. A row per cell; ends with 1 when a rule was broken.
#include <cstdio>

#include "tests/bench/report.hpp"
#include "tests/network/link_run.hpp"

namespace {

using namespace splash::network;

struct Sum {
  std::uint64_t runs = 0, wrong = 0;
  std::uint64_t sent = 0, lost = 0, duplicates = 0, reordered = 0, events = 0, late = 0;
  std::uint64_t too_late = 0;

  void add(const Sum& other) {
    runs += other.runs;
    wrong += other.wrong;
    sent += other.sent;
    lost += other.lost;
    duplicates += other.duplicates;
    reordered += other.reordered;
    events += other.events;
    late += other.late;
    too_late += other.too_late;
  }
};

Sum of(const LinkReport& one) {
  return {1,          one.wrong.size(), one.sent,    one.lost, one.duplicates, one.reordered,
          one.events, one.late,         one.too_late};
}

std::vector<std::string> counts(const Sum& sum) {
  std::vector<std::string> row;
  for (const std::uint64_t count : {sum.runs, sum.sent, sum.lost, sum.duplicates, sum.reordered,
                                    sum.events, sum.late, sum.too_late, sum.wrong}) {
    row.push_back(std::to_string(count));
  }
  return row;
}

void add(splash::bench::Table& table, const std::string& name, const Sum& sum) {
  std::vector<std::string> row = counts(sum);
  row.insert(row.begin(), name);
  table.add(row);
}

Sum run_cell(double loss, double duplication, double reordering, std::uint32_t seeds) {
  Sum sum;
  for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
    const LinkReport report = run_link(loss, duplication, reordering, seed);
    sum.add(of(report));
    for (const std::string& line : report.wrong) {
      std::printf("  seed %u: %s\n", seed, line.c_str());
    }
  }
  return sum;
}

bool run(splash::bench::Bench& bench, std::uint32_t seeds) {
  auto table =
      bench.table("link.csv", {"lost, doubled, reordered [%]", "runs", "bundles", "lost", "doubles",
                               "reordered", "events", "late", "dropped", "wrong"});
  Sum all;
  for (const double loss : kLosses) {
    for (const double duplication : kDuplications) {
      for (const double reordering : kReorderings) {
        const Sum cell = run_cell(loss, duplication, reordering, seeds);
        add(table,
            splash::bench::number(100.0 * loss) + ", " +
                splash::bench::number(100.0 * duplication) + ", " +
                splash::bench::number(100.0 * reordering),
            cell);
        all.add(cell);
      }
    }
  }
  add(table, "all", all);
  bench.tell(std::to_string(all.runs) + " runs: " + std::to_string(all.sent) + " bundles sent, " +
             std::to_string(all.lost) + " lost, " + std::to_string(all.duplicates) + " doubled, " +
             std::to_string(all.reordered) + " reordered; " + std::to_string(all.events) +
             " events came, " + std::to_string(all.late) + " of them late and played at once, " +
             std::to_string(all.too_late) + " too late and dropped. " + std::to_string(all.wrong) +
             " rules were broken.");
  return all.wrong == 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint32_t seeds = 10;
  splash::bench::Bench bench("link", "robustness.md", "The wire over a bad link",
                             "The wire over a bad link, every cell of the grid");
  bench.options().add_option("--seeds", seeds, "runs of each cell")->capture_default_str();
  return bench.run(argc, argv, [&] { return run(bench, seeds); });
}
