// SPDX-License-Identifier: MIT
// The only file that includes Boost.Beast, which takes long to compile, with the two kinds of
// connection beside it.
#include "view-server/server.hpp"

#include <utility>  // Boost 1.74 forgets it in C++20

#include <algorithm>
#include <array>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/signal_set.hpp>
#include <chrono>
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

#include "program/failure.hpp"
#include "protocol/control.hpp"
#include "protocol/limits.hpp"
#include "protocol/reply_budget.hpp"
#include "protocol/time_tag.hpp"
#include "view-server/admission.hpp"
#include "view-server/feed.hpp"
#include "view-server/holds.hpp"
#include "view-server/page_socket.hpp"
#include "view-server/query.hpp"
#include "view-server/visit.hpp"

namespace splash::view {
namespace {

using asio::ip::udp;

constexpr std::size_t kPagesMax = 16;
/// What the kernel keeps of what a page does not read [bytes].
constexpr int kSendBuffer = 1 << 18;
constexpr std::size_t kListensMax = 1024;  ///< addresses
constexpr std::size_t kSoundAsked = 32;    ///< as many as the synth allows
constexpr int kNotifyEvery = 10;           ///< seconds; the programs forget clients after a minute
/// So long the programs are looked at for one question about the tree, and so soon it is answered.
constexpr auto kInterest = std::chrono::seconds(30);
constexpr auto kSoon = std::chrono::milliseconds(700);
constexpr auto kTurn = std::chrono::milliseconds(100);
constexpr auto kNoRoom = std::chrono::milliseconds(200);  ///< no descriptor is left: wait so long

udp::endpoint to_udp(const protocol::Endpoint& endpoint) {
  return {asio::ip::address_v4(endpoint.address), endpoint.port};
}

SharedFrame bytes_of(const protocol::Message& message) {
  return std::make_shared<const protocol::ViewFrame>(protocol::encode(message));
}

bool is_state(const protocol::ViewFrame& frame) {
  return frame.size() >= protocol::kFrameHead &&
         protocol::frame_kind(frame.data()) == protocol::kStateFrame;
}

/// Behind a frame's head.
std::string_view text_of(const protocol::ViewFrame& frame) {
  const std::size_t head = std::min(protocol::kFrameHead, frame.size());
  return {reinterpret_cast<const char*>(frame.data()) + head, frame.size() - head};
}

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

class Server::Hub final : public PageOwner, public Host {
 public:
  explicit Hub(const Options& options)
      : options_(options),
        signals_(context_, SIGINT, SIGTERM),
        acceptor_(listen_at(context_, options.listen)),
        talk_(context_, udp::endpoint(talking_address(options), 0)),
        ticks_(context_),
        room_(context_),
        turns_(context_),
        interest_(context_),
        osc_(context_),
        water_(context_, options.sim_show, protocol::kSceneFrame,
               {[this] { note_feed(water_); }, [this](const auto& f) { show(f); }}),
        sound_(context_, options.synth_show, protocol::kRigFrame,
               {[this] { note_feed(sound_); }, [this](const auto& f) { hear(f); }}) {
    signals_.async_wait([this](const error_code& error, int) {
      if (!error) context_.stop();
    });
    accept();
    listen_to_programs();
    open_osc();
  }

  asio::io_context& context() noexcept { return context_; }
  [[nodiscard]] protocol::Endpoint local() const {
    return {acceptor_.local_endpoint().address().to_v4().to_uint(),
            acceptor_.local_endpoint().port()};
  }

  void keep_turning(const std::function<void()>& turn) {
    turn();
    turns_.expires_after(kTurn);
    turns_.async_wait([this, turn](const error_code& error) {
      if (!error) keep_turning(turn);
    });
  }

  void heard(Page& page, protocol::Bytes bytes) override {
    if (page.watches()) return carry_out(admit(bytes), &page);
    take_osc(bytes, &page);
  }
  /// {"COMMAND": "LISTEN" or "IGNORE", "DATA": "/synth/impact/q"}
  void told(Page& page, std::string_view text) override {
    const auto said = nlohmann::json::parse(text, nullptr, false);
    if (page.watches() || !said.is_object()) return;
    const auto word = [&said](const char* key) {
      const auto found = said.find(key);
      return found != said.end() && found->is_string() ? found->get<std::string>() : std::string();
    };
    const std::string path = word("DATA");
    if (word("COMMAND") == "IGNORE") page.listens_to.erase(path);
    const bool more = page.listens_to.size() < kListensMax;
    if (word("COMMAND") == "LISTEN" && more) page.listens_to.insert(path);
  }
  void wants_state() override { ask_for_state(); }
  void left(const std::shared_ptr<Page>& page) override {
    if (pages_.erase(page) + listeners_.erase(page) == 0) return;
    for (const std::int32_t body : holds_.of(page.get())) {
      holds_.let_go(body, page.get());
      say(options_.sim, {"/body/grab", {body, 0}});
    }
    tell_presence();
    look();
  }

  void ask(const Target& target, Reply reply) override {
    interested_ = true;
    interest_.expires_after(kInterest);
    interest_.async_wait([this](const error_code& error) {
      if (error) return;
      interested_ = false;
      look();
    });
    look();
    const auto wait = std::make_shared<asio::steady_timer>(context_, looks_since_ + kSoon);
    wait->async_wait([this, wait, path = std::string(target.path),
                      attribute = std::string(target.attribute),
                      reply = std::move(reply)](const error_code& error) {
      if (!error) reply(query(known_, path, attribute, osc_port_));
    });
  }

  void welcome(beast::tcp_stream stream, const Request& request) override {
    if (pages_.size() + listeners_.size() >= kPagesMax) return;
    const bool watches = request.target() == "/view";
    const auto page = std::make_shared<Page>(std::move(stream), *this, watches);
    page->accept(request, [this, page] {
      (page->watches() ? pages_ : listeners_).insert(page);
      look();
      if (page->watches()) greet(*page);
    });
  }

 private:
  /// Whether anybody looks at the programs.
  void look() {
    const bool wanted = interested_ || !pages_.empty() || !listeners_.empty();
    if (wanted == looks_) return;
    looks_ = wanted;
    water_.look(wanted);
    sound_.look(wanted);
    if (wanted) {
      looks_since_ = std::chrono::steady_clock::now();
      tick(0);
    } else {
      known_ = {};
      for (const auto& program : {options_.sim, options_.synth}) say(program, {"/notify", {0}});
    }
  }

  void greet(Page& page) {
    page.send(presence(page), Page::Content::text);
    for (const Feed* feed : {&water_, &sound_}) {
      if (feed->connected()) page.send(feed->greeting());
    }
    for (const auto& [name, value] : changed_) {
      page.send(bytes_of(protocol::value_of(name, static_cast<double>(value))));
    }
    ask_for_sound();
  }

  void carry_out(const Admitted& said, Page* page) {
    switch (said.way) {
      case Way::refused:
        if (page != nullptr) page->send(bytes_of(protocol::fail(said.address, said.reason)));
        return;
      case Way::here:
        if (page != nullptr) pong(*page, said.message);
        return;
      case Way::both:
        say(options_.sim, said.message);
        return say(options_.synth, said.message);
      case Way::synth:
        return say(options_.synth, said.message);
      case Way::sim:
        if (!may_say(said.message, page)) return;
        if (said.made) return send(options_.sim, protocol::encode(*said.made, {said.message}));
        return say(options_.sim, said.message);
    }
  }
  /// In the tree's addresses.
  void take_osc(protocol::Bytes bytes, Page* page) {
    for (const protocol::Message& message : protocol::decode(bytes).packet.messages) {
      if (const auto own = meant(message)) carry_out(admit(protocol::encode(*own)), page);
    }
  }
  /// At the page's port, if nobody else has it.
  void open_osc() {
    const auto where = acceptor_.local_endpoint();
    error_code error;
    osc_.open(udp::v4(), error);
    osc_.bind({where.address(), where.port()}, error);
    if (error) return;
    osc_port_ = where.port();
    listen_for_osc();
  }
  void listen_for_osc() {
    osc_.async_receive(asio::buffer(osc_packet_),
                       [this](const error_code& error, std::size_t size) {
                         if (!error) take_osc(protocol::Bytes(osc_packet_.data(), size), nullptr);
                         if (error != asio::error::operation_aborted) listen_for_osc();
                       });
  }

  void accept() {
    acceptor_.async_accept([this](const error_code& error, tcp::socket socket) {
      if (error) return accept_later();
      error_code ignored;  // a browser may be gone again
      socket.set_option(tcp::no_delay(true), ignored);
      socket.set_option(asio::socket_base::send_buffer_size(kSendBuffer), ignored);
      std::make_shared<Visit>(std::move(socket), options_.origins, *this)->begin();
      accept();
    });
  }
  /// Without a descriptor for it, who waits would be seen again at once, and for ever.
  void accept_later() {
    room_.expires_after(kNoRoom);
    room_.async_wait([this](const error_code& error) {
      if (!error) accept();
    });
  }

  [[nodiscard]] SharedFrame presence(const Page& page) const {
    const std::string text = nlohmann::json({{"sim", water_.connected()},
                                             {"synth", sound_.connected()},
                                             {"held", holds_.of_others(&page)}})
                                 .dump();
    protocol::ViewFrame bytes(text.size());
    std::transform(text.begin(), text.end(), bytes.begin(),
                   [](char c) { return static_cast<std::byte>(c); });
    return std::make_shared<const protocol::ViewFrame>(std::move(bytes));
  }

  void tell_presence() {
    for (const auto& page : pages_) page->send(presence(*page), Page::Content::text);
  }

  void note_feed(const Feed& feed) {
    (&feed == &sound_ ? sound_asked_ : state_asked_) = false;
    tell_presence();
    if (!feed.connected()) return;
    ask_for_sound();
    subscribe();
  }
  /// Only pages hear: who asks for the tree costs the synth nothing.
  void ask_for_sound() {
    if (pages_.empty() || sound_asked_ || !sound_.connected()) return;
    sound_asked_ = true;
    sound_.ask(kSoundAsked);
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
      note_scene(text_of(*frame), known_);
      std::erase_if(changed_, [](const auto& row) { return is_of_scene(row.first); });
      for (const auto& page : pages_) page->send(frame);
    } else {
      state_asked_ = false;
      for (const auto& page : pages_) page->send_state(frame);
    }
    ask_for_state();
  }
  void hear(const SharedFrame& frame) {
    for (const auto& page : pages_) page->send(frame);
    if (protocol::frame_kind(frame->data()) == protocol::kRigFrame) {
      note_rig(text_of(*frame), known_);
      std::erase_if(changed_, [](const auto& row) { return !is_of_scene(row.first); });
    } else if (pages_.empty()) {
      sound_asked_ = false;
    } else {
      sound_.ask(1);
    }
  }

  /// Asks both programs how they are, each second, and for their events.
  void tick(int second) {
    if (!looks_) return;
    if (second % kNotifyEvery == 0) subscribe();
    for (const auto& program : {options_.sim, options_.synth}) say(program, {"/status", {}});
    ticks_.expires_after(std::chrono::seconds(1));
    ticks_.async_wait([this, second](const error_code& error) {
      if (!error) tick(second + 1);
    });
  }
  void subscribe() {
    if (!looks_) return;
    for (const auto& program : {options_.sim, options_.synth}) say(program, {"/notify", {1}});
  }

  /// A question is as long as its answer (protocol/README.md).
  void say(const protocol::Endpoint& program, protocol::Message message) {
    if (message.address == "/status" || message.address == "/notify") {
      message = protocol::filled_up(std::move(message), protocol::kFilledQuestion);
    }
    send(program, protocol::encode(message));
  }
  void send(const protocol::Endpoint& program, const std::vector<std::byte>& packet) {
    error_code ignored;  // UDP may lose
    talk_.send_to(asio::buffer(packet), to_udp(program), 0, ignored);
  }

  void pong(Page& page, const protocol::Message& ping) {
    const auto now = protocol::to_time_tag(protocol::unix_now());
    page.send(
        bytes_of(protocol::pong(std::get<protocol::TimeTag>(ping.arguments.front()), now, now)));
  }

  /// The number of the body that a message names by number or by name; empty: none of the scene's.
  [[nodiscard]] std::optional<std::int32_t> body_of(const protocol::Message& message) const {
    const auto* number = std::get_if<std::int32_t>(&message.arguments[0]);
    if (number != nullptr) return *number;
    const auto& names = known_.bodies;
    const auto found =
        std::find(names.begin(), names.end(), std::get<std::string>(message.arguments[0]));
    if (found == names.end()) return std::nullopt;
    return static_cast<std::int32_t>(found - names.begin());
  }
  /// Not of a body that another visitor holds.
  bool may_say(const protocol::Message& message, Page* page) {
    const bool grab = message.address == "/body/grab";
    if (!grab && message.address != "/body/pose") return true;
    const auto body = body_of(message);
    if (!body) return true;  // the simulator refuses it
    const double now = protocol::monotonic_now();
    if (!grab) return holds_.moves(*body, page, now);
    const bool takes = std::get<std::int32_t>(message.arguments[1]) != 0;
    const bool may = takes ? holds_.take(*body, page, now) : holds_.let_go(*body, page);
    if (!may && page != nullptr) {
      page->send(bytes_of(
          protocol::fail(message.address, "another visitor holds body " + std::to_string(*body))));
    }
    tell_presence();
    return may;
  }

  void listen_to_programs() {
    talk_.async_receive_from(asio::buffer(packet_), from_,
                             [this](const error_code& error, std::size_t size) {
                               const auto address = from_.address();
                               const bool known = address == to_udp(options_.sim).address() ||
                                                  address == to_udp(options_.synth).address();
                               const protocol::Bytes bytes(packet_.data(), size);
                               if (!error && known) pass_on(bytes);
                               if (error != asio::error::operation_aborted) listen_to_programs();
                             });
  }

  /// What a program said, to all who hear it.
  void pass_on(protocol::Bytes bytes) {
    const auto read = protocol::decode(bytes);
    if (read.refusal != protocol::Refusal::none) return;
    const auto shared = std::make_shared<const protocol::ViewFrame>(bytes.begin(), bytes.end());
    for (const auto& page : pages_) page->send(shared);
    for (const protocol::Message& message : read.packet.messages) note(message);
  }
  void note(const protocol::Message& message) {
    if (message.address == "/status.reply" && !message.arguments.empty()) {
      const auto* program = std::get_if<std::string>(&message.arguments.front());
      if (program != nullptr) (*program == "sim-server" ? known_.sim : known_.synth) = message;
    }
    const std::string address = told_as(message);
    if (address.empty()) return;
    protocol::Message told{address, message.arguments};
    if (message.address == "/value") {
      const auto* value = std::get_if<float>(&message.arguments.back());
      if (value == nullptr) return;
      const std::string& name = std::get<std::string>(message.arguments.front());
      known_.values[name] = static_cast<double>(*value);
      changed_[name] = *value;
      told.arguments = {*value};
    }
    for (const auto& page : listeners_) {
      if (page->listens_to.contains(address)) page->send(bytes_of(told));
    }
  }

  Options options_;
  asio::io_context context_{1};
  asio::signal_set signals_;
  tcp::acceptor acceptor_;
  udp::socket talk_;
  asio::steady_timer ticks_;
  asio::steady_timer room_;
  asio::steady_timer turns_;
  asio::steady_timer interest_;
  udp::socket osc_;
  int osc_port_ = 0;  ///< 0: none
  std::array<std::byte, protocol::kMaxDatagram + 1> osc_packet_ = {};
  std::set<std::shared_ptr<Page>> pages_;
  std::set<std::shared_ptr<Page>> listeners_;
  bool interested_ = false;  ///< somebody asked for the tree
  bool looks_ = false;       ///< at the programs
  std::chrono::steady_clock::time_point looks_since_ = {};
  Known known_;
  Holds holds_;
  std::map<std::string, float> changed_;  ///< numbers of rig and scene since their frames
  bool state_asked_ = false;
  bool sound_asked_ = false;
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

void Server::run(const std::function<void()>& turn) {
  if (turn) hub_->keep_turning(turn);
  hub_->context().run();
}

void Server::stop() {
  hub_->context().stop();
}

}  // namespace splash::view
