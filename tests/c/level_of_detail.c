/* shx_solver_set_element_count and _lengths: splitting a moving scene is exact, joining says how far it moved, ids stay, the scene goes on,
 * and any number of threads gives the same bits.
 * shx_suggest_elements and the warning of coarse elements. */
#include <math.h>
#include "expect.h"

static void tips_of(const shx_solver *solver, const shx_strand_id ids[SCENE_STRANDS], double tips[SCENE_STRANDS][3]) {
  for (int i = 0; i < SCENE_STRANDS; i++) {
    double end = 0.1 + 0.002 * i;
    const shx_output point = {tips[i], 0, 1, SHX_FORMAT_F64X3, 0};
    EXPECT(shx_solver_sample_at(solver, ids[i], &end, 1, NULL, &point, NULL, NULL) == SHX_OK);
  }
}

static double apart(double a[3], double b[3]) { return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]); }

static uint64_t play(uint32_t threads) {
  shx_solver_def def;
  EXPECT(shx_solver_def_init(&def, sizeof def) == SHX_OK);
  def.worker_count = threads;
  shx_solver *solver;
  EXPECT(shx_solver_create(&def, &solver) == SHX_OK);
  shx_strand_id ids[SCENE_STRANDS];
  add_scene(solver, ids);
  run_scene(solver, ids);

  double before[SCENE_STRANDS][3], after[SCENE_STRANDS][3], distances[SCENE_STRANDS];
  size_t count = 0;
  tips_of(solver, ids, before);
  EXPECT(shx_solver_set_element_count(solver, ids, SCENE_STRANDS, 2 * SCENE_ELEMENTS, distances) == SHX_OK);
  tips_of(solver, ids, after);
  for (int i = 0; i < SCENE_STRANDS; i++) {
    EXPECT(shx_solver_get_element_count(solver, ids[i], &count) == SHX_OK && count == 2 * SCENE_ELEMENTS);
    EXPECT(distances[i] < 1e-12 && apart(before[i], after[i]) < 1e-12);
  }
  run_scene(solver, ids);

  tips_of(solver, ids, before);
  EXPECT(shx_solver_set_element_count(solver, ids, SCENE_STRANDS, SCENE_ELEMENTS / 2, distances) == SHX_OK);
  tips_of(solver, ids, after);
  for (int i = 0; i < SCENE_STRANDS; i++)
    EXPECT(distances[i] > 0 && distances[i] < 0.02 && apart(before[i], after[i]) <= distances[i] * (1 + 1e-9));

  const double lengths[3] = {0.01, 0.03, 0.06};
  double distance = -1;
  EXPECT(shx_solver_set_element_lengths(solver, ids[0], lengths, 3, &distance) == SHX_OK && distance > 0);
  double got[3];
  EXPECT(shx_solver_get_element_lengths(solver, ids[0], got, 3) == SHX_OK && memcmp(got, lengths, sizeof got) == 0);
  run_scene(solver, ids);
  EXPECT(shx_solver_set_element_count(solver, ids, SCENE_STRANDS, SCENE_ELEMENTS, NULL) == SHX_OK);
  run_scene(solver, ids);
  const uint64_t hash = state_hash(solver);
  shx_solver_destroy(solver);
  return hash;
}

/* How many elements: the cantilever of tests/physics/element_suggestions.rs, a tight coil, a motion; and the warning when such strands are added. */
static int warnings = 0;

static void log_message(void *user, uint32_t level, const char *message) {
  (void)user;
  if (level == SHX_LOG_WARN && strstr(message, "3 of 5 strands") != NULL && strstr(message, "defs[3]") != NULL)
    warnings++;
}

static void suggestions(void) {
  shx_strand_def strand;
  shx_suggest_def demand;
  shx_suggestion found;
  EXPECT(shx_strand_def_init(&strand, sizeof strand) == SHX_OK);
  EXPECT(shx_suggest_def_init(&demand, sizeof demand) == SHX_OK);
  EXPECT(shx_suggestion_init(&found, sizeof found) == SHX_OK);
  strand.length = 0.1;
  strand.element_count = 1;
  strand.youngs_modulus = 4 * 1300 * 9.81 * 0.001 / (50e-6 * 50e-6 * 10);
  EXPECT(shx_suggest_elements(&strand, NULL, &found) == SHX_OK); /* 1 mm, 1 % of the length */
  EXPECT(found.meets_tolerance == 1 && found.element_count == 5 && found.rest_error < 1e-3 && isnan(found.motion_error) && found.max_turning_angle < 0.6);
  shx_frame frames[30];
  for (int k = 0; k < 30; k++) {
    const shx_frame frame = {{0, 0.001 * k * k / 10, 0}, {0, 0, 0, 1}};
    frames[k] = frame;
  }
  demand.motion = frames;
  demand.motion_count = 30;
  EXPECT(shx_suggest_elements(&strand, &demand, &found) == SHX_OK);
  EXPECT(found.meets_tolerance == 1 && found.element_count >= 5 && found.motion_error > 0 && found.motion_error <= 1e-3);
  const double coil[3] = {0, 200, 0}; /* 20 rad */
  strand.natural_curvatures = coil;
  demand.motion_count = 0;
  demand.max_elements = 12;
  EXPECT(shx_suggest_elements(&strand, &demand, &found) == SHX_OK);
  EXPECT(found.meets_tolerance == 0 && found.element_count == 12 && found.max_turning_angle > 1.6);

  shx_solver_def def;
  EXPECT(shx_solver_def_init(&def, sizeof def) == SHX_OK);
  def.log = log_message;
  shx_solver *solver;
  EXPECT(shx_solver_create(&def, &solver) == SHX_OK);
  shx_strand_def strands[5];
  shx_strand_id ids[5];
  double curls[5][3] = {{0, 10, 0}, {0, 20, 0}, {0, 15, 10}, {10, 0, 30}, {0, 5, 0}}, turns[5];
  for (int i = 0; i < 5; i++) {
    strands[i] = strand;
    strands[i].natural_curvatures = curls[i];
  }
  EXPECT(shx_solver_add_strands(solver, strands, sizeof strands[0], 5, ids) == SHX_OK);
  EXPECT(warnings == 1); /* one line, whatever the number of strands */
  EXPECT(shx_solver_strand_turning_angles(solver, ids, 5, turns) == SHX_OK);
  uint32_t points[5];
  double errors[5];
  EXPECT(shx_solver_strand_quadrature(solver, ids, 5, points, errors) == SHX_OK);
  for (int i = 0; i < 5; i++)
    EXPECT(points[i] == (i == 3 ? 5u : 4u) && errors[i] <= 1e-4); /* 3.2 rad and less than 2.1 */
  EXPECT(fabs(turns[0] - 1) < 1e-12 && fabs(turns[3] - 0.1 * sqrt(1000)) < 1e-12);
  shx_solver_destroy(solver);
}

int main(void) {
  suggestions();
  EXPECT(play(1) == play(4));
  printf("elements change under way\n");
  return 0;
}
