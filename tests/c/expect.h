/* What the C test programs share: an expectation that prints where it failed, and a scene of wavy strands. */
#ifndef EXPECT_H
#define EXPECT_H
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "superhelix.h"

#define EXPECT(condition)                                                      \
  do {                                                                         \
    if (!(condition)) {                                                        \
      char expect_text[512] = "";                                              \
      shx_last_error(expect_text, sizeof expect_text);                         \
      fprintf(stderr, "%s:%d: not so: %s (last error: %s)\n", __FILE__, __LINE__, #condition, expect_text); \
      exit(1);                                                                 \
    }                                                                          \
  } while (0)

enum { SCENE_STRANDS = 37, SCENE_ELEMENTS = 6 };

/* Adds strands of different curl to a solver. */
static inline void add_scene(shx_solver *solver, shx_strand_id ids[SCENE_STRANDS]) {
  static const double step = 0.01;
  shx_strand_def defs[SCENE_STRANDS];
  double natural[SCENE_STRANDS][SCENE_ELEMENTS][3];
  for (int i = 0; i < SCENE_STRANDS; i++) {
    EXPECT(shx_strand_def_init(&defs[i], sizeof defs[i]) == SHX_OK);
    defs[i].length = 0.1 + 0.002 * i;
    defs[i].element_count = SCENE_ELEMENTS;
    defs[i].air_drag = 5e-6;
    defs[i].internal_friction = 1e-10;
    defs[i].root.origin[1] = step * i;
    for (int element = 0; element < SCENE_ELEMENTS; element++) {
      natural[i][element][0] = 3.0 + i;
      natural[i][element][1] = 20.0 + element;
      natural[i][element][2] = 0.1 * i;
    }
    defs[i].natural_curvatures = &natural[i][0][0];
  }
  EXPECT(shx_solver_add_strands(solver, defs, sizeof defs[0], SCENE_STRANDS, ids) == SHX_OK);
}

static inline uint64_t state_hash(const shx_solver *solver) {
  uint64_t hash = 0;
  EXPECT(shx_solver_state_hash(solver, &hash) == SHX_OK);
  return hash;
}

/* Puts a ball under the strands of the scene, lets them touch it and each other, and pins a tip. */
static inline void add_obstacles(shx_solver *solver, const shx_strand_id ids[SCENE_STRANDS]) {
  shx_body_def ball;
  shx_body_id ball_id;
  shx_contact_options options;
  shx_strand_contact contact;
  shx_constraint_def pin;
  shx_constraint_id pin_id;
  EXPECT(shx_body_def_init(&ball, sizeof ball) == SHX_OK);
  ball.shape = SHX_SHAPE_SPHERE;
  ball.radius = 0.05;
  ball.pose.origin[0] = 0.05;
  ball.pose.origin[1] = 0.1;
  ball.pose.origin[2] = -0.06;
  EXPECT(shx_solver_add_bodies(solver, &ball, sizeof ball, 1, &ball_id) == SHX_OK);
  EXPECT(shx_contact_options_init(&options, sizeof options) == SHX_OK);
  options.model = SHX_CONTACT_PENALTY;
  options.hair_contact = 1;
  EXPECT(shx_solver_set_contact_options(solver, &options) == SHX_OK);
  EXPECT(shx_strand_contact_init(&contact, sizeof contact) == SHX_OK);
  contact.wisp_radius = 0.003;
  contact.exempt_length = 0.01;
  EXPECT(shx_solver_set_strand_contact(solver, ids, SCENE_STRANDS, &contact, 0) == SHX_OK);
  EXPECT(shx_constraint_def_init(&pin, sizeof pin) == SHX_OK);
  pin.strand = ids[3];
  pin.arclength = 0.08;
  pin.target.origin[0] = 0.05;
  pin.target.origin[1] = 0.03;
  EXPECT(shx_solver_add_constraints(solver, &pin, sizeof pin, 1, &pin_id) == SHX_OK);
}

/* Ten steps of a moving scene. */
static inline void run_scene(shx_solver *solver, const shx_strand_id ids[SCENE_STRANDS]) {
  for (int frame = 1; frame <= 10; frame++) {
    shx_frame roots[SCENE_STRANDS];
    for (int i = 0; i < SCENE_STRANDS; i++) {
      const shx_frame root = {{0.01 * frame, 0.01 * i, 0.0}, {0.0, 0.0, 0.0, 1.0}};
      roots[i] = root;
    }
    const shx_input input = {roots, 0, SCENE_STRANDS, SHX_FORMAT_FRAME, 0};
    EXPECT(shx_solver_set_root_frames(solver, ids, SCENE_STRANDS, &input, 1.0 / 60) == SHX_OK);
    EXPECT(shx_solver_step(solver, 1.0 / 60, 1, NULL) == SHX_OK);
  }
}
#endif
