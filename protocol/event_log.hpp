// SPDX-License-Identifier: MIT
// Event logs: OSC bundles, each behind its size (int32, big-endian). The framing of OSC 1.0
// streams and of scsynth's score files; time tags count seconds from the log's start.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <istream>
#include <vector>

#include "protocol/message.hpp"

namespace splash::protocol {

/// Appends bundles to a log. Throws WriteError when it cannot write. A killed program or a full
/// disk leaves a log of whole bundles behind.
class LogWriter {
 public:
  /// `start`: the time at which the log starts [s], of the clock that append() has.
  explicit LogWriter(const std::filesystem::path& path, double start = 0.0);
  /// `seconds`: the bundle's time [s], never smaller than the last one's nor the start's (it is
  /// raised to it, so that the log is a legal score).
  void append(double seconds, const std::vector<Message>& messages);

 private:
  /// Removes the part of a bundle that was written, and throws.
  [[noreturn]] void give_up();

  std::filesystem::path path_;
  double start_;
  std::ofstream file_;
  double last_seconds_ = 0.0;       ///< from the log's start
  std::uintmax_t whole_bytes_ = 0;  ///< of complete bundles
};

struct LogEntry {
  double seconds = 0.0;  ///< from the log's start
  std::vector<Message> messages;
};

/// A log that speaks of later than this is broken, not long [s].
inline constexpr double kLongestLog = 7.0 * 24.0 * 3600.0;

/// The sample at which an event starts that lies so far behind its bundle's time. Throws
/// program::DataError beyond kLongestLog.
[[nodiscard]] std::int64_t start_sample(double seconds, float offset_ms, double sample_rate);

/// Reads a whole log; every packet passes the gate. Throws program::DataError with the file, the
/// byte offset and the reason.
[[nodiscard]] std::vector<LogEntry> read_log(const std::filesystem::path& path);
/// The same from a stream of `total` bytes; errors name it `path`.
[[nodiscard]] std::vector<LogEntry> read_log(std::istream& file, std::uintmax_t total,
                                             const std::filesystem::path& path);

}  // namespace splash::protocol
