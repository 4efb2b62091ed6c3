// SPDX-License-Identifier: MIT
#include "sim-server/scene/scene_reader.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "program/config.hpp"
#include "program/text.hpp"
#include "sim-server/scene/mapping_readers.hpp"
#include "sim-server/scene/mesh/mesh_file.hpp"
#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/mesh/soundness.hpp"
#include "sim-server/scene/pace.hpp"
#include "sim-server/scene/resolution.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/scene_rules.hpp"
#include "sim-server/scene/scene_table.hpp"
#include "sim-server/scene/shape.hpp"
#include "sim-server/scene/solver_choice.hpp"

namespace splash::sim {

namespace {

using program::ConfigMap;

/// A file's path, made absolute by the scene's folder.
std::filesystem::path find_file(const ConfigMap& map, const std::string& key,
                                const std::string& name) {
  if (name.empty()) return {};
  std::filesystem::path path = map.folder() / name;
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::is_regular_file(status)) return path;
  constexpr std::size_t kShown = 200;  // characters
  const std::string shown = program::printable(path.string(), kShown);
  const bool found = status.type() != std::filesystem::file_type::not_found;
  if (found && error) throw map.error(key, shown + " cannot be read: " + error.message());
  throw map.error(key,
                  "there is no file " + shown + " (a relative name begins in the scene's folder)");
}

/// A free body turns about its centre of mass: that becomes its origin, and it rests where the
/// file's own origin was meant to. A device that it hangs on still says where that origin is.
Shape read_mesh_shape(const ConfigMap& map, double spacing, BodySettings& body) {
  MeshEntry entry;
  map.read(mesh_fields(), {}, entry);
  const auto path = find_file(map, "mesh", entry.mesh);
  if (path.empty()) throw map.error("mesh", "must not be empty");
  TriangleMesh surface = read_mesh(path, entry.scale);
  if (is_free(body)) {
    check_soundness(surface);
    const Vector3 centre = mesh_mass(surface).centre;
    move_mesh(surface, -1.0 * centre);
    body.rest.position = body.rest.position + rotate(body.rest.rotation, centre);
    if (is_tied(body)) body.centre = centre;
  }
  return mesh_shape(make_solid(std::move(surface), spacing));
}

Shape read_shape(const ConfigMap& map) {
  ShapeEntry entry;
  map.read(shape_fields(), {}, entry);
  entry.kind = shape_kind(entry.kind_spelled);
  check_shape(map, entry);
  return entry;
}

std::vector<Keyframe> read_keyframes(const ConfigMap& motion) {
  std::vector<Keyframe> keyframes;
  for (const ConfigMap& map : motion.list("keyframes")) {
    Keyframe keyframe;
    map.read(keyframe_fields(), {}, keyframe);
    keyframe.rotation = checked_rotation(map, keyframe.rotation);
    if (!keyframes.empty() && keyframe.time <= keyframes.back().time) {
      throw map.error("time", "is not later than that of the keyframe before");
    }
    if (!keyframes.empty()) {
      const std::string fast = too_fast(keyframes.back(), keyframe, kScriptedPace);
      if (!fast.empty()) throw map.error("time", fast + " since the keyframe before");
    }
    keyframes.push_back(keyframe);
  }
  return keyframes;
}

/// A key that this kind of motion does not use is a mistake, not a no-op.
void refuse_foreign_keys(const ConfigMap& map, const MotionEntry& entry) {
  const std::string& kind = entry.kind_spelled;
  const std::string meaningless = "has no meaning for a motion of kind " + kind;
  if (map.has("keyframes") && entry.kind != MotionKind::script) {
    throw map.error("keyframes", meaningless);
  }
  const bool spring = entry.kind == MotionKind::osc && entry.coupling == CouplingKind::spring;
  const auto* row = foreign_key(map, motion_fields(), {kind, spring ? "spring" : kind});
  if (row == nullptr) return;
  const auto& users = row->kinds;
  const bool wants_spring = entry.kind == MotionKind::osc &&
                            std::find(users.begin(), users.end(), "spring") != users.end();
  throw map.error(row->key, meaningless + (wants_spring ? " without coupling: spring" : ""));
}

/// Bits of what is held.
int read_held(const ConfigMap& map, const std::vector<std::string>& names) {
  static const std::vector<std::string> kNames = {"x", "y", "z", "rx", "ry", "rz"};
  int held = 0;
  for (const std::string& name : names) {
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    if (found == kNames.end()) {
      throw map.error("held", "'" + name + "' must be one of x, y, z, rx, ry and rz");
    }
    held |= 1 << (found - kNames.begin());
  }
  return held;
}

void check_markers(const ConfigMap& map, const MotionEntry& entry) {
  if (entry.markers.size() < 3) {
    throw map.error("markers", "a trc motion needs three or more (got " +
                                   std::to_string(entry.markers.size()) + ")");
  }
  const std::set<std::string> names(entry.markers.begin(), entry.markers.end());
  if (names.size() < entry.markers.size()) throw map.error("markers", "names a marker twice");
}

MotionSettings read_motion(const ConfigMap& map) {
  MotionEntry entry;
  map.read(motion_fields(), {"keyframes"}, entry);
  entry.kind = motion_kinds().at(entry.kind_spelled);
  if (entry.coupling_spelled == "spring") entry.coupling = CouplingKind::spring;
  refuse_foreign_keys(map, entry);
  entry.keyframes = read_keyframes(map);
  if (entry.kind == MotionKind::script && entry.keyframes.empty()) {
    throw map.error("keyframes", "a scripted motion needs at least one");
  }
  if (entry.kind == MotionKind::csv && entry.file_spelled.empty()) {
    throw map.error("file", "a csv motion needs one");
  }
  if (entry.kind == MotionKind::trc) check_markers(map, entry);
  entry.gap = entry.gap_spelled == "hold" ? GapKind::hold : GapKind::bridge;
  if (entry.gap == GapKind::hold && map.has("gap_limit")) {
    throw map.error("gap_limit", "has no meaning where a gap is held; gap: bridge needs it");
  }
  const bool spring = entry.coupling == CouplingKind::spring;
  entry.held = read_held(map, entry.held_spelled);
  if (entry.kind == MotionKind::free || spring) check_free(map, entry);
  if (spring) check_spring(map, entry);
  entry.file = find_file(map, "file", entry.file_spelled);
  return entry;
}

void read_rest(const ConfigMap& map, BodySettings& body) {
  const MotionKind kind = body.motion.kind;
  const bool needed = kind == MotionKind::fixed || kind == MotionKind::osc ||
                      kind == MotionKind::free || is_felt(body);
  if (needed) {
    const ConfigMap rest = map.child("rest");
    rest.read(rest_fields(), {}, body.rest);
    body.rest.rotation = checked_rotation(rest, body.rest.rotation);
    return;
  }
  if (map.has("rest")) throw map.error("rest", "the motion already says where the body is");
  if (!body.motion.keyframes.empty()) body.rest = body.motion.keyframes.front();
}

BodySettings read_body(const ConfigMap& map, double spacing) {
  BodySettings body;
  map.read(body_fields(), {"shape", "rest", "motion"}, body);
  if (body.name.empty()) throw map.error("name", "must not be empty");
  const ConfigMap shape = map.child("shape");
  const bool is_mesh = shape.has("mesh");
  if (!is_mesh) body.shape = read_shape(shape);
  if (const auto motion = map.optional_child("motion")) body.motion = read_motion(*motion);
  read_rest(map, body);
  if (is_mesh) body.shape = read_mesh_shape(shape, spacing, body);
  if (is_mesh && body.motion.sole) {
    throw map.child("motion").error("sole", "only a box has a sole, not a mesh");
  }
  if (is_free(body) && body.shape.rocker > 0.0) {
    throw map.child("shape").error("rocker", "a free body cannot have a curved sole");
  }
  return body;
}

void read_frictions(const ConfigMap& map, Scene& scene) {
  const auto index_of = [&](const ConfigMap& entry, const std::string& name) {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      if (scene.bodies[b].name == name) return static_cast<int>(b);
    }
    if (name == "walls") return -1;
    throw entry.error("between", "there is no body named '" + name + "', and it is not `walls`");
  };
  const auto is_free_one = [&](int body) {
    return body >= 0 && is_free(scene.bodies[static_cast<std::size_t>(body)]);
  };
  for (const ConfigMap& entry : map.list("frictions")) {
    FrictionEntry pair;
    entry.read(friction_fields(), {}, pair);
    if (pair.between_spelled.size() != 2) {
      throw entry.error("between", "names two, not " + std::to_string(pair.between_spelled.size()));
    }
    pair.one = index_of(entry, pair.between_spelled[0]);
    pair.other = index_of(entry, pair.between_spelled[1]);
    if (pair.one == pair.other) throw entry.error("between", "names the same twice");
    if (!is_free_one(pair.one) && !is_free_one(pair.other)) {
      throw entry.error("between", "names no free body: what goes its way feels no friction");
    }
    scene.frictions.push_back(pair);
  }
}

void read_bodies(const ConfigMap& map, Scene& scene) {
  std::set<std::string> names;
  int free = 0;
  for (const ConfigMap& entry : map.list("bodies")) {
    scene.bodies.push_back(read_body(entry, particle_spacing(scene)));
    if (scene.bodies.size() > kBodiesMax) {
      throw entry.error("name", "this is body " + std::to_string(scene.bodies.size()) +
                                    ", and events tell of " + std::to_string(kBodiesMax) +
                                    " at most");
    }
    if (is_free(scene.bodies.back()) && ++free > kFreeBodiesMax) {
      throw entry.error("motion", "more than " + std::to_string(kFreeBodiesMax) +
                                      " bodies are free: each of them costs every step");
    }
    // A mesh has the axes of its file, whose origin may be anywhere.
    if (is_free(scene.bodies.back()) && scene.bodies.back().shape.kind != ShapeKind::mesh) {
      check_place(entry, scene.bodies.back().rest.position, scene.tank);
    }
    const std::string& name = scene.bodies.back().name;
    if (!names.insert(name).second) {
      throw entry.error("name", "there is another body named '" + name + "'");
    }
  }
}

void read_tank_motion(const ConfigMap& map, TankMotionSettings& motion) {
  map.read(tank_motion_fields(), {"samples"}, motion);
  motion.present = true;
  for (const ConfigMap& entry : map.list("samples")) {
    TankSample sample;
    entry.read(tank_sample_fields(), {}, sample);
    if (!motion.samples.empty() && sample.time <= motion.samples.back().time) {
      throw entry.error("time", "is not later than that of the sample before");
    }
    motion.samples.push_back(sample);
  }
  check_tank_motion(map, motion);
}

void read_basin(const ConfigMap& map, Scene& scene) {
  const ConfigMap tank = map.child("tank");
  tank.read(tank_fields(), {}, scene.tank);
  check_tank(tank, scene.tank);
  if (const auto slope = map.optional_child("slope")) {
    slope->read(slope_fields(), {}, scene.slope);
    scene.slope.present = true;
    check_slope(*slope, scene.slope, scene.tank);
  }
  if (const auto maker = map.optional_child("wave_maker")) {
    maker->read(wave_maker_fields(), {}, scene.wave_maker);
    scene.wave_maker.present = true;
    check_wave_maker(*maker, scene.wave_maker, scene.tank);
  }
  if (const auto motion = map.optional_child("tank_motion")) {
    read_tank_motion(*motion, scene.tank_motion);
  }
  read_water(map, scene);
  read_flow(map, scene);
}

FluidEntry read_fluid(const ConfigMap& map) {
  static const std::map<std::string, PressureKind> kSolvers = {
      {"weakly_compressible", PressureKind::weakly_compressible},
      {"grid_projected", PressureKind::grid_projected},
      {"auto", PressureKind::weakly_compressible}};  // until all of the scene is known
  static const std::map<std::string, SettleKind> kSettling = {{"auto", SettleKind::automatic},
                                                              {"always", SettleKind::always},
                                                              {"never", SettleKind::never}};
  FluidEntry entry;
  map.read(fluid_fields(), {}, entry);
  entry.solver = kSolvers.at(entry.solver_spelled);
  entry.settle = kSettling.at(entry.settle_spelled);
  entry.kernels = entry.kernels_spelled == "reference" ? KernelKind::reference : KernelKind::vector;
  return entry;
}

/// Where a foot that a floor feels is just out of the water, and whether there is such a floor. It
/// stands on the floor already when that is known, so it begins as near as it does not yet touch,
/// but so far from the floor that it falls for a frame.
void find_hovers(const ConfigMap& map, Scene& scene) {
  const std::vector<ConfigMap> entries = map.list("bodies");
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    BodySettings& body = scene.bodies[b];
    if (!is_felt(body)) continue;
    const bool tiles = body.motion.kind == MotionKind::pressure;
    const auto& sources = scene.tracking.sources;
    const bool told = tiles ? scene.tracking.floor.present
                            : std::any_of(sources.begin(), sources.end(),
                                          [&](const auto& source) { return source.body == b; });
    if (!told) {
      throw entries[b].error("motion", tiles ? "needs a `floor` in the scene's `tracking`"
                                             : "needs a source with preset: tuio in the scene's "
                                               "`tracking`");
    }
    double sole = body.rest.position[2];
    for (std::size_t i = 0; i < 3; ++i) {
      Vector3 edge = {0.0, 0.0, 0.0};
      edge[i] = 0.5 * body.shape.size[i];
      sole -= std::abs(rotate(body.rest.rotation, edge)[2]);
    }
    double surface = sole;
    for (const WaterBlock& water : scene.water) surface = std::max(surface, water.upper[2]);
    body.motion.hover = std::max(surface - sole + kSurfaceRoughness * particle_spacing(scene),
                                 body.motion.fall / scene.serve.frame_rate);
  }
}

/// Whoever confuses the two kinds of file is told so, not that a key is unknown.
void refuse_rig(const ConfigMap& map) {
  if (!map.has("outputs") || map.has("tank") || map.has("fluid")) return;
  throw map.error("outputs",
                  "this is a rig, which says what synth-server drives (--rig); a scene is wanted "
                  "here, which says what sim-server simulates, e.g. configs/scenes/basin.yaml");
}

Scene build(const ConfigMap& map, const std::string& file_stem) {
  refuse_rig(map);
  Scene scene;
  map.read(scene_fields(),
           {"fluid", "tank", "slope", "wave_maker", "tank_motion", "water", "gate", "flow",
            "bodies", "frictions", "gauges", "detect", "skip", "serve", "tracking"},
           scene);
  if (scene.name.empty()) scene.name = file_stem;
  read_basin(map, scene);
  const ConfigMap fluid = map.child("fluid");
  const FluidEntry entry = read_fluid(fluid);
  scene.fluid = entry;
  check_resolution(fluid, scene);
  read_bodies(map, scene);
  read_frictions(map, scene);
  if (entry.solver_spelled == "auto") scene.fluid.solver = suitable_solver(scene).solver;
  check_solver(fluid, scene.fluid);
  check_time_step(fluid, scene.fluid);
  if (scene.tank_motion.present) check_turning(map.child("tank_motion"), scene);
  check_sound(fluid, scene);
  if (const auto gauges = map.optional_child("gauges")) {
    scene.gauges = read_gauges(*gauges, scene);
  }
  if (const auto skip = map.optional_child("skip")) skip->read(skip_fields(), {}, scene.skip);
  if (const auto detect = map.optional_child("detect")) {
    detect->read(detect_fields(), {}, scene.detect);
    check_detect(*detect, scene.detect);
  }
  if (const auto serve = map.optional_child("serve")) serve->read(serve_fields(), {}, scene.serve);
  if (const auto tracking = map.optional_child("tracking")) {
    scene.tracking = read_tracking(*tracking, scene);
  }
  find_hovers(map, scene);
  const std::vector<ConfigMap> entries = map.list("bodies");
  for (std::size_t b = 0; b < entries.size(); ++b) {
    if (is_tied(scene.bodies[b])) {
      check_passivity(entries[b].child("motion"), scene.bodies[b].motion, scene.serve.frame_rate);
    }
  }
  return scene;
}

}  // namespace

Scene read_scene(const std::filesystem::path& path) {
  return build(ConfigMap::load(path), path.stem().string());
}

Scene parse_scene(const std::string& text, const std::string& file_name) {
  return build(ConfigMap::parse(text, file_name), std::filesystem::path(file_name).stem().string());
}

}  // namespace splash::sim
