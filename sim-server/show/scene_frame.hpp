// SPDX-License-Identifier: MIT
// What of a scene stays the same, as a viewer gets it (view-server/README.md, SPC1).
#pragma once

#include <string>
#include <vector>

#include "protocol/frame.hpp"
#include "sim-server/scene/live_rows.hpp"
#include "sim-server/scene/mesh/triangle_mesh.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

/// The surface of a body as triangles, in its own axes, closed. A mesh's own, else the surface of a
/// cube carried to the shape.
[[nodiscard]] TriangleMesh body_mesh(const Shape& shape);

/// JSON. `particles`: of water, as there are; `spacing`: between them [m]; `rows`: the live ones.
[[nodiscard]] std::string describe_for_viewers(const Scene& scene, int particles, double spacing,
                                               const std::vector<LiveRow>& rows = {});

[[nodiscard]] protocol::ViewFrame scene_frame(const Scene& scene, int particles, double spacing,
                                              const std::vector<LiveRow>& rows = {});

}  // namespace splash::sim
