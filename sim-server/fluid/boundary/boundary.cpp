// SPDX-License-Identifier: MIT
#include "sim-server/fluid/boundary/boundary.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {

namespace {

void add_mesh(const MeshSolid& solid, BodyShape& shape, std::vector<float>& meshes) {
  const DistanceField& field = solid.field();
  shape.field = static_cast<int>(meshes.size());
  shape.nodes_x = field.nodes[0];
  shape.nodes_y = field.nodes[1];
  shape.nodes_z = field.nodes[2];
  shape.lower_x = as_float(field.lower[0]);
  shape.lower_y = as_float(field.lower[1]);
  shape.lower_z = as_float(field.lower[2]);
  shape.cell = as_float(field.cell);
  meshes.insert(meshes.end(), field.values.begin(), field.values.end());
  shape.vertices = static_cast<int>(meshes.size());
  const std::vector<Vector3>& corners = solid.surface.vertices;
  const std::vector<Vector3>& edges = solid.ridges.edges;
  shape.vertex_count = static_cast<int>(corners.size() + edges.size());
  for (const auto* places : {&corners, &edges}) {
    for (const Vector3& place : *places) {
      for (const double part : place) meshes.push_back(as_float(part));
    }
  }
  if (meshes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()) / 2) {
    throw std::length_error(
        "the meshes of all bodies together are too large; make their scales smaller, or the "
        "spacing of the fluid larger");
  }
}

}  // namespace

Outlines body_outlines(const std::vector<BodySettings>& bodies) {
  Outlines all;
  for (const BodySettings& body : bodies) {
    const Shape& s = body.shape;
    const Vector3 half = farthest_of(s);
    BodyShape shape = {};
    shape.kind = static_cast<int>(s.kind);
    shape.half_x = as_float(half[0]);
    shape.half_y = as_float(half[1]);
    shape.half_z = as_float(half[2]);
    shape.rocker = as_float(s.rocker);
    shape.flat = as_float(s.flat);
    if (s.kind == ShapeKind::mesh) add_mesh(*s.mesh, shape, all.meshes);
    all.shapes.push_back(shape);
  }
  return all;
}

Boundary::Boundary(Device& device, const cl::Program& program, const FluidParams& params,
                   const std::vector<BoundaryPoint>& points, const Outlines& outlines)
    : point_count_(static_cast<int>(points.size())),
      body_count_(static_cast<int>(outlines.shapes.size())),
      shapes_(device, outlines.shapes),
      meshes_(device, outlines.meshes),
      unsorted_(device, points.size()),
      sorted_(device, points.size()),
      grid_(device, program, params, points.size(), std::min(device.profile().sort_chunks, 1)),
      place_bodies_(program, "place_bodies"),
      gather_volumes_(program, "gather_body_volumes") {
  load(device, params, points);
}

void Boundary::load(Device& device, const FluidParams& params,
                    const std::vector<BoundaryPoint>& points) {
  const auto stride = static_cast<std::size_t>(unsorted_.stride);
  std::vector<float> sample(3 * stride, 0.0F);
  std::vector<int> owner(stride, 0);
  std::vector<float> volume(stride, 0.0F);
  // A body is weighed like the fluid it displaces: a particle's mass differs from rho0 spacing^3.
  const float weight = params.layer_weight / params.spacing;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sample[axis * stride + i] = static_cast<float>(points[i].place[axis]);
    }
    owner[i] = points[i].owner;
    volume[i] = weight * static_cast<float>(points[i].volume);
  }
  std::vector<int> ids(points.size());
  std::iota(ids.begin(), ids.end(), 0);
  sample_ = Buffer<float>(device, sample);
  owner_ = Buffer<int>(device, owner);
  sample_volume_ = Buffer<float>(device, volume);
  unsorted_.id.write(device, ids);
  volume_ = Buffer<float>(device, stride + kReadAhead);
}

void Boundary::set_steps(Device& device, const std::vector<BodyStep>& steps) {
  // One step more: where free bodies are when the frame ends.
  const std::size_t room = steps.size() + static_cast<std::size_t>(body_count_);
  if (room > steps_.size() || steps_.size() == 0) {
    steps_ = Buffer<BodyStep>(device, std::max<std::size_t>(2 * room, 1));
  }
  uploaded_ = steps;
  steps_.enqueue_write(device, uploaded_);
}

void Boundary::release(Device& device, const std::vector<FreeBody>& bodies) {
  std::vector<BodyShape> shapes = shapes_.read(device, static_cast<std::size_t>(body_count_));
  for (const FreeBody& body : bodies) shapes[static_cast<std::size_t>(body.body)].free = 1;
  shapes_.write(device, shapes);
}

void Boundary::place(cl::CommandQueue& queue, const Buffer<FluidParams>& params, const Step& step) {
  if (point_count_ == 0) return;
  const auto points = static_cast<std::size_t>(point_count_);
  place_bodies_.run(queue, points,
                    {{"points", point_count_},
                     {"stride", unsorted_.stride},
                     {"sample", sample_},
                     {"owner", owner_},
                     {"position", unsorted_.position},
                     {"velocity", unsorted_.velocity}},
                    steps_at(step));
  grid_.sort(queue, params, point_count_, unsorted_, sorted_);
  gather_volumes_.run(queue, points,
                      {{"points", point_count_},
                       {"id", sorted_.id},
                       {"volume", sample_volume_},
                       {"owner", owner_},
                       {"sorted_volume", volume_}},
                      steps_at(step));
}

}  // namespace splash::sim
