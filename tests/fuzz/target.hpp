// SPDX-License-Identifier: MIT
// What reads bytes from outside, each as one function of the bytes that must keep its promises
// whatever they are. The same functions serve libFuzzer (./splash bench fuzz) and the test that
// replays the seeds.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/gate.hpp"

namespace splash::fuzz {

using protocol::Bytes;

/// A reader did what it promises never to do.
class Broken : public std::logic_error {
  using std::logic_error::logic_error;
};

/// Throws Broken when `holds` is false.
inline void promise(bool holds, const std::string& what) {
  if (!holds) throw Broken(what);
}

/// Each returns whether the input was accepted; refusing it is as right as accepting it. Throws
/// Broken, or whatever escaped the reader.
bool try_gate(Bytes input);      ///< gate() alone
bool try_packet(Bytes input);    ///< both readers of packets, and what becomes of their messages
bool try_intake(Bytes input);    ///< datagrams in a row through the synth's whole receiving side
bool try_log(Bytes input);       ///< event logs
bool try_scene(Bytes input);     ///< scene files
bool try_rig(Bytes input);       ///< rig files
bool try_mesh(Bytes input);      ///< triangle meshes, of either format
bool try_tracker(Bytes input);   ///< datagrams of trackers, through every preset
bool try_tuio(Bytes input);      ///< datagrams of touched surfaces in a row, to the feet they move
bool try_pressure(Bytes input);  ///< datagrams of a pressure-sensing floor, likewise

struct Target {
  std::string name;
  bool (*try_input)(Bytes);
  std::size_t longest;                       ///< input worth trying [bytes]
  std::vector<std::filesystem::path> seeds;  ///< files, or folders of them
  std::filesystem::path dictionary;          ///< libFuzzer's: words to insert
  double share;                              ///< of all inputs of a run [1]
};

[[nodiscard]] const std::vector<Target>& targets();

/// The seeds' contents, in the order of their names.
[[nodiscard]] std::vector<std::vector<std::byte>> read_seeds(const Target& target);

}  // namespace splash::fuzz
