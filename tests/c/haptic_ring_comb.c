/* Ring combs in the hand from C: one does what a ring comb of the host's own does along the same path, the hand feels what the strands on its
 * teeth pull with, what fails changes nothing, and what is let go is free. */
#include <math.h>
#include "expect.h"

enum { STRANDS = 12, STEPS = 1000 };
static const double DT = 1e-3;

/* Teeth point along y; the comb is x aside and z high. */
static shx_frame comb_at(double x, double z) {
  const double half = sqrt(0.5);
  const shx_frame frame = {{x, -0.03, z}, {-half, 0, 0, half}};
  return frame;
}

/* Into the hair from the side within 0.3 s, then down. */
static shx_frame path(int step) {
  const double t = DT * step, part = fmin(t / 0.3, 1.0), down = fmax(t - 0.3, 0.0);
  return comb_at(-0.03 + 0.035 * part, -0.02 - 0.12 * down);
}

/* Hair that hangs down, and a body a metre off: what the hand holds must not touch it. */
static shx_solver *make_scene(shx_strand_id ids[STRANDS], shx_body_id *held) {
  const double half = sqrt(0.5);
  shx_solver *solver;
  shx_body_def handle;
  EXPECT(shx_solver_create(NULL, &solver) == SHX_OK);
  for (int i = 0; i < STRANDS; i++) {
    shx_strand_def def;
    EXPECT(shx_strand_def_init(&def, sizeof def) == SHX_OK);
    def.length = i % 2 == 0 ? 0.06 : 0.14; /* the short ones are combed to their tips */
    def.element_count = 6;
    def.viscosity = 5e-3;
    def.root = (shx_frame){{0.002 * (i % 4), 0.002 * (i / 4), 0}, {0, half, 0, half}};
    EXPECT(shx_solver_add_strands(solver, &def, sizeof def, 1, &ids[i]) == SHX_OK);
  }
  EXPECT(shx_body_def_init(&handle, sizeof handle) == SHX_OK);
  handle.shape = SHX_SHAPE_SPHERE;
  handle.radius = 1e-3;
  handle.pose = path(0);
  handle.pose.origin[0] += 1.0;
  EXPECT(shx_solver_add_bodies(solver, &handle, sizeof handle, 1, held) == SHX_OK);
  return solver;
}

static size_t constraints(const shx_solver *solver) {
  size_t count;
  EXPECT(shx_solver_constraint_count(solver, &count) == SHX_OK);
  return count;
}

/* Counts are equal; forces, N, and torques, N m, to within a tolerance. */
static int agree(const shx_ring_comb_report *a, const shx_ring_comb_report *b, double tolerance) {
  double most = 0.0;
  for (int axis = 0; axis < 3; axis++)
    most = fmax(most, fmax(fabs(a->force[axis] - b->force[axis]), fabs(a->torque[axis] - b->torque[axis])));
  return a->held == b->held && a->caught == b->caught && a->combed == b->combed && a->let_go == b->let_go && most <= tolerance;
}

int main(int argc, char **argv) {
  const int steps = argc > 1 ? atoi(argv[1]) : STEPS; /* fewer, with hair on the teeth at the end, under valgrind */
  shx_strand_id ids[STRANDS], twin_ids[STRANDS], other_ids[STRANDS];
  shx_body_id held, twin_held, other_held;
  shx_solver *solver = make_scene(ids, &held), *twin = make_scene(twin_ids, &twin_held), *other = make_scene(other_ids, &other_held);
  shx_haptic_def def;
  shx_haptic_state state;
  shx_haptic *hand;
  EXPECT(shx_haptic_def_init(&def, sizeof def) == SHX_OK && shx_haptic_state_init(&state, sizeof state) == SHX_OK);
  def.mode = SHX_HAPTIC_MODE_DIRECT;
  def.handle = (shx_frame){{-1.0, 0, 0}, {0, 0, 0, 1}}; /* in the body's axes: where the comb is */
  const double half = sqrt(0.5);
  EXPECT(shx_haptic_create(solver, &def, &held, 1, &hand) == SHX_OK);

  shx_tool_def tool;
  EXPECT(shx_tool_def_init(&tool, sizeof tool) == SHX_OK);
  tool.kind = SHX_TOOL_COMB;
  tool.length = 0.06;
  shx_frame frame = path(0), told = {{7, 7, 7}, {7, 7, 7, 7}};
  shx_ring_comb_report report, before, zero;
  memset(&zero, 0, sizeof zero);
  memset(&report, 0x55, sizeof report);

  /* Without combs there is nothing to report; what fails adds none, and writes nothing. */
  const uint64_t hash = state_hash(solver);
  size_t index = 77;
  before = report;
  EXPECT(shx_haptic_ring_comb_report(hand, 0, &report) == SHX_ERROR_INVALID_ARGUMENT && memcmp(&report, &before, sizeof report) == 0);
  EXPECT(shx_haptic_add_ring_comb(hand, other, &tool, &frame, NULL, other_ids, STRANDS, &index) == SHX_ERROR_INVALID_ID && index == 77);
  EXPECT(shx_haptic_add_ring_comb(hand, solver, &tool, &frame, NULL, other_ids, STRANDS, &index) == SHX_ERROR_INVALID_ID && index == 77);
  tool.kind = SHX_TOOL_PLATES;
  EXPECT(shx_haptic_add_ring_comb(hand, solver, &tool, &frame, NULL, ids, STRANDS, &index) == SHX_ERROR_UNSUPPORTED && index == 77);
  tool.kind = SHX_TOOL_COMB;
  EXPECT(shx_haptic_ring_comb_frame(hand, 0, &told) == SHX_ERROR_INVALID_ARGUMENT && told.origin[0] == 7);
  EXPECT(state_hash(solver) == hash);

  /* Two combs at once, of which one may catch nothing. Their definitions need not stay. */
  {
    shx_tool_def passing = tool;
    shx_frame here = frame;
    shx_strand_id list[STRANDS];
    memcpy(list, ids, sizeof list);
    EXPECT(shx_haptic_add_ring_comb(hand, solver, &passing, &here, NULL, list, STRANDS, &index) == SHX_OK && index == 0);
    here.origin[2] -= 0.01;
    EXPECT(shx_haptic_add_ring_comb(hand, solver, &passing, &here, NULL, NULL, 0, &index) == SHX_OK && index == 1);
    memset(&passing, 0xff, sizeof passing);
    memset(&here, 0xff, sizeof here);
    memset(list, 0xff, sizeof list);
  }
  EXPECT(shx_haptic_ring_comb_report(hand, 0, &report) == SHX_OK && agree(&report, &zero, 0));
  EXPECT(shx_haptic_ring_comb_frame(hand, 0, &told) == SHX_OK);
  for (int axis = 0; axis < 3; axis++)
    EXPECT(fabs(told.origin[axis] - frame.origin[axis]) < 1e-12);
  EXPECT(fabs(told.rotation[0] + half) < 1e-12 && fabs(told.rotation[3] - half) < 1e-12);

  /* A comb of the host's own along the same path, in the same hair. */
  shx_ring_comb *own;
  EXPECT(shx_ring_comb_create(&tool, &told, NULL, &own) == SHX_OK);
  unsigned caught = 0, combed = 0, most = 0;
  double wrench[6], strongest = 0, upward = 0, velocity[6] = {0};
  shx_frame last = path(0);
  memset(&before, 0, sizeof before);
  for (int step = 0; step < steps; step++) {
    const shx_frame pose = path(step);
    for (int axis = 0; axis < 3; axis++)
      velocity[axis] = (pose.origin[axis] - last.origin[axis]) / DT;
    last = pose;
    EXPECT(shx_haptic_update(hand, &pose, velocity, DT, wrench, &state) == SHX_OK);
    /* In direct mode the hand feels what the step before made of the hair: by no other thing, the bodies being far off. */
    for (int axis = 0; axis < 3; axis++)
      EXPECT(fabs(state.contact_force[axis] - before.force[axis]) < 1e-12);
    EXPECT(state.max_energy_excess <= def.energy_allowance);
    upward += step >= 700 ? wrench[2] : 0; /* on the way down along hair that hangs */
    EXPECT(shx_haptic_before_step(hand, solver, DT) == SHX_OK);
    EXPECT(shx_solver_step(solver, DT, 1, NULL) == SHX_OK);
    EXPECT(shx_haptic_after_step(hand, solver) == SHX_OK);
    EXPECT(shx_haptic_ring_comb_report(hand, 0, &report) == SHX_OK && shx_haptic_ring_comb_frame(hand, 0, &told) == SHX_OK);
    for (int axis = 0; axis < 3; axis++)
      EXPECT(fabs(told.origin[axis] - state.proxy.origin[axis]) < 1e-12);

    EXPECT(shx_ring_comb_before_step(own, twin, twin_ids, STRANDS, &told, DT) == SHX_OK);
    EXPECT(shx_solver_step(twin, DT, 1, NULL) == SHX_OK);
    EXPECT(shx_ring_comb_after_step(own, twin, &before) == SHX_OK);
    EXPECT(agree(&report, &before, 1e-12)); /* a frame given from outside is rounded */
    caught += report.caught;
    combed += report.combed;
    most = report.held > most ? report.held : most;
    strongest = fmax(strongest, sqrt(pow(report.force[0], 2) + pow(report.force[1], 2) + pow(report.force[2], 2)));
    EXPECT(shx_haptic_ring_comb_report(hand, 1, &report) == SHX_OK && agree(&report, &zero, 0));
  }
  EXPECT(most >= 4 && caught >= most && strongest > 1e-5);
  EXPECT(steps < STEPS || (combed >= 1 && upward > 0));
  EXPECT(constraints(solver) > 0 && constraints(solver) == before.held);

  /* Another solver's hair is not this hand's; then all of it is let go, twice without harm, and none is on a tooth any more. */
  const size_t held_count = constraints(solver);
  EXPECT(shx_haptic_release_ring_combs(hand, other) == SHX_ERROR_INVALID_ID && constraints(solver) == held_count);
  EXPECT(shx_haptic_release_ring_combs(hand, solver) == SHX_OK && constraints(solver) == 0);
  EXPECT(shx_haptic_release_ring_combs(hand, solver) == SHX_OK && constraints(solver) == 0);

  /* The haptic object frees its combs, whatever is on them; what holds the strands belongs to the solver. */
  shx_haptic_destroy(hand);
  shx_ring_comb_destroy(own);
  EXPECT(constraints(twin) == before.held);
  shx_solver_destroy(other);
  shx_solver_destroy(twin);
  shx_solver_destroy(solver);
  return 0;
}
