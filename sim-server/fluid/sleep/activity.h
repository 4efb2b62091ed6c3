// SPDX-License-Identifier: MIT
// What goes on in a cell of water (sleep.h): 0, it sleeps.
#ifndef SPLASH_ACTIVITY_H
#define SPLASH_ACTIVITY_H

#define SPLASH_ACTIVITY_DENSITY 1  // the particles' density is kept up
#define SPLASH_ACTIVITY_MOTION 2   // they move

#endif
