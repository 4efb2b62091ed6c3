// SPDX-License-Identifier: MIT
#include "tests/stress/piece.hpp"

#include <fstream>
#include <stdexcept>

namespace splash::stress {
namespace {

template <class Stream, class P>
void numbers(Stream&& each, P& p) {
  each(p.steps);
  each(p.simulated);
  each(p.wall);
  each(p.growth);
  each(p.hours);
  each(p.opened);
  each(p.lost);
  each(p.again);
  each(p.given_up);
  each(p.resets);
  each(p.events);
}

template <class T>
void write_array(std::ofstream& out, const std::vector<T>& array) {
  const std::uint64_t size = array.size();
  out.write(reinterpret_cast<const char*>(&size), sizeof size);
  out.write(reinterpret_cast<const char*>(array.data()),
            static_cast<std::streamsize>(size * sizeof(T)));
}

template <class T>
void read_array(std::ifstream& in, std::vector<T>& array) {
  std::uint64_t size = 0;
  in.read(reinterpret_cast<char*>(&size), sizeof size);
  if (!in || size > 1U << 30U) throw std::runtime_error("a kept piece is cut short");
  array.resize(size);
  in.read(reinterpret_cast<char*>(array.data()), static_cast<std::streamsize>(size * sizeof(T)));
}

}  // namespace

bool read_piece(const std::filesystem::path& file, Piece& piece) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return false;
  numbers([&](auto& value) { in.read(reinterpret_cast<char*>(&value), sizeof value); }, piece);
  read_array(in, piece.water.position);
  read_array(in, piece.water.velocity);
  read_array(in, piece.water.id);
  read_array(in, piece.water.pressure);
  if (!in) throw std::runtime_error(file.string() + " is cut short: delete it to begin anew");
  return true;
}

void write_piece(const std::filesystem::path& file, const Piece& piece) {
  const std::filesystem::path part = file.string() + ".part";
  std::ofstream out(part, std::ios::binary);
  numbers(
      [&](const auto& value) { out.write(reinterpret_cast<const char*>(&value), sizeof value); },
      piece);
  write_array(out, piece.water.position);
  write_array(out, piece.water.velocity);
  write_array(out, piece.water.id);
  write_array(out, piece.water.pressure);
  out.close();
  if (!out) throw std::runtime_error("cannot write " + part.string());
  std::filesystem::rename(part, file);
}

}  // namespace splash::stress
