// SPDX-License-Identifier: MIT
#include "sim-server/show/scene_frame.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "program/config_file.hpp"
#include "protocol/time_tag.hpp"
#include "sim-server/scene/shape.hpp"
#include "sim-server/scene/solver_choice.hpp"
#include "sim-server/show/body_mesh.hpp"

namespace splash::sim {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(MotionKind kind) {
  switch (kind) {
    case MotionKind::fixed:
      return "fixed";
    case MotionKind::script:
      return "script";
    case MotionKind::csv:
      return "csv";
    case MotionKind::trc:
      return "trc";
    case MotionKind::osc:
      return "osc";
    case MotionKind::touch:
      return "touch";
    case MotionKind::pressure:
      return "pressure";
    case MotionKind::free:
      break;
  }
  return "free";
}

Json json_of(const TriangleMesh& mesh) {
  Json vertices = Json::array();
  for (const Vector3& vertex : mesh.vertices) {
    for (const double x : vertex) vertices.push_back(1e-6 * std::round(1e6 * x));
  }
  Json triangles = Json::array();
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle) triangles.push_back(corner);
  }
  return {{"vertices", vertices}, {"triangles", triangles}};
}

Json body_of(const BodySettings& body) {
  const Shape& shape = body.shape;
  return {{"name", body.name},
          {"motion", name_of(body.motion.kind)},
          {"kind", name_of(shape.kind)},
          {"size", shape.size},
          {"rocker", shape.rocker},
          {"flat", shape.flat},
          {"mesh", json_of(body_mesh(shape))}};
}

/// Where a slider of even steps would spend few of them on what is mostly wanted.
constexpr double kWide = 50.0;  ///< largest by smallest value

Json row_of(const LiveRow& live) {
  const program::Row& row = *live.row;
  const double min = live.is_switch ? 0.0 : row.min;
  const double max = live.is_switch ? 1.0 : row.max;
  return {{"name", live.name},
          {"min", min},
          {"max", max},
          {"value", live.value},
          {"logarithmic", min > 0.0 && max / min > kWide},
          {"power", min == 0.0 && max > 1.0 ? 3 : 1},
          {"switch", live.is_switch},
          {"unit", row.unit.empty() ? "1" : row.unit},
          {"meaning", row.meaning}};
}

}  // namespace

std::string describe_for_viewers(const Scene& scene, int particles, double spacing,
                                 const std::vector<LiveRow>& rows) {
  Json json;
  json["scene"] = scene.name;
  json["description"] = scene.description;
  json["particles"] = particles;
  json["spacing"] = spacing;
  json["solver"] = name_of(scene.fluid.solver);
  json["frame_rate"] = scene.serve.frame_rate;
  json["tank"] = {{"lower", scene.tank.lower}, {"upper", scene.tank.upper}};
  json["slope"] = nullptr;
  if (scene.slope.present) {
    json["slope"] = {{"foot", scene.slope.foot}, {"gradient", scene.slope.gradient}};
  }
  json["wave_maker"] = nullptr;
  if (scene.wave_maker.present) {
    json["wave_maker"] = {{"stroke", scene.wave_maker.stroke}, {"period", scene.wave_maker.period}};
  }
  json["bodies"] = Json::array();
  for (const BodySettings& body : scene.bodies) json["bodies"].push_back(body_of(body));
  json["rows"] = Json::array();
  for (const LiveRow& row : rows) json["rows"].push_back(row_of(row));
  json["scenes"] = Json::array();
  for (const auto& [name, description] : program::list_configs("scenes")) {
    json["scenes"].push_back({{"name", name}, {"description", description}});
  }
  // A name may have any bytes: those that are no UTF-8 are replaced.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

protocol::ViewFrame scene_frame(const Scene& scene, int particles, double spacing,
                                const std::vector<LiveRow>& rows) {
  protocol::FrameWriter writer(protocol::kSceneFrame, protocol::unix_now());
  writer.text(describe_for_viewers(scene, particles, spacing, rows));
  return std::move(writer).take();
}

}  // namespace splash::sim
