/* Rules 7, 8 and 10: concurrent reading calls; the same bits for 1, 2, 3 and 8 workers and a host's own parallel loop; each thread its
 * own last error; a step beside a reading call is refused, never a race. */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include "expect.h"

typedef struct chunk {
  shx_range_fn function;
  void *task;
  uint32_t begin, end, worker;
} chunk;

static void *run_chunk(void *argument) {
  chunk *c = argument;
  if (c->begin < c->end)
    c->function(c->task, c->begin, c->end, c->worker);
  return NULL;
}

/* Three threads a loop, uneven ranges, backwards. */
static void parallel_for(void *user, uint32_t count, uint32_t min_range, shx_range_fn function, void *task) {
  (void)min_range;
  ++*(int *)user;
  const uint32_t cuts[4] = {0, count / 5, count / 2, count};
  pthread_t threads[3];
  chunk chunks[3];
  for (int i = 2; i >= 0; i--) {
    const chunk c = {function, task, cuts[i], cuts[i + 1], (uint32_t)i};
    chunks[i] = c;
    if (pthread_create(&threads[i], NULL, run_chunk, &chunks[i]) != 0)
      exit(1);
  }
  for (int i = 0; i < 3; i++)
    pthread_join(threads[i], NULL);
}

/* Two hosts that break their promise: ranges left out, ranges given twice. */
static void idle(void *user, uint32_t count, uint32_t min_range, shx_range_fn function, void *task) {
  (void)user, (void)count, (void)min_range, (void)function, (void)task;
}
static void doubled(void *user, uint32_t count, uint32_t min_range, shx_range_fn function, void *task) {
  (void)user, (void)min_range;
  function(task, 0, count, 0);
  function(task, count / 2, count + 7, 1);
  function(task, count, 0, 1);
}

static uint64_t hash_of(uint32_t workers, shx_parallel_for_fn loop, int *calls) {
  shx_solver_def def;
  EXPECT(shx_solver_def_init(&def, sizeof def) == SHX_OK);
  def.worker_count = workers;
  def.parallel_for = loop;
  def.parallel_for_user = calls;
  shx_solver *solver;
  shx_strand_id ids[SCENE_STRANDS];
  EXPECT(shx_solver_create(&def, &solver) == SHX_OK);
  add_scene(solver, ids);
  run_scene(solver, ids);
  const uint64_t hash = state_hash(solver);
  shx_solver_destroy(solver);
  return hash;
}

typedef struct reader {
  const shx_solver *solver;
  const shx_strand_id *ids;
  int failed;
  float points[SCENE_STRANDS * 9][4];
} reader;

static void *read_much(void *argument) {
  reader *r = argument;
  shx_sample_def def;
  r->failed |= shx_sample_def_init(&def, sizeof def) != SHX_OK;
  def.points_per_strand = 9;
  const shx_output output = {r->points, 0, SCENE_STRANDS * 9, SHX_FORMAT_F32X4, 0};
  for (int round = 0; round < 300; round++) {
    r->failed |= shx_solver_sample_strands(r->solver, r->ids, SCENE_STRANDS, &def, &output, NULL, NULL) != SHX_OK;
    uint64_t hash;
    r->failed |= shx_solver_state_hash(r->solver, &hash) != SHX_OK;
  }
  return NULL;
}

typedef struct collider_of_calls {
  shx_solver *solver;
  int other;
} collider_of_calls;

/* Steps and reads at once: each call either works or is refused as busy. */
static void *misuse(void *argument) {
  collider_of_calls *c = argument;
  for (int round = 0; round < 200; round++) {
    size_t count;
    const shx_result result = round % 2 == 0 ? shx_solver_step(c->solver, 1e-3, 1, NULL) : shx_solver_strand_count(c->solver, &count);
    c->other += result != SHX_OK && result != SHX_ERROR_BUSY;
  }
  return NULL;
}

static void *own_error(void *argument) {
  char text[200];
  *(int *)argument = shx_last_error(text, sizeof text) == 0;
  (void)shx_solver_step(NULL, 1.0, 1, NULL);
  *(int *)argument &= shx_last_error(text, sizeof text) > 0 && strstr(text, "shx_solver_step: solver is null") != NULL;
  return NULL;
}

int main(void) {
  int calls = 0;
  const uint64_t serial = hash_of(0, NULL, NULL);
  EXPECT(hash_of(1, NULL, NULL) == serial);
  EXPECT(hash_of(2, NULL, NULL) == serial);
  EXPECT(hash_of(3, NULL, NULL) == serial);
  EXPECT(hash_of(8, NULL, NULL) == serial);
  EXPECT(hash_of(3, parallel_for, &calls) == serial && calls >= 10);
  EXPECT(hash_of(0, idle, NULL) == serial);
  EXPECT(hash_of(0, doubled, NULL) == serial);

  shx_solver *solver;
  shx_strand_id ids[SCENE_STRANDS];
  EXPECT(shx_solver_create(NULL, &solver) == SHX_OK);
  add_scene(solver, ids);
  run_scene(solver, ids);
  static reader readers[4];
  pthread_t threads[4];
  for (int i = 0; i < 4; i++) {
    readers[i].solver = solver;
    readers[i].ids = ids;
    EXPECT(pthread_create(&threads[i], NULL, read_much, &readers[i]) == 0);
  }
  for (int i = 0; i < 4; i++) {
    EXPECT(pthread_join(threads[i], NULL) == 0);
    EXPECT(!readers[i].failed);
    EXPECT(memcmp(readers[i].points, readers[0].points, sizeof readers[0].points) == 0);
  }

  static collider_of_calls pair[2];
  for (int i = 0; i < 2; i++) {
    pair[i].solver = solver;
    EXPECT(pthread_create(&threads[i], NULL, misuse, &pair[i]) == 0);
  }
  for (int i = 0; i < 2; i++) {
    EXPECT(pthread_join(threads[i], NULL) == 0);
    EXPECT(pair[i].other == 0);
  }

  EXPECT(shx_solver_step(solver, -7.0, 1, NULL) == SHX_ERROR_INVALID_ARGUMENT);
  int fine = 0;
  EXPECT(pthread_create(&threads[0], NULL, own_error, &fine) == 0);
  EXPECT(pthread_join(threads[0], NULL) == 0);
  EXPECT(fine);
  char text[200];
  EXPECT(shx_last_error(text, sizeof text) > 0 && strstr(text, "-7") != NULL);
  shx_solver_destroy(solver);
  printf("the same bits from any number of threads\n");
  return 0;
}
