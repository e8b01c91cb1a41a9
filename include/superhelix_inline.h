// Conveniences for C and C++ on top of superhelix.h: nothing here is part of the library's binary interface. C99 and C++17; needs -lm.

#ifndef SUPERHELIX_INLINE_H
#define SUPERHELIX_INLINE_H

#include <math.h>

#include "superhelix.h"

#ifdef __cplusplus
extern "C" {
#endif

// An input of count items, tightly packed. format is SHX_FORMAT_.
static inline shx_input shx_make_input(const void *data, size_t count, uint32_t format) {
  const shx_input input = {data, 0, count, format, 0};
  return input;
}

// An output for count items, tightly packed. format is SHX_FORMAT_.
static inline shx_output shx_make_output(void *data, size_t count, uint32_t format) {
  const shx_output output = {data, 0, count, format, 0};
  return output;
}

// Puts settings (shx_settings_from_preset, shx_settings_suggest) into the definition of a solver. The number of elements goes into your strands, and
// the number of substeps into shx_solver_step.
static inline void shx_apply_settings(const shx_settings *settings, shx_solver_def *def) {
  def->integrator = settings->integrator;
  def->max_iterations = settings->max_iterations;
  def->max_subdivisions = settings->max_subdivisions;
  def->tolerance = settings->tolerance;
  def->error_tolerance = settings->error_tolerance;
  def->quadrature_tolerance = settings->quadrature_tolerance;
}

// The frame inner, given in the axes of outer, in the axes that outer is given in.
static inline shx_frame shx_frame_compose(const shx_frame *outer, const shx_frame *inner) {
  const double *a = outer->rotation, *b = inner->rotation, *p = inner->origin;
  // t = 2 a x p
  const double t0 = 2 * (a[1] * p[2] - a[2] * p[1]), t1 = 2 * (a[2] * p[0] - a[0] * p[2]), t2 = 2 * (a[0] * p[1] - a[1] * p[0]);
  const shx_frame frame = {
      {outer->origin[0] + p[0] + a[3] * t0 + a[1] * t2 - a[2] * t1, outer->origin[1] + p[1] + a[3] * t1 + a[2] * t0 - a[0] * t2,
       outer->origin[2] + p[2] + a[3] * t2 + a[0] * t1 - a[1] * t0},
      {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] + a[1] * b[3] + a[2] * b[0] - a[0] * b[2],
       a[3] * b[2] + a[2] * b[3] + a[0] * b[1] - a[1] * b[0], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]}};
  return frame;
}

// The frame that frame is the inverse of: composed with frame, in either order, it gives the world's.
static inline shx_frame shx_frame_inverse(const shx_frame *frame) {
  const shx_frame turn = {{0, 0, 0}, {-frame->rotation[0], -frame->rotation[1], -frame->rotation[2], frame->rotation[3]}};
  const shx_frame back = {{-frame->origin[0], -frame->origin[1], -frame->origin[2]}, {0, 0, 0, 1}};
  return shx_frame_compose(&turn, &back);
}

// Puts what shx_hair_strands generated into the definition of a strand: section, material, drag. Turns def->root about its tangent by root_turn: set
// the root before. Curvatures and element lengths are arrays of yours; set them yourself.
static inline void shx_apply_hair_strand(const shx_hair_strand *strand, shx_strand_def *def) {
  const double half = 0.5 * strand->root_turn;
  const shx_frame turn = {{0, 0, 0}, {sin(half), 0, 0, cos(half)}};
  def->radius[0] = strand->radius[0];
  def->radius[1] = strand->radius[1];
  def->density = strand->density;
  def->youngs_modulus = strand->youngs_modulus;
  def->poisson_ratio = strand->poisson_ratio;
  def->internal_friction = strand->internal_friction;
  def->viscosity = strand->viscosity;
  def->air_drag = strand->air_drag;
  def->root = shx_frame_compose(&def->root, &turn);
}

// Puts the friction of a generated strand into what it is to contact.
static inline void shx_apply_hair_friction(const shx_hair_strand *strand, shx_strand_contact *contact) {
  contact->friction_along = contact->hair_friction_along = strand->friction_along;
  contact->friction_against = contact->hair_friction_against = strand->friction_against;
}

#ifdef __cplusplus
}
#endif

#endif  // SUPERHELIX_INLINE_H
