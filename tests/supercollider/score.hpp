// SPDX-License-Identifier: MIT
// What SuperCollider's server plays without real time: a voice compiled by hand, and a score of
// bundles behind their sizes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace splash::supercollider {

// The binary SynthDef format, version 2 (SuperCollider's "Synth Definition File Format").

enum Rate : int { kScalar = 0, kControl = 1, kAudio = 2 };
/// Special indices of UnaryOpUGen and BinaryOpUGen.
enum Operator : int {
  kAdd = 0,
  kMinus = 1,
  kTimes = 2,
  kMinimum = 12,
  kMaximum = 13,
  kNegate = 0,
  kFraction = 10,
  kExponential = 15,
  kSine = 28
};

/// What goes into a unit generator: another's output, or a constant.
struct Wire {
  int ugen = -1;  ///< -1: a constant
  int index = 0;  ///< of the output or of the constant
};

/// The few kinds of OSC that a score needs; big-endian.
class Packet {
 public:
  void text(const std::string& value);
  void whole(std::int64_t value, int bytes = 4);
  void real(double value);
  void blob(const std::string& value);
  /// As it stands.
  void raw(const std::string& value) { bytes_ += value; }
  /// A Pascal string.
  void pascal(const std::string& value);
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

class Definition {
 public:
  Wire constant(float value);
  /// The parameters: the first unit generator.
  void parameters(const std::vector<std::string>& names);
  [[nodiscard]] static Wire parameter(int index) { return {0, index}; }

  Wire add(const std::string& name, Rate rate, const std::vector<Wire>& inputs, int outputs = 1,
           int special = 0);
  Wire unary(Operator op, Wire in) { return add("UnaryOpUGen", kAudio, {in}, 1, op); }
  Wire binary(Operator op, Wire a, Wire b) { return add("BinaryOpUGen", kAudio, {a, b}, 1, op); }

  [[nodiscard]] std::string compiled(const std::string& name) const;

 private:
  std::vector<float> constants_;
  std::vector<std::string> names_;
  Packet ugens_;
  int count_ = 0;
};

/// A score's bundle with one message, `seconds` after the start.
void write_bundle(std::ofstream& file, double seconds, const std::string& message);
/// /d_recv at the start.
void write_definition(std::ofstream& file, const std::string& compiled);
/// The rendering ends with the last bundle.
void write_end(std::ofstream& file, double seconds);

}  // namespace splash::supercollider
