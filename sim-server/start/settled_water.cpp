// SPDX-License-Identifier: MIT
// The file: a mark with its version, a Header, the buffers of Fluid::state() one behind the other,
// each behind its size in bytes. Numbers are as this machine has them: the key is of its program.
#include "sim-server/start/settled_water.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "program/failure.hpp"
#include "program/files.hpp"
#include "program/this_program.hpp"
#include "sim-server/fluid/boundary/boundary.hpp"
#include "sim-server/fluid/params/parts.hpp"
#include "sim-server/fluid/set_up.hpp"
#include "sim-server/scene/step_policy.hpp"
#include "sim-server/start/come_to_rest.hpp"

namespace splash::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = "splash settled water 1\n";

struct Header {
  std::uint64_t key = 0;
  std::uint64_t sum = 0;   ///< of all that follows
  std::uint64_t size = 0;  ///< of all that follows [B]
};

/// FNV-1a (Fowler, Noll, Vo), against accidents, not against enemies.
class Sum {
 public:
  void add(std::string_view bytes) noexcept {
    for (const char byte : bytes) {
      sum_ = (sum_ ^ static_cast<unsigned char>(byte)) * 1099511628211ULL;
    }
  }
  /// Of a type without padding.
  template <class T>
  void add(const T& value) noexcept {
    add(std::string_view(reinterpret_cast<const char*>(&value), sizeof value));
  }
  template <class T>
  void add_all(const std::vector<T>& values) noexcept {
    add(values.size());
    for (const T& value : values) add(value);
  }
  [[nodiscard]] std::uint64_t value() const noexcept { return sum_; }

 private:
  std::uint64_t sum_ = 14695981039346656037ULL;
};

std::uint64_t sum_of(std::string_view bytes) {
  Sum sum;
  sum.add(bytes);
  return sum.value();
}

/// What computes the water: this build of the program and its kernels, on this device.
void add_program(Sum& sum, const Device& device) {
  const fs::path program = program::this_program();
  std::error_code unknown;
  sum.add(fs::file_size(program, unknown));
  sum.add(fs::last_write_time(program, unknown).time_since_epoch().count());
  for (const auto& sources : {kernels::fluid(), kernels::grid_projected()}) {
    for (const KernelSource& source : sources) sum.add(std::string_view(source.text));
  }
  const DeviceFacts& facts = device.facts();
  for (const std::string& part : {facts.platform, facts.name, facts.driver}) {
    sum.add(std::string_view(part));
  }
  sum.add(device.lanes());
}

std::vector<char> bytes_of(Device& device, const cl::Buffer& buffer) {
  std::vector<char> bytes(buffer.getInfo<CL_MEM_SIZE>());
  device.queue().enqueueReadBuffer(buffer, CL_TRUE, 0, bytes.size(), bytes.data());
  return bytes;
}

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
  throw program::DataError("--settled " + path.string() + ": " + what +
                           "; nothing of it is changed: name another file, or remove this one");
}

/// All of the file behind the mark and the header, looked at; nullopt: of another key.
std::optional<std::string> body_of(const fs::path& path, std::uint64_t key) {
  program::require_readable("--settled", path);
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!text.starts_with(kMark)) refuse(path, "this is no settled water, or of another version");
  Header header;
  if (text.size() < kMark.size() + sizeof header) refuse(path, "the file ends too early");
  std::memcpy(&header, text.data() + kMark.size(), sizeof header);
  std::string body = text.substr(kMark.size() + sizeof header);
  if (body.size() < header.size) refuse(path, "the file ends too early");
  if (body.size() != header.size || sum_of(body) != header.sum) refuse(path, "it is damaged");
  if (header.key != key) return std::nullopt;
  return body;
}

/// What a buffer of the state holds, by its place there: the third has ids, all others floats.
bool is_sound(std::size_t place, const std::vector<char>& bytes, int particles) {
  if (place == 2) {
    std::vector<int> ids(static_cast<std::size_t>(particles));
    if (bytes.size() < ids.size() * sizeof(int)) return false;
    std::memcpy(ids.data(), bytes.data(), ids.size() * sizeof(int));
    std::sort(ids.begin(), ids.end());
    for (int id = 0; id < particles; ++id) {
      if (ids[static_cast<std::size_t>(id)] != id) return false;
    }
    return true;
  }
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
  return std::all_of(values.begin(), values.end(), [](float x) { return std::isfinite(x); });
}

/// A sum over all that the water at rest depends on: program and kernels, device, the fluid's
/// numbers, its particles and bodies before it settles.
std::uint64_t key_of(Fluid& fluid, const Scene& scene, const Bodies& bodies,
                     const std::vector<SupportState>& support_states) {
  Sum sum;
  add_program(sum, fluid.device());
  sum.add(fluid.params());
  sum.add(StepPolicy(scene.fluid).factor());
  sum.add(bodies.fastest(0.0));
  sum.add(scene.seed);
  sum.add(scene.gate.present ? scene.gate.x : std::nan(""));
  sum.add(piston_at(scene.wave_maker, 0.0).offset);
  sum.add_all(support_states);
  const Outlines outlines = body_outlines(scene.bodies);
  sum.add_all(outlines.shapes);
  sum.add_all(outlines.meshes);
  sum.add_all(bodies.at(0.0));
  for (const BodyPoint& point : bodies.points()) {
    sum.add(point.place);
    sum.add(point.owner);
  }
  const Snapshot before = fluid.snapshot();
  sum.add_all(before.position);
  sum.add_all(before.id);
  return sum.value();
}

/// Puts the water of the file into `fluid`; false: none of this key is there, nothing has changed.
bool take_up(const fs::path& path, std::uint64_t key, Fluid& fluid) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return false;
  const std::optional<std::string> body = body_of(path, key);
  if (!body) return false;
  const std::vector<cl::Buffer> state = fluid.state();
  std::vector<std::vector<char>> all;
  std::size_t at = 0;
  for (const cl::Buffer& buffer : state) {
    std::uint64_t size = 0;
    if (body->size() - at < sizeof size) refuse(path, "the file ends too early");
    std::memcpy(&size, body->data() + at, sizeof size);
    at += sizeof size;
    if (size != buffer.getInfo<CL_MEM_SIZE>() || body->size() - at < size) {
      refuse(path, "its water is of another size");
    }
    const char* const first = body->data() + at;
    all.emplace_back(first, first + size);
    if (!is_sound(all.size() - 1, all.back(), fluid.params().count)) {
      refuse(path, "its numbers are none of water");
    }
    at += size;
  }
  if (at != body->size()) refuse(path, "the file is too long");
  for (std::size_t k = 0; k < state.size(); ++k) {
    fluid.device().queue().enqueueWriteBuffer(state[k], CL_TRUE, 0, all[k].size(), all[k].data());
  }
  return true;
}

void keep(const fs::path& path, std::uint64_t key, Fluid& fluid) {
  std::string text(kMark);
  text.resize(kMark.size() + sizeof(Header));
  for (const cl::Buffer& buffer : fluid.state()) {
    const std::vector<char> bytes = bytes_of(fluid.device(), buffer);
    const std::uint64_t size = bytes.size();
    text.append(reinterpret_cast<const char*>(&size), sizeof size);
    text.append(bytes.begin(), bytes.end());
  }
  const std::string_view body = std::string_view(text).substr(kMark.size() + sizeof(Header));
  const Header header = {key, sum_of(body), body.size()};
  std::memcpy(text.data() + kMark.size(), &header, sizeof header);
  program::write_file(path, text, "cannot write the settled water '" + path.string() + "'");
}

}  // namespace

bool rest_from_file(const fs::path& file, Fluid& fluid, const Scene& scene, const Bodies& bodies,
                    const std::vector<SupportState>& support_states, const Progress& tell) {
  const std::uint64_t key = key_of(fluid, scene, bodies, support_states);
  if (take_up(file, key, fluid)) return true;
  come_to_rest(fluid, scene, bodies, support_states, tell);
  keep(file, key, fluid);
  return false;
}

}  // namespace splash::sim
