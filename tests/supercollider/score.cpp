// SPDX-License-Identifier: MIT
#include "tests/supercollider/score.hpp"

#include <bit>
#include <cmath>

namespace splash::supercollider {

void Packet::text(const std::string& value) {
  raw(value);
  bytes_.append(4 - value.size() % 4, '\0');
}

void Packet::whole(std::int64_t value, int bytes) {
  for (int k = bytes - 1; k >= 0; --k) {
    bytes_.push_back(static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * k) & 0xFFU));
  }
}

void Packet::real(double value) {
  whole(std::bit_cast<std::int32_t>(static_cast<float>(value)));
}

void Packet::blob(const std::string& value) {
  whole(static_cast<std::int64_t>(value.size()));
  raw(value);
  bytes_.append((4 - value.size() % 4) % 4, '\0');
}

void Packet::pascal(const std::string& value) {
  whole(static_cast<std::int64_t>(value.size()), 1);
  raw(value);
}

Wire Definition::constant(float value) {
  constants_.push_back(value);
  return {-1, static_cast<int>(constants_.size()) - 1};
}

void Definition::parameters(const std::vector<std::string>& names) {
  names_ = names;
  add("Control", kControl, {}, static_cast<int>(names.size()), 0);
}

Wire Definition::add(const std::string& name, Rate rate, const std::vector<Wire>& inputs,
                     int outputs, int special) {
  ugens_.pascal(name);
  ugens_.whole(rate, 1);
  ugens_.whole(static_cast<std::int64_t>(inputs.size()));
  ugens_.whole(outputs);
  ugens_.whole(special, 2);
  for (const Wire& wire : inputs) {
    ugens_.whole(wire.ugen);
    ugens_.whole(wire.index);
  }
  for (int k = 0; k < outputs; ++k) ugens_.whole(rate, 1);
  return {count_++, 0};
}

std::string Definition::compiled(const std::string& name) const {
  Packet out;
  out.raw("SCgf");
  out.whole(2);     // version
  out.whole(1, 2);  // definitions
  out.pascal(name);
  out.whole(static_cast<std::int64_t>(constants_.size()));
  for (const float value : constants_) out.real(static_cast<double>(value));
  out.whole(static_cast<std::int64_t>(names_.size()));
  for (std::size_t k = 0; k < names_.size(); ++k) out.whole(0);  // defaults
  out.whole(static_cast<std::int64_t>(names_.size()));
  for (std::size_t k = 0; k < names_.size(); ++k) {
    out.pascal(names_[k]);
    out.whole(static_cast<std::int64_t>(k));
  }
  out.whole(count_);
  out.raw(ugens_.bytes());
  out.whole(0, 2);  // variants
  return out.bytes();
}

void write_bundle(std::ofstream& file, double seconds, const std::string& message) {
  Packet bundle;
  bundle.text("#bundle");
  bundle.whole(static_cast<std::int64_t>(std::llround(seconds * 4294967296.0)), 8);
  bundle.whole(static_cast<std::int64_t>(message.size()));
  Packet size;
  size.whole(static_cast<std::int64_t>(bundle.bytes().size() + message.size()));
  file << size.bytes() << bundle.bytes() << message;
}

void write_definition(std::ofstream& file, const std::string& compiled) {
  Packet definition;
  definition.text("/d_recv");
  definition.text(",b");
  definition.blob(compiled);
  write_bundle(file, 0.0, definition.bytes());
}

void write_end(std::ofstream& file, double seconds) {
  Packet nothing;
  nothing.text("/c_set");
  nothing.text(",ii");
  nothing.whole(0);
  nothing.whole(0);
  write_bundle(file, seconds, nothing.bytes());
}

}  // namespace splash::supercollider
