// SPDX-License-Identifier: MIT
// The forms that bodies have, listed once for the host, for kernels and for scene files. What
// depends on the form is a switch that names all of them, without a default: the host's compiler
// and the test of the kernels' language point out each one that lacks a new form.
#ifndef SPLASH_BODY_FORM_H
#define SPLASH_BODY_FORM_H

// Each as the host and as kernels call it, and what its three sizes are. Meshes last: they are
// files, the others have names in scene files.
#define SPLASH_BODY_FORMS(FORM)                                          \
  FORM(box, SPLASH_BOX, "edges x y z")                                   \
  FORM(sphere, SPLASH_SPHERE, "its diameter thrice")                     \
  FORM(cylinder, SPLASH_CYLINDER, "diameter, diameter, length along z")  \
  FORM(mesh, SPLASH_MESH, "")

#define SPLASH_FORM_OF_HOST(name, in_kernels, sizes) name,
#define SPLASH_FORM_IN_KERNELS(name, in_kernels, sizes) in_kernels,

#ifdef __cplusplus
namespace splash::sim {

enum class ShapeKind { SPLASH_BODY_FORMS(SPLASH_FORM_OF_HOST) };
#endif

typedef enum { SPLASH_BODY_FORMS(SPLASH_FORM_IN_KERNELS) } BodyForm;

#ifdef __cplusplus
}  // namespace splash::sim
#endif

#endif
