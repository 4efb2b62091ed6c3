// SPDX-License-Identifier: MIT
// One browser, or another client, on its WebSocket.
#pragma once

#include <utility>  // Boost 1.74 forgets it in C++20

#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>

#include "protocol/limits.hpp"
#include "protocol/message.hpp"
#include "view-server/feed.hpp"
#include "view-server/visit.hpp"

namespace splash::view {

inline constexpr std::size_t kQueueMax = 64;  ///< messages that a slow page may have waiting

class Page;

/// What a page may do.
class PageOwner {
 public:
  virtual void heard(Page& page, protocol::Bytes message) = 0;
  virtual void told(Page& page, std::string_view text) = 0;
  virtual void wants_state() = 0;
  virtual void left(const std::shared_ptr<Page>& page) = 0;

 protected:
  ~PageOwner() = default;
};

class Page : public std::enable_shared_from_this<Page> {
 public:
  /// What waits to be sent; of states never more than one.
  enum class Content { bytes, text, state };

  /// `watches`: it gets frames; else it speaks in the tree's addresses.
  Page(beast::tcp_stream stream, PageOwner& owner, bool watches)
      : socket_(std::move(stream)), owner_(owner), watches_(watches) {}

  void accept(const Request& request, std::function<void()> accepted) {
    socket_.set_option(beast::websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.read_message_max(protocol::kMaxDatagram);
    socket_.auto_fragment(false);
    socket_.async_accept(request, [self = shared_from_this(),
                                   accepted = std::move(accepted)](const error_code& error) {
      if (error) return self->end();
      accepted();
      self->read();
    });
  }
  /// A page that does not take what it got loses this.
  void send(const SharedFrame& bytes, Content content = Content::bytes) {
    if (waiting_.size() < kQueueMax) put(bytes, content);
  }
  /// However much waits: a page asks for the next one when it has got this.
  void send_state(const SharedFrame& frame) {
    if (!wants_state()) return;
    wants_state_ = false;
    state_waits_ = true;
    put(frame, Content::state);
  }
  [[nodiscard]] bool watches() const noexcept { return watches_; }
  /// It asked, and what it asked for before is on its way.
  [[nodiscard]] bool wants_state() const noexcept { return wants_state_ && !state_waits_; }
  void end() {
    if (std::exchange(ended_, true)) return;
    beast::get_lowest_layer(socket_).close();
    owner_.left(shared_from_this());
  }
  std::set<std::string> listens_to = {};  ///< addresses of the tree

 private:
  struct Waiting {
    SharedFrame bytes;
    Content content = Content::bytes;
  };

  void put(const SharedFrame& bytes, Content content) {
    if (ended_) return;
    waiting_.push_back({bytes, content});
    if (waiting_.size() == 1) write();
  }
  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](const error_code& error, std::size_t) {
      if (error) return self->end();
      self->take();
      self->read();
    });
  }
  void take() {
    const auto data = buffer_.data();
    if (socket_.got_text()) {
      owner_.told(*this, {static_cast<const char*>(data.data()), data.size()});
    } else if (data.size() == 0) {
      wants_state_ = true;
      owner_.wants_state();
    } else {
      owner_.heard(*this, {static_cast<const std::byte*>(data.data()), data.size()});
    }
    buffer_.consume(buffer_.size());
  }
  void write() {
    const Waiting& next = waiting_.front();
    socket_.text(next.content == Content::text);
    socket_.async_write(asio::buffer(*next.bytes),
                        [self = shared_from_this()](const error_code& error, std::size_t) {
                          if (error) return self->end();
                          self->written();
                        });
  }

  void written() {
    if (waiting_.front().content == Content::state) {
      state_waits_ = false;
      if (wants_state_) owner_.wants_state();
    }
    waiting_.pop_front();
    if (!waiting_.empty()) write();
  }

  beast::websocket::stream<beast::tcp_stream> socket_;
  PageOwner& owner_;
  bool watches_;
  beast::flat_buffer buffer_;
  std::deque<Waiting> waiting_;
  bool wants_state_ = false;
  bool state_waits_ = false;
  bool ended_ = false;
};

}  // namespace splash::view
