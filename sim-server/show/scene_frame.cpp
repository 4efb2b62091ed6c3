// SPDX-License-Identifier: MIT
#include "sim-server/show/scene_frame.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "program/config_file.hpp"
#include "protocol/time_tag.hpp"
#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"
#include "sim-server/scene/solver_choice.hpp"

namespace splash::sim {
namespace {

/// As near to the surface are the middles of quadrilaterals [part of the largest size].
constexpr double kNear = 0.005;
/// Quadrilaterals along an edge of the cube, at most.
constexpr int kMost = 16;

struct Carried {
  TriangleMesh mesh;
  double off = 0.0;  ///< farthest of a quadrilateral's middle from that of its part of the cube [m]
};

void add_face(const Shape& shape, int along, std::size_t axis, double side, Carried& all) {
  const auto at = [&](double i, double k) {
    Vector3 cube;
    cube[axis] = side;
    cube[(axis + 1) % 3] = side * (2.0 * i / along - 1.0);
    cube[(axis + 2) % 3] = 2.0 * k / along - 1.0;
    return from_cube(shape, cube);
  };
  for (int i = 0; i < along; ++i) {
    for (int k = 0; k < along; ++k) {
      const auto first = static_cast<int>(all.mesh.vertices.size());
      all.mesh.vertices.insert(all.mesh.vertices.end(),
                               {at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
      all.mesh.triangles.push_back({first, first + 1, first + 2});
      all.mesh.triangles.push_back({first, first + 2, first + 3});
      Vector3 middle = {0.0, 0.0, 0.0};
      for (auto corner = all.mesh.vertices.end() - 4; corner != all.mesh.vertices.end(); ++corner) {
        middle = middle + 0.25 * *corner;
      }
      all.off = std::max(all.off, length(at(i + 0.5, k + 0.5) - middle));
    }
  }
}

Carried carried_cube(const Shape& shape, int along) {
  Carried all;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) add_face(shape, along, axis, side, all);
  }
  join_equal_vertices(all.mesh);
  return all;
}

using Json = nlohmann::ordered_json;

std::string name_of(MotionKind kind) {
  const auto& kinds = motion_kinds();
  return std::find_if(kinds.begin(), kinds.end(),
                      [&](const auto& known) { return known.second == kind; })
      ->first;
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

TriangleMesh body_mesh(const Shape& shape) {
  if (shape.kind == ShapeKind::mesh) return shape.mesh->surface;
  const double near = kNear * std::max({shape.size[0], shape.size[1], shape.size[2]});
  int along = 1;
  Carried carried = carried_cube(shape, along);
  while (carried.off > near && along < kMost) carried = carried_cube(shape, along *= 2);
  return carried.mesh;
}

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
