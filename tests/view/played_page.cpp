// SPDX-License-Identifier: MIT
#include "tests/view/played_page.hpp"

#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "protocol/limits.hpp"
#include "protocol/time_tag.hpp"
#include "tests/support/waiting.hpp"

namespace splash::tests {
namespace {

constexpr double kSpacing = 0.02;      ///< of the water's particles [m]
constexpr double kUnit = 1e-5;         ///< of their places in a state [m]
constexpr double kPeriod = 0.02;       ///< from one state to the next [s]
constexpr std::uint32_t kGrabbed = 4;  ///< flag of a body in a state
constexpr const char* kStill = R"({"scene": "still", "description": "", "particles": 4000,
  "spacing": 0.02, "solver": "none", "frame_rate": 50,
  "tank": {"lower": [-0.2, -0.2, 0], "upper": [0.2, 0.2, 0.5]}, "slope": null, "wave_maker": null,
  "bodies": [{"name": "disc", "motion": "script", "kind": "box", "size": [0.15, 0.15, 0.05],
              "rocker": 0, "flat": 0, "mesh": {
    "vertices": [-0.075, -0.075, -0.025, 0.075, -0.075, -0.025, -0.075, 0.075, -0.025,
                 0.075, 0.075, -0.025, -0.075, -0.075, 0.025, 0.075, -0.075, 0.025,
                 -0.075, 0.075, 0.025, 0.075, 0.075, 0.025],
    "triangles": [0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                  2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5]}}],
  "rows": [], "scenes": []})";
constexpr const char* kSilent = R"({"rig": "none", "description": "", "sample_rate": 48000,
  "outputs": [], "channels": [], "rows": [], "middle": null, "rigs": [], "sounds": []})";

protocol::ViewFrame told(std::string_view kind, std::string_view text) {
  protocol::FrameWriter writer(kind, 0.0);
  writer.text(text);
  return std::move(writer).take();
}

protocol::BodyPose at_rest() {
  protocol::BodyPose pose;
  pose.position.z = PlayedPage::kRest;
  return pose;
}

}  // namespace

PlayedPage& PlayedPage::shared() {
  static PlayedPage page;
  return page;
}

PlayedPage::PlayedPage()
    : water_({}, told(protocol::kSceneFrame, kStill)),
      sound_({.listen = {}, .allowed = {}, .most_asked = 16}, told(protocol::kRigFrame, kSilent)),
      sim_(protocol::Endpoint{}),
      synth_(protocol::Endpoint{}),
      server_({.listen = {},
               .sim = sim_.local(),
               .synth = synth_.local(),
               .sim_show = water_.local(),
               .synth_show = sound_.local(),
               .origins = {}}),
      browser_(std::make_unique<Chromium>("420,300")),
      disc_(at_rest()),
      serves_([this] { server_.run(); }),
      plays_([this](const std::stop_token& stop) {
        while (!stop.stop_requested()) play();
      }) {}

PlayedPage::~PlayedPage() {
  browser_.reset();
  server_.stop();
}

void PlayedPage::load_modules() {
  browser_->call("Page.navigate",
                 {{"url", "http://" + protocol::to_string(server_.local()) + "/vector.js"}});
}

void PlayedPage::load(const std::string& query, int width, int height, double level) {
  fill(level);
  browser_->call(
      "Emulation.setDeviceMetricsOverride",
      {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
  show_page(*browser_, "http://" + protocol::to_string(server_.local()) + "/" + query);
}

bool PlayedPage::disc_comes(const std::string& condition) {
  return browser_->wait_for(
      "(([x, y, z]) => " + condition + ")(splash.playout.states.at(-1)?.bodies[0].place ?? [])",
      kTimeout);
}

std::vector<SentPose> PlayedPage::poses(std::int32_t body, std::size_t count) {
  std::vector<SentPose> all;
  const double end = protocol::monotonic_now() + kTimeout;
  while (all.size() < count && protocol::monotonic_now() < end) {
    sleep(kPeriod);
    const std::lock_guard lock(mutex_);
    for (const SentPose& sent : std::exchange(poses_, {})) {
      if (sent.pose.body == body && all.size() < count) all.push_back(sent);
    }
  }
  return all;
}

void PlayedPage::play() {
  std::array<std::byte, protocol::kMaxDatagram> buffer{};
  const double next = protocol::monotonic_now() + kPeriod;
  for (double left = kPeriod; left > 0.0; left = next - protocol::monotonic_now()) {
    const auto got = sim_.receive(buffer.data(), buffer.size(), left);
    if (got) hear(protocol::decode({buffer.data(), got->size}).packet);
  }
  if (!water_.wanted()) return;
  told_ += kPeriod;
  water_.offer(state());
}

void PlayedPage::hear(const protocol::Packet& packet) {
  for (const protocol::Message& said : packet.messages) {
    if (said.address == "/body/grab") {
      held_ = said.arguments.at(1) == protocol::Argument{1};
      if (!held_) disc_ = at_rest();
    }
    const auto pose = protocol::to_body_pose(said);
    if (!pose || !packet.time) continue;
    if (pose->body == 0 && held_) disc_ = *pose;
    const std::lock_guard lock(mutex_);
    poses_.push_back({protocol::to_unix_seconds(*packet.time), *pose});
  }
}

protocol::ViewFrame PlayedPage::state() const {
  const auto along = static_cast<std::uint64_t>(std::lround(2.0 * kHalf / kSpacing));
  const auto high = static_cast<std::uint64_t>(std::lround(level_ / kSpacing));
  const auto count = [](std::uint64_t i) {
    return static_cast<std::uint64_t>(
        std::lround((static_cast<double>(i) + 0.5) * kSpacing / kUnit));
  };
  std::vector<std::uint64_t> particles;
  for (std::uint64_t x = 0; x < along; ++x) {
    for (std::uint64_t y = 0; y < along; ++y) {
      for (std::uint64_t z = 0; z < high; ++z) {
        particles.push_back(count(x) | count(y) << 16U | count(z) << 32U);
      }
    }
  }
  const auto& [body, place, qx, qy, qz, qw] = disc_;
  protocol::FrameWriter writer(protocol::kStateFrame, protocol::unix_now());
  writer.reserve(72 + 8 * particles.size());
  writer.put(told_);
  for (const std::size_t number :
       {std::size_t{0}, particles.size(), std::size_t{0}, std::size_t{1}}) {
    writer.put(static_cast<std::uint32_t>(number));
  }
  for (const double corner : {-kHalf, -kHalf, 0.0, kUnit}) writer.put(static_cast<float>(corner));
  for (const float x : {place.x, place.y, place.z, qx, qy, qz, qw}) writer.put(x);
  writer.put(held_ ? kGrabbed : 0U);
  writer.put_all(std::span<const std::uint64_t>(particles));
  return std::move(writer).take();
}

}  // namespace splash::tests
