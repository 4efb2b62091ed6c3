// SPDX-License-Identifier: MIT
// The rules of a scene that span several keys: what cannot be said by one row's range.
#pragma once

#include <string>

#include "program/config.hpp"
#include "sim-server/scene/scene.hpp"

namespace splash::sim {

// Each throws program::ConfigError at the mapping that breaks the rule.
/// Returns the mapping's `rotation`, normalised to unit length.
[[nodiscard]] Quaternion checked_rotation(const program::ConfigMap& map, const Quaternion& q);
void check_tank(const program::ConfigMap& map, const Tank& tank);
void check_slope(const program::ConfigMap& map, const Slope& slope, const Tank& tank);
void check_wave_maker(const program::ConfigMap& map, const WaveMaker& maker, const Tank& tank);
/// Something in it moves the tank.
void check_tank_motion(const program::ConfigMap& map, const TankMotionSettings& motion);
/// No free body is in a tank that turns. `scene` has its bodies.
void check_turning(const program::ConfigMap& motion, const Scene& scene);
/// `scene` holds the tank, the slope and the blocks before it in the file.
void check_water(const program::ConfigMap& map, const WaterBlock& block, const Scene& scene);
/// No block of water on both sides of it, and no wave maker there.
void check_gate(const program::ConfigMap& map, const Scene& scene);
/// Inside the tank and outside the body that it rides on, on a surface if it has a size; or a
/// region with a volume. `scene` has its bodies.
void check_gauge(const program::ConfigMap& map, const GaugeSettings& gauge, const Scene& scene);
void check_shape(const program::ConfigMap& map, const Shape& shape);
/// Of a free motion: density or mass, one of them.
void check_free(const program::ConfigMap& map, const MotionSettings& motion);
/// Of a motion on a spring: what it needs.
void check_spring(const program::ConfigMap& map, const MotionSettings& motion);
/// The spring, which is felt late, gives a hand no energy that its device does not take.
void check_passivity(const program::ConfigMap& map, const MotionSettings& motion,
                     double frame_rate);
/// A free body must start between the tank's walls; a body with a prescribed motion need not.
void check_place(const program::ConfigMap& body, const Vector3& place, const Tank& tank);
/// Smallest values below largest ones.
void check_detect(const program::ConfigMap& map, const DetectSettings& detect);
/// What breaks that rule, as a sentence; empty: nothing.
[[nodiscard]] std::string wrong_order(const DetectSettings& detect);
/// Steps no longer than the solver's water stands, at a speed of sound that is given or on a grid.
void check_time_step(const program::ConfigMap& map, const FluidSettings& fluid);
/// What only one of the solvers knows.
void check_solver(const program::ConfigMap& map, const FluidSettings& fluid);
/// Sound that is given is fast enough for the scene's depth and for what falls and flows in it.
/// `scene` has its bodies.
void check_sound(const program::ConfigMap& fluid, const Scene& scene);
/// Spacing or particles, one of them; a number of particles that can be simulated.
void check_resolution(const program::ConfigMap& fluid, const Scene& scene);

}  // namespace splash::sim
