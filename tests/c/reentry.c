/* Rule 5: a call from a callback into the solver that is calling is SHX_ERROR_BUSY, from log and from parallel_for, for every kind of
 * call; destroy from a callback frees nothing. Another solver may be used. */
#include "expect.h"

typedef struct host {
  shx_solver *self, *other;
  shx_result changing, reading, other_one, adding, listing;
  bool has;
  shx_strand_id id;
  int calls;
} host;

static void call_in(host *h) {
  if (h->self == NULL || h->calls > 0)
    return;
  h->calls++;
  size_t count = 12345;
  h->changing = shx_solver_step(h->self, 0.01, 1, NULL);
  h->reading = shx_solver_strand_count(h->self, &count);
  if (count != 12345)
    exit(1);
  shx_body_def def;
  shx_body_id id = {12345};
  EXPECT(shx_body_def_init(&def, sizeof def) == SHX_OK);
  def.shape = SHX_SHAPE_SPHERE;
  def.radius = 1.0;
  h->adding = shx_solver_add_bodies(h->self, &def, sizeof def, 1, &id);
  h->listing = shx_solver_contacts(h->self, NULL, 0, 0, &count);
  if (count != 12345 || id.bits != 12345)
    exit(1);
  h->has = shx_solver_has_strand(h->self, h->id);
  shx_solver_destroy(h->self);
  h->other_one = shx_solver_step(h->other, 0.01, 1, NULL);
}

static void log_message(void *user, uint32_t level, const char *message) {
  (void)level;
  (void)message;
  call_in(user);
}

static void parallel_for(void *user, uint32_t count, uint32_t min_range, shx_range_fn function, void *task) {
  (void)min_range;
  call_in(user);
  function(task, 0, count, 0);
}

static void check(int from_log, int contact) {
  host h = {NULL, NULL, SHX_OK, SHX_OK, SHX_OK, SHX_OK, SHX_OK, true, {0}, 0};
  shx_solver_def def;
  EXPECT(shx_solver_def_init(&def, sizeof def) == SHX_OK);
  if (from_log) {
    def.log = log_message;
    def.log_user = &h;
    def.log_level = SHX_LOG_DEBUG;
  } else {
    def.parallel_for = parallel_for;
    def.parallel_for_user = &h;
  }
  shx_solver *solver;
  shx_strand_id ids[SCENE_STRANDS], other_ids[SCENE_STRANDS];
  EXPECT(shx_solver_create(&def, &solver) == SHX_OK);
  EXPECT(shx_solver_create(NULL, &h.other) == SHX_OK);
  add_scene(solver, ids);
  add_scene(h.other, other_ids);
  if (contact) {
    add_obstacles(solver, ids);
    add_obstacles(h.other, other_ids);
  }
  h.id = ids[0];
  h.self = solver;
  EXPECT(shx_solver_step(solver, 0.01, 1, NULL) == SHX_OK);
  EXPECT(h.calls == 1);
  EXPECT(h.changing == SHX_ERROR_BUSY && h.reading == SHX_ERROR_BUSY && !h.has && h.other_one == SHX_OK);
  EXPECT(h.adding == SHX_ERROR_BUSY && h.listing == SHX_ERROR_BUSY);
  /* The solver was not hurt: it goes on like one that was left in peace. */
  EXPECT(shx_solver_step(solver, 0.01, 1, NULL) == SHX_OK);
  EXPECT(shx_solver_step(h.other, 0.01, 1, NULL) == SHX_OK);
  EXPECT(state_hash(solver) == state_hash(h.other));
  h.self = NULL;
  shx_solver_destroy(solver);
  shx_solver_destroy(h.other);
}

int main(void) {
  for (int contact = 0; contact <= 1; contact++) {
    check(1, contact);
    check(0, contact);
  }
  printf("re-entry is refused and harmless\n");
  return 0;
}
