// SPDX-License-Identifier: MIT
#include "program/service_notice.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>

namespace splash::program {
namespace {

/// sd_watchdog_enabled(3) asks for half the period; twice that forgives a late turn.
constexpr double kSignsPerPeriod = 4.0;

/// A start may take so long [s].
constexpr double kStart = 600.0;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

std::optional<long long> number(const std::string& text) {
  long long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// [s]; 0 when nobody watches this process.
double watchdog_period(const std::string& period, const std::string& watched) {
  const auto microseconds = number(period);
  if (!watched.empty() && number(watched) != getpid()) return 0.0;
  return microseconds ? std::max(1e-6 * static_cast<double>(*microseconds), 0.0) : 0.0;
}

std::string watchdog_text(double seconds) {
  return "WATCHDOG_USEC=" + std::to_string(std::llround(1e6 * seconds));
}

/// Monotonic clock now [s].
double now() {
  using std::chrono::duration;
  return duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

ServiceNotice::ServiceNotice() {
  for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) {
    taken_.push_back({name, variable(name)});
    unsetenv(name);
  }
  address_ = taken_[0].value;
  period_ = watchdog_period(taken_[1].value, taken_[2].value) / kSignsPerPeriod;
  if (address_.empty()) return;
  if (address_.front() == '@') address_.front() = '\0';
  socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
}

ServiceNotice::~ServiceNotice() {
  if (socket_ >= 0) close(socket_);
}

void ServiceNotice::starting(double seconds) {
  send("EXTEND_TIMEOUT_USEC=" + std::to_string(std::llround(1e6 * seconds)));
}

void ServiceNotice::ready(const std::string& status) {
  if (period_ > 0.0) send(watchdog_text(kSignsPerPeriod * period_));
  send("READY=1\nSTATUS=" + status);
}

bool ServiceNotice::is_due() const {
  return period_ > 0.0 && now() >= next_;
}

void ServiceNotice::alive() {
  next_ = now() + period_;
  send("WATCHDOG=1");
}

void ServiceNotice::stopping() {
  send("STOPPING=1");
}

void ServiceNotice::beginning_anew() {
  if (period_ > 0.0) send(watchdog_text(kStart));
  for (const auto& [name, value] : taken_) {
    if (!value.empty()) setenv(name, value.c_str(), 1);
  }
}

void ServiceNotice::send(const std::string& text) const {
  sockaddr_un to{};
  if (socket_ < 0) return;
  to.sun_family = AF_UNIX;
  bool sent = address_.size() < sizeof to.sun_path;
  if (sent) {
    std::memcpy(to.sun_path, address_.data(), address_.size());
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address_.size());
    sent = sendto(socket_, text.data(), text.size(), MSG_NOSIGNAL,
                  reinterpret_cast<const sockaddr*>(&to), size) >= 0;
  } else {
    errno = ENAMETOOLONG;
  }
  if (!sent) {
    std::fprintf(stderr, "$NOTIFY_SOCKET takes no %s: %s\n",
                 text.substr(0, text.find('\n')).c_str(), std::strerror(errno));
  }
}

}  // namespace splash::program
