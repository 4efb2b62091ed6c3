// SPDX-License-Identifier: MIT
#include "tests/supercollider/synthdef.hpp"

#include <bit>
#include <cstdint>
#include <numbers>
#include <string>

namespace splash::supercollider {
namespace {

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

class Definition {
 public:
  Wire constant(float value) {
    constants_.push_back(value);
    return {-1, static_cast<int>(constants_.size()) - 1};
  }
  /// The parameters: the first unit generator.
  void parameters(const std::vector<std::string>& names) {
    names_ = names;
    add("Control", kControl, {}, static_cast<int>(names.size()), 0);
  }
  [[nodiscard]] static Wire parameter(int index) { return {0, index}; }

  Wire add(const std::string& name, Rate rate, const std::vector<Wire>& inputs, int outputs = 1,
           int special = 0) {
    text(ugens_, name);
    number(ugens_, rate, 1);
    number(ugens_, static_cast<std::int64_t>(inputs.size()), 4);
    number(ugens_, outputs, 4);
    number(ugens_, special, 2);
    for (const Wire& wire : inputs) {
      number(ugens_, wire.ugen, 4);
      number(ugens_, wire.index, 4);
    }
    for (int k = 0; k < outputs; ++k) number(ugens_, rate, 1);
    return {count_++, 0};
  }
  Wire unary(Operator op, Wire in) { return add("UnaryOpUGen", kAudio, {in}, 1, op); }
  Wire binary(Operator op, Wire a, Wire b) { return add("BinaryOpUGen", kAudio, {a, b}, 1, op); }

  [[nodiscard]] std::vector<std::byte> compiled(const std::string& name) const {
    std::vector<std::byte> out;
    for (const char letter : std::string("SCgf")) out.push_back(std::byte(letter));
    number(out, 2, 4);  // version
    number(out, 1, 2);  // definitions
    text(out, name);
    number(out, static_cast<std::int64_t>(constants_.size()), 4);
    for (const float value : constants_) number(out, std::bit_cast<std::int32_t>(value), 4);
    number(out, static_cast<std::int64_t>(names_.size()), 4);
    for (std::size_t k = 0; k < names_.size(); ++k) number(out, 0, 4);  // defaults
    number(out, static_cast<std::int64_t>(names_.size()), 4);
    for (std::size_t k = 0; k < names_.size(); ++k) {
      text(out, names_[k]);
      number(out, static_cast<std::int64_t>(k), 4);
    }
    number(out, count_, 4);
    out.insert(out.end(), ugens_.begin(), ugens_.end());
    number(out, 0, 2);  // variants
    return out;
  }

 private:
  /// Big-endian.
  static void number(std::vector<std::byte>& out, std::int64_t value, int bytes) {
    for (int k = bytes - 1; k >= 0; --k) {
      out.push_back(std::byte(static_cast<std::uint64_t>(value) >> (8 * k) & 0xFFU));
    }
  }
  /// A Pascal string.
  static void text(std::vector<std::byte>& out, const std::string& value) {
    out.push_back(std::byte(value.size()));
    for (const char letter : value) out.push_back(std::byte(letter));
  }

  std::vector<float> constants_;
  std::vector<std::string> names_;
  std::vector<std::byte> ugens_;
  int count_ = 0;
};

}  // namespace

std::vector<std::byte> bubble_synthdef() {
  constexpr int kAmp = 0;
  constexpr int kFrequency = 1;
  constexpr int kDamping = 2;
  constexpr int kLength = 3;
  constexpr int kBreaks = 4;
  constexpr float kFreeSelf = 2.0F;  // what Line does when it is through
  Definition def;
  const Wire nil = def.constant(0.0F);
  const Wire one = def.constant(1.0F);
  def.parameters({"amp", "f0", "d", "length", "breaks"});
  const Wire amp = Definition::parameter(kAmp);
  const Wire f0 = Definition::parameter(kFrequency);
  const Wire d = Definition::parameter(kDamping);
  const Wire length = Definition::parameter(kLength);
  const Wire breaks = Definition::parameter(kBreaks);
  def.add("Line", kControl, {nil, one, length, def.constant(kFreeSelf)});
  const Wire t = def.add("Sweep", kAudio, {nil, one});
  const Wire decay = def.binary(kTimes, d, t);
  const Wire chirp = def.binary(kAdd, one, def.binary(kTimes, def.constant(0.1F), decay));
  const Wire cycles = def.binary(kTimes, def.binary(kTimes, f0, t), chirp);
  const Wire angle = def.binary(kTimes, def.constant(2.0F * std::numbers::pi_v<float>),
                                def.unary(kFraction, cycles));
  const Wire envelope = def.unary(kExponential, def.unary(kNegate, decay));
  const Wire tone = def.binary(kTimes, def.unary(kSine, angle), def.binary(kTimes, amp, envelope));
  // From `breaks` on it fades within 50 ms: left^2 (3 - 2 left).
  const Wire since = def.binary(kMinus, t, breaks);
  const Wire falling = def.binary(kMinus, one, def.binary(kTimes, def.constant(20.0F), since));
  const Wire left = def.binary(kMaximum, def.binary(kMinimum, falling, one), nil);
  const Wire bend =
      def.binary(kMinus, def.constant(3.0F), def.binary(kTimes, def.constant(2.0F), left));
  const Wire fade = def.binary(kTimes, def.binary(kTimes, left, left), bend);
  def.add("OffsetOut", kAudio, {nil, def.binary(kTimes, tone, fade)}, 0);
  return def.compiled("bubble");
}

}  // namespace splash::supercollider
