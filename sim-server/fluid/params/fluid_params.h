// SPDX-License-Identifier: MIT
// Numbers that stay the same for a whole run, and bodies, shared by host and kernels.
#ifndef SPLASH_FLUID_PARAMS_H
#define SPLASH_FLUID_PARAMS_H

#include "sim-server/device/shared_struct.h"
#include "sim-server/scene/body_form.h"

#define SPLASH_MAX_WALLS 8
#define SPLASH_SLICES 4  // of each cell along x, by which points are sorted (neighbours/grid.h)

// Where pressure comes from.
#define SPLASH_WEAKLY_COMPRESSIBLE 0
#define SPLASH_GRID_PROJECTED 1

// What goes on in a cell of water (sleep/sleep.h): 0, it sleeps.
#define SPLASH_ACTIVITY_DENSITY 1  // the particles' density is kept up
#define SPLASH_ACTIVITY_MOTION 2   // they move

#ifdef __cplusplus
namespace splash::sim {
#endif

// A half-space of solid: the fluid is where normal . x > offset.
typedef struct {
  float nx, ny, nz;  // unit normal, into the fluid
  float offset;      // [m]
} WallPlane;
SPLASH_SHARED_STRUCT(WallPlane, 16)

typedef struct {
  int count;     // fluid particles
  int capacity;  // stride between the x, y and z parts of a vector array
  int cells_x;   // grid cells per axis, an empty margin on each side included
  int cells_y;
  int cells_z;
  float origin_x;  // lower corner of the grid [m]
  float origin_y;
  float origin_z;
  float inverse_cell;  // 1 / edge of a cell, the support radius [1/m]
  float support;       // H [m]
  float inverse_support;
  float length;        // smoothing length h [m]
  float kernel_norm;   // sigma of params/smoothing.h [1/m3]
  float mass;          // of a fluid particle [kg]
  float rest_density;  // [kg/m3]
  float sound_speed;   // [m/s]
  float viscous;       // 10 nu: factor of the physical viscosity, Monaghan 2005 [m2/s]
  float artificial;    // alpha c0 h: factor of the artificial one, pairs that approach [m2/s]
  float gravity_x;     // [m/s2]
  float gravity_y;
  float gravity_z;
  float pull_x;  // squared rates of the central field [1/s2]
  float pull_y;
  float pull_z;
  float centre_x;  // where it draws to [m]
  float centre_y;
  float centre_z;
  float spacing;        // [m]
  float layer_weight;   // mass of a particle per rho0 and area spacing^2: weighs a layer of it [m]
  float least_density;  // of a particle in a body of water, not in spray or a film [kg/m3]
  float torn_density;   // water that is less dense has air in it, and pulls nothing [kg/m3]
  float speed_limit;    // no particle moves faster [m/s]
  int wall_count;
  int piston;        // index of the wall that moves along its normal, -1: none
  int slope;         // index of the sloped floor, which replaces the floor (wall 0) where it
                     // is the nearer, -1: none
  int solver;        // SPLASH_WEAKLY_COMPRESSIBLE or SPLASH_GRID_PROJECTED
  float wave_speed;  // of the longest wave, sqrt(g H) of the deepest water [m/s]
  float advective_cfl;  // largest displacement in a step, unused with the state equation [spacings]
  int pockets;          // 1: air that is shut in resists, with SPLASH_GRID_PROJECTED
  WallPlane walls[SPLASH_MAX_WALLS];
} FluidParams;
SPLASH_SHARED_STRUCT(FluidParams, 39 * 4 + 16 * SPLASH_MAX_WALLS)

// Water that is stretched (pressure/state_equation.h): its stiffness over that of compressed water
// [1], and how fast it forgets that it is [1/s]. A slap's relief takes R / c0, some 10 ms, a hollow
// behind a body some tenths of a second, a few thousandths stretched at most: forgetting lets that
// grow by as much again. A pool that settles is rid of what its surface was left with.
#define SPLASH_STRETCH_STIFFNESS 0.5f
#define SPLASH_STRETCH_FADES 10.0f

// Where a body is during one step.
typedef struct {
  float px, py, pz;                 // centre [m]
  float qx, qy, qz, qw;             // body to world
  float vx, vy, vz;                 // [m/s]
  float wx, wy, wz;                 // angular velocity in the world [rad/s]
  float lower_x, lower_y, lower_z;  // box around its points, grown by the support radius [m]
  float upper_x, upper_y, upper_z;
  float speed;  // of its fastest point, at most [m/s]
  float lacks;  // of its size, while it appears (boundary/bodies.h) [1]
  float grows;  // by so much of its size [1/s]
} BodyStep;
SPLASH_SHARED_STRUCT(BodyStep, 22 * 4)

// A body slower than this is at rest: trackers tremble [m/s].
#define SPLASH_TREMBLE 1e-3f

// Radius of edges and corners of bodies (free_bodies/outline_gap.h) [least half size].
#define SPLASH_ROUNDED 0.02f

// The outline of a body in its own axes.
typedef struct {
  int kind;                      // a BodyForm
  float half_x, half_y, half_z;  // how far it reaches from its origin, either way [m]
  float rocker;                  // the sole of a box curves up at both x ends by this [m]
  float flat;                    // share of its length, in the middle, that does not curve [1]
  int free;                      // 1: the water moves it (free_bodies/), 0: it goes its way
  // Meshes only: where the mesh's distance on a grid, its vertices and the points along its sharp
  // edges are in the array that holds the numbers of all meshes.
  int field;  // where its distances begin, x fastest [m]
  int nodes_x, nodes_y, nodes_z;
  float lower_x, lower_y, lower_z;  // first node [m]
  float cell;                       // between nodes [m]
  int vertices;                     // where they begin, x y z of each [m]
  int vertex_count;
} BodyShape;
SPLASH_SHARED_STRUCT(BodyShape, 17 * 4)

// A body that the water moves. Its centre is that of its mass.
typedef struct {
  int body;              // number among all bodies
  float mass;            // [kg]
  float ix, iy, iz;      // moments of inertia [kg m2]
  float size;            // lever by which spins are made speeds: all unknowns of one unit [m]
  float restitution;     // of its speed, after a knock against a wall or another body [1]
  float friction;        // on those, Coulomb [1]
  float ax, ay, az, aw;  // its own axes to the principal ones, of which the moments are
  // On the device that it hangs on; all 0: on none (boundary/body_spring.h).
  float spring;          // [N/m]
  float damper;          // [N s/m]
  float turning_spring;  // [N m/rad]
  float turning_damper;  // [N m s]
  int held;              // bits of what it does not do: move along x y z, turn about x y z
} FreeBody;
SPLASH_SHARED_STRUCT(FreeBody, 17 * 4)

// Where a device is that a body hangs on by a spring, when a step begins.
typedef struct {
  float px, py, pz;      // [m]
  float qx, qy, qz, qw;  // device to world
  float vx, vy, vz;      // [m/s]
  float wx, wy, wz;      // [rad/s]
} Anchor;
SPLASH_SHARED_STRUCT(Anchor, 13 * 4)

// Fields of what a particle and a free body in its reach do to each other
// (free_bodies/body_reach.h).
#define SPLASH_REACH_FIELDS 8
// Parts of the water that are summed side by side, and what each sums: a push of six components and
// an inertia of 21.
#define SPLASH_PUSH_PARTS 64
#define SPLASH_PUSH_ENTRIES 27
// What each part sums of a body's film (free_bodies/body_film.cl): of its rim, and of its push.
#define SPLASH_RIM_ENTRIES 10
#define SPLASH_FILM_ENTRIES 8
// Room for each free body's contacts with walls and other bodies, and for one of them
// (free_bodies/contact.h).
#define SPLASH_CONTACTS 96
#define SPLASH_CONTACT_FLOATS 32

// What is left of a contact for the next step.
typedef struct {
  int key;
  float pushed;  // [N s]
} KeptPush;
SPLASH_SHARED_STRUCT(KeptPush, 8)

#ifdef __cplusplus
}  // namespace splash::sim
#endif

#endif
