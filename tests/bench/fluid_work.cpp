// SPDX-License-Identifier: MIT
#include "tests/bench/fluid_work.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <stdexcept>
#include <tuple>

#include "sim-server/bodies/skin.hpp"
#include "sim-server/detect/bubble_state.h"

namespace splash::bench {
namespace {

using namespace splash::sim;

/// What the search around all particles meets (neighbours/near.h).
struct Met {
  double tested = 0.0;   ///< points held against a group's box, a vector at a time
  double visited = 0.0;  ///< pairs whose formula is computed
  double turns = 0.0;    ///< searches of the nine runs around some particles of a row
};

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
// Instructions that no vector saves: of a turn (group.h, rest.h), of a run (grid.h, near.h: two
// addresses and look-ups, where to go on), of a point's cell (grid.h) with its loads and store, of
// a point's place in the sort, of a number that is fetched from where its particle was (sleep.h),
// of a box that is held against a body's (bodies.h).
constexpr double kOfTurn = 100.0, kOfRun = 25.0, kOfCell = 28.0, kOfPlace = 4.0;
constexpr double kOfFetch = 4.0, kOfNearness = 14.0;
// Of a point that moves to its place, in a vector of those that stay together (points.h: eight
// numbers in and out).
constexpr double kOfMove = 32.0;
// Of a particle that is held against a body (keep_out.h: two rotations, a depth); on a CPU each is
// held alone.
constexpr double kOfLeaving = 200.0;

// Of a frame.

constexpr double kEddy = 0.06;  ///< its width, bubble_eddy [m]

/// Per particle: places, speeds, id, peak, and what spawning remembers [B].
constexpr double kState = 36.0;

// Operations of a pair that a detector looks at: where it is and the kernel (colour.h), what else
// it sums (body_touch.cl, bubble_state.cl, air_fold.cl). Of a particle in the statistics.
constexpr double kOfPair = 18.0, kOfTouch = 22.0, kOfCarried = 8.0, kOfEddy = 14.0, kOfMean = 3.0,
                 kOfSurvey = 60.0;
// Instructions that no vector saves: of the nine runs around a place, of a particle that is slow,
// of a cell that wakes others.
constexpr double kOfRuns = 9.0 * 25.0, kOfSlow = 10.0, kOfAwake = 30.0;

/// An instruction that no vector saves takes the place of two operations of each lane.
double alone(double instructions, const Profile& profile) {
  return 2.0 * profile.lanes * instructions;
}

/// What both pair loops have in common beside their pairs.
Work search_work(const Met& met, const Profile& profile) {
  // The list of those found is gone through, too.
  const double found = profile.lanes > 1 ? met.turns : 0.0;
  return {.operations =
              kOfTest * met.tested + alone(kOfTurn * met.turns + kOfRun * 9.0 * met.turns, profile),
          .runs = 9.0 * met.turns + found};
}

/// Of pairs whose formula is computed.
double pairs_work(double pairs, double operations, double loads, const Profile& profile) {
  return pairs * (operations + (profile.lanes > 1 ? 0.0 : 2.0 * loads));
}

int used_cells(const std::vector<int>& cell_start) {
  const auto full = std::find(cell_start.begin(), cell_start.end(), cell_start.back());
  return static_cast<int>(full - cell_start.begin());
}

/// With `lanes` particles to a work-item.
Met meet_all(const Places& places, int lanes) {
  return Search(places, lanes, places.position, places.cell_start).all(false);
}

/// The bodies' points, by those that are near a body.
Met meet_bodies(const Places& places, int lanes) {
  if (places.body_start.empty()) return {};
  return Search(places, lanes, places.body_position, places.body_start).all(true);
}

/// Pairs of a turn and a wall within its reach.
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

/// A sort of so many points.
struct SortSize {
  double points = 0.0;
  double cells = 0.0;   ///< of the grid
  double used = 0.0;    ///< up to the last that has a point
  double chunks = 0.0;  ///< runs of points that are sorted side by side; 0: by rank
};

std::map<std::string, Work> sort_work(const SortSize& size, const Profile& profile) {
  const double n = size.points;
  if (profile.sort_chunks == 0) {
    return {{"count_points", {.bytes = 28.0 * n, .operations = 2.0 * kOfCell * n}},
            {"sum_cells", {.bytes = 4.0 * size.cells, .operations = size.cells}},
            {"start_cells", {.bytes = 12.0 * size.cells, .operations = size.cells}},
            {"gather_cells", {.bytes = 16.0 * n}},
            {"rank_points", {.bytes = 76.0 * n, .operations = (kOfMove + 8.0 * kOfPlace) * n}}};
  }
  const double counts = size.used * size.chunks;
  const Work count = {.bytes = 16.0 * n + 12.0 * counts, .operations = alone(kOfCell * n, profile)};
  const Work place = {.bytes = 8.0 * counts + 4.0 * size.used,
                      .operations = alone(5.0 * counts, profile)};
  const Work move = {.bytes = 64.0 * n + 8.0 * counts,
                     .operations = kOfMove * n + alone(kOfPlace * n, profile)};
  if (size.chunks == 1.0) {
    Work few = count;
    few += place;
    few += move;
    few.launches = 1.0;
    return {{"sort_few", few}};
  }
  return {{"count_cells", count},
          {"sum_blocks", {.bytes = 4.0 * counts, .operations = alone(counts, profile)}},
          {"place_cells", place},
          {"sort_points", move}};
}

/// `turns`: of the search among particles.
void add_bodies(std::map<std::string, Work>& all, const Places& p, double turns,
                const Profile& profile) {
  const double points = static_cast<double>(p.body_position.size()) / 3.0;
  if (points == 0.0) return;
  const auto bodies = static_cast<double>(p.bodies.size());
  const Met met = meet_bodies(p, profile.lanes);
  const double near = met.turns * profile.lanes;
  const double nearness = alone(kOfNearness * bodies * turns, profile);
  Work& density = all["compute_density"];
  Work& forces = all["compute_acceleration"];
  const Work search = search_work(met, profile);
  for (const auto& [work, operations, loads] :
       {std::tuple{&density, kOfBodyDensity, kLoadsOfDensity + 1.0},
        std::tuple{&forces, kOfBodyForce, kLoadsOfForce + 1.0}}) {
    work->operations += search.operations + pairs_work(met.visited, operations, loads, profile);
    work->runs += search.runs;
    work->bytes += 20.0 * near;
  }
  density.operations += 2.0 * nearness + near * (bodies * kOfFace + kOfImage);
  forces.operations += nearness;
  all["integrate"].operations += nearness + kOfLeaving * profile.lanes * bodies * near;
  all["place_bodies"] = {.bytes = 44.0 * points, .operations = alone(80.0 * points, profile)};
  all["gather_body_volumes"] = {.bytes = 16.0 * points,
                                .operations = alone(20.0 * points, profile)};
  const auto cells = static_cast<double>(p.body_start.size());
  for (const auto& [name, work] :
       sort_work({points, cells, static_cast<double>(used_cells(p.body_start)),
                  std::min(1.0, static_cast<double>(profile.sort_chunks))},
                 profile)) {
    all[name] += work;
  }
}

/// For each particle, in sorted order, whether its speed is at least `speed` [m/s].
std::vector<bool> find_fast(Fluid& fluid, double speed) {
  const auto stride = static_cast<std::size_t>(fluid.particles().stride);
  const std::vector<float> v = fluid.particles().velocity.read(fluid.device(), 3 * stride);
  std::vector<bool> fast(static_cast<std::size_t>(fluid.params().count));
  for (std::size_t i = 0; i < fast.size(); ++i) {
    fast[i] = static_cast<double>(std::hypot(v[i], v[stride + i], v[2 * stride + i])) >= speed;
  }
  return fast;
}

double count_fast(Fluid& fluid, double speed) {
  const std::vector<bool> fast = find_fast(fluid, speed);
  return static_cast<double>(std::count(fast.begin(), fast.end(), true));
}

/// Particles that may have a fast one within an eddy's width: in cells as wide, those in its own
/// and in the 26 around.
double count_stirred(Fluid& fluid, const Places& places, double speed) {
  const std::vector<bool> fast = find_fast(fluid, speed);
  const std::size_t stride = places.position.size() / 3;
  const auto cell_of = [&](std::size_t i) {
    std::array<int, 3> cell;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto x = static_cast<double>(places.position[axis * stride + i]);
      cell[axis] = static_cast<int>(std::floor(x / kEddy));
    }
    return cell;
  };
  std::set<std::array<int, 3>> stirred;
  for (std::size_t i = 0; i < fast.size(); ++i) {
    if (!fast[i]) continue;
    const auto [x, y, z] = cell_of(i);
    for (int k = 0; k < 27; ++k) {
      stirred.insert({x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1});
    }
  }
  double count = 0.0;
  for (std::size_t i = 0; i < fast.size(); ++i) count += stirred.contains(cell_of(i)) ? 1.0 : 0.0;
  return count;
}

/// Particles in any body's box, in which neighbours may be those of its skin.
double count_near(Fluid& fluid, const Step& step) {
  const auto stride = static_cast<std::size_t>(fluid.particles().stride);
  const auto count = static_cast<std::size_t>(fluid.params().count);
  const auto bodies = static_cast<std::size_t>(fluid.boundary().body_count());
  if (bodies == 0) return 0.0;
  const std::vector<float> x = fluid.particles().position.read(fluid.device(), 3 * stride);
  std::vector<BodyStep> steps(bodies);
  fluid.boundary().steps().read(fluid.device(), std::span<BodyStep>(steps),
                                static_cast<std::size_t>(step.first_body));
  double near = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    near += std::any_of(steps.begin(), steps.end(), [&](const BodyStep& b) {
      return x[i] > b.lower_x && x[i] < b.upper_x && x[stride + i] > b.lower_y &&
             x[stride + i] < b.upper_y && x[2 * stride + i] > b.lower_z &&
             x[2 * stride + i] < b.upper_z;
    });
  }
  return near;
}

/// Lanes that a search for one place visits, on average.
double lanes_of_a_search(const Places& p, int lanes) {
  const Met met = meet_all(p, 1);
  // Each of the nine runs fills its vectors, and the last one half.
  const double in_runs = met.visited / met.turns;
  return lanes == 1 ? in_runs : in_runs + 9.0 * 0.5 * (lanes - 1);
}

Work pairs_of(double places, double lanes, double operations, const Profile& profile) {
  return {.operations = places * lanes * operations + alone(places * kOfRuns, profile),
          .runs = 9.0 * places};
}

}  // namespace

Work& Work::operator+=(const Work& other) {
  launches += other.launches;
  bytes += other.bytes;
  operations += other.operations;
  runs += other.runs;
  return *this;
}

Work Work::times(double factor) const {
  return {factor * launches, factor * bytes, factor * operations, factor * runs};
}

double expected(const Work& work, const Limits& limits) {
  return std::max(work.bytes / limits.bandwidth, work.operations / limits.arithmetic) +
         work.runs / limits.runs;
}

Places places_of(Fluid& fluid, const Step& step) {
  Device& device = fluid.device();
  const auto stride = static_cast<std::size_t>(fluid.particles().stride);
  Places p;
  p.params = fluid.params();
  p.position = fluid.particles().position.read(device, 3 * stride);
  const std::size_t cells = SPLASH_SLICES * static_cast<std::size_t>(p.params.cells_x) *
                            static_cast<std::size_t>(p.params.cells_y) *
                            static_cast<std::size_t>(p.params.cells_z);
  p.cell_start = fluid.grid().cell_start().read(device, cells + 1);
  p.used = used_cells(p.cell_start);
  const Boundary& boundary = fluid.boundary();
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

std::map<std::string, Work> work_of(const Places& p, const Profile& profile) {
  const Met met = meet_all(p, profile.lanes);
  const double n = p.params.count;
  const double used = p.used;
  std::map<std::string, Work> all = sort_work(
      {n, static_cast<double>(p.cell_start.size()), used, static_cast<double>(profile.sort_chunks)},
      profile);
  const double wide = profile.lanes > 1 ? 1.0 : 0.0;  // one lane alone has no least number to find
  const double walls = static_cast<double>(p.params.wall_count) * (kOfWall + wide * kOfLeast);
  Work pairs = search_work(met, profile);
  pairs.operations += kOfParticle * n + profile.lanes * ((walls + wide * kOfBox) * met.turns +
                                                         kOfBehind * meet_walls(p, profile.lanes));
  Work density = pairs;
  density.bytes = 36.0 * n + 4.0 * used;
  density.operations +=
      pairs_work(met.visited, kOfDensity, kLoadsOfDensity, profile) + alone(kOfFetch * n, profile);
  Work forces = pairs;
  forces.bytes = 44.0 * n + 4.0 * used;
  forces.operations += pairs_work(met.visited, kOfForce, kLoadsOfForce, profile);
  all["compute_density"] = density;
  all["compute_acceleration"] = forces;
  const double box = p.bodies.empty() ? 0.0 : wide * kOfBox;
  all["integrate"] = {.bytes = 64.0 * n, .operations = (kOfMotion + box + walls) * n};
  add_bodies(all, p, met.turns, profile);
  return all;
}

FrameSeen see_frame(Simulation& simulation) {
  FrameSeen seen;
  const Scene& scene = simulation.scene();
  const RunTotals before = simulation.totals();
  seen.bubbles = static_cast<double>(before.bubbles_alive);
  simulation.set_hook([&](Fluid& fluid, Step& step, Moment moment) {
    if (moment != Moment::between) return;
    seen.places = places_of(fluid, step);
    seen.fast = count_fast(fluid, scene.detect.bubble_speed);
    // What eddies as fast as bubble_onset along each axis have.
    const double eddying = std::sqrt(3.0) * scene.detect.bubble_onset;
    seen.stirred = count_stirred(fluid, seen.places, eddying);
    seen.near = count_near(fluid, step);
  });
  const FrameResult frame = simulation.advance();
  simulation.set_hook({});
  const RunTotals& after = simulation.totals();
  seen.steps = static_cast<int>(after.steps - before.steps);
  if (seen.steps == 0 || frame.step_fault) throw std::runtime_error("the frame is no usual one");
  seen.sleeps = scene.skip.sleep && scene.fluid.solver == PressureKind::weakly_compressible;
  seen.looks = after.skipped.bubbles == before.skipped.bubbles;
  if (!seen.looks) seen.bubbles = seen.fast = 0.0;
  if (after.skipped.contacts == before.skipped.contacts) {
    seen.skin = static_cast<double>(
        sample_skins(scene.bodies, static_cast<double>(seen.places.params.spacing)).size());
  }
  return seen;
}

std::map<std::string, Work> frame_work(const FrameSeen& seen, const Profile& profile) {
  const Places& p = seen.places;
  const double n = p.params.count;
  std::map<std::string, Work> all = work_of(p, profile);
  all["check_health"] = {.bytes = 64.0 * n, .operations = kOfHealth * n};
  for (auto& [name, work] : all) work = work.times(seen.steps);
  all["reduce_stats"] = {.bytes = 44.0 * n, .operations = kOfSurvey * n};
  if (seen.sleeps) {
    const double cells =
        static_cast<double>(p.params.cells_x) * p.params.cells_y * p.params.cells_z;
    const double waking = alone(kOfAwake * cells, profile);
    all["keep_awake"] = {.bytes = 12.0 * n + 16.0 * cells, .operations = 6.0 * n + waking};
    all["spread_activity"] = {.bytes = 12.0 * cells, .operations = waking};
  }
  const double lanes = seen.looks || seen.skin > 0.0 ? lanes_of_a_search(p, profile.lanes) : 0.0;
  if (seen.skin > 0.0) {
    all["touch_water"] = pairs_of(2.0 * seen.skin, lanes, kOfPair + 0.5 * kOfTouch, profile);
    all["touch_water"].bytes = 116.0 * seen.skin;
    all["average_density"] = pairs_of(seen.near, lanes, kOfPair + kOfMean, profile);
    all["average_density"].bytes = 12.0 * n + 4.0 * seen.near;
  }
  if (seen.looks) {
    all["spawn_bubbles"] = pairs_of(seen.fast, lanes, kOfPair, profile);
    all["spawn_bubbles"].bytes = 20.0 * n;
    all["spawn_bubbles"].operations += alone(kOfSlow * n, profile);
    // One particle in so many looks within an eddy's width, as a search does within the support.
    const double wide = std::pow(kEddy / static_cast<double>(p.params.support), 3.0);
    const double few = std::ceil(seen.stirred / SPLASH_FOLDS_APART);
    all["fold_air"] = pairs_of(few, std::max(1.0, wide) * lanes, kOfPair + kOfEddy, profile);
    all["fold_air"].bytes = 12.0 * n / SPLASH_FOLDS_APART + 12.0 * few;
    all["find_fastest"] = {.bytes = 12.0 * n, .operations = 6.0 * n};
  }
  if (seen.bubbles == 0.0) return all;
  all["carry_bubbles"] = pairs_of(2.0 * seen.bubbles, lanes, kOfPair + kOfCarried, profile);
  all["carry_bubbles"].bytes = 40.0 * seen.bubbles;
  const auto cells = static_cast<double>(p.cell_start.size());
  const double chunks = std::min(1.0, static_cast<double>(profile.sort_chunks));
  // Their number changes from frame to frame: all cells are gone through (cell_count.cl).
  for (const auto& [name, work] : sort_work({seen.bubbles, cells, cells, chunks}, profile)) {
    all[name] += work;
  }
  return all;
}

double copied_bytes(const FrameSeen& seen) {
  return 2.0 * kState * seen.places.params.count;
}

}  // namespace splash::bench
