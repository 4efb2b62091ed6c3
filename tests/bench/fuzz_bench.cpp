// SPDX-License-Identifier: MIT
// ./splash bench fuzz: builds the libFuzzer programs of tests/fuzz with clang and both sanitizers,
// gives each its share of the inputs, and counts what they find; then asks oscpack and liblo what
// they read in what the gate accepts. Prints progress and a report; what was found lies in a
// folder, each input a file. Ends with 1 when anything was found.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "protocol/time_tag.hpp"
#include "tests/bench/report.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/protocol/other_readers.hpp"
#include "tests/protocol/random_packets.hpp"
#include "tests/support/child_process.hpp"

namespace {

using namespace splash;
namespace fs = std::filesystem;

constexpr int kPortions = 20;               ///< of a target's inputs: after each there is news
constexpr int kMostFindings = 20;           ///< of one target; more would be the same again
constexpr double kLongestPortion = 7200.0;  ///< [s]

struct Options {
  double inputs = 10e6;
  std::vector<std::string> only;
  unsigned seed = 1;
  unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
  fs::path out;  ///< corpora and findings
};

struct Result {
  std::string name;
  std::uint64_t inputs = 0;
  std::uint64_t wanted = 0;
  double seconds = 0.0;
  std::uint64_t corpus = 0;  ///< inputs that reached something new
  int findings = 0;
  int stalls = 0;     ///< ends that the input alone does not repeat: a machine that stood still
  std::string first;  ///< words of the first finding
};

/// The number behind `label` in libFuzzer's last words; 0: not there.
std::uint64_t number_after(const std::string& text, const std::string& label) {
  const auto found = text.rfind(label);
  return found == std::string::npos ? 0 : std::stoull(text.substr(found + label.size()));
}

std::string line_with(const std::string& text, const std::vector<std::string>& marks) {
  for (const std::string& mark : marks) {
    const auto found = text.find(mark);
    if (found != std::string::npos) return text.substr(found, text.find('\n', found) - found);
  }
  return "no words";
}

std::uint64_t files_in(const fs::path& folder) {
  return static_cast<std::uint64_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// One target's way through its share of the inputs, in portions.
class Campaign {
 public:
  Campaign(const fuzz::Target& target, const Options& options)
      : target_(target),
        options_(options),
        corpus_(options.out / ("corpus-" + target.name)),
        findings_(options.out / ("findings-" + target.name)) {
    fs::create_directories(corpus_);
    fs::remove_all(findings_);
    fs::create_directories(findings_);
    result_.name = target.name;
    result_.wanted = static_cast<std::uint64_t>(options.inputs * target.share);
  }

  Result run(const std::function<void(const Result&)>& news) {
    const double start = protocol::monotonic_now();
    for (unsigned portion = 0; result_.inputs < result_.wanted; ++portion) {
      if (result_.findings >= kMostFindings) break;
      run_portion(portion);
      result_.seconds = protocol::monotonic_now() - start;
      result_.corpus = files_in(corpus_);
      news(result_);
    }
    return result_;
  }

 private:
  void run_portion(unsigned portion) {
    const std::uint64_t left = result_.wanted - result_.inputs;
    const std::uint64_t runs = std::min(left, result_.wanted / kPortions + 1);
    std::vector<std::string> command{
        program(),
        "-runs=" + std::to_string(runs),
        "-seed=" + std::to_string(options_.seed + portion),
        "-max_len=" + std::to_string(target_.longest),
        "-dict=" + target_.dictionary.string(),
        "-artifact_prefix=" + findings_.string() + "/" + std::to_string(portion) + "-",
        "-timeout=5",
        "-rss_limit_mb=2048",
        "-print_final_stats=1",
        "-verbosity=1",
        corpus_.string()};
    for (const fs::path& seeds : target_.seeds) command.push_back(seeds.string());
    tests::ChildProcess process(command);
    const int code = process.wait_for_end(kLongestPortion);
    const std::string said = process.output();
    const std::uint64_t done = number_after(said, "stat::number_of_executed_units:");
    result_.inputs += std::max<std::uint64_t>(done, 1);
    if (code != 0) note_end(portion, said);
  }

  /// libFuzzer's limit for one input is of the wall clock: what it names must fail alone, too.
  void note_end(unsigned portion, const std::string& said) {
    const std::string prefix = std::to_string(portion) + "-";
    for (const auto& entry : fs::directory_iterator(findings_)) {
      if (!entry.path().filename().string().starts_with(prefix)) continue;
      tests::ChildProcess again({program(), "-timeout=5", entry.path().string()});
      if (again.wait_for_end(60.0) != 0) continue;
      ++result_.stalls;
      fs::remove(entry.path());
      return;
    }
    if (result_.findings++ == 0) {
      result_.first = line_with(said, {"broken: ", "runtime error: ", "ERROR: "});
    }
  }

  [[nodiscard]] std::string program() const {
    return std::string(SPLASH_FUZZ_BINARIES) + "/fuzz-" + target_.name;
  }

  const fuzz::Target& target_;
  const Options& options_;
  fs::path corpus_;
  fs::path findings_;
  Result result_;
};

void print_news(const Result& result) {
  std::printf("%-8s %10llu of %10llu  %8.0f/s  corpus %5llu  findings %d\n", result.name.c_str(),
              static_cast<unsigned long long>(result.inputs),
              static_cast<unsigned long long>(result.wanted),
              static_cast<double>(result.inputs) / std::max(result.seconds, 1e-3),
              static_cast<unsigned long long>(result.corpus), result.findings);
  std::fflush(stdout);
}

/// As many targets at once as there are cores, in the order of the table.
std::vector<Result> fuzz_all(const Options& options) {
  std::vector<const fuzz::Target*> queue;
  for (const fuzz::Target& target : fuzz::targets()) {
    if (bench::is_wanted(options.only, target.name)) queue.push_back(&target);
  }
  std::vector<Result> results(queue.size());
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < queue.size(); i = next++) {
      results[i] = Campaign(*queue[i], options).run([&](const Result& result) {
        const std::lock_guard lock(mutex);
        print_news(result);
      });
    }
  };
  std::vector<std::jthread> workers;
  for (unsigned i = 0; i < options.jobs; ++i) workers.emplace_back(work);
  workers.clear();  // joins
  return results;
}

void build_fuzzers(unsigned jobs) {
  const fs::path folder = fs::path(SPLASH_FUZZ_BINARIES).parent_path();
  std::printf("building the fuzzers in %s\n", folder.c_str());
  std::fflush(stdout);
  const std::string command = "cd '" SPLASH_SOURCE_DIR "' && cmake --preset fuzz -B '" +
                              folder.string() + "' >/dev/null && cmake --build '" +
                              folder.string() + "' --target fuzzers -j " + std::to_string(jobs);
  if (std::system(command.c_str()) != 0) {
    throw std::runtime_error(
        "the fuzzers could not be built: clang and libclang-rt-dev are needed");
  }
}

/// True when nothing was found.
bool report(bench::Bench& bench, const std::vector<Result>& results) {
  auto table = bench.table("fuzz.csv", {"target", "inputs", "per second", "corpus", "findings",
                                        "stalls", "first finding"});
  int findings = 0;
  for (const Result& result : results) {
    table.add({result.name, std::to_string(result.inputs),
               bench::number(static_cast<double>(result.inputs) / std::max(result.seconds, 1e-3)),
               std::to_string(result.corpus), std::to_string(result.findings),
               std::to_string(result.stalls), result.first});
    findings += result.findings;
  }
  bench.tell(table);
  return findings == 0;
}

struct Counts {
  std::uint64_t inputs = 0;
  std::uint64_t accepted = 0;
  std::uint64_t broken = 0;  ///< accepted ones that had been mutated
  std::uint64_t different = 0;
};

void print(const Counts& counts, double seconds) {
  std::printf(
      "readers  %10llu inputs  %8.0f/s  accepted %llu (of them mutated %llu)  read differently "
      "%llu\n",
      static_cast<unsigned long long>(counts.inputs),
      static_cast<double>(counts.inputs) / std::max(seconds, 1e-3),
      static_cast<unsigned long long>(counts.accepted),
      static_cast<unsigned long long>(counts.broken),
      static_cast<unsigned long long>(counts.different));
  std::fflush(stdout);
}

void print_packet(protocol::Bytes packet) {
  std::printf("read differently: ");
  for (const auto byte : packet) std::printf("%02x", std::to_integer<unsigned>(byte));
  std::printf("\n");
}

/// The differential test at length: what the gate accepts, oscpack, liblo and our decoder read
/// alike. `inputs` packets, half of them legal and half mutated. Prints progress and the counts;
/// true when no packet was read differently.
bool compare_readers(std::uint64_t inputs) {
  constexpr std::uint64_t kNews = 10;  // lines of progress
  constexpr std::uint64_t kShown = 5;  // packets printed
  protocol::test::RandomPackets random(7);
  protocol::test::LibloReader liblo;
  Counts counts;
  const double start = protocol::monotonic_now();
  while (counts.inputs < inputs) {
    const bool mutated = counts.inputs % 2 == 1;
    const auto packet = mutated ? random.mutated() : random.legal();
    ++counts.inputs;
    const protocol::DecodeResult ours = protocol::decode(packet);
    if (ours.refusal == protocol::Refusal::none) {
      ++counts.accepted;
      counts.broken += mutated ? 1U : 0U;
      const bool alike = protocol::test::read_with_oscpack(packet) == ours.packet &&
                         liblo.read(packet) == ours.packet;
      if (!alike && counts.different++ < kShown) print_packet(packet);
    }
    if (counts.inputs % std::max<std::uint64_t>(1, inputs / kNews) == 0) {
      print(counts, protocol::monotonic_now() - start);
    }
  }
  return counts.different == 0;
}

bool run(bench::Bench& bench, Options options) {
  options.out = bench.out();
  bool right = true;
  if (options.only != std::vector<std::string>{"readers"}) {
    build_fuzzers(options.jobs);
    right = report(bench, fuzz_all(options));
  }
  if (bench::is_wanted(options.only, "readers")) {
    const auto inputs = static_cast<std::uint64_t>(0.1 * options.inputs);
    const bool alike = compare_readers(inputs);
    bench.tell("Of " + std::to_string(inputs) + " packets, oscpack, liblo and our decoder read " +
               (alike ? "each alike." : "some differently."));
    right = alike && right;
  }
  std::printf(right ? "nothing was found\n" : "findings lie in %s\n", options.out.c_str());
  return right;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  bench::Bench bench("fuzz", "robustness.md", "What reads packets and files, fuzzed",
                     "Fuzzes what reads packets, logs, scenes and rigs");
  CLI::App& app = bench.options();
  app.add_option("--inputs", options.inputs, "inputs over all targets together")
      ->check(CLI::Range(1.0, 1e12))
      ->capture_default_str();
  app.add_option("--target", options.only,
                 "only these: gate packet intake log scene rig mesh tracker tuio pressure readers");
  app.add_option("--seed", options.seed, "of the mutations")->capture_default_str();
  app.add_option("--jobs", options.jobs, "targets at once")->check(CLI::Range(1, 256));
  return bench.run(argc, argv, [&] { return run(bench, options); });
}
