// SPDX-License-Identifier: MIT
// Chromium without a screen at the hands of a test, over its DevTools protocol. It draws in
// software.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace splash::tests {

class Chromium {
 public:
  using Json = nlohmann::json;

  /// Whether there is one.
  [[nodiscard]] static bool is_there();
  /// Starts it with a window of so many CSS pixels and no page. `graphics`: in software for all
  /// that it shows, or "swiftshader-webgl": for WebGL alone, as it does by itself where there is no
  /// card. Throws std::runtime_error when that fails.
  explicit Chromium(const std::string& window = "720,480",
                    const std::string& graphics = "swiftshader");
  ~Chromium();
  Chromium(const Chromium&) = delete;
  Chromium& operator=(const Chromium&) = delete;

  /// A command to the page; what it answers. Throws what the browser says is wrong.
  Json call(const std::string& method, const Json& parameters = Json::object());
  /// What an expression is in the page; of a promise, what it becomes.
  Json evaluate(const std::string& expression);
  /// Whether it becomes true within so many seconds; asks ten times a second.
  bool wait_for(const std::string& expression, double seconds);
  /// A key that is pressed and let go.
  void press(const std::string& key);
  /// `type`: mousePressed, mouseMoved or mouseReleased, of the left button [CSS pixels].
  void mouse(const std::string& type, double x, double y);
  /// The same without waiting until the page has heard of it.
  void mouse_on(const std::string& type, double x, double y);
  /// The colour of places of the picture, red, green and blue each: [[r, g, b], ...] from 0 to 255.
  /// `places`: [[x, y], ...] [CSS pixels].
  Json colours(const Json& places);
  /// Errors of the page so far: exceptions, and what it or the browser wrote to the console.
  [[nodiscard]] const std::vector<std::string>& errors() const noexcept { return errors_; }
  /// Ends it as a crash would.
  void kill();

 private:
  void send(const Json& message) const;
  void begin(const std::string& method, const Json& parameters);
  /// The next message; null: none came in time.
  Json next(double seconds);
  void note(const Json& event);

  TemporaryFolder folder_;
  int to_ = -1;
  int from_ = -1;
  std::string heard_;
  std::unique_ptr<ChildProcess> process_;
  std::string session_;
  int calls_ = 0;
  std::vector<std::string> errors_;
};

}  // namespace splash::tests
