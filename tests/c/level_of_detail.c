/* shx_solver_set_element_count and _lengths: splitting a moving scene is exact, joining says how far it moved, ids stay, the scene goes on,
 * and any number of threads gives the same bits. */
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
    EXPECT(shx_solver_element_count(solver, ids[i], &count) == SHX_OK && count == 2 * SCENE_ELEMENTS);
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

int main(void) {
  EXPECT(play(1) == play(4));
  printf("elements change under way\n");
  return 0;
}
