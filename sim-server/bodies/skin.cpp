// SPDX-License-Identifier: MIT
#include "sim-server/bodies/skin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "sim-server/bodies/mass.hpp"
#include "sim-server/scene/mesh/mesh_solid.hpp"
#include "sim-server/scene/rotation.hpp"
#include "sim-server/scene/shape.hpp"

namespace splash::sim {
namespace {

constexpr double kPointsMax = 4096.0;

Vector3 normalised(const Vector3& v) {
  const double size = length(v);
  return size > 0.0 ? (1.0 / size) * v : Vector3{0.0, 0.0, 1.0};
}

/// One face of the cube as a grid of points; each quadrilateral gives a quarter to its corners.
void add_face(const Shape& shape, std::size_t axis, double side, double spacing, int owner,
              std::vector<SkinPoint>& skin) {
  const std::size_t a = (axis + 1) % 3;
  const std::size_t b = (axis + 2) % 3;
  const auto steps = [&](std::size_t k) {
    return std::max(static_cast<int>(std::ceil(shape.size[k] / spacing - 1e-9)), 2);
  };
  const int across = steps(a);
  const int along = steps(b);
  std::vector<SkinPoint> points;
  for (int j = 0; j <= along; ++j) {
    for (int i = 0; i <= across; ++i) {
      Vector3 cube;
      cube[axis] = side;
      cube[a] = 2.0 * i / across - 1.0;
      cube[b] = 2.0 * j / along - 1.0;
      points.push_back({from_cube(shape, cube), {0.0, 0.0, 0.0}, 0.0, owner});
    }
  }
  const std::size_t row = static_cast<std::size_t>(across) + 1;
  for (int j = 0; j < along; ++j) {
    for (int i = 0; i < across; ++i) {
      const std::size_t first = static_cast<std::size_t>(j) * row + static_cast<std::size_t>(i);
      const std::array<std::size_t, 4> corner = {first, first + 1, first + row + 1, first + row};
      const Vector3 outwards = 0.5 * side *
                               cross(points[corner[2]].place - points[corner[0]].place,
                                     points[corner[3]].place - points[corner[1]].place);
      for (const std::size_t k : corner) {
        points[k].area += length(outwards) / 4.0;
        points[k].normal = points[k].normal + outwards;
      }
    }
  }
  for (SkinPoint& point : points) point.normal = normalised(point.normal);
  skin.insert(skin.end(), points.begin(), points.end());
}

/// Corners of a mesh's triangles that lie in one cell and look the same way are one point, where
/// the one farthest from the middle is.
class Clusters {
 public:
  Clusters(const Vector3& middle, double cell) : middle_(middle), cell_(cell) {}

  /// A triangle, cut in two across its longest side until it is no larger than a cell.
  void add(const std::array<Vector3, 3>& corner) {
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (side(corner, k) > side(corner, longest)) longest = k;
    }
    const Vector3& from = corner[longest];
    const Vector3& to = corner[(longest + 1) % 3];
    const Vector3& top = corner[(longest + 2) % 3];
    if (side(corner, longest) > cell_) {
      const Vector3 between = 0.5 * (from + to);
      add({from, between, top});
      add({between, to, top});
      return;
    }
    const Vector3 outwards = 0.5 * cross(to - from, top - from);
    for (const Vector3& place : corner) add(place, (1.0 / 3.0) * outwards);
  }

  void give(int owner, std::vector<SkinPoint>& skin) const {
    for (const auto& [key, cluster] : clusters_) {
      skin.push_back({cluster.place, normalised(cluster.outwards), cluster.area, owner});
    }
  }

 private:
  struct Cluster {
    Vector3 place = {0.0, 0.0, 0.0};
    Vector3 outwards = {0.0, 0.0, 0.0};  ///< [m2]
    double area = 0.0;                   ///< [m2]
  };
  using Key = std::array<int, 4>;

  static double side(const std::array<Vector3, 3>& corner, std::size_t k) {
    return length(corner[(k + 1) % 3] - corner[k]);
  }

  void add(const Vector3& place, const Vector3& outwards) {
    Key key = {};
    std::size_t main = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      key[axis] = static_cast<int>(std::floor(place[axis] / cell_));
      if (std::abs(outwards[axis]) > std::abs(outwards[main])) main = axis;
    }
    key[3] = static_cast<int>(2 * main) + (outwards[main] > 0.0 ? 1 : 0);
    Cluster& cluster = clusters_[key];
    if (cluster.area == 0.0 || length(place - middle_) > length(cluster.place - middle_)) {
      cluster.place = place;
    }
    cluster.outwards = cluster.outwards + outwards;
    cluster.area += length(outwards);
  }

  Vector3 middle_;
  double cell_;  ///< [m]
  std::map<Key, Cluster> clusters_;
};

/// Of the box around it [m2].
double box_area(const Shape& shape) {
  return 2.0 * (shape.size[0] * shape.size[1] + shape.size[1] * shape.size[2] +
                shape.size[2] * shape.size[0]);
}

}  // namespace

std::vector<SkinPoint> sample_skin(const Shape& shape, int owner, double spacing) {
  std::vector<SkinPoint> skin;
  if (shape.kind == ShapeKind::mesh) {
    Clusters clusters(0.5 * (shape.mesh->lower + shape.mesh->upper), spacing);
    for (std::size_t t = 0; t < shape.mesh->surface.triangles.size(); ++t) {
      clusters.add(corners(shape.mesh->surface, t));
    }
    clusters.give(owner, skin);
    return skin;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) add_face(shape, axis, side, spacing, owner, skin);
  }
  return skin;
}

std::vector<SkinPoint> sample_skins(const std::vector<BodySettings>& bodies,
                                    double particle_spacing) {
  double area = 0.0;
  for (const BodySettings& body : bodies) area += box_area(body.shape);
  const double spacing = std::max(particle_spacing / 2.0, std::sqrt(area / kPointsMax));
  std::vector<SkinPoint> all;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto skin = sample_skin(bodies[b].shape, static_cast<int>(b), spacing);
    all.insert(all.end(), skin.begin(), skin.end());
  }
  return all;
}

std::vector<SkinFace> film_skin(const Shape& shape, int owner, double particle_spacing) {
  const auto skin = sample_skin(shape, owner, particle_spacing);
  Vector3 open = {0.0, 0.0, 0.0};
  double area = 0.0;
  for (const SkinPoint& point : skin) {
    open = open + point.area * point.normal;
    area += point.area;
  }
  std::vector<SkinFace> faces;
  double volume = 0.0;
  for (const SkinPoint& point : skin) {
    faces.push_back({point.place, point.area * (point.normal - (1.0 / area) * open), owner});
    volume += dot(faces.back().place, faces.back().area) / 3.0;
  }
  for (SkinFace& face : faces) face.area = (volume_of(shape) / volume) * face.area;
  return faces;
}

std::vector<SkinFace> film_skins(const std::vector<BodySettings>& bodies,
                                 const std::vector<FreeBody>& of, double particle_spacing) {
  std::vector<SkinFace> all;
  for (const FreeBody& one : of) {
    const auto b = static_cast<std::size_t>(one.body);
    const auto faces = film_skin(bodies[b].shape, one.body, particle_spacing);
    all.insert(all.end(), faces.begin(), faces.end());
  }
  return all;
}

std::vector<SkinFace> film_skins(const std::vector<BodySettings>& bodies, double particle_spacing) {
  return film_skins(bodies, free_bodies(bodies), particle_spacing);
}

std::vector<double> faces_of(const std::vector<SkinPoint>& skin, std::size_t bodies) {
  std::vector<Vector3> shown(bodies, Vector3{0.0, 0.0, 0.0});
  for (const SkinPoint& point : skin) {
    Vector3& face = shown[static_cast<std::size_t>(point.owner)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      face[axis] += 0.5 * point.area * std::abs(point.normal[axis]);
    }
  }
  std::vector<double> largest;
  for (const Vector3& face : shown) largest.push_back(std::max({face[0], face[1], face[2]}));
  return largest;
}

}  // namespace splash::sim
