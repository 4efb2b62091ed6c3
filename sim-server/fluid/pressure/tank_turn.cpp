// SPDX-License-Identifier: MIT
#include "sim-server/fluid/pressure/tank_turn.hpp"

#include "sim-server/fluid/fluid.hpp"
#include "sim-server/fluid/params/parts.hpp"
#include "sim-server/scene/rotation.hpp"

namespace splash::sim {

TankTurn turn_of(const TankState& tank, const Vector3& pivot, double dt) {
  TankTurn turn = {};
  const Quaternion back = from_turn(-2.0 * dt * tank.spin);
  for (std::size_t column = 0; column < 3; ++column) {
    Vector3 e = {0.0, 0.0, 0.0};
    e[column] = 1.0;
    const Vector3 turned = rotate(back, e);
    const Vector3 pushed = -dt * (cross(tank.spin_rate, e) + cross(tank.spin, cross(tank.spin, e)));
    for (std::size_t row = 0; row < 3; ++row) {
      turn.turned[3 * row + column] = static_cast<float>(turned[row]);
      turn.pushed[3 * row + column] = static_cast<float>(pushed[row]);
    }
  }
  turn.px = static_cast<float>(pivot[0]);
  turn.py = static_cast<float>(pivot[1]);
  turn.pz = static_cast<float>(pivot[2]);
  return turn;
}

TankTurning::TankTurning(Device& device)
    : turn_water_(build_program(device, kernels::tank_turn(), {}), "turn_water",
                  device.profile().group),
      turn_(device, 1) {}

void TankTurning::set(Device& device, const TankTurn& turn) {
  uploaded_ = turn;
  turn_.enqueue_write(device, std::span<const TankTurn>(&uploaded_, 1));
}

void TankTurning::push(Fluid& fluid) {
  turn_water_.run(fluid.device().queue(), fluid.groups(),
                  {{"p", fluid.params_buffer()},
                   {"turn", turn_},
                   {"position", fluid.particles().position},
                   {"velocity", fluid.particles().velocity}});
}

}  // namespace splash::sim
