// SPDX-License-Identifier: MIT
// Size, bundle, size, bundle, ... to the end of the file.
#include "protocol/event_log.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <string>

#include "program/failure.hpp"
#include "program/files.hpp"
#include "protocol/limits.hpp"

namespace splash::protocol {
namespace {

// Hours of dense events; a file beyond it is not a log of ours and would fill the memory.
constexpr std::uintmax_t kMaxLogBytes = std::uintmax_t{256} << 20U;
constexpr std::uint32_t kBundleHead = 16;

std::string cannot(const std::string& what, const std::filesystem::path& path) {
  return "cannot " + what + " event log '" + path.string() + "'";
}

program::DataError unreadable(const std::filesystem::path& path, const std::string& why) {
  return program::DataError(cannot("read", path) + ": " + why);
}

[[noreturn]] void refuse(const std::filesystem::path& path, std::uintmax_t offset,
                         const std::string& reason) {
  throw program::DataError("event log '" + path.string() + "', byte " + std::to_string(offset) +
                           ": " + reason);
}

/// How to keep what comes before the damage.
std::string whole_part(const std::filesystem::path& path, std::uintmax_t offset) {
  if (offset == 0) return {};
  return "; 'head -c " + std::to_string(offset) + " " + path.string() +
         " > whole.osc' keeps what is whole";
}

std::uint32_t read_u32(const std::array<char, 4>& bytes) {
  std::uint32_t value = 0;
  for (const char byte : bytes) value = value << 8U | static_cast<unsigned char>(byte);
  return value;
}

LogEntry to_entry(const std::filesystem::path& path, std::uintmax_t offset, Bytes bundle) {
  auto decoded = decode(bundle);
  if (decoded.refusal != Refusal::none) {
    refuse(path, offset, "the packet is refused: " + std::string(describe(decoded.refusal)));
  }
  if (!decoded.packet.time) refuse(path, offset, "a bare message, expected a bundle");
  return {to_score_seconds(*decoded.packet.time), std::move(decoded.packet.messages)};
}

std::uint32_t read_size(const std::filesystem::path& path, std::uintmax_t offset,
                        std::uintmax_t left, std::istream& file) {
  std::array<char, 4> bytes{};
  if (left < bytes.size() || !file.read(bytes.data(), bytes.size())) {
    refuse(path, offset, "the file ends inside a packet's size" + whole_part(path, offset));
  }
  const std::uint32_t size = read_u32(bytes);
  if (size < kBundleHead || size % 4 != 0 || size > kMaxDatagram) {
    refuse(path, offset,
           "packet size " + std::to_string(size) + ", expected a multiple of 4 in " +
               std::to_string(kBundleHead) + ".." + std::to_string(kMaxDatagram) +
               (offset == 0 ? "; this is no event log (sim-server --record writes them)"
                            : whole_part(path, offset)));
  }
  if (size > left - bytes.size()) {
    refuse(path, offset,
           "the file ends inside a packet: it has " + std::to_string(size) + " bytes, " +
               std::to_string(left - bytes.size()) + " are left" + whole_part(path, offset));
  }
  return size;
}

}  // namespace

LogWriter::LogWriter(const std::filesystem::path& path, double start) : path_(path), start_(start) {
  errno = 0;
  file_.open(path, std::ios::binary | std::ios::trunc);
  if (!file_) throw program::WriteError(cannot("create", path_), errno);
}

void LogWriter::append(double seconds, const std::vector<Message>& messages) {
  // In this order NaN keeps the last time.
  const double time = std::max(last_seconds_, seconds - start_);
  const auto packet = encode(to_score_tag(time), messages);
  last_seconds_ = time;
  std::array<char, 4> size{};
  for (std::size_t i = 0; i < size.size(); ++i) {
    size[i] = static_cast<char>(packet.size() >> (8U * (3U - i)) & 0xffU);
  }
  errno = 0;
  file_.write(size.data(), size.size());
  file_.write(reinterpret_cast<const char*>(packet.data()),
              static_cast<std::streamsize>(packet.size()));
  if (!file_.flush()) give_up();
  whole_bytes_ += size.size() + packet.size();
}

void LogWriter::give_up() {
  const program::WriteError error(cannot("write", path_), errno);
  file_.close();
  std::error_code ignored;  // a device cannot be cut, and the first error is the one to tell
  if (std::filesystem::is_regular_file(path_, ignored)) {
    std::filesystem::resize_file(path_, whole_bytes_, ignored);
  }
  throw error;
}

std::int64_t start_sample(double seconds, float offset_ms, double sample_rate) {
  const double start = seconds + static_cast<double>(offset_ms) * 1e-3;
  if (!(start <= kLongestLog)) {
    throw program::DataError("event log: an event at " + std::to_string(start) +
                             " s; a log may last 7 days");
  }
  return std::max<std::int64_t>(0, std::llround(start * sample_rate));
}

std::vector<LogEntry> read_log(const std::filesystem::path& path) {
  errno = 0;
  std::error_code error;
  const auto total = std::filesystem::file_size(path, error);
  if (error) throw unreadable(path, error.message());
  std::ifstream file(path, std::ios::binary);
  if (!file) throw unreadable(path, program::write_error(errno));
  return read_log(file, total, path);
}

std::vector<LogEntry> read_log(std::istream& file, std::uintmax_t total,
                               const std::filesystem::path& path) {
  if (total > kMaxLogBytes) {
    refuse(path, 0,
           "the file has " + std::to_string(total) + " bytes, at most " +
               std::to_string(kMaxLogBytes) + " are read");
  }
  std::vector<LogEntry> entries;
  std::array<std::byte, kMaxDatagram> packet{};
  for (std::uintmax_t offset = 0; offset < total;) {
    const auto size = read_size(path, offset, total - offset, file);
    if (!file.read(reinterpret_cast<char*>(packet.data()), size))
      throw unreadable(path, program::write_error(errno));
    auto entry = to_entry(path, offset, Bytes(packet).first(size));
    if (!entries.empty() && entry.seconds < entries.back().seconds) {
      refuse(path, offset,
             "its time " + std::to_string(entry.seconds) + " s lies before the " +
                 std::to_string(entries.back().seconds) + " s of the packet before");
    }
    entries.push_back(std::move(entry));
    offset += 4 + size;
  }
  return entries;
}

}  // namespace splash::protocol
