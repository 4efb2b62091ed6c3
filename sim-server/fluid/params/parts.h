// SPDX-License-Identifier: MIT
// Parts of the kernels that a scene may lack; programs are built whole unless told otherwise
// (parts.hpp). A condition that is 0 when compiled takes its branch with it.

#ifndef HAS_BODIES
#define HAS_BODIES 1
#endif
#ifndef HAS_SLOPE
#define HAS_SLOPE 1
#endif
#ifndef HAS_PISTON
#define HAS_PISTON 1
#endif
#ifndef HAS_MESH
#define HAS_MESH 1
#endif
#ifndef HAS_POCKETS
#define HAS_POCKETS 1
#endif
#ifndef HAS_FRICTION
#define HAS_FRICTION 1
#endif
