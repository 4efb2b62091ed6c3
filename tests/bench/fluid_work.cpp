// SPDX-License-Identifier: MIT
#include "tests/bench/fluid_work.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace splash::bench {
namespace {

using namespace splash::sim;

struct Box {
  float lower[3], upper[3];  ///< [m]
};

class Search {
 public:
  /// Of points `where`, whose cells begin at `start`, with `lanes` particles to a work-item.
  Search(const Places& places, int lanes, const std::vector<float>& where,
         const std::vector<int>& start)
      : p_(places), lanes_(lanes), where_(where), start_(start) {}

  /// `near_bodies`: by those turns alone.
  Met all(bool near_bodies) {
    each_turn(p_, lanes_, [&](int row, int first, int last) {
      const Box around = box(first, last);
      if (!near_bodies || is_near_bodies(around)) meet(row, first, last, around);
    });
    return met_;
  }

  /// Whether the box around these particles is near a body.
  [[nodiscard]] bool is_near(int first, int last) const { return is_near_bodies(box(first, last)); }

  /// Calls `turn(row, first, last)`: a work-item goes up to its last particle, or the row's.
  template <class Turn>
  static void each_turn(const Places& p, int lanes, const Turn& turn) {
    const int slices = SPLASH_SLICES * p.params.cells_x;
    const int rows = p.params.cells_y * p.params.cells_z;
    const auto start = [&](int cell) { return p.cell_start[static_cast<std::size_t>(cell)]; };
    for (int row = 0; row < rows; ++row) {
      const int end = start((row + 1) * slices);
      for (int first = start(row * slices); first < end;) {
        const int last = std::min((first / lanes + 1) * lanes, end);
        turn(row, first, last);
        first = last;
      }
    }
  }

 private:
  [[nodiscard]] int start(int cell) const { return start_[static_cast<std::size_t>(cell)]; }
  [[nodiscard]] float at(int axis, int i) const { return part(p_.position, axis, i); }
  static float part(const std::vector<float>& parts, int axis, int i) {
    const std::size_t stride = parts.size() / 3;
    return parts[static_cast<std::size_t>(axis) * stride + static_cast<std::size_t>(i)];
  }
  [[nodiscard]] int slice(int i) const {
    const FluidParams& s = p_.params;
    const float cell =
        std::clamp((at(0, i) - s.origin_x) * s.inverse_cell, 1.0F, static_cast<float>(s.cells_x));
    return std::min(static_cast<int>(cell * SPLASH_SLICES), (s.cells_x - 1) * SPLASH_SLICES - 1);
  }
  [[nodiscard]] Box box(int first, int last) const {
    Box box{};
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = box.upper[axis] = at(axis, first);
      for (int i = first; i < last; ++i) {
        box.lower[axis] = std::min(box.lower[axis], at(axis, i));
        box.upper[axis] = std::max(box.upper[axis], at(axis, i));
      }
    }
    return box;
  }
  [[nodiscard]] bool is_near_bodies(const Box& box) const {
    return std::any_of(p_.bodies.begin(), p_.bodies.end(), [&](const BodyStep& b) {
      return box.upper[0] > b.lower_x && box.lower[0] < b.upper_x && box.upper[1] > b.lower_y &&
             box.lower[1] < b.upper_y && box.upper[2] > b.lower_z && box.lower[2] < b.upper_z;
    });
  }
  [[nodiscard]] bool is_near(const Box& box, int j) const {
    float apart2 = 0.0F;
    for (int axis = 0; axis < 3; ++axis) {
      const float x = part(where_, axis, j);
      const float apart = std::max({box.lower[axis] - x, x - box.upper[axis], 0.0F});
      apart2 += apart * apart;
    }
    return apart2 < p_.params.support * p_.params.support;
  }

  void meet(int row, int first, int last, const Box& around) {
    const int slices = SPLASH_SLICES * p_.params.cells_x;
    const int from = slice(first) - SPLASH_SLICES;
    const int to = slice(last - 1) + SPLASH_SLICES + 1;
    ++met_.turns;
    for (int k = 0; k < 9; ++k) {
      const int base = (row + (k / 3 - 1) * p_.params.cells_y + k % 3 - 1) * slices;
      const int begin = start(base + from);
      const int end = start(base + to);
      if (lanes_ == 1) {
        met_.visited += end - begin;
        continue;
      }
      const int vectors = (end - begin + lanes_ - 1) / lanes_;
      met_.tested += vectors * lanes_;
      for (int j = begin; j < end; ++j) met_.visited += is_near(around, j) ? lanes_ : 0;
    }
  }

  const Places& p_;
  int lanes_;
  const std::vector<float>& where_;
  const std::vector<int>& start_;
  Met met_;
};

// Operations of the formulas, as the kernels write them (density.cl, acceleration.cl, near.h): two
// to an instruction, fused or not, as compilers leave them. And the numbers that they load of a
// neighbour: a CPU does that beside its arithmetic, a GPU instead.
constexpr double kOfTest = 56.0, kOfDensity = 30.0, kOfForce = 68.0;
constexpr double kLoadsOfDensity = 3.0, kLoadsOfForce = 7.0;
// Of a body's point: what walls.h calls its share, and how it rubs (acceleration.cl).
constexpr double kOfBodyDensity = kOfDensity + 2.0, kOfBodyForce = kOfForce + 24.0;
// Of a particle besides its pairs (group.h, density.cl: the state equation); what a vector's least
// number takes of each of its lanes (lanes.h), of which a group's box has six.
constexpr double kOfParticle = 50.0, kOfLeast = 16.0, kOfBox = 6.0 * kOfLeast;
// Of a wall: how far it is (walls.h), and what is behind it, in three layers of two polynomials; of
// a body's face (body_face.h) and of the image behind it (body_image.h), twice what a wall is.
constexpr double kOfWall = 8.0, kOfBehind = 150.0, kOfFace = 130.0, kOfImage = 2.0 * kOfBehind;
// Of a particle that moves on (integrate.cl), of one whose health is looked at (health.cl).
constexpr double kOfMotion = 80.0, kOfHealth = 200.0;
// Scalar instructions: of a turn (group.h, rest.h), of a run (grid.h, near.h: two addresses and
// look-ups, where to go on), of a point's cell (grid.h) with its loads and store, of a point that
// is moved alone (points.h: eight numbers in and out) or a vector that stays together, of a point's
// place in the sort, of a number that is fetched from where its particle was (sleep.h, health.cl),
// of a box that is held against a body's (bodies.h).
constexpr double kOfTurn = 100.0, kOfRun = 25.0, kOfCell = 28.0, kOfMove = 16.0, kOfPlace = 4.0;
constexpr double kOfFetch = 4.0, kOfNearness = 14.0;
// Of a particle that is held against a body, where it is alone (keep_out.h: two rotations, a
// depth).
constexpr double kOfLeaving = 200.0;

double share(double work, double rate) {
  return work > 0.0 && rate > 0.0 ? work / rate : 0.0;
}

/// `scalar` instructions of a CPU: on a GPU operations as the others, two to each.
void add_scalar(Work& work, double scalar, const sim::Profile& profile) {
  (profile.lanes > 1 ? work.scalar : work.operations) += profile.lanes > 1 ? scalar : 2.0 * scalar;
}

/// What both pair loops have in common beside their pairs.
Work search_work(const Met& met, const sim::Profile& profile) {
  // The list of those found is gone through, too.
  const double found = profile.lanes > 1 ? met.turns : 0.0;
  Work work = {.operations = kOfTest * met.tested, .runs = 9.0 * met.turns + found};
  add_scalar(work, kOfTurn * met.turns + kOfRun * 9.0 * met.turns, profile);
  return work;
}

double pairs_work(double pairs, double operations, double loads, const sim::Profile& profile) {
  return pairs * (operations + (profile.lanes > 1 ? 0.0 : 2.0 * loads));
}

/// Particles of the vectors whose box is near a body, ends of two rows or not (keep_out.h).
double held_against_bodies(const Places& p, int lanes) {
  double held = 0.0;
  for (int i = 0; i < p.params.count; i += lanes) {
    held += Search(p, lanes, p.body_position, p.body_start)
                    .is_near(i, std::min(i + lanes, p.params.count))
                ? lanes
                : 0.0;
  }
  return held;
}

/// Groups of particles that were next to each other before the sort, too (health.cl).
double fetched_alone(const Places& p, std::size_t lanes) {
  const std::size_t count = p.source.size();
  if (lanes == 1) return 0.0;
  double alone = 0.0;
  for (std::size_t i = 0; i < count; i += lanes) {
    bool together = i + lanes <= count;
    for (std::size_t k = 1; together && k < lanes; ++k) {
      together = p.source[i + k] == p.source[i] + static_cast<int>(k);
    }
    alone += together ? 0.0 : static_cast<double>(lanes);
  }
  return alone;
}

int used_cells(const std::vector<int>& cell_start) {
  const auto full = std::find(cell_start.begin(), cell_start.end(), cell_start.back());
  return static_cast<int>(full - cell_start.begin());
}

/// `turns`: of the search among particles.
void add_bodies(std::map<std::string, Work>& all, const Places& p, double turns,
                const sim::Profile& profile) {
  const double points = static_cast<double>(p.body_position.size()) / 3.0;
  if (points == 0.0) return;
  const auto bodies = static_cast<double>(p.bodies.size());
  const Met met = meet_bodies(p, profile.lanes);
  const double near = met.turns * profile.lanes;
  Work& density = all["compute_density"];
  Work& forces = all["compute_acceleration"];
  add_scalar(density, 2.0 * kOfNearness * bodies * turns, profile);
  add_scalar(forces, kOfNearness * bodies * turns, profile);
  add_scalar(all["integrate"], kOfNearness * bodies * turns, profile);
  if (profile.lanes > 1) {
    all["integrate"].held = bodies * held_against_bodies(p, profile.lanes);
  } else {
    all["integrate"].operations += kOfLeaving * bodies * near;
  }
  const Work search = search_work(met, profile);
  for (const auto& [work, operations, loads] :
       {std::tuple{&density, kOfBodyDensity, kLoadsOfDensity + 1.0},
        std::tuple{&forces, kOfBodyForce, kLoadsOfForce + 1.0}}) {
    work->operations += search.operations + pairs_work(met.visited, operations, loads, profile);
    work->scalar += search.scalar;
    work->runs += search.runs;
  }
  density.operations += near * (bodies * kOfFace + kOfImage);
  density.bytes += 20.0 * near;
  forces.bytes += 20.0 * near;
  const double groups = std::ceil(points / 64.0);
  all["place_bodies"] = {.groups = groups, .bytes = 44.0 * points};
  add_scalar(all["place_bodies"], 80.0 * points, profile);
  all["gather_body_volumes"] = {.groups = groups, .bytes = 16.0 * points};
  add_scalar(all["gather_body_volumes"], 20.0 * points, profile);
  const auto cells = static_cast<double>(p.body_start.size());
  for (const auto& [name, work] :
       sort_work({points, cells, static_cast<double>(used_cells(p.body_start)),
                  std::min(1.0, static_cast<double>(profile.sort_chunks)), points},
                 profile)) {
    all[name] += work;
  }
}

}  // namespace

Work& Work::operator+=(const Work& other) {
  launches += other.launches;
  groups += other.groups;
  bytes += other.bytes;
  operations += other.operations;
  scalar += other.scalar;
  counts += other.counts;
  runs += other.runs;
  held += other.held;
  return *this;
}

Work Work::times(double factor) const {
  return {factor * launches, factor * groups, factor * bytes, factor * operations,
          factor * scalar,   factor * counts, factor * runs,  factor * held};
}

double expected(const Work& work, const Limits& limits) {
  const double computing =
      share(work.operations, limits.arithmetic) + share(work.scalar, limits.scalar);
  return work.launches * limits.begin + share(work.groups, limits.groups) +
         std::max(share(work.bytes, limits.bandwidth), computing) +
         share(work.counts, limits.counts) + share(work.runs, limits.runs) +
         share(work.held, limits.held);
}

Places places_of(sim::Fluid& fluid, const sim::Step& step) {
  sim::Device& device = fluid.device();
  const auto stride = static_cast<std::size_t>(fluid.particles().stride);
  Places p;
  p.params = fluid.params();
  p.position = fluid.particles().position.read(device, 3 * stride);
  const std::size_t cells = SPLASH_SLICES * static_cast<std::size_t>(p.params.cells_x) *
                            static_cast<std::size_t>(p.params.cells_y) *
                            static_cast<std::size_t>(p.params.cells_z);
  p.cell_start = fluid.grid().cell_start().read(device, cells + 1);
  p.source = fluid.grid().source().read(device, static_cast<std::size_t>(p.params.count));
  p.used = used_cells(p.cell_start);
  const sim::Boundary& boundary = fluid.boundary();
  if (boundary.point_count() == 0) return p;
  const auto points = static_cast<std::size_t>(boundary.point_count());
  const auto apart = static_cast<std::size_t>(boundary.points().stride);
  const std::vector<float> all = boundary.points().position.read(device, 3 * apart);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(axis * apart);
    p.body_position.insert(p.body_position.end(), first,
                           first + static_cast<std::ptrdiff_t>(points));
  }
  p.body_start = boundary.grid().cell_start().read(device, cells + 1);
  const auto first = boundary.given_steps().begin() + step.first_body;
  p.bodies.assign(first, first + boundary.body_count());
  return p;
}

Places places_of(Block& block) {
  block.fluid.prepare(block.step);
  return places_of(block.fluid, block.step);
}

Met meet_all(const Places& places, int lanes) {
  return Search(places, lanes, places.position, places.cell_start).all(false);
}

Met meet_bodies(const Places& places, int lanes) {
  if (places.body_start.empty()) return {};
  return Search(places, lanes, places.body_position, places.body_start).all(true);
}

double meet_walls(const Places& p, int lanes) {
  double met = 0.0;
  const std::size_t stride = p.position.size() / 3;
  Search::each_turn(p, lanes, [&](int /*row*/, int first, int /*last*/) {
    // All lanes of the group are held against a wall, whosever turn it is.
    const int begin = first / lanes * lanes;
    const int end = std::min(begin + lanes, p.params.count);
    for (int k = 0; k < p.params.wall_count; ++k) {
      const WallPlane& wall = p.params.walls[k];
      bool near = false;
      for (int i = begin; i < end; ++i) {
        const auto at = static_cast<std::size_t>(i);
        near = near || wall.nx * p.position[at] + wall.ny * p.position[stride + at] +
                               wall.nz * p.position[2 * stride + at] - wall.offset <
                           p.params.support;
      }
      met += near ? 1.0 : 0.0;
    }
  });
  return met;
}

double moved_alone(const Places& places, const sim::Profile& profile) {
  const auto count = places.source.size();
  const auto lanes = static_cast<std::size_t>(profile.lanes);
  const auto chunks = static_cast<std::size_t>(std::max(profile.sort_chunks, 1));
  std::vector<std::size_t> place(count);
  for (std::size_t k = 0; k < count; ++k) place[static_cast<std::size_t>(places.source[k])] = k;
  const std::size_t size = (count + chunks - 1) / chunks;
  std::size_t together = 0;
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    const std::size_t end = std::min((chunk + 1) * size, count);
    for (std::size_t i = chunk * size; i + lanes <= end; i += lanes) {
      bool apart = false;
      for (std::size_t k = 1; k < lanes; ++k) apart = apart || place[i + k] != place[i] + k;
      together += apart ? 0 : lanes;
    }
  }
  return static_cast<double>(count - together);
}

std::map<std::string, Work> sort_work(const SortSize& size, const sim::Profile& profile) {
  const double n = size.points;
  const double groups = std::ceil(n / 64.0);
  if (profile.sort_chunks == 0) {
    return {
        {"count_points", {.groups = groups, .bytes = 28.0 * n, .operations = 2.0 * kOfCell * n}},
        {"sum_cells", {.bytes = 4.0 * size.cells, .operations = size.cells}},
        {"start_cells", {.bytes = 12.0 * size.cells, .operations = size.cells}},
        {"gather_cells", {.groups = groups, .bytes = 16.0 * n}},
        {"rank_points",
         {.groups = groups,
          .bytes = 76.0 * n,
          .operations = 2.0 * (kOfMove + 4.0 * kOfPlace) * n}}};
  }
  const double counts = size.used * size.chunks;
  return {{"count_cells", {.bytes = 16.0 * n + 12.0 * counts, .scalar = kOfCell * n, .counts = n}},
          {"sum_blocks", {.bytes = 4.0 * counts, .scalar = counts}},
          {"place_cells", {.bytes = 8.0 * counts + 4.0 * size.used, .scalar = 5.0 * counts}},
          {"sort_points",
           {.bytes = 64.0 * n + 8.0 * counts,
            .scalar = kOfPlace * n + kOfMove * (size.alone + (n - size.alone) / profile.lanes),
            .counts = n}}};
}

std::map<std::string, Work> work_of(const Places& p, const sim::Profile& profile) {
  const Met met = meet_all(p, profile.lanes);
  const double n = p.params.count;
  const double used = p.used;
  const double groups = std::ceil(n / profile.lanes / static_cast<double>(profile.group));
  std::map<std::string, Work> all = sort_work(
      {n, static_cast<double>(p.cell_start.size()), used, static_cast<double>(profile.sort_chunks),
       profile.sort_chunks > 0 ? moved_alone(p, profile) : 0.0},
      profile);
  const double wide = profile.lanes > 1 ? 1.0 : 0.0;  // one lane alone has no least number to find
  const double walls = static_cast<double>(p.params.wall_count) * (kOfWall + wide * kOfLeast);
  Work pairs = search_work(met, profile);
  pairs.groups = groups;
  pairs.operations += kOfParticle * n + profile.lanes * ((walls + wide * kOfBox) * met.turns +
                                                         kOfBehind * meet_walls(p, profile.lanes));
  Work density = pairs;
  density.bytes = 36.0 * n + 4.0 * used;
  density.operations += pairs_work(met.visited, kOfDensity, kLoadsOfDensity, profile);
  add_scalar(density, kOfFetch * n, profile);
  Work forces = pairs;
  forces.bytes = 44.0 * n + 4.0 * used;
  forces.operations += pairs_work(met.visited, kOfForce, kLoadsOfForce, profile);
  all["compute_density"] = density;
  all["compute_acceleration"] = forces;
  const double box = p.bodies.empty() ? 0.0 : wide * kOfBox;
  all["integrate"] = {
      .groups = groups, .bytes = 64.0 * n, .operations = (kOfMotion + box + walls) * n};
  if (p.watched) {
    Work health = {.groups = static_cast<double>(profile.parts),
                   .bytes = 64.0 * n,
                   .operations = kOfHealth * n};
    add_scalar(health, 3.0 * kOfFetch * fetched_alone(p, static_cast<std::size_t>(profile.lanes)),
               profile);
    all["check_health"] = health;
  }
  add_bodies(all, p, met.turns, profile);
  return all;
}

}  // namespace splash::bench
