// SPDX-License-Identifier: MIT
// The coordinates of padding: entries of an array of points that are no points.
#ifndef SPLASH_FAR_AWAY_H
#define SPLASH_FAR_AWAY_H

#define SPLASH_FAR_AWAY 1.0e6f  // beyond every support, its square still finite [m]

#endif
