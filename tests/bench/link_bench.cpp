// SPDX-License-Identifier: MIT
// ./splash bench link: all 45 cells of loss, duplication and reordering over a link with jitter and
// an outage, each with several seeds. Prints a line per cell and ends with 1 when a rule was
// broken.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>

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

void print(const char* name, const Sum& sum) {
  const auto n = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
  std::printf("%-22s %5llu %9llu %8llu %8llu %8llu %9llu %8llu %8llu %6llu\n", name, n(sum.runs),
              n(sum.sent), n(sum.lost), n(sum.duplicates), n(sum.reordered), n(sum.events),
              n(sum.late), n(sum.too_late), n(sum.wrong));
  std::fflush(stdout);
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
  char name[64];
  std::snprintf(name, sizeof name, "%4.0f %6.0f %9.0f", 100.0 * loss, 100.0 * duplication,
                100.0 * reordering);
  print(name, sum);
  return sum;
}

int run(std::uint32_t seeds) {
  std::printf("%-22s %5s %9s %8s %8s %8s %9s %8s %8s %6s\n", "loss dup. reordered %", "runs",
              "bundles", "lost", "doubles", "reorder.", "events", "late", "dropped", "wrong");
  Sum all;
  for (const double loss : kLosses) {
    for (const double duplication : kDuplications) {
      for (const double reordering : kReorderings) {
        all.add(run_cell(loss, duplication, reordering, seeds));
      }
    }
  }
  print("all", all);
  return all.wrong == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint32_t seeds = 10;
  CLI::App app("The wire over a bad link, every cell of the grid");
  app.add_option("--seeds", seeds, "runs of each cell")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    return run(seeds);
  } catch (const std::exception& error) {
    std::cerr << "bench-link: " << error.what() << '\n';
    return 70;
  }
}
