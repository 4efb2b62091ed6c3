// SPDX-License-Identifier: MIT
// Where points are that are none.
#ifndef SPLASH_FAR_AWAY_H
#define SPLASH_FAR_AWAY_H

#define SPLASH_FAR_AWAY 1.0e6f  // beyond every support, its square still finite [m]

#endif
