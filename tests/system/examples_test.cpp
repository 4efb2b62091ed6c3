// SPDX-License-Identifier: MIT
// The examples in Python, and the README's, against the real simulator: a hand that one program
// moves makes impacts that another hears.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <string>

#include "protocol/event_log.hpp"
#include "tests/support/programs.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::tests {
namespace {

using testing::ContainsRegex;

const std::string kSource = SPLASH_SOURCE_DIR;

/// An example at the simulator's port.
Arguments example(const std::string& name, Simulator& simulator, const std::string& seconds) {
  return {"python3",
          "-B",
          kSource + "/examples/python/" + name,
          "--port",
          std::to_string(simulator.endpoint().port),
          "--seconds",
          seconds};
}

/// The README's block of Python, at another port.
std::string readme_example(int port) {
  const std::string text = text_of(kSource + "/README.md");
  const std::string fence = "```python\n";
  const std::size_t begin = text.find(fence) + fence.size();
  std::string code = text.substr(begin, text.find("```", begin) - begin);
  const std::string usual = "57300";
  const std::size_t at = code.find(usual);
  return at == std::string::npos ? "" : code.replace(at, usual.size(), std::to_string(port));
}

TEST(Examples, AHandThatOneMovesIsHeardAndFeltByOthers) {
  Simulator simulator(
      {"--scene", kSource + "/configs/scenes/hand.yaml", "--target", "127.0.0.1:9"});
  ASSERT_TRUE(simulator.process().wait_for_text("running")) << simulator.process().output();
  {
    ChildProcess listener(example("listen.py", simulator, "60"));
    const std::string plunge =
        "import time\n"
        "for step in range(100):\n"
        "    send_pose(0, 0.0, 0.0, 0.65 - 0.003 * step)\n"
        "    time.sleep(0.01)\n";
    ChildProcess sender({"python3", "-c", readme_example(simulator.endpoint().port) + plunge});
    EXPECT_EQ(sender.wait_for_end(60.0), 0) << sender.output();
    EXPECT_TRUE(listener.wait_for_text("impact", 60.0)) << simulator.process().output();
  }
  ChildProcess listener(example("listen.py", simulator, "60"));
  ChildProcess sender(example("send_hand.py", simulator, "60"));
  ChildProcess feeler(example("feel_force.py", simulator, "60"));
  EXPECT_TRUE(listener.wait_for_text("impact", 60.0)) << listener.output();
  EXPECT_TRUE(listener.wait_for_text("bubble", 60.0)) << listener.output();
  EXPECT_TRUE(feeler.wait_for_text("N  ###", 60.0)) << feeler.output();
  for (ChildProcess* one : {&listener, &sender, &feeler}) {
    one->signal(SIGINT);
    EXPECT_EQ(one->wait_for_end(), 0) << one->output();
  }
  EXPECT_THAT(listener.output(),
              ContainsRegex("impact +[0-9.]+ m/s   body 0 at \\([-0-9.]+, [-0-9.]+, 0.[45]"));
}

TEST(Examples, ALogBecomesATable) {
  const TemporaryFolder folder;
  {
    protocol::LogWriter log(folder / "run.osc");
    const protocol::Message frame = to_message(protocol::Frame{.session = 1});
    log.append(0.5,
               {frame, to_message(protocol::Event(protocol::Impact{.id = 3,
                                                                   .speed = 1.5F,
                                                                   .approach = 1.25F,
                                                                   .position = {0.5F, 0.0F, 0.25F},
                                                                   .offset_ms = 20.0F,
                                                                   .momentum = 2.0F}))});
    log.append(
        2.0,
        {frame, to_message(protocol::Event(protocol::Bubble{.radius = 0.005F, .position = {}})),
         to_message(
             protocol::Event(protocol::Cavity{.radius = 0.03125F, .position = {}, .life = 0.5F}))});
  }
  const Arguments program{"python3", "-B", kSource + "/examples/python/log_to_csv.py"};
  Arguments line = program;
  line.push_back(folder / "run.osc");
  const Ended ended = run_command(line, 60.0);
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.text,
            "seconds,event,id,body,x,y,z,speed,approach,momentum,rise,radius,epsilon,life\r\n"
            "0.52,impact,3,0,0.5,0,0.25,1.5,1.25,2,0,,,\r\n"
            "2,bubble,0,-1,0,0,0,,,,,0.005,0,\r\n"
            "2,cavity,0,-1,0,0,0,,,,,0.03125,0.1,0.5\r\n");
  line.back() = kSource + "/README.md";
  EXPECT_THAT(run_command(line, 60.0).text, testing::HasSubstr("byte 0: this is no bundle"));
}

}  // namespace
}  // namespace splash::tests
