// SPDX-License-Identifier: MIT
// Host and device lay out the structs that they share alike: each member is where the other side
// looks for it.
#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "sim-server/detect/bubble_state.h"
#include "sim-server/detect/touch.h"
#include "sim-server/device/buffer.hpp"
#include "sim-server/device/kernel.hpp"
#include "sim-server/fluid/health/health_record.h"
#include "sim-server/fluid/params/fluid_params.h"
#include "sim-server/fluid/params/parts.hpp"
#include "sim-server/fluid/pressure/grid_projected/mac_grid.h"
#include "sim-server/fluid/pressure/grid_projected/pocket.h"
#include "sim-server/fluid/pressure/tank_turn.h"

namespace splash::sim {

namespace kernels {
std::vector<KernelSource> detect();
}  // namespace kernels

namespace {

struct Member {
  std::string type;
  std::string name;
  std::size_t offset;
  std::size_t size;
};

#define MEMBER(type, name)                                 \
  Member {                                                 \
#type, #name, offsetof(type, name), sizeof(type::name) \
  }
#define MEMBERS_2(type, a, b) MEMBER(type, a), MEMBER(type, b)
#define MEMBERS_3(type, a, b, c) MEMBERS_2(type, a, b), MEMBER(type, c)
#define MEMBERS_4(type, a, b, c, d) MEMBERS_2(type, a, b), MEMBERS_2(type, c, d)

/// All members of all of them: their sizes sum up to the structs'.
const std::vector<Member> kMembers = {
    MEMBERS_4(WallPlane, nx, ny, nz, offset),

    MEMBERS_2(FluidParams, count, capacity),
    MEMBERS_3(FluidParams, cells_x, cells_y, cells_z),
    MEMBERS_3(FluidParams, origin_x, origin_y, origin_z),
    MEMBERS_4(FluidParams, inverse_cell, support, inverse_support, length),
    MEMBERS_4(FluidParams, kernel_norm, mass, rest_density, sound_speed),
    MEMBERS_2(FluidParams, viscous, artificial),
    MEMBERS_3(FluidParams, gravity_x, gravity_y, gravity_z),
    MEMBERS_3(FluidParams, pull_x, pull_y, pull_z),
    MEMBERS_3(FluidParams, centre_x, centre_y, centre_z),
    MEMBERS_4(FluidParams, spacing, layer_weight, least_density, torn_density),
    MEMBERS_4(FluidParams, speed_limit, wall_count, piston, slope),
    MEMBERS_4(FluidParams, solver, wave_speed, advective_cfl, pockets),
    MEMBER(FluidParams, walls),

    MEMBERS_3(BodyStep, px, py, pz),
    MEMBERS_4(BodyStep, qx, qy, qz, qw),
    MEMBERS_3(BodyStep, vx, vy, vz),
    MEMBERS_3(BodyStep, wx, wy, wz),
    MEMBERS_3(BodyStep, lower_x, lower_y, lower_z),
    MEMBERS_3(BodyStep, upper_x, upper_y, upper_z),
    MEMBERS_3(BodyStep, speed, lacks, grows),

    MEMBERS_4(BodyShape, kind, half_x, half_y, half_z),
    MEMBERS_4(BodyShape, rocker, flat, free, field),
    MEMBERS_3(BodyShape, nodes_x, nodes_y, nodes_z),
    MEMBERS_3(BodyShape, lower_x, lower_y, lower_z),
    MEMBERS_3(BodyShape, cell, vertices, vertex_count),

    MEMBERS_2(FreeBody, body, mass),
    MEMBERS_3(FreeBody, ix, iy, iz),
    MEMBERS_3(FreeBody, size, restitution, friction),
    MEMBERS_4(FreeBody, ax, ay, az, aw),
    MEMBERS_4(FreeBody, spring, damper, turning_spring, turning_damper),
    MEMBER(FreeBody, held),

    MEMBERS_3(Anchor, px, py, pz),
    MEMBERS_4(Anchor, qx, qy, qz, qw),
    MEMBERS_3(Anchor, vx, vy, vz),
    MEMBERS_3(Anchor, wx, wy, wz),

    MEMBERS_2(KeptPush, key, pushed),

    MEMBERS_3(MacLevel, nx, ny, nz),
    MEMBERS_4(MacLevel, row, layer, cells, first),

    MEMBERS_3(MacGrid, x, y, z),
    MEMBERS_3(MacGrid, hx, hy, hz),
    MEMBERS_3(MacGrid, ix, iy, iz),
    MEMBERS_3(MacGrid, share, levels, level),

    MEMBERS_2(TankTurn, turned, pushed),
    MEMBERS_3(TankTurn, px, py, pz),

    MEMBERS_3(SolveState, iterations, error, solves),
    MEMBERS_3(SolveState, total, most, given_up),

    MEMBERS_4(FluidStatsPart, speed2, acceleration2, excess_sum, excess_max),
    MEMBERS_4(FluidStatsPart, not_finite, first_bad, runaway, asleep),
    MEMBERS_2(FluidStatsPart, lower, upper),

    MEMBERS_2(HealthLimits, lower, upper),
    MEMBERS_3(HealthLimits, speed, thinnest, densest),
    MEMBERS_4(AirPocket, first, cells, volume, amount),
    MEMBER(AirPocket, pressure),
    MEMBERS_2(AirPockets, count, pocket),

    MEMBERS_2(HealthRecord, count, first),
    MEMBERS_4(HealthRecord, before, after, ids_before, ids_after),
    MEMBERS_2(Rested, state, ids),

    MEMBERS_2(BubbleState, colour, upward),
    MEMBERS_4(BubbleState, x, y, z, id),
    MEMBERS_4(Spawn, id, x, y, z),
    MEMBER(Spawn, before),

    MEMBERS_4(AirFold, id, x, y, z),
    MEMBER(AirFold, rate),

    MEMBERS_4(Touch, colour, gx, gy, gz),
    MEMBERS_3(Touch, x, y, z),
    MEMBERS_3(Touch, u, v, w),
    MEMBERS_3(Touch, water_u, water_v, water_w),
    MEMBERS_3(Touch, nx, ny, nz),
    MEMBERS_2(Touch, ahead, all_colour),
};

#undef MEMBER
#undef MEMBERS_2
#undef MEMBERS_3
#undef MEMBERS_4

/// The headers of all programs that share a struct, in an order that compiles.
std::vector<KernelSource> shared_headers() {
  std::vector<KernelSource> headers;
  std::set<std::string> seen;
  for (const auto& program : {kernels::fluid(), kernels::free_bodies(), kernels::stats(),
                              kernels::grid_projected(), kernels::tank_turn(), kernels::detect()}) {
    for (const KernelSource& source : program) {
      if (source.text.find("SPLASH_SHARED_STRUCT(") == std::string::npos) continue;
      if (seen.insert(source.name).second) headers.push_back(source);
    }
  }
  return headers;
}

/// Those that they share, and the sizes that the host knows.
std::set<std::string> shared_structs() {
  static const std::regex kShared("\nSPLASH_SHARED_STRUCT\\((\\w+),");
  std::set<std::string> names;
  for (const KernelSource& header : shared_headers()) {
    const std::string& text = header.text;
    for (std::sregex_iterator it(text.begin(), text.end(), kShared), end; it != end; ++it) {
      names.insert((*it)[1].str());
    }
  }
  return names;
}

TEST(SharedStructs, AreAllKnownHereWithoutGaps) {
  std::map<std::string, std::size_t> ends;
  for (const Member& member : kMembers) {
    EXPECT_EQ(member.offset, ends[member.type]) << member.type << "::" << member.name;
    ends[member.type] = member.offset + member.size;
  }
  std::set<std::string> known;
  for (const auto& [type, end] : ends) known.insert(type);
  EXPECT_EQ(known, shared_structs());
  EXPECT_EQ(ends["FluidParams"], sizeof(FluidParams));
  EXPECT_EQ(ends["BodyStep"], sizeof(BodyStep));
  EXPECT_EQ(ends["BodyShape"], sizeof(BodyShape));
  EXPECT_EQ(ends["Touch"], sizeof(Touch));
  EXPECT_EQ(ends["HealthRecord"], sizeof(HealthRecord));
}

TEST(SharedStructs, HaveTheSameOffsetsOnTheDevice) {
  std::string text = "kernel void find(global int* offset) {\n";
  for (const std::string& type : shared_structs()) text += "  " + type + " a_" + type + ";\n";
  for (std::size_t i = 0; i < kMembers.size(); ++i) {
    const std::string object = "a_" + kMembers[i].type;
    text += "  offset[" + std::to_string(i) + "] = (int)((char*)&" + object + '.' +
            kMembers[i].name + " - (char*)&" + object + ");\n";
  }
  std::vector<KernelSource> sources = shared_headers();
  sources.push_back({"find.cl", text + "}\n"});
  Device device;
  Kernel find(build_program(device, sources, {}), "find", 1);
  const Buffer<int> offset(device, kMembers.size());
  find.run(device.queue(), 1, {{"offset", offset}});
  const std::vector<int> found = offset.read(device, kMembers.size());
  for (std::size_t i = 0; i < kMembers.size(); ++i) {
    EXPECT_EQ(found[i], static_cast<int>(kMembers[i].offset))
        << kMembers[i].type << "::" << kMembers[i].name;
  }
}

}  // namespace
}  // namespace splash::sim
