// SPDX-License-Identifier: MIT
#include "tests/view/chromium.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "tests/support/waiting.hpp"

namespace splash::tests {
namespace {

namespace fs = std::filesystem;

constexpr double kAnswerTimeout = 120.0;  ///< for an answer [s]

/// Draws a screenshot into a canvas of the page and reads what is asked for.
constexpr const char* kRead = R"js((async (text, places) => {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
  const canvas = new OffscreenCanvas(image.width, image.height);
  const pen = canvas.getContext('2d');
  pen.drawImage(image, 0, 0);
  const dense = image.width / window.innerWidth;
  return places.map(([x, y]) =>
    [...pen.getImageData(Math.round(x * dense), Math.round(y * dense), 1, 1).data].slice(0, 3));
}))js";

std::string found() {
  std::istringstream folders(std::getenv("PATH") == nullptr ? "" : std::getenv("PATH"));
  for (std::string folder; std::getline(folders, folder, ':');) {
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
      const fs::path file = fs::path(folder) / name;
      if (access(file.c_str(), X_OK) == 0) return file;
    }
  }
  return {};
}

nlohmann::json event_of(const std::string& type, double x, double y) {
  return {{"type", type},
          {"x", x},
          {"y", y},
          {"button", "left"},
          {"buttons", type == "mouseReleased" ? 0 : 1},
          {"clickCount", 1}};
}

int fifo(const std::string& path) {
  if (mkfifo(path.c_str(), 0600) != 0) throw std::runtime_error("mkfifo " + path);
  return open(path.c_str(), O_RDWR | O_CLOEXEC);
}

}  // namespace

bool Chromium::is_there() {
  return !found().empty();
}

Chromium::Chromium(const std::string& window, const std::string& graphics)
    : to_(fifo(folder_ / "to")), from_(fifo(folder_ / "from")) {
  process_ = std::make_unique<ChildProcess>(std::vector<std::string>{
      "/bin/sh", "-c", R"(exec "$@" 3<"$0/to" 4>"$0/from")", folder_.path(), found(),
      "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--remote-debugging-pipe",
      "--use-angle=" + graphics, "--enable-unsafe-swiftshader",
      "--autoplay-policy=no-user-gesture-required", "--window-size=" + window,
      "--user-data-dir=" + (folder_ / "profile").string(), "--no-first-run", "--disable-extensions",
      "--disable-background-networking", "about:blank"});
  const Json target = call("Target.createTarget", {{"url", "about:blank"}});
  session_ = call("Target.attachToTarget", {{"targetId", target.at("targetId")}, {"flatten", true}})
                 .at("sessionId");
  for (const char* domain : {"Page.enable", "Runtime.enable", "Log.enable"}) call(domain);
}

Chromium::~Chromium() {
  process_.reset();
  close(to_);
  close(from_);
}

void Chromium::kill() {
  process_->kill();
}

void Chromium::send(const Json& message) const {
  const std::string text = message.dump();
  for (std::size_t sent = 0; sent <= text.size();) {  // the 0 at its end, too
    const ssize_t count = write(to_, text.c_str() + sent, text.size() + 1 - sent);
    if (count < 0) throw std::runtime_error("the browser takes nothing");
    sent += static_cast<std::size_t>(count);
  }
}

Chromium::Json Chromium::next(double seconds) {
  pollfd readable{from_, POLLIN, 0};
  for (;;) {
    const auto end = heard_.find('\0');
    if (end != std::string::npos) {
      Json message = Json::parse(heard_.substr(0, end));
      heard_.erase(0, end + 1);
      return message;
    }
    if (poll(&readable, 1, static_cast<int>(1e3 * seconds)) <= 0) return nullptr;
    std::array<char, 65536> bytes{};
    const ssize_t count = read(from_, bytes.data(), bytes.size());
    if (count <= 0) return nullptr;
    heard_.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

void Chromium::note(const Json& event) {
  const std::string method = event.value("method", "");
  const bool failed =
      method == "Runtime.exceptionThrown" ||
      (method == "Runtime.consoleAPICalled" && event["params"]["type"] == "error") ||
      (method == "Log.entryAdded" && event["params"]["entry"]["level"] == "error");
  if (!failed) return;
  const Json& told = event["params"];
  if (told.contains("exceptionDetails")) {
    const Json& thrown = told["exceptionDetails"];
    errors_.push_back(thrown.value("text", "") + ": " +
                      thrown.value("exception", Json::object()).value("description", ""));
  } else {
    errors_.push_back(told.dump());
  }
}

void Chromium::begin(const std::string& method, const Json& parameters) {
  Json message = {{"id", ++calls_}, {"method", method}, {"params", parameters}};
  if (!session_.empty()) message["sessionId"] = session_;
  send(message);
}

Chromium::Json Chromium::call(const std::string& method, const Json& parameters) {
  begin(method, parameters);
  for (;;) {
    const Json answer = next(kAnswerTimeout);
    if (answer.is_null()) throw std::runtime_error(method + ": no answer\n" + process_->output());
    if (answer.value("id", 0) != calls_) {
      note(answer);
      continue;
    }
    if (answer.contains("error")) throw std::runtime_error(method + ": " + answer["error"].dump());
    return answer.at("result");
  }
}

Chromium::Json Chromium::evaluate(const std::string& expression) {
  const Json result = call("Runtime.evaluate", {{"expression", expression},
                                                {"awaitPromise", true},
                                                {"returnByValue", true},
                                                {"userGesture", true}});
  if (result.contains("exceptionDetails")) throw std::runtime_error(result.dump());
  return result["result"].value("value", Json());
}

bool Chromium::wait_for(const std::string& expression, double seconds) {
  return eventually([&] { return evaluate("Boolean(" + expression + ")") == true; }, seconds, 0.1);
}

void Chromium::press(const std::string& key) {
  for (const char* type : {"keyDown", "keyUp"}) {
    call("Input.dispatchKeyEvent", {{"type", type}, {"key", key}});
  }
}

void Chromium::mouse(const std::string& type, double x, double y) {
  call("Input.dispatchMouseEvent", event_of(type, x, y));
}

void Chromium::mouse_on(const std::string& type, double x, double y) {
  begin("Input.dispatchMouseEvent", event_of(type, x, y));
}

Chromium::Json Chromium::colours(const Json& places) {
  const Json shot = call("Page.captureScreenshot", {{"format", "png"}});
  return evaluate(kRead + ("(" + shot.at("data").dump() + "," + places.dump() + ")"));
}

}  // namespace splash::tests
