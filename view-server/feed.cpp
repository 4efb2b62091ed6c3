// SPDX-License-Identifier: MIT
#include "view-server/feed.hpp"

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/read.hpp>
#include <chrono>

namespace splash::view {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

constexpr auto kRetry = std::chrono::milliseconds(500);

asio::ip::tcp::endpoint to_tcp(const protocol::Endpoint& endpoint) {
  return {asio::ip::address_v4(endpoint.address), endpoint.port};
}

}  // namespace

Feed::Feed(asio::io_context& context, const protocol::Endpoint& where, std::string_view greeting,
           Actions actions)
    : where_(to_tcp(where)),
      greeting_kind_(greeting),
      actions_(std::move(actions)),
      socket_(context),
      timer_(context) {}

void Feed::look(bool looked_at) {
  if (looked_at == looked_at_) return;
  looked_at_ = looked_at;
  if (looked_at) {
    connect();
  } else {
    close();
  }
}

void Feed::close() {
  ++connection_;
  error_code ignored;
  socket_.close(ignored);
  timer_.cancel(ignored);
  if (std::exchange(greeting_, nullptr) != nullptr) actions_.changed();
}

void Feed::connect() {
  const std::uint64_t mine = ++connection_;
  socket_.async_connect(where_, [this, mine](const error_code& error) {
    if (mine != connection_) return;
    if (error) return retry();
    error_code ignored;
    socket_.set_option(asio::ip::tcp::no_delay(true), ignored);
    read_head();
  });
}

void Feed::retry() {
  close();
  if (!looked_at_) return;
  const std::uint64_t mine = connection_;
  timer_.expires_after(kRetry);
  timer_.async_wait([this, mine](const error_code& error) {
    if (!error && mine == connection_) connect();
  });
}

void Feed::read_head() {
  frame_.resize(protocol::kFrameHead);
  const std::uint64_t mine = connection_;
  asio::async_read(socket_, asio::buffer(frame_), [this, mine](const error_code& error, auto) {
    if (mine != connection_) return;
    const auto size = error ? 0 : protocol::frame_number<std::uint32_t>(&frame_[4]);
    if (size < protocol::kFrameHead || size > protocol::kLargestFrame) return retry();
    frame_.resize(size);
    read_rest();
  });
}

void Feed::read_rest() {
  const std::uint64_t mine = connection_;
  const auto rest = asio::buffer(frame_) + protocol::kFrameHead;
  asio::async_read(socket_, rest, [this, mine](const error_code& error, auto) {
    if (mine != connection_) return;
    if (error) return retry();
    const auto frame = std::make_shared<const protocol::ViewFrame>(std::move(frame_));
    frame_ = {};
    if (protocol::frame_kind(frame->data()) == greeting_kind_) {
      greeting_ = frame;
      actions_.changed();
    }
    actions_.arrived(frame);
    if (mine == connection_) read_head();
  });
}

void Feed::ask(std::size_t frames) {
  static constexpr std::array<char, 16> kBytes = {};
  if (!connected()) return;
  error_code ignored;  // so few bytes fit, or the connection is gone, which the reader learns
  socket_.write_some(asio::buffer(kBytes, frames), ignored);
}

}  // namespace splash::view
