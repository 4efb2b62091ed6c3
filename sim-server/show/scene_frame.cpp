// SPDX-License-Identifier: MIT
#include "sim-server/show/scene_frame.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "protocol/time_tag.hpp"
#include "sim-server/scene/mesh/mesh_solid.hpp"

namespace splash::sim {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::box:
      return "box";
    case ShapeKind::sphere:
      return "sphere";
    case ShapeKind::cylinder:
      return "cylinder";
    case ShapeKind::mesh:
      break;
  }
  return "mesh";
}

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

Json mesh_of(const TriangleMesh& mesh) {
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
          {"mesh", shape.mesh ? mesh_of(shape.mesh->surface) : Json()}};
}

}  // namespace

std::string describe_for_viewers(const Scene& scene, int particles, double spacing) {
  Json json;
  json["scene"] = scene.name;
  json["description"] = scene.description;
  json["particles"] = particles;
  json["spacing"] = spacing;
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
  // A name may have any bytes: those that are no UTF-8 are replaced.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

protocol::ViewFrame scene_frame(const Scene& scene, int particles, double spacing) {
  protocol::FrameWriter writer(protocol::kSceneFrame, protocol::unix_now());
  writer.text(describe_for_viewers(scene, particles, spacing));
  return std::move(writer).take();
}

}  // namespace splash::sim
