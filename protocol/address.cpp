// SPDX-License-Identifier: MIT
// The table itself. New addresses and arguments go here and nowhere else.
#include "protocol/address.hpp"

#include <array>

#include "protocol/limits.hpp"

namespace splash::protocol {
namespace {

constexpr double kLastId = kCounterWrap - 1;
constexpr double kReach = 1000.0;  // a scene's coordinates [m]
constexpr double kLastInt = 2147483647.0;

constexpr ArgumentRow count_row(std::string_view name, std::string_view meaning) {
  return {'i', name, "1", 0, kLastId, meaning};
}
constexpr ArgumentRow coordinate(std::string_view name, std::string_view meaning) {
  return {'f', name, "m", -kReach, kReach, meaning};
}
constexpr ArgumentRow component(std::string_view name, std::string_view meaning) {
  // A little over 1, as its length may be.
  return {'f', name, "1", -1.1, 1.1, meaning};
}
constexpr ArgumentRow text(std::string_view name, std::string_view meaning) {
  return {'s', name, "", 0, 0, meaning};
}
constexpr ArgumentRow stamp(std::string_view name, std::string_view meaning) {
  return {'t', name, "", 0, 0, meaning};
}
constexpr ArgumentRow program(std::string_view name) {
  return {'s', "program", "", 0, 0, "who answers", name};
}
constexpr ArgumentRow optional(ArgumentRow row) {
  row.optional = true;
  return row;
}

constexpr ArgumentRow kOffset = {
    'f', "offset_ms", "ms", 0, 10000, "moment at which it sounds, after its bundle's time"};
constexpr ArgumentRow kBody = {'i', "body", "1", 0, 255, "index of the body in the scene"};
constexpr ArgumentRow kNearestBody = {'i', "body", "1",
                                      -1,  255,    "nearest body of the scene, -1: none"};

constexpr ArgumentRow kFrame[] = {
    {'i', "session", "1", 1, kLastId, "drawn at the sender's start: a new one means a restart"},
    count_row("sequence", "counts the sender's bundles, wraps at 2^24"),
    count_row("step", "simulation step the bundle speaks of, wraps at 2^24"),
    {'f', "delay_ms", "ms", -10000, 10000,
     "from sending to the bundle's time, for receivers that cannot read time tags"}};
constexpr ArgumentRow kImpact[] = {
    count_row("id", "counts the impacts of a session, wraps at 2^24"),
    {'i', "body", "1", -1, 255, "index of the body in the scene, -1: none"},
    {'f', "speed", "m/s", 0, 100, "speed of the touching point of the body"},
    {'f', "approach", "m/s", 0, 100, "its part along the water surface's normal"},
    coordinate("x", "where the surfaces meet"),
    coordinate("y", "to the left of x, seen from above"),
    coordinate("z", "upwards"),
    kOffset,
    optional({'f', "momentum", "N s", 0, 1e6,
              "given to the water until the blow is strongest, 0: not known"}),
    optional({'f', "rise", "s", 0, 10,
              "from the first touch until the blow is strongest, 0: not known"})};
constexpr ArgumentRow kBubble[] = {
    count_row("id", "counts the bubbles of a session, wraps at 2^24"),
    kNearestBody,
    {'f', "radius", "m", 1e-4, 1, "of the bubble at rest"},
    {'f', "epsilon", "1", 0, 1, "initial excitation as a part of the radius"},
    coordinate("x", "where the air was entrapped"),
    coordinate("y", "to the left of x, seen from above"),
    coordinate("z", "upwards"),
    kOffset};
constexpr ArgumentRow kCavity[] = {
    count_row("id", "counts the cavities of a session, wraps at 2^24"),
    kNearestBody,
    {'f', "radius", "m", 1e-4, 1, "of the sphere that holds the cavity's air"},
    {'f', "epsilon", "1", 0, 1, "initial excitation as a part of the radius"},
    coordinate("x", "the cavity's centre"),
    coordinate("y", "to the left of x, seen from above"),
    coordinate("z", "upwards"),
    kOffset,
    optional({'f', "life", "s", 0, 100, "until it surfaces or breaks, 0: not known"})};
constexpr ArgumentRow kBodyPose[] = {
    kBody,
    coordinate("x", "the body's origin"),
    coordinate("y", "to the left of x, seen from above"),
    coordinate("z", "upwards"),
    component("qx", "unit quaternion, body to world; up to 10 % off it is brought to length 1"),
    component("qy", "same"),
    component("qz", "same"),
    component("qw", "same, the real part")};
constexpr ArgumentRow kNamedPose[] = {text("body", "name of the body in the scene"),
                                      kBodyPose[1],
                                      kBodyPose[2],
                                      kBodyPose[3],
                                      kBodyPose[4],
                                      kBodyPose[5],
                                      kBodyPose[6],
                                      kBodyPose[7]};
constexpr ArgumentRow kBodyGrab[] = {
    kBody, {'i', "on", "1", 0, 1, "1: it follows /body/pose from now on, 0: its own motion"}};
constexpr ArgumentRow reading(std::string_view name, std::string_view meaning) {
  return {'f', name, "N", -1e6, 1e6, meaning};
}
constexpr ArgumentRow next_reading(std::string_view name) {
  return optional(reading(name, "same of the next one"));
}

constexpr ArgumentRow kPressure[] = {
    {'i', "first", "1", 0, 65535,
     "sensor of the first value: those of tile 0, of tile 1 and so on"},
    reading("f0", "what that one feels; below 0, which is drift: as 0"),
    next_reading("f1"),
    next_reading("f2"),
    next_reading("f3"),
    next_reading("f4"),
    next_reading("f5"),
    next_reading("f6"),
    next_reading("f7"),
    next_reading("f8"),
    next_reading("f9"),
    next_reading("f10"),
    next_reading("f11"),
    next_reading("f12"),
    next_reading("f13"),
    next_reading("f14")};
constexpr ArgumentRow kForce[] = {kBody,
                                  {'f', "fx", "N", -1e6, 1e6, "force of the water on the body"},
                                  {'f', "fy", "N", -1e6, 1e6, "same"},
                                  {'f', "fz", "N", -1e6, 1e6, "same, upwards"},
                                  {'f', "tx", "N m", -1e6, 1e6, "torque about the body's origin"},
                                  {'f', "ty", "N m", -1e6, 1e6, "same"},
                                  {'f', "tz", "N m", -1e6, 1e6, "same"}};

constexpr ArgumentRow rate(std::string_view name, std::string_view meaning) {
  return {'f', name, name[1] == 'f' ? "N s/m" : "N m s", -1e9, 1e9, meaning};
}
constexpr ArgumentRow kForceRate[] = {
    kBody,
    rate("dfx", "what a speed along x adds to fx; 0 or less"),
    rate("dfy", "same along y"),
    rate("dfz", "same along z"),
    rate("dtx", "what an angular velocity about x adds to tx; 0 or less"),
    rate("dty", "same about y"),
    rate("dtz", "same about z")};
constexpr ArgumentRow kForceChange[] = {
    kBody,
    coordinate("x", "the body's origin"),
    coordinate("y", "to the left of x, seen from above"),
    coordinate("z", "upwards"),
    {'f', "rate", "N/s", 0, 1e6, "size of the change of the force on it in a second"}};
constexpr ArgumentRow speed(std::string_view name, std::string_view meaning) {
  return {'f', name, name[0] == 'v' ? "m/s" : "rad/s", -1e6, 1e6, meaning};
}
constexpr ArgumentRow kBodyTwist[] = {kBody,
                                      speed("vx", "velocity of the body's origin"),
                                      speed("vy", "same"),
                                      speed("vz", "same, upwards"),
                                      speed("wx", "angular velocity, in the scene's axes"),
                                      speed("wy", "same"),
                                      speed("wz", "same")};

constexpr ArgumentRow kNotify[] = {
    {'i', "streams", "1", 0, 3,
     "1: events, 2: forces (the simulator alone), 3: both; 0 ends them"}};
constexpr ArgumentRow kSync[] = {{'i', "id", "1", -kLastInt - 1, kLastInt, "returned in /synced"}};
constexpr ArgumentRow kDumpOsc[] = {
    {'i', "level", "1", 0, 3, "0: off, 1: text, 2: hexadecimal, 3: both"}};
constexpr ArgumentRow kError[] = {
    {'i', "on", "1", 0, 1, "1: failures are reported in the log, 0: not"}};
constexpr ArgumentRow kMute[] = {{'i', "on", "1", 0, 1, "1: silent, 0: heard"}};
constexpr ArgumentRow kSet[] = {
    text("name", "row of the sound or level of the rig, such as impact/q or rig/hand/gain_db"),
    {'f', "value", "its own", -1e6, 1e6, "where it goes; each name has a range of its own"}};
constexpr ArgumentRow kGet[] = {text("name", "as in /set")};
constexpr ArgumentRow kPreset[] = {
    text("name", "of a sound: one's own or a shipped one, no path"),
    {'f', "seconds", "s", 0, 600, "within which it goes there, 0.02 at least"}};
constexpr ArgumentRow kParam[] = {
    text("name", "live row of the scene, such as detect/bubble_speed"),
    {'f', "value", "its own", -1e6, 1e6, "where it goes; the scene's table has its range"}};
constexpr ArgumentRow kParamAsked[] = {text("name", "same; without a value it is asked for")};
constexpr ArgumentRow kScene[] = {text("name", "of a scene: one's own or a shipped one, no path")};
constexpr ArgumentRow kRig[] = {text("name", "of a rig: one's own or a shipped one, no path")};
constexpr ArgumentRow kRigAt[] = {text("name", "same; empty: the one that it has"),
                                  coordinate("x", "the scene's middle"), coordinate("y", "same"),
                                  coordinate("z", "same, upwards")};
constexpr ArgumentRow kPause[] = {{'i', "on", "1", 0, 1, "1: time stands still, 0: it goes on"}};
constexpr ArgumentRow kTone[] = {{'i', "channel", "1", 0, kLastId, "from 1; 0 ends it"}};
constexpr ArgumentRow kPing[] = {stamp("t0", "sender's clock when it sent the ping")};

constexpr ArgumentRow kDone[] = {
    text("command", "address of the command"),
    optional({'i', "value", "1", -kLastInt - 1, kLastInt, "its result, if it has one"})};
constexpr ArgumentRow kFail[] = {text("command", "address of the command"),
                                 text("reason", "why, and what is allowed; cut at 64 characters")};
constexpr ArgumentRow kValue[] = {text("name", "as in /set and /param"),
                                  {'f', "value", "its own", -1e6, 1e6, "where it goes, or is"}};
constexpr ArgumentRow kSynced[] = {{'i', "id", "1", -kLastInt - 1, kLastInt, "as given to /sync"}};
constexpr ArgumentRow kPong[] = {stamp("t0", "as given to /ping"),
                                 stamp("t1", "answerer's clock when the ping came"),
                                 stamp("t2", "answerer's clock when it sent this")};
constexpr ArgumentRow kVersionReply[] = {text("program", "sim-server or synth-server"),
                                         count_row("major", "version"),
                                         count_row("minor", "version"),
                                         count_row("patch", "version"),
                                         text("branch", "of the source, may be empty"),
                                         text("hash", "of the source, may be empty")};

constexpr ArgumentRow kSynthStatus[] = {
    program("synth-server"),
    count_row("voices", "sounding now"),
    count_row("events", "events taken"),
    count_row("late", "events that came after their moment"),
    count_row("early", "events too far ahead of their moment"),
    count_row("lost", "bundles that never came"),
    count_row("duplicates", "bundles that came twice"),
    count_row("refused", "datagrams stopped by the gate or the address table"),
    count_row("dropped", "events without a free voice or queue place"),
    count_row("xruns", "missed deadlines of the audio device"),
    {'f', "cpu_average", "%", 0, 10000, "rendering time in its block's time, mean"},
    {'f', "cpu_peak", "%", 0, 10000, "rendering time in its block's time, largest"},
    {'f', "sample_rate", "Hz", 0, 1e6, "of the output"},
    count_row("silenced", "blocks the output guard had to silence"),
    {'f', "level", "1", 0, 1, "loudest channel's peak, last half second, part of full scale"},
    count_row("loudest", "number of that channel, from 1; 0: all are silent"),
    count_row("most_voices", "that may sound at once now: fewer where the load is high")};
constexpr ArgumentRow kSimStatus[] = {
    program("sim-server"),
    count_row("particles", "fluid particles in the scene"),
    count_row("steps", "simulation steps done"),
    count_row("impacts", "impacts sent"),
    count_row("bubbles", "bubbles sent"),
    count_row("cavities", "cavities sent"),
    count_row("late", "frames that overran real time"),
    count_row("unsent", "datagrams the network refused"),
    count_row("refused",
              "datagrams stopped by the gate or the address table, and poses that no body took"),
    count_row("resets", "times the solver had to recover"),
    count_row("skipped",
              "frames without a step, and searches of frames for events that were left out"),
    {'f', "real_time_factor", "1", 0, 1e6, "simulated time in wall time, last second"},
    {'f', "steps_per_second", "1/s", 0, 1e6, "last second"},
    {'f', "density_error", "1", 0, 10,
     "mean of what density exceeds that at rest by, as a part of it"},
    count_row("bubble_particles", "bubble particles alive now"),
    count_row("thinned", "bubbles over the scene's bubbles_per_second, told in larger ones")};

constexpr auto kTable = std::to_array<AddressRow>({
    {"/frame", Direction::to_synth, "Opens each bundle; alone in its bundle it is the heartbeat",
     kFrame},
    {"/impact", Direction::to_synth, "A body met the water's surface", kImpact},
    {"/bubble", Direction::to_synth, "A pocket of air was entrapped", kBubble},
    {"/cavity", Direction::to_synth, "The cavity behind a body closed", kCavity},
    {"/force/change", Direction::to_synth,
     "How fast the force on a body changes: what a synth's own recordings have in place of /force",
     kForceChange},
    {"/leave",
     Direction::to_synth,
     "Behind a sender's last /frame: what was sent sounds to its end, and no more is waited for",
     {}},
    {"/body/pose", Direction::to_sim, "Pose of a tracked body", kBodyPose},
    {"/body/pose", Direction::to_sim, "The same, the body by its name", kNamedPose},
    {"/body/grab", Direction::sim_alone,
     "Grabs a body that has a motion of its own, or lets it go; answered by /done", kBodyGrab},
    {"/tile/pressure", Direction::to_sim,
     "What the force sensors of a floor of tiles feel; the last one ends a scan", kPressure},
    {"/force", Direction::subscribers,
     "Force and torque of the water on a body, the mean over a frame", kForce},
    {"/force/rate", Direction::subscribers, "How that depends on the body's speed", kForceRate},
    {"/body/at", Direction::subscribers, "Where such a body is at the frame's end", kBodyPose},
    {"/body/twist", Direction::subscribers, "How it moves then", kBodyTwist},
    {"/notify", Direction::to_both, "Subscribes the sender to streams; answered by /done", kNotify},
    {"/status", Direction::to_both, "Asks for /status.reply", {}},
    {"/version", Direction::to_both, "Asks for /version.reply", {}},
    {"/sync", Direction::to_both, "Answered by /synced when all earlier commands are done", kSync},
    {"/clearSched",
     Direction::to_both,
     "The synth drops what waits for its time; answered by /done",
     {}},
    {"/mute", Direction::synth_alone,
     "Fades all channels out in 20 ms, or opens them within two seconds; answered by /done", kMute},
    {"/set", Direction::synth_alone,
     "Moves a number of the sound or of the rig's levels within 20 ms; answered by /value", kSet},
    {"/get", Direction::synth_alone, "Asks for such a number; answered by /value", kGet},
    {"/preset", Direction::synth_alone, "Goes over to another sound; answered by /done", kPreset},
    {"/tone", Direction::synth_alone,
     "Plays a soft tone of a second on one channel, in place of water; answered by /done", kTone},
    {"/pause", Direction::sim_alone,
     "Simulated time stands still or goes on, what was told sounds to its end; answered by /done",
     kPause},
    {"/reset",
     Direction::sim_alone,
     "The scene begins anew, water, bodies and their own motions; answered by /done",
     {}},
    {"/param", Direction::sim_alone,
     "Sets a live row of the scene from the next frame on; answered by /value", kParam},
    {"/param", Direction::sim_alone, "Asks for such a row; answered by /value", kParamAsked},
    {"/scene", Direction::sim_alone,
     "Goes over to another scene: the program begins anew with it; answered by /done", kScene},
    {"/rig", Direction::synth_alone,
     "Goes over to another rig: the program begins anew with it; answered by /done", kRig},
    {"/rig", Direction::synth_alone,
     "The same, with the middle of a scene, where loudspeakers without a place are heard; answered "
     "by /done",
     kRigAt},
    {"/dumpOSC", Direction::to_both, "Prints incoming packets; answered by /done", kDumpOsc},
    {"/error", Direction::to_both, "Turns the report of failures on or off; answered by /done",
     kError},
    {"/quit", Direction::to_both, "Ends the program; answered by /done; only from loopback", {}},
    {"/ping", Direction::to_both, "Measures the clocks; answered by /pong", kPing},
    {"/done", Direction::reply, "A command was carried out", kDone},
    {"/fail", Direction::reply, "A command was refused", kFail},
    {"/value", Direction::reply,
     "Answers /set, /get and /param, and tells clients of /notify what has changed", kValue},
    {"/synced", Direction::reply, "Answers /sync", kSynced},
    {"/pong", Direction::reply, "Answers /ping", kPong},
    {"/version.reply", Direction::reply, "Answers /version, laid out as scsynth's", kVersionReply},
    {"/status.reply", Direction::reply, "Answers /status: the synth", kSynthStatus},
    {"/status.reply", Direction::reply, "Answers /status: the simulator", kSimStatus},
});

}  // namespace

std::span<const AddressRow> address_table() noexcept {
  return kTable;
}

}  // namespace splash::protocol
