// SPDX-License-Identifier: MIT
#include "protocol/frame_stream.hpp"

#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>

#include "protocol/time_tag.hpp"

namespace splash::protocol {
namespace {

/// How long no viewer is accepted after accept() found no descriptor or memory left [s].
constexpr double kPause = 0.2;

/// What the kernel keeps of a frame that a viewer does not read [bytes].
constexpr int kSendBuffer = 1 << 16;

SocketError cannot_show(const Endpoint& local) {
  return SocketError("cannot listen for viewers on TCP port " + std::to_string(local.port) + " (" +
                     to_string(local) + "): " + std::strerror(errno) +
                     "; use --show host:port with another one, or port 0");
}

int listen_at(Endpoint& local) {
  const int descriptor = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (descriptor < 0) throw cannot_show(local);
  const int on = 1;  // what went before on this port may still be closing
  (void)setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(local.address);
  address.sin_port = htons(local.port);
  socklen_t size = sizeof address;
  if (bind(descriptor, reinterpret_cast<const sockaddr*>(&address), size) != 0 ||
      ::listen(descriptor, static_cast<int>(FrameStream::kViewersMax)) != 0 ||
      getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    const auto error = cannot_show(local);
    close(descriptor);
    throw error;
  }
  local.port = ntohs(address.sin_port);
  return descriptor;
}

}  // namespace

FrameStream::FrameStream(const FrameStreamSettings& settings, ViewFrame greeting)
    : FrameStream(settings, [frame = std::move(greeting)] { return frame; }) {}

FrameStream::FrameStream(const FrameStreamSettings& settings, std::function<ViewFrame()> greet)
    : settings_(settings),
      greet_([make = std::move(greet)] { return std::make_shared<const ViewFrame>(make()); }),
      local_(settings.listen) {
  listener_ = listen_at(local_);
  wake_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  thread_ = std::thread([this] { run(); });
}

FrameStream::~FrameStream() {
  ending_ = true;
  (void)eventfd_write(wake_, 1);
  thread_.join();
  for (const Viewer& viewer : viewers_) close(viewer.descriptor);
  close(wake_);
  close(listener_);
}

void FrameStream::offer(ViewFrame frame) {
  const auto shared = std::make_shared<const ViewFrame>(std::move(frame));
  {
    const std::lock_guard lock(mutex_);
    for (Viewer& viewer : viewers_) {
      if (!is_open(viewer)) continue;
      --viewer.asked;
      viewer.waiting.push_back(shared);
    }
    note_wanted();
  }
  (void)eventfd_write(wake_, 1);
}

void FrameStream::run() {
  while (!ending_) {
    const double pause = paused_until_ - monotonic_now();
    std::vector<pollfd> polled = {{pause > 0.0 ? -1 : listener_, POLLIN, 0}, {wake_, POLLIN, 0}};
    {
      const std::lock_guard lock(mutex_);
      for (const Viewer& viewer : viewers_) {
        const int events = viewer.waiting.empty() ? POLLIN : POLLIN | POLLOUT;
        polled.push_back({viewer.descriptor, static_cast<short>(events), 0});
      }
    }
    const int wait = pause > 0.0 ? static_cast<int>(std::ceil(1e3 * pause)) : -1;  // [ms]
    if (poll(polled.data(), polled.size(), wait) < 0) continue;
    eventfd_t ignored = 0;
    (void)eventfd_read(wake_, &ignored);
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < viewers_.size(); ++i) {
      if ((polled[i + 2].revents & ~POLLOUT) != 0) hear(viewers_[i]);
      write(viewers_[i]);
    }
    drop_gone();
    if (polled[0].revents != 0) welcome();
    note_wanted();
  }
}

void FrameStream::welcome() {
  sockaddr_in from{};
  socklen_t size = sizeof from;
  const int descriptor =
      accept4(listener_, reinterpret_cast<sockaddr*>(&from), &size, SOCK_CLOEXEC | SOCK_NONBLOCK);
  if (descriptor < 0) {
    if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) pause();
    return;
  }
  const Endpoint peer{ntohl(from.sin_addr.s_addr), 0};
  const auto& allowed = settings_.allowed;
  const bool may = is_loopback(peer) || peer.address == local_.address ||
                   std::find(allowed.begin(), allowed.end(), peer.address) != allowed.end();
  if (!may || viewers_.size() == kViewersMax) {
    close(descriptor);
    return;
  }
  const int on = 1;
  (void)setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  (void)setsockopt(descriptor, SOL_SOCKET, SO_SNDBUF, &kSendBuffer, sizeof kSendBuffer);
  (void)setsockopt(descriptor, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
  viewers_.push_back({descriptor, 0, {greet_()}, 0});
  write(viewers_.back());
  drop_gone();
}

// Who waits stays in the kernel's line, and poll would tell of it again at once.
void FrameStream::pause() {
  const int cause = errno;
  paused_until_ = monotonic_now() + kPause;
  if (std::exchange(warned_of_pause_, true)) return;
  std::fprintf(stderr,
               "%s: a viewer waits, no connection can be taken (%s): raise the limit of open files "
               "(ulimit -n, LimitNOFILE)\n",
               program_invocation_short_name, std::strerror(cause));
}

void FrameStream::hear(Viewer& viewer) {
  std::array<std::byte, 256> bytes{};
  const ssize_t count = recv(viewer.descriptor, bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (count <= 0) {
    close(std::exchange(viewer.descriptor, -1));
    return;
  }
  viewer.asked = std::min(viewer.asked + static_cast<int>(count), settings_.most_asked);
}

void FrameStream::write(Viewer& viewer) {
  while (viewer.descriptor >= 0 && !viewer.waiting.empty()) {
    const ViewFrame& frame = *viewer.waiting.front();
    const ssize_t count = send(viewer.descriptor, frame.data() + viewer.sent,
                               frame.size() - viewer.sent, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (count < 0) {
      if (errno != EAGAIN && errno != EINTR) close(std::exchange(viewer.descriptor, -1));
      return;
    }
    viewer.sent += static_cast<std::size_t>(count);
    if (viewer.sent < frame.size()) continue;
    viewer.waiting.pop_front();
    viewer.sent = 0;
  }
}

void FrameStream::drop_gone() {
  std::erase_if(viewers_, [](const Viewer& viewer) { return viewer.descriptor < 0; });
  viewers_count_ = viewers_.size();
}

bool FrameStream::is_open(const Viewer& viewer) const noexcept {
  return viewer.asked > 0 && std::cmp_less(viewer.waiting.size(), settings_.most_asked);
}

void FrameStream::note_wanted() {
  const bool any = std::any_of(viewers_.begin(), viewers_.end(),
                               [this](const Viewer& viewer) { return is_open(viewer); });
  wanted_.store(any, std::memory_order_release);
}

}  // namespace splash::protocol
