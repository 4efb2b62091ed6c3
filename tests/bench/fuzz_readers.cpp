// SPDX-License-Identifier: MIT
#include "tests/bench/fuzz_readers.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

#include "protocol/time_tag.hpp"
#include "tests/protocol/other_readers.hpp"
#include "tests/protocol/random_packets.hpp"

namespace splash::bench {
namespace {

using namespace protocol;

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

void print_packet(Bytes packet) {
  std::printf("read differently: ");
  for (const auto byte : packet) std::printf("%02x", std::to_integer<unsigned>(byte));
  std::printf("\n");
}

}  // namespace

bool compare_readers(std::uint64_t inputs) {
  constexpr std::uint64_t kNews = 10;  // lines of progress
  constexpr std::uint64_t kShown = 5;  // packets printed
  protocol::test::RandomPackets random(7);
  protocol::test::LibloReader liblo;
  Counts counts;
  const double start = monotonic_now();
  while (counts.inputs < inputs) {
    const bool mutated = counts.inputs % 2 == 1;
    const auto packet = mutated ? random.mutated() : random.legal();
    ++counts.inputs;
    const DecodeResult ours = decode(packet);
    if (ours.refusal == Refusal::none) {
      ++counts.accepted;
      counts.broken += mutated ? 1U : 0U;
      const bool alike = protocol::test::read_with_oscpack(packet) == ours.packet &&
                         liblo.read(packet) == ours.packet;
      if (!alike && counts.different++ < kShown) print_packet(packet);
    }
    if (counts.inputs % std::max<std::uint64_t>(1, inputs / kNews) == 0) {
      print(counts, monotonic_now() - start);
    }
  }
  return counts.different == 0;
}

}  // namespace splash::bench
