// SPDX-License-Identifier: MIT
// ./splash bench link: all 45 cells of loss, duplication and reordering over a link with jitter and
// an outage, each with several seeds. A row per cell; ends with 1 when a rule was broken.
#include <array>
#include <cstdio>

#include "program/text.hpp"
#include "tests/bench/report.hpp"
#include "tests/network/link_run.hpp"

namespace {

using namespace splash::network;

/// Runs, bundles sent, lost, doubled and reordered, events that came, that were late and that were
/// too late, broken rules.
using Sum = std::array<std::uint64_t, 9>;

void add(Sum& sum, const Sum& other) {
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += other[k];
}

splash::bench::Row row(const std::string& name, const Sum& sum) {
  splash::bench::Row cells = {name};
  for (const std::uint64_t count : sum) cells.push_back(std::to_string(count));
  return cells;
}

Sum run_cell(double loss, double duplication, double reordering, std::uint32_t seeds) {
  Sum sum{};
  for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
    const LinkReport one = run_link(loss, duplication, reordering, seed);
    add(sum, {1, one.sent, one.lost, one.duplicates, one.reordered, one.events, one.late,
              one.too_late, one.wrong.size()});
    for (const std::string& line : one.wrong) std::printf("  seed %u: %s\n", seed, line.c_str());
  }
  return sum;
}

bool run(splash::bench::Bench& bench, std::uint32_t seeds) {
  auto table =
      bench.table("link.csv", {"lost, doubled, reordered [%]", "runs", "bundles", "lost", "doubles",
                               "reordered", "events", "late", "dropped", "wrong"});
  Sum all{};
  for (const double loss : kLosses) {
    for (const double duplication : kDuplications) {
      for (const double reordering : kReorderings) {
        const Sum cell = run_cell(loss, duplication, reordering, seeds);
        table.add(row(splash::program::format("%g, %g, %g", 100.0 * loss, 100.0 * duplication,
                                              100.0 * reordering),
                      cell));
        add(all, cell);
      }
    }
  }
  table.add(row("all", all));
  const auto& [runs, sent, lost, doubled, reordered, events, late, too_late, wrong] = all;
  const auto text = [](std::uint64_t count) { return std::to_string(count); };
  bench.tell(text(runs) + " runs: " + text(sent) + " bundles sent, " + text(lost) + " lost, " +
             text(doubled) + " doubled, " + text(reordered) + " reordered; " + text(events) +
             " events came, " + text(late) + " of them late and played at once, " + text(too_late) +
             " too late and dropped. " + text(wrong) + " rules were broken.");
  return wrong == 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint32_t seeds = 10;
  splash::bench::Bench bench("link", "robustness.md", "The wire over a bad link",
                             "The wire over a bad link, every cell of the grid");
  bench.options().add_option("--seeds", seeds, "runs of each cell")->capture_default_str();
  return bench.run(argc, argv, [&] { return run(bench, seeds); });
}
