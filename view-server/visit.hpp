// SPDX-License-Identifier: MIT
// A connection until it has asked for something: a file of the page, what OSCQuery tells, or a
// WebSocket.
#pragma once

#include <utility>  // Boost 1.74 forgets it in C++20

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "view-server/admission.hpp"
#include "view-server/page.hpp"
#include "view-server/query.hpp"

namespace splash::view {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using boost::system::error_code;

inline constexpr std::size_t kHeaderMax = 8192;  ///< of a request [bytes]
inline constexpr auto kTimeout = std::chrono::seconds(10);
/// All that the page needs comes from this server; pictures and films are saved from memory.
inline constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
    "img-src data: blob:; media-src blob:; worker-src 'self'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'";

inline std::string_view view_of(beast::string_view text) {
  return {text.data(), text.size()};
}

inline const char* type_of(std::string_view name) {
  if (name.ends_with(".html")) return "text/html; charset=utf-8";
  if (name.ends_with(".css")) return "text/css";
  return "text/javascript";
}

using Request = http::request<http::empty_body>;
using Response = http::response<http::string_body>;

inline Response answer(const Request& request, http::status status, std::string text,
                       const char* type) {
  Response response(status, request.version());
  response.set(http::field::content_type, type);
  response.set(http::field::cache_control, "no-cache");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("X-Frame-Options", "DENY");
  response.set("Content-Security-Policy", kPolicy);
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set("Permissions-Policy", "camera=(), microphone=(), geolocation=()");
  response.body() = std::move(text);
  response.prepare_payload();
  response.keep_alive(false);
  return response;
}

/// What is asked for: /synth/impact?VALUE is the attribute VALUE of the path /synth/impact.
struct Target {
  std::string_view path;
  std::string_view attribute;
};

inline Target target_of(const Request& request) {
  const std::string_view all = view_of(request.target());
  const std::size_t mark = std::min(all.find('?'), all.size());
  return {all.substr(0, mark), all.substr(std::min(mark + 1, all.size()))};
}

/// People get the page at /, what asks for no HTML the tree.
inline bool asks_for_tree(const Request& request) {
  const auto [path, attribute] = target_of(request);
  const bool html = view_of(request[http::field::accept]).find("text/html") != std::string::npos;
  const auto below = [path = path](std::string_view top) {
    return path == top || path.starts_with(std::string(top) + '/');
  };
  return attribute == "HOST_INFO" || (path == "/" && !html) || below("/sim") || below("/synth");
}

/// A file of the page.
inline Response file_for(const Request& request) {
  std::string_view name = target_of(request).path;
  name.remove_prefix(name.starts_with('/') ? 1 : 0);
  if (name.empty()) name = "index.html";
  for (const PageFile& file : page_files()) {
    if (file.name == name) {
      return answer(request, http::status::ok, std::string(file.text), type_of(name));
    }
  }
  return answer(request, http::status::not_found, "no such file\n", "text/plain");
}

/// Who knows what a visit asks for.
class Host {
 public:
  using Reply = std::function<void(const Answer&)>;
  /// Answers now or a little later.
  virtual void ask(const Target& target, Reply reply) = 0;
  /// A browser at /view, or another client at /.
  virtual void welcome(beast::tcp_stream stream, const Request& request) = 0;

 protected:
  ~Host() = default;
};

class Visit : public std::enable_shared_from_this<Visit> {
 public:
  Visit(tcp::socket socket, const std::vector<std::string>& ours, Host& host)
      : stream_(std::move(socket)), ours_(ours), host_(host) {
    parser_.header_limit(kHeaderMax);
    parser_.body_limit(0);
  }

  void begin() {
    stream_.expires_after(kTimeout);
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
    if (beast::websocket::is_upgrade(request)) return upgrade(request);
    if (request.method() != http::verb::get) {
      return reply(answer(request, http::status::method_not_allowed, "only GET\n", "text/plain"));
    }
    if (!asks_for_tree(request)) return reply(file_for(request));
    stream_.expires_never();  // until the programs have told what they know
    host_.ask(target_of(request), [self = shared_from_this()](const Answer& answered) {
      self->stream_.expires_after(kTimeout);
      const auto status = static_cast<http::status>(answered.status);
      self->reply(answer(self->parser_.get(), status, answered.json, "application/json"));
    });
  }
  void upgrade(const Request& request) {
    if (request.target() != "/view" && request.target() != "/") {
      return reply(answer(request, http::status::not_found, "it is /view\n", "text/plain"));
    }
    stream_.expires_never();
    host_.welcome(std::move(stream_), request);
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
  Host& host_;
  beast::flat_buffer buffer_;
  http::request_parser<http::empty_body> parser_;
  Response response_;
};

}  // namespace splash::view
