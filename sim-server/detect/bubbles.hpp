// SPDX-License-Identifier: MIT
// Bubble particles (paper, section 4): spawned by fast water with most of its matter above it,
// carried by the water one way, deleted when alone (c_b null), when the matter around lies below,
// or when old.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim-server/detect/air_account.hpp"
#include "sim-server/detect/air_folds.hpp"
#include "sim-server/detect/bubble_draw.hpp"
#include "sim-server/detect/bubble_state.h"
#include "sim-server/detect/counted_list.hpp"
#include "sim-server/detect/detection.hpp"
#include "sim-server/detect/wake_air.hpp"
#include "sim-server/fluid/fluid.hpp"

namespace splash::sim {

struct PoolBubble {
  Vector3 position = {0.0, 0.0, 0.0};  ///< [m]
  double born = 0.0;                   ///< [s]
  int serial = 0;                      ///< counts all bubbles ever spawned
  int cavity = -1;                     ///< serial of the cavity it is part of, -1: none
};

/// Sums over a run.
struct AirTotals {
  double entrapped = 0.0;     ///< [m3]
  double by_bodies = 0.0;     ///< of it (wake_air.hpp) [m3]
  double told = 0.0;          ///< in bubbles; differs by the scatter of their radii, too [m3]
  std::uint64_t thinned = 0;  ///< bubbles over the budget: their air went into larger ones, up to
                              ///< the limit of those
};

class Bubbles {
 public:
  /// No more than `room` bubbles live at once; spawns beyond it are counted and dropped.
  Bubbles(Fluid& fluid, const cl::Program& program, const DetectSettings& settings, int seed,
          std::size_t room);

  /// Between prepare and advance of a frame's last step: looks for spawns and carries the living.
  void enqueue(const Step& step, double frame);
  /// Instead of it, where no water is fast and no bubble lives.
  void skip();
  /// Enqueues the reads of what was found: after the last kernel of a frame, for a driver may let a
  /// read wait for all that was enqueued before it, and what follows for the read.
  void enqueue_read();
  /// What was found, once the queue is finished: bubbles to be heard, in the order of their
  /// particles' ids: until none of the entrapped air is left, or with bubble_per_particle one for
  /// each bubble particle that is spawned; where that is more than the budget, as many as it has,
  /// and larger ones. `frame`: seconds since the last call; `step`: counts the
  /// steps; `wakes`: what bodies take down in the frame.
  [[nodiscard]] std::vector<DetectedBubble> collect(double time, double frame, std::uint32_t step,
                                                    const WakeAir& wakes = {});

  [[nodiscard]] std::vector<PoolBubble>& pool() noexcept { return pool_; }
  [[nodiscard]] const std::vector<PoolBubble>& pool() const noexcept { return pool_; }
  [[nodiscard]] std::size_t pool_size() const noexcept { return pool_.size(); }
  /// State of the bubbles that were carried, in grid order; id: index in the pool before collect.
  [[nodiscard]] const std::vector<BubbleState>& states() const noexcept { return states_; }
  [[nodiscard]] const PointArrays& sorted() const noexcept { return sorted_; }
  [[nodiscard]] const NeighbourGrid& grid() const noexcept { return grid_; }
  [[nodiscard]] const Buffer<BubbleState>& state_buffer() const noexcept { return state_buffer_; }
  /// Of each particle by id (bubble_spawn.cl).
  [[nodiscard]] const cl::Buffer& memory() const noexcept { return memory_.memory(); }
  [[nodiscard]] int carried() const noexcept { return carried_; }
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_; }
  [[nodiscard]] const AirTotals& air() const noexcept { return air_; }

  /// Drops the dead, keeps the order, and adds what collect found to be spawned; called by its
  /// owner after cavities have been searched among the states.
  void renew(double time);
  /// All are gone, and all water was slow.
  void forget();
  /// Other thresholds and sizes, from the next frame on.
  void set(const DetectSettings& settings);

 private:
  void upload();
  void look_for_spawns(const Step& step);
  void carry(const Step& step, double frame);
  /// Of a radius from `least` to `most` [m].
  [[nodiscard]] DetectedBubble draw_bubble(int particle, const Vector3& place, const Draws& draws,
                                           double least, double most) const;
  /// By the paper's rule: one for each.
  [[nodiscard]] std::vector<DetectedBubble> tell_spawns(const std::vector<Spawn>& spawns,
                                                        double time, double frame,
                                                        std::uint32_t step);
  /// Reduces the air of folds by the part whose energy is the `work` of bodies [J].
  void leave_own_loss(std::vector<AirFold>& folds, double work, double frame);
  /// From the air of all folds, until it is used up.
  [[nodiscard]] std::vector<DetectedBubble> tell_folds(const std::vector<AirFold>& folds,
                                                       double time, double frame,
                                                       std::uint32_t step);

  Fluid& fluid_;
  DetectSettings settings_;
  std::uint32_t seed_;
  std::size_t room_;
  std::vector<PoolBubble> pool_;
  std::vector<Vector3> spawned_;  ///< places of the bubble particles that are to be added
  std::vector<BubbleState> states_;
  int carried_ = 0;
  std::uint32_t frames_ = 0;
  bool looked_ = false;  ///< for spawns, in this frame
  int serial_ = 0;
  std::uint64_t dropped_ = 0;
  BubbleBudget budget_;
  AirTotals air_;
  std::optional<AirFolds> folds_;  ///< without bubble_per_particle
  AirAccount account_;
  std::uint32_t drawn_ = 0;  ///< bubbles from it so far

  Buffer<float> memory_;
  CountedList<Spawn> spawns_;
  std::vector<float> uploaded_;  ///< kept until the queue has read it
  PointArrays points_;
  PointArrays sorted_;
  NeighbourGrid grid_;
  Buffer<BubbleState> state_buffer_;
  Kernel spawn_bubbles_;
  Kernel carry_bubbles_;
};

}  // namespace splash::sim
