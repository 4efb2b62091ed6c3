// SPDX-License-Identifier: MIT
// The only file that includes Boost.Beast, which takes long to compile.
#include "view-server/server.hpp"

#include <utility>  // Boost 1.74 forgets it in C++20

#include <algorithm>
#include <array>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <csignal>
#include <deque>
#include <set>
#include <string>

#include "program/failure.hpp"
#include "protocol/control.hpp"
#include "protocol/filling.hpp"
#include "protocol/limits.hpp"
#include "view-server/admission.hpp"
#include "view-server/feed.hpp"
#include "view-server/page.hpp"

namespace splash::view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using asio::ip::udp;
using boost::system::error_code;

constexpr std::size_t kPagesMax = 16;
constexpr std::size_t kQueueMax = 64;     ///< messages that a slow page may have waiting
constexpr std::size_t kSoundAsked = 16;   ///< as many as the synth allows
constexpr int kNotifyEvery = 10;          ///< seconds; the programs forget clients after a minute
constexpr std::size_t kHeaderMax = 8192;  ///< of a request [bytes]
constexpr auto kPatience = std::chrono::seconds(10);

udp::endpoint to_udp(const protocol::Endpoint& endpoint) {
  return {asio::ip::address_v4(endpoint.address), endpoint.port};
}

std::string_view view_of(beast::string_view text) {
  return {text.data(), text.size()};
}

SharedFrame bytes_of(const protocol::Message& message) {
  return std::make_shared<const protocol::ViewFrame>(protocol::encode(message));
}

bool is_state(const protocol::ViewFrame& frame) {
  return frame.size() >= protocol::kFrameHead &&
         protocol::frame_kind(frame.data()) == protocol::kStateFrame;
}

const char* type_of(std::string_view name) {
  if (name.ends_with(".html")) return "text/html; charset=utf-8";
  if (name.ends_with(".css")) return "text/css";
  return "text/javascript";
}

using Request = http::request<http::empty_body>;
using Response = http::response<http::string_body>;

Response answer(const Request& request, http::status status, std::string text, const char* type) {
  Response response(status, request.version());
  response.set(http::field::content_type, type);
  response.set(http::field::cache_control, "no-cache");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("X-Frame-Options", "DENY");
  response.body() = std::move(text);
  response.prepare_payload();
  response.keep_alive(false);
  return response;
}

/// A file of the page.
Response file_for(const Request& request) {
  std::string_view name = view_of(request.target());
  name = name.substr(0, name.find('?'));
  name.remove_prefix(name.starts_with('/') ? 1 : 0);
  if (name.empty()) name = "index.html";
  if (request.method() != http::verb::get) {
    return answer(request, http::status::method_not_allowed, "only GET\n", "text/plain");
  }
  for (const PageFile& file : page_files()) {
    if (file.name == name) {
      return answer(request, http::status::ok, std::string(file.text), type_of(name));
    }
  }
  return answer(request, http::status::not_found, "no such file\n", "text/plain");
}

class Page;

/// What a page may do.
class PageOwner {
 public:
  virtual void heard(Page& page, protocol::Bytes message) = 0;
  virtual void wants_state() = 0;
  virtual void left(const std::shared_ptr<Page>& page) = 0;

 protected:
  ~PageOwner() = default;
};

/// One browser on its WebSocket.
class Page : public std::enable_shared_from_this<Page> {
 public:
  Page(beast::tcp_stream stream, PageOwner& owner) : socket_(std::move(stream)), owner_(owner) {}

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
  void send(const SharedFrame& bytes, bool text = false) {
    if (ended_ || waiting_.size() >= kQueueMax) return;
    waiting_.push_back({bytes, text});
    if (waiting_.size() == 1) write();
  }
  void send_state(const SharedFrame& frame) {
    if (std::exchange(wants_state_, false)) send(frame);
  }
  [[nodiscard]] bool wants_state() const noexcept { return wants_state_; }
  void end() {
    if (std::exchange(ended_, true)) return;
    beast::get_lowest_layer(socket_).close();
    owner_.left(shared_from_this());
  }
  std::set<std::int32_t> grabbed;  ///< bodies

 private:
  struct Waiting {
    SharedFrame bytes;
    bool text = false;
  };

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
      // Nothing is said in words.
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
    socket_.text(next.text);
    socket_.async_write(asio::buffer(*next.bytes),
                        [self = shared_from_this()](const error_code& error, std::size_t) {
                          if (error) return self->end();
                          self->waiting_.pop_front();
                          if (!self->waiting_.empty()) self->write();
                        });
  }

  beast::websocket::stream<beast::tcp_stream> socket_;
  PageOwner& owner_;
  beast::flat_buffer buffer_;
  std::deque<Waiting> waiting_;
  bool wants_state_ = false;
  bool ended_ = false;
};

/// One connection until it has asked for something.
class Visit : public std::enable_shared_from_this<Visit> {
 public:
  using Upgrade = std::function<void(beast::tcp_stream, const Request&)>;
  Visit(tcp::socket socket, const std::vector<std::string>& ours, Upgrade upgrade)
      : stream_(std::move(socket)), ours_(ours), upgrade_(std::move(upgrade)) {
    parser_.header_limit(kHeaderMax);
    parser_.body_limit(0);
  }

  void begin() {
    stream_.expires_after(kPatience);
    http::async_read(stream_, buffer_, parser_,
                     [self = shared_from_this()](const error_code& error, std::size_t) {
                       if (!error) self->serve();
                     });
  }

 private:
  void serve() {
    const Request& request = parser_.get();
    if (!is_own(view_of(request[http::field::host]), view_of(request[http::field::origin]),
                ours_)) {
      return reply(answer(request, http::status::forbidden,
                          "this server speaks only to its own page: reach it by its address, or "
                          "start it with --origin NAME:PORT\n",
                          "text/plain"));
    }
    if (!beast::websocket::is_upgrade(request)) return reply(file_for(request));
    if (request.target() != "/view") {
      return reply(answer(request, http::status::not_found, "it is /view\n", "text/plain"));
    }
    stream_.expires_never();
    upgrade_(std::move(stream_), request);
  }
  void reply(Response response) {
    response_ = std::move(response);
    http::async_write(stream_, response_, [self = shared_from_this()](const error_code&, auto) {
      error_code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  beast::tcp_stream stream_;
  const std::vector<std::string>& ours_;
  Upgrade upgrade_;
  beast::flat_buffer buffer_;
  http::request_parser<http::empty_body> parser_;
  Response response_;
};

tcp::acceptor listen_at(asio::io_context& context, const protocol::Endpoint& where) {
  try {
    return {context, tcp::endpoint(asio::ip::address_v4(where.address), where.port)};
  } catch (const boost::system::system_error& error) {
    throw program::Failure(program::kExitUnavailable,
                           "cannot listen for browsers at " + protocol::to_string(where) + ": " +
                               error.code().message() +
                               "; use --listen host:port with another one, or port 0");
  }
}

/// Where replies of both programs can reach us.
asio::ip::address_v4 talking_address(const Options& options) {
  const bool here = is_loopback(options.sim) && is_loopback(options.synth);
  return here ? asio::ip::address_v4::loopback() : asio::ip::address_v4::any();
}

}  // namespace

class Server::Hub final : public PageOwner {
 public:
  explicit Hub(const Options& options)
      : options_(options),
        signals_(context_, SIGINT, SIGTERM),
        acceptor_(listen_at(context_, options.listen)),
        talk_(context_, udp::endpoint(talking_address(options), 0)),
        ticks_(context_),
        water_(context_, options.sim_show, protocol::kSceneFrame,
               {[this] { note_feed(water_, 1); }, [this](const auto& f) { show(f); }}),
        sound_(context_, options.synth_show, protocol::kRigFrame,
               {[this] { note_feed(sound_, kSoundAsked); }, [this](const auto& f) { hear(f); }}) {
    signals_.async_wait([this](const error_code& error, int) {
      if (!error) context_.stop();
    });
    accept();
    listen_to_programs();
  }

  asio::io_context& context() noexcept { return context_; }
  [[nodiscard]] protocol::Endpoint local() const {
    return {acceptor_.local_endpoint().address().to_v4().to_uint(),
            acceptor_.local_endpoint().port()};
  }

  void heard(Page& page, protocol::Bytes bytes) override {
    const Admitted said = admit(bytes);
    switch (said.way) {
      case Way::refused:
        return page.send(bytes_of(protocol::fail(said.address, said.reason)));
      case Way::here:
        return pong(page, said.message);
      case Way::both:
        say(options_.sim, said.message);
        return say(options_.synth, said.message);
      case Way::synth:
        return say(options_.synth, said.message);
      case Way::sim:
        note_grab(page, said.message);
        return say(options_.sim, said.message);
    }
  }
  void wants_state() override { ask_for_state(); }
  void left(const std::shared_ptr<Page>& page) override {
    if (pages_.erase(page) == 0) return;
    for (const std::int32_t body : page->grabbed) say(options_.sim, {"/body/grab", {body, 0}});
    if (!pages_.empty()) return;
    water_.look(false);
    sound_.look(false);
    for (const auto& program : {options_.sim, options_.synth}) say(program, {"/notify", {0}});
  }

 private:
  void accept() {
    acceptor_.async_accept([this](const error_code& error, tcp::socket socket) {
      if (!error) {
        error_code ignored;  // a browser may be gone again
        socket.set_option(tcp::no_delay(true), ignored);
        std::make_shared<Visit>(
            std::move(socket), options_.origins,
            [this](auto stream, const Request& request) { welcome(std::move(stream), request); })
            ->begin();
      }
      accept();
    });
  }

  void welcome(beast::tcp_stream stream, const Request& request) {
    if (pages_.size() >= kPagesMax) return;
    const auto page = std::make_shared<Page>(std::move(stream), *this);
    page->accept(request, [this, page] {
      const bool first = pages_.empty();
      pages_.insert(page);
      water_.look(true);
      sound_.look(true);
      page->send(presence(), true);
      for (const Feed* feed : {&water_, &sound_}) {
        if (feed->connected()) page->send(feed->greeting());
      }
      if (first) tick(0);
    });
  }

  [[nodiscard]] SharedFrame presence() const {
    const std::string text = std::string(R"({"sim": )") + (water_.connected() ? "true" : "false") +
                             R"(, "synth": )" + (sound_.connected() ? "true" : "false") + "}";
    protocol::ViewFrame bytes(text.size());
    std::transform(text.begin(), text.end(), bytes.begin(),
                   [](char c) { return static_cast<std::byte>(c); });
    return std::make_shared<const protocol::ViewFrame>(std::move(bytes));
  }

  void note_feed(Feed& feed, std::size_t frames) {
    state_asked_ = false;
    for (const auto& page : pages_) page->send(presence(), true);
    if (!feed.connected()) return;
    if (&feed == &sound_) feed.ask(frames);
    subscribe();
  }

  void ask_for_state() {
    const bool wanted = std::any_of(pages_.begin(), pages_.end(),
                                    [](const auto& page) { return page->wants_state(); });
    if (!wanted || state_asked_ || !water_.connected()) return;
    state_asked_ = true;
    water_.ask(1);
  }

  void show(const SharedFrame& frame) {
    if (!is_state(*frame)) {
      for (const auto& page : pages_) page->send(frame);
    } else {
      state_asked_ = false;
      for (const auto& page : pages_) page->send_state(frame);
    }
    ask_for_state();
  }
  void hear(const SharedFrame& frame) {
    for (const auto& page : pages_) page->send(frame);
    if (protocol::frame_kind(frame->data()) != protocol::kRigFrame) sound_.ask(1);
  }

  /// Asks both programs how they are, each second, and for their events.
  void tick(int second) {
    if (pages_.empty()) return;
    if (second % kNotifyEvery == 0) subscribe();
    for (const auto& program : {options_.sim, options_.synth}) say(program, {"/status", {}});
    ticks_.expires_after(std::chrono::seconds(1));
    ticks_.async_wait([this, second](const error_code& error) {
      if (!error) tick(second + 1);
    });
  }
  void subscribe() {
    if (pages_.empty()) return;
    for (const auto& program : {options_.sim, options_.synth}) say(program, {"/notify", {1}});
  }

  /// A question is as long as its answer (protocol/README.md).
  void say(const protocol::Endpoint& program, protocol::Message message) {
    if (message.address == "/status" || message.address == "/notify") {
      message = protocol::filled_up(std::move(message), protocol::kFilledQuestion);
    }
    error_code ignored;  // UDP may lose
    talk_.send_to(asio::buffer(protocol::encode(message)), to_udp(program), 0, ignored);
  }

  void pong(Page& page, const protocol::Message& ping) {
    const auto now = protocol::to_time_tag(protocol::unix_now());
    page.send(
        bytes_of(protocol::pong(std::get<protocol::TimeTag>(ping.arguments.front()), now, now)));
  }

  static void note_grab(Page& page, const protocol::Message& message) {
    if (message.address != "/body/grab") return;
    const auto body = std::get<std::int32_t>(message.arguments[0]);
    if (std::get<std::int32_t>(message.arguments[1]) != 0) {
      page.grabbed.insert(body);
    } else {
      page.grabbed.erase(body);
    }
  }

  void listen_to_programs() {
    talk_.async_receive_from(
        asio::buffer(packet_), from_, [this](const error_code& error, std::size_t size) {
          const auto address = from_.address();
          const bool known = address == to_udp(options_.sim).address() ||
                             address == to_udp(options_.synth).address();
          const protocol::Bytes bytes(packet_.data(), size);
          if (!error && known && protocol::gate(bytes) == protocol::Refusal::none) {
            const auto shared =
                std::make_shared<const protocol::ViewFrame>(bytes.begin(), bytes.end());
            for (const auto& page : pages_) page->send(shared);
          }
          if (error != asio::error::operation_aborted) listen_to_programs();
        });
  }

  Options options_;
  asio::io_context context_{1};
  asio::signal_set signals_;
  tcp::acceptor acceptor_;
  udp::socket talk_;
  asio::steady_timer ticks_;
  std::set<std::shared_ptr<Page>> pages_;
  bool state_asked_ = false;
  std::array<std::byte, protocol::kMaxDatagram + 1> packet_ = {};
  udp::endpoint from_;
  Feed water_;
  Feed sound_;
};

Server::Server(const Options& options) : hub_(std::make_unique<Hub>(options)) {}
Server::~Server() = default;

protocol::Endpoint Server::local() const {
  return hub_->local();
}

void Server::run() {
  hub_->context().run();
}

void Server::stop() {
  hub_->context().stop();
}

}  // namespace splash::view
