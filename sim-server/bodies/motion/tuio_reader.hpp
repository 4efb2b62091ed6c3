// SPDX-License-Identifier: MIT
// TUIO 1.1 (Kaltenbrunner et al. 2005, tuio.org): which cursors, objects and blobs are on a surface
// now. A sender says a whole frame in one bundle: source, who is alive, what of it changed, and the
// frame's number. So a lost frame is mended by the next ones, which name all that live.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "protocol/message.hpp"

namespace splash::sim {

/// One that lives.
struct TuioCursor {
  double x = 0.0;                    ///< of the surface's width, from its left edge [1]
  double y = 0.0;                    ///< of its depth, from its upper edge [1]
  std::optional<double> angle = {};  ///< of objects and blobs [rad]
};

/// All of a source that live, by their session numbers.
struct TuioFrame {
  std::string address;  ///< /tuio/2Dcur, /tuio/2Dobj or /tuio/2Dblb
  std::string source;   ///< what the sender calls itself, may be empty
  std::map<std::int32_t, TuioCursor> cursors;
};

/// Returns whether a message counts that the TUIO source `source` sent to the OSC address
/// `address`; called for each message. An empty function lets all messages count.
using LetSource = std::function<bool(const std::string& address, const std::string& source)>;

/// True for the addresses above.
[[nodiscard]] bool is_tuio(const std::string& address) noexcept;

class TuioReader {
 public:
  /// A message at one of the addresses, in the order of its bundle, at `arrival` [s]. What lives,
  /// once a frame is complete and no older than the one before.
  std::optional<TuioFrame> take(const protocol::Message& message, double arrival,
                                const LetSource& lets = {});

 private:
  struct Source {
    std::int32_t last = -1;  ///< number of its newest frame
    double arrival = 0.0;    ///< of that [s]
    TuioFrame frame;         ///< as of that
    std::vector<std::int32_t> alive = {};
    std::map<std::int32_t, TuioCursor> changed = {};
  };

  [[nodiscard]] Source* open(const std::string& address, double arrival);
  static void change(Source& source, const protocol::Message& message);

  std::map<std::string, std::string> speaking_;  ///< by address, the source of the open bundle
  std::map<std::pair<std::string, std::string>, Source> sources_;
};

}  // namespace splash::sim
