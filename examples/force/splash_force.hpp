// SPDX-License-Identifier: MIT
// Feel splash's water with a force-feedback device: include this file, it needs C++17 and nothing
// else. The device's own loop, at 1 kHz say, asks for a force; the simulator sends one for each of
// its frames (160 a second), each with its derivative by speed. Between them this extrapolates, and
// it keeps the hand safe: see Safety.
//
//   splash_force::Client water("127.0.0.1", 57300, 0);  // the simulator, and the body's number
//   // CHAI3D, in the haptic loop. Its x points to the user and its y to the right:
//   device->getPosition(x); device->getLinearVelocity(v);
//   const splash_force::Vector place = {-x.x(), -x.y(), x.z()}, speed = {-v.x(), -v.y(), v.z()};
//   water.send_pose(place, {0, 0, 0, 1});
//   const auto f = water.force(place, speed, {0, 0, 0}).force;
//   device->setForce(chai3d::cVector3d(-f[0], -f[1], f[2]));
//   // OpenHaptics, in the scheduler's callback. Millimetres, x to the right, y up:
//   //   place = {-pos[2] / 1000, -pos[0] / 1000, pos[1] / 1000}
//   //   and the force for it is {-f[1], f[2], -f[0]}.
//
// It was tried with simulated devices (tests/examples), not with any real one: begin with a low
// max_force.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#ifdef _WIN32
#include <winsock2.h>
#include <ws2tcpip.h>
#else
#include <arpa/inet.h>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>
#endif

namespace splash_force {

using Vector = std::array<double, 3>;

/// A force [N] and a torque [N m].
struct Wrench {
  Vector force = {0.0, 0.0, 0.0};
  Vector torque = {0.0, 0.0, 0.0};
};

/// The latest message of the simulator about a body.
struct Model {
  std::int32_t session = 0;           ///< another one: it was started anew
  Vector velocity = {0.0, 0.0, 0.0};  ///< of the body there [m/s]
  Vector spin = {0.0, 0.0, 0.0};      ///< [rad/s]
  Wrench wrench;                      ///< of the water at that speed
  Vector by_speed = {0.0, 0.0, 0.0};  ///< [N s/m], none above 0
  Vector by_spin = {0.0, 0.0, 0.0};   ///< [N m s]
};

/// What never reaches the hand, whatever comes from the network.
struct Safety {
  double max_force = 5.0;      ///< [N]
  double max_torque = 0.1;     ///< [N m]
  double max_damping = 5.0;    ///< of what is extrapolated by speed [N s/m]
  double max_turning = 0.005;  ///< the same of torques [N m s]
  double slew = 200.0;    ///< the force changes no faster, whatever it is for [N/s], its torque
                          ///< no faster than a fiftieth of it [N m/s]
  double ramp = 0.5;      ///< the first force, and that after a silence, grows so long [s]
  double silence = 0.05;  ///< so long after the last message there is no force left [s]
  double fade = 0.02;     ///< of that, the last part, in which it fades [s]
  /// The water gives the hand no energy but what the hand gave it before, of which it owes the last
  /// `credit` at most, and `advance` (the passivity observer of Hannaford & Ryu 2002). As the force
  /// cannot end at once, it is never larger than what can be taken back by `slew` before that
  /// energy is used up, while the hand speeds up by `hand` meanwhile, or as it did of late.
  bool passive = true;
  double credit = 2.0;         ///< [J]
  double advance = 0.8e-3;     ///< [J]
  double hand = 50.0;          ///< at least [m/s2]
  double horizon = 0.02;       ///< what was taken too much is given back by damping, so soon [s]
  double most_passive = 60.0;  ///< such damping, at most [N s/m]
};

/// The arithmetic alone: no socket, no thread, no clock of its own. Times in seconds of any clock.
class ForceModel {
 public:
  explicit ForceModel(const Safety& safety = {}) : safety_(safety) {}

  /// Stores what the simulator sent, received at `now`. A message with NaN or infinity is ignored.
  void take(const Model& model, double now) {
    if (!is_sound(model)) return;
    if (!heard_ || model.session != model_.session || now - last_ > safety_.silence) start_ = now;
    model_ = model;
    last_ = now;
    heard_ = true;
  }

  /// What to give the hand now. Call in every turn of the loop with where the device is and how it
  /// moves.
  Wrench force(const Vector& place, const Vector& velocity, const Vector& spin, double now) {
    const double dt = asked_ ? std::clamp(now - asked_at_, 0.0, 0.02) : 0.0;
    const bool sound = is_finite(place) && is_finite(velocity) && is_finite(spin);
    Wrench wanted;
    if (sound && heard_) {
      const double share = share_of(now);
      wanted.force = scaled(share, extrapolated(model_.wrench.force, model_.by_speed, velocity,
                                                model_.velocity, safety_.max_damping));
      wanted.torque = scaled(share, extrapolated(model_.wrench.torque, model_.by_spin, spin,
                                                 model_.spin, safety_.max_turning));
    }
    note_work(place, sound);
    if (sound) note_hand(velocity, dt);
    limit(wanted.force, safety_.max_force);
    limit(wanted.torque, safety_.max_torque);
    if (safety_.passive && sound) make_passive(wanted.force, velocity, dt);
    // What the slew limit can take back until the silence is over.
    const double left = std::max(safety_.silence - (now - last_) - dt, 0.0);
    limit(wanted.force, safety_.slew * left);
    limit(wanted.torque, safety_.slew / 50.0 * left);
    approach(given_.force, wanted.force, safety_.slew * dt);
    approach(given_.torque, wanted.torque, safety_.slew / 50.0 * dt);
    if (!sound || (heard_ && now - last_ >= safety_.silence)) given_ = {};
    place_ = sound ? place : place_;
    asked_at_ = now;
    asked_ = true;
    return given_;
  }

  /// Since the simulator last spoke; 0 before it did [s].
  double silence(double now) const { return heard_ ? now - last_ : 0.0; }
  /// What the hand has given the water and not got back, as far as it counts [J].
  double energy() const { return energy_; }

 private:
  static bool is_finite(const Vector& v) {
    return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
  }
  static bool is_sound(const Model& m) {
    return is_finite(m.velocity) && is_finite(m.spin) && is_finite(m.wrench.force) &&
           is_finite(m.wrench.torque) && is_finite(m.by_speed) && is_finite(m.by_spin);
  }
  static double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  static Vector scaled(double factor, const Vector& a) {
    return {factor * a[0], factor * a[1], factor * a[2]};
  }
  static void limit(Vector& v, double most) {
    const double size = std::sqrt(dot(v, v));
    if (size > most) v = scaled(most / size, v);
  }
  static void approach(Vector& v, const Vector& to, double most) {
    Vector way = {to[0] - v[0], to[1] - v[1], to[2] - v[2]};
    limit(way, most);
    for (std::size_t i = 0; i < 3; ++i) v[i] += way[i];
  }
  static Vector extrapolated(const Vector& sent, const Vector& rate, const Vector& now,
                             const Vector& then, double most) {
    Vector sum = sent;
    for (std::size_t i = 0; i < 3; ++i) {
      sum[i] += std::clamp(rate[i], -most, 0.0) * (now[i] - then[i]);
    }
    return sum;
  }

  /// 0 after a silence, up to 1 after the ramp.
  double share_of(double now) const {
    const double silent = now - last_;
    const double in = safety_.ramp > 0.0 ? (now - start_) / safety_.ramp : 1.0;
    const double out = safety_.fade > 0.0 ? (safety_.silence - silent) / safety_.fade : 1.0;
    return silent >= safety_.silence ? 0.0 : std::clamp(std::min(in, out), 0.0, 1.0);
  }

  /// The force that was given last has done its work since: the hand's energy in the water is
  /// known to the sample, whatever the limits made of that force.
  void note_work(const Vector& place, bool sound) {
    if (!asked_ || !sound) return;
    const Vector way = {place[0] - place_[0], place[1] - place_[1], place[2] - place_[2]};
    energy_ = std::min(energy_ - dot(given_.force, way), safety_.credit);
  }

  /// How fast the hand speeds up: what a mean of its velocity lags behind it by, over the mean's
  /// time; the most of about the last second counts, and half as much again.
  void note_hand(const Vector& velocity, double dt) {
    constexpr double kMean = 0.005, kKeeps = 1.0;  // [s]
    const double part = asked_ ? 1.0 - std::exp(-dt / kMean) : 1.0;
    double square = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double lag = velocity[i] - mean_velocity_[i];
      square += lag * lag;
      mean_velocity_[i] += part * lag;
    }
    const double now = asked_ ? 1.5 * std::sqrt(square) / kMean : 0.0;
    hand_ = std::max({now, hand_ * std::exp(-dt / kKeeps), safety_.hand});
  }

  /// What the hand gets from a force along its motion at `speed` while the slew limit takes it
  /// back:
  ///   integral of (F - slew t) (speed + hand t) dt  until F = slew t.
  double cost(double force, double speed) const {
    const double time = force / safety_.slew;
    return force * time * (speed / 2.0 + hand_ * time / 6.0);
  }

  /// The largest force that costs no more than `energy`. Below it there is none that does: the cost
  /// falls at first where the force holds the hand up, then grows.
  double affordable(double speed, double energy) const {
    double low = 0.0, high = safety_.max_force;
    if (cost(high, speed) <= energy) return high;
    for (int k = 0; k < 40; ++k) {
      const double middle = (low + high) / 2.0;
      (cost(middle, speed) <= energy ? low : high) = middle;
    }
    return low;
  }

  void make_passive(Vector& force, const Vector& velocity, double dt) const {
    const double energy = energy_ + safety_.advance;
    const double square = dot(velocity, velocity);
    if (energy < 0.0 && square > 1.0e-8) {
      const double damping = std::min(-energy / (safety_.horizon * square), safety_.most_passive);
      for (std::size_t i = 0; i < 3; ++i) force[i] -= damping * velocity[i];
    }
    const double size = std::sqrt(dot(force, force));
    if (size <= 0.0) return;
    // A turn passes before the force can change.
    const double speed = dot(force, velocity) / size + hand_ * dt;
    const double most = affordable(speed, std::max(energy, 0.0)) - safety_.slew * dt;
    limit(force, std::max(most, 0.0));
  }

  Safety safety_;
  Model model_;
  bool heard_ = false;
  double last_ = 0.0;   ///< when the simulator last spoke [s]
  double start_ = 0.0;  ///< of the ramp [s]
  bool asked_ = false;
  double asked_at_ = 0.0;
  Vector place_ = {0.0, 0.0, 0.0};
  Wrench given_;  ///< what the hand gets
  double energy_ = 0.0;
  Vector mean_velocity_ = {0.0, 0.0, 0.0};
  double hand_ = 0.0;  ///< how fast it speeds up [m/s2]
};

/// OSC 1.0 as splash writes and reads it, of what a force loop needs.
namespace osc {

inline void put_text(std::vector<char>& bytes, const std::string& text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
  do bytes.push_back('\0');
  while (bytes.size() % 4 != 0);
}
inline void put_int(std::vector<char>& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<char>((value >> static_cast<unsigned>(shift)) & 0xFFU));
  }
}
inline void put_float(std::vector<char>& bytes, double value) {
  const float small = static_cast<float>(value);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &small, sizeof bits);
  put_int(bytes, bits);
}
inline std::uint32_t get_int(const char* at) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8U | static_cast<unsigned char>(at[i]);
  return value;
}
inline double get_float(const char* at) {
  const std::uint32_t bits = get_int(at);
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof value);
  return static_cast<double>(value);
}

/// Takes a message of the simulator into `model`; true: it was the last one of `body`.
inline bool take(const char* data, std::size_t size, std::int32_t body, Model& model) {
  const auto text_end = [&](std::size_t at) {
    while (at < size && data[at] != '\0') ++at;
    return at;
  };
  const std::size_t address_end = text_end(0);
  const std::size_t tags = (address_end / 4 + 1) * 4;
  if (tags >= size) return false;
  const std::size_t tags_end = text_end(tags);
  const std::size_t values = (tags_end / 4 + 1) * 4;
  const std::string address(data, address_end);
  const std::string types(data + tags, tags_end - tags);
  if (values + 4 * (types.size() - 1) > size) return false;
  const auto number = [&](std::size_t index) { return get_float(data + values + 4 * index); };
  if (address == "/frame" && types == ",iiif") {
    model.session = static_cast<std::int32_t>(get_int(data + values));
    return false;
  }
  if (types != ",iffffff" || static_cast<std::int32_t>(get_int(data + values)) != body)
    return false;
  Vector one = {number(1), number(2), number(3)};
  Vector other = {number(4), number(5), number(6)};
  if (address == "/body/twist") {
    model.velocity = one;
    model.spin = other;
  } else if (address == "/force") {
    model.wrench = {one, other};
  } else if (address == "/force/rate") {
    model.by_speed = one;
    model.by_spin = other;
    return true;
  }
  return false;
}

/// Takes a packet; true: `model` is that of a frame.
inline bool take_packet(const char* data, std::size_t size, std::int32_t body, Model& model) {
  if (size < 16 || std::memcmp(data, "#bundle", 8) != 0) return false;
  bool complete = false;
  for (std::size_t at = 16; at + 4 <= size;) {
    const std::size_t length = get_int(data + at);
    if (length > size - at - 4) return false;
    complete = take(data + at + 4, length, body, model) || complete;
    at += 4 + length;
  }
  return complete;
}

}  // namespace osc

/// The socket, and a thread that listens. force() and send_pose() may be called from any thread;
/// neither waits for the network.
class Client {
 public:
  /// Throws std::runtime_error if the simulator's name is not known or there is no socket.
  Client(const std::string& host, std::uint16_t port, std::int32_t body, const Safety& safety = {})
      : body_(body), model_(safety) {
    addrinfo hints = {};
    hints.ai_family = AF_INET;
    hints.ai_socktype = SOCK_DGRAM;
    addrinfo* found = nullptr;
#ifdef _WIN32
    WSADATA ignored;
    WSAStartup(MAKEWORD(2, 2), &ignored);
#endif
    if (getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found) != 0) {
      throw std::runtime_error("no host called " + host);
    }
    std::memcpy(&simulator_, found->ai_addr, sizeof simulator_);
    freeaddrinfo(found);
    // Not connected: forces come from another port than the one that is asked.
    socket_ = socket(AF_INET, SOCK_DGRAM, 0);
    if (socket_ == kNone) throw std::runtime_error("no UDP socket");
    set_timeout();
    thread_ = std::thread([this] { listen(); });
  }
  ~Client() {
    ends_ = true;
    thread_.join();
    notify(0);
#ifdef _WIN32
    closesocket(socket_);
#else
    close(socket_);
#endif
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// Where the device is: metres, and a unit quaternion x y z w, in the scene's axes.
  void send_pose(const Vector& place, const std::array<double, 4>& rotation) {
    std::vector<char> bytes;
    osc::put_text(bytes, "/body/pose");
    osc::put_text(bytes, ",ifffffff");
    osc::put_int(bytes, static_cast<std::uint32_t>(body_));
    for (const double part : place) osc::put_float(bytes, part);
    for (const double part : rotation) osc::put_float(bytes, part);
    say(bytes);
  }
  /// What to give the hand now.
  Wrench force(const Vector& place, const Vector& velocity, const Vector& spin) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return model_.force(place, velocity, spin, now());
  }
  /// How long the simulator has been silent: nothing is left of the force after Safety's [s].
  double silence() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return model_.silence(now());
  }

 private:
#ifdef _WIN32
  using Socket = SOCKET;
  using Size = int;
  static constexpr Socket kNone = INVALID_SOCKET;
  void set_timeout() {
    const DWORD milliseconds = 100;
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, reinterpret_cast<const char*>(&milliseconds),
               sizeof milliseconds);
  }
#else
  using Socket = int;
  using Size = std::size_t;
  static constexpr Socket kNone = -1;
  void set_timeout() {
    const timeval tenth = {0, 100000};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &tenth, sizeof tenth);
  }
#endif

  static double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
  void say(const std::vector<char>& bytes) {
    static_cast<void>(sendto(socket_, bytes.data(), static_cast<Size>(bytes.size()), 0,
                             reinterpret_cast<const sockaddr*>(&simulator_), sizeof simulator_));
  }
  void notify(std::uint32_t streams) {
    std::vector<char> bytes;
    osc::put_text(bytes, "/notify");
    osc::put_text(bytes, ",i");
    osc::put_int(bytes, streams);
    say(bytes);
  }
  void listen() {
    double ask = 0.0;
    Model latest;
    std::array<char, 2048> buffer = {};
    while (!ends_) {
      if (now() >= ask) {  // the simulator forgets who asked after a minute, or when it is started
        notify(2);
        ask = now() + 1.0;
      }
      sockaddr_in from = {};
      socklen_t length = sizeof from;
      const auto size = recvfrom(socket_, buffer.data(), static_cast<Size>(buffer.size()), 0,
                                 reinterpret_cast<sockaddr*>(&from), &length);
      if (size <= 0) {
        if (size < 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        continue;
      }
      if (from.sin_addr.s_addr != simulator_.sin_addr.s_addr) continue;
      if (!osc::take_packet(buffer.data(), static_cast<std::size_t>(size), body_, latest)) continue;
      const std::lock_guard<std::mutex> lock(mutex_);
      model_.take(latest, now());
    }
  }

  std::int32_t body_;
  std::mutex mutex_;
  ForceModel model_;
  sockaddr_in simulator_ = {};
  Socket socket_ = kNone;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace splash_force
