/* Tools on a lock of wavy hair: styling. A comb is drawn through it and lets each strand go at its tip, plates straighten it, scissors trim
   it, a clip holds it, and the style is frozen until a finger wakes it. Writes what happens. */
#include <math.h>
#include <string.h>
#include "check.h"

enum { STRANDS = 24, ELEMENTS = 10, MANY = 128 };
static const double LENGTH = 0.12, STEP = 1.0 / 120.0;
static const shx_frame DOWN = {{0, 0, 0}, {0, 0.70710678118654757, 0, 0.70710678118654757}};

/* A frame at a place, its axes along the world's, or turned so that the teeth of a tool point along y. */
static shx_frame at(double x, double y, double z, int teeth_along_y) {
  shx_frame frame = {{0, 0, 0}, {0, 0, 0, 1}};
  frame.origin[0] = x;
  frame.origin[1] = y;
  frame.origin[2] = z;
  if (teeth_along_y) {
    frame.rotation[0] = -0.70710678118654757;
    frame.rotation[3] = 0.70710678118654757;
  }
  return frame;
}

/* How far tips hang below their roots, the mean, m. */
static double hang(const shx_solver *solver, const shx_strand_id ids[STRANDS]) {
  double points[2 * STRANDS][3], sum = 0;
  shx_sample_def sample;
  shx_output out;
  CHECK(shx_sample_def_init(&sample, sizeof sample));
  sample.points_per_strand = 2;
  memset(&out, 0, sizeof out);
  out.data = points;
  out.count = 2 * STRANDS;
  out.format = SHX_FORMAT_F64X3;
  CHECK(shx_solver_sample_strands(solver, ids, STRANDS, &sample, &out, NULL, NULL));
  for (int k = 0; k < STRANDS; k++)
    sum += points[2 * k][2] - points[2 * k + 1][2];
  return sum / STRANDS;
}

int main(void) {
  shx_solver *solver;
  shx_strand_id ids[STRANDS];
  shx_strand_def strand;
  shx_strand_contact contact;
  double natural[ELEMENTS][3];
  CHECK(shx_solver_create(NULL, &solver));
  CHECK(shx_strand_def_init(&strand, sizeof strand));
  CHECK(shx_strand_contact_init(&contact, sizeof contact));
  for (int i = 0; i < ELEMENTS; i++) {
    natural[i][0] = 4;
    natural[i][1] = 45;
    natural[i][2] = 0;
  }
  strand.element_count = ELEMENTS;
  strand.length = LENGTH;
  strand.natural_curvatures = natural[0];
  strand.viscosity = 5e-3;
  for (int k = 0; k < STRANDS; k++) {
    strand.root = DOWN;
    strand.root.origin[0] = 2e-3 * (k % 6 - 2.5);
    strand.root.origin[1] = 2e-3 * (k / 6 - 1.5);
    CHECK(shx_solver_add_strands(solver, &strand, sizeof strand, 1, &ids[k]));
  }
  CHECK(shx_solver_set_strand_contact(solver, ids, STRANDS, &contact, 0));
  for (int i = 0; i < 240; i++)
    CHECK(shx_solver_step(solver, STEP, 1, NULL));
  printf("hangs by %.1f mm\n", 1e3 * hang(solver, ids));

  /* The comb: into the lock from the side, down through it. Its teeth hold what they meet until that is combed. */
  shx_tool_def tool;
  shx_ring_comb *comb;
  shx_ring_comb_report report;
  unsigned caught = 0, combed = 0, let_go = 0;
  double strongest = 0;
  shx_frame frame = at(-0.03, -0.03, -0.015, 1);
  CHECK(shx_tool_def_init(&tool, sizeof tool));
  tool.kind = SHX_TOOL_COMB;
  tool.length = 0.06;
  CHECK(shx_ring_comb_create(&tool, &frame, NULL, &comb));
  for (int i = 1; i <= 300; i++) {
    const double in = i < 80 ? i / 80.0 : 1, down = i < 80 ? 0 : (i - 80) / 220.0;
    frame = at(-0.03 * (1 - in), -0.03, -0.015 - 0.14 * down, 1);
    CHECK(shx_ring_comb_before_step(comb, solver, ids, STRANDS, &frame, STEP));
    CHECK(shx_solver_step(solver, STEP, 1, NULL));
    CHECK(shx_ring_comb_after_step(comb, solver, &report));
    caught += report.caught;
    combed += report.combed;
    let_go += report.let_go;
    strongest = fmax(strongest, sqrt(report.force[0] * report.force[0] + report.force[1] * report.force[1] + report.force[2] * report.force[2]));
  }
  CHECK(shx_ring_comb_release(comb, solver));
  shx_ring_comb_destroy(comb);
  printf("combed %u of %u that were caught, %u let go; the comb felt up to %.0f uN\n", combed, caught, let_go, 1e6 * strongest);

  /* Plates that glide down: what is between them becomes straight. */
  shx_heat_def heat;
  CHECK(shx_tool_def_init(&tool, sizeof tool));
  tool.kind = SHX_TOOL_PLATES;
  CHECK(shx_heat_def_init(&heat, sizeof heat));
  CHECK(shx_tool_hot_box(&tool, 0.02, heat.half_edges));
  heat.shape = SHX_HEAT_STRAIGHT;
  heat.rate = 8;
  for (int i = 0; i < 360; i++) {
    heat.pose = at(0, 0, -0.15 * i / 360, 0);
    CHECK(shx_solver_heat_strands(solver, &heat, ids, STRANDS, STEP, NULL));
    CHECK(shx_solver_step(solver, STEP, 1, NULL));
  }
  printf("straightened, it hangs by %.1f mm\n", 1e3 * hang(solver, ids));

  /* Scissors: a blade across the lock. */
  const double blade[12] = {-0.1, -0.1, -0.1, 0.1, -0.1, -0.1, 0.1, 0.1, -0.1, -0.1, 0.1, -0.1};
  shx_cut cuts[STRANDS];
  size_t cut_count;
  double shortest = LENGTH;
  CHECK(shx_solver_scissor_strands(solver, ids, STRANDS, blade, 1e-3, cuts, &cut_count));
  for (size_t i = 0; i < cut_count; i++)
    shortest = fmin(shortest, cuts[i].length);
  printf("cut %zu, the shortest is %.1f mm\n", cut_count, 1e3 * shortest);

  /* A clip: closed on the lock, moved aside, opened. */
  shx_clip_def clip;
  shx_constraint_id held[MANY];
  size_t held_count;
  CHECK(shx_clip_def_init(&clip, sizeof clip));
  clip.kind = SHX_CONSTRAINT_POINT;
  clip.pose = at(0, 0, -0.06, 0);
  clip.half_edges[0] = clip.half_edges[1] = 0.03;
  clip.half_edges[2] = 0.004;
  CHECK(shx_solver_clip_strands(solver, &clip, ids, STRANDS, held, MANY, &held_count));
  frame = at(0.02, 0, -0.055, 0);
  CHECK(shx_solver_move_constraints(solver, held, held_count, &clip.pose, &frame, 0.5));
  for (int i = 0; i < 120; i++)
    CHECK(shx_solver_step(solver, STEP, 1, NULL));
  printf("clipped %zu\n", held_count);
  CHECK(shx_solver_remove_constraints(solver, held, held_count));

  /* The current style is frozen; a finger wakes the strands that it approaches. */
  uint8_t frozen[STRANDS];
  shx_body_id finger[1];
  size_t count;
  unsigned awake = 0;
  CHECK(shx_solver_freeze_strands(solver, ids, STRANDS));
  const double before = hang(solver, ids);
  for (int i = 0; i < 120; i++)
    CHECK(shx_solver_step(solver, STEP, 1, NULL));
  printf("frozen, it moves by %.1g mm\n", 1e3 * fabs(hang(solver, ids) - before));
  CHECK(shx_tool_def_init(&tool, sizeof tool));
  tool.kind = SHX_TOOL_FINGER;
  frame = at(-0.03, -0.03, -0.05, 1);
  CHECK(shx_solver_add_tool(solver, &tool, &frame, 0, finger, 1, &count));
  for (int i = 1; i <= 60; i++) {
    shx_input frames;
    memset(&frames, 0, sizeof frames);
    frame = at(-0.03 + 0.037 * i / 60, -0.03, -0.05, 1);
    frames.data = &frame;
    frames.count = 1;
    frames.format = SHX_FORMAT_FRAME;
    CHECK(shx_solver_set_body_frames(solver, finger, 1, &frames, STEP));
    CHECK(shx_solver_step(solver, STEP, 1, NULL));
  }
  CHECK(shx_solver_frozen_strands(solver, ids, STRANDS, frozen));
  for (int k = 0; k < STRANDS; k++)
    awake += frozen[k] == 0;
  printf("the finger woke %u\n", awake);
  shx_solver_destroy(solver);
  return 0;
}
