// SPDX-License-Identifier: MIT
// Frames of one of the programs over TCP (protocol/frame_stream.hpp): connected while a viewer
// looks, and again when the program comes back.
#pragma once

#include <utility>  // Boost 1.74 forgets it in C++20

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "protocol/frame.hpp"
#include "protocol/udp_socket.hpp"

namespace splash::view {

using SharedFrame = std::shared_ptr<const protocol::ViewFrame>;

class Feed {
 public:
  struct Actions {
    std::function<void()> changed;                    ///< connected() did
    std::function<void(const SharedFrame&)> arrived;  ///< a frame, whole
  };
  /// `greeting`: kind of the program's first frame.
  Feed(boost::asio::io_context& context, const protocol::Endpoint& where, std::string_view greeting,
       Actions actions);

  /// Whether any viewer looks.
  void look(bool looked_at);
  /// Asks for so many frames.
  void ask(std::size_t frames);
  [[nodiscard]] bool connected() const noexcept { return greeting_ != nullptr; }
  /// The first frame of this connection; null while there is none.
  [[nodiscard]] const SharedFrame& greeting() const noexcept { return greeting_; }

 private:
  void connect();
  void read_head();
  void read_rest();
  void retry();
  void close();

  boost::asio::ip::tcp::endpoint where_;
  std::string_view greeting_kind_;
  Actions actions_;
  boost::asio::ip::tcp::socket socket_;
  boost::asio::steady_timer timer_;
  bool looked_at_ = false;
  std::uint64_t connection_ = 0;  ///< counts: what an earlier one still says is not heard
  SharedFrame greeting_;
  protocol::ViewFrame frame_;
};

}  // namespace splash::view
