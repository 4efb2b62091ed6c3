// SPDX-License-Identifier: MIT
#include "sim-server/show/vtk_files.hpp"

#include <bit>
#include <cerrno>
#include <fstream>
#include <vector>

#include "program/files.hpp"
#include "program/text.hpp"
#include "sim-server/show/state_frame.hpp"

namespace splash::sim {
namespace {

/// Frames end a little before or after the moment that is due [s].
constexpr double kSlack = 1e-6;

program::WriteError cannot_write(const std::filesystem::path& path) {
  return {"cannot write the water to " + path.string(), errno};
}

/// Big endian, as the format asks.
void put(std::string& text, std::uint32_t word) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) text += static_cast<char>(word >> shift & 255U);
}
void put(std::string& text, float value) {
  put(text, std::bit_cast<std::uint32_t>(value));
}

void put_vectors(std::string& text, const ShownWater& water, const std::vector<float>& vectors,
                 const std::vector<std::size_t>& at) {
  for (const std::size_t i : at) {
    for (std::size_t axis = 0; axis < 3; ++axis) put(text, vectors[axis * water.stride + i]);
  }
}

/// Where each particle lies among those that were read, by its id.
std::vector<std::size_t> places_by_id(const ShownWater& water) {
  std::vector<std::size_t> at(water.count);
  for (std::size_t i = 0; i < water.count; ++i) at[static_cast<std::size_t>(water.id[i])] = i;
  return at;
}

void write(const std::filesystem::path& path, const std::string& text) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw cannot_write(path);
}

}  // namespace

std::string vtk_text(const ShownWater& water, double seconds) {
  const std::vector<std::size_t> at = places_by_id(water);
  const std::string count = std::to_string(water.count);
  std::string text = "# vtk DataFile Version 3.0\nsplash: water at " + std::to_string(seconds) +
                     " s\nBINARY\nDATASET POLYDATA\nPOINTS " + count + " float\n";
  put_vectors(text, water, water.position, at);
  text += "\nVERTICES " + count + ' ' + std::to_string(2 * water.count) + '\n';
  for (std::uint32_t i = 0; i < water.count; ++i) {
    put(text, std::uint32_t{1});
    put(text, i);
  }
  text += "\nPOINT_DATA " + count + "\nVECTORS velocity float\n";
  put_vectors(text, water, water.velocity, at);
  text += "\nSCALARS density float 1\nLOOKUP_TABLE default\n";
  for (const std::size_t i : at) put(text, water.density[i]);
  text += "\nSCALARS spray float 1\nLOOKUP_TABLE default\n";
  for (const std::size_t i : at) put(text, water.density[i] < water.least_density ? 1.0F : 0.0F);
  return text + '\n';
}

VtkFiles::VtkFiles(const std::filesystem::path& folder) : folder_(folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  errno = error.value();
  if (error) throw cannot_write(folder);
  write_series();
}

void VtkFiles::note(double seconds, Fluid& fluid) {
  if (seconds < next_ - kSlack) return;
  next_ += kPeriod;
  if (next_ <= seconds) next_ = seconds + kPeriod;  // frames are longer than that
  read_water(fluid, water_);
  const std::string name = program::format("water-%06d.vtk", files_++);
  write(folder_ / name, vtk_text(water_, seconds));
  listed_ += (listed_.empty() ? "" : ",\n") + std::string("  {\"name\": \"") + name +
             "\", \"time\": " + std::to_string(seconds) + "}";
  write_series();
}

void VtkFiles::write_series() {
  write(folder_ / "water.vtk.series",
        "{\"file-series-version\": \"1.0\", \"files\": [\n" + listed_ + "\n]}\n");
}

}  // namespace splash::sim
