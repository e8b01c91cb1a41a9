/* Rule 5: the host's floating-point mode (flush-to-zero, denormals-are-zero, rounding, sticky flags, unmasked traps) neither changes
 * the result nor is changed; callbacks see it, and tasks of a host's threads are guarded as well. */
#define _GNU_SOURCE
#include <fenv.h>
#include "expect.h"

#if defined(__x86_64__)
static unsigned mode(void) { return __builtin_ia32_stmxcsr(); }
static void set_mode(unsigned value) { __builtin_ia32_ldmxcsr(value); }
/* Flush to zero, denormals are zero, round up, division by zero and invalid trap, the inexact flag set. */
enum { HOSTILE = 0x8000 | 0x0040 | 0x4000 | (0x1f80 & ~(0x0080 | 0x0200)) | 0x0020, PLAIN = 0x1f80 };
#else
#include <stdint.h>
static unsigned mode(void) { uint64_t control; __asm__ volatile("mrs %0, fpcr" : "=r"(control)); return (unsigned)control; }
static void set_mode(unsigned value) { uint64_t control = value; __asm__ volatile("msr fpcr, %0" : : "r"(control)); }
enum { HOSTILE = 1 << 24 | 1 << 22, PLAIN = 0 };
#endif

static unsigned seen_by_log;

static void log_message(void *user, uint32_t level, const char *message) {
  (void)user;
  (void)level;
  (void)message;
  seen_by_log = mode();
}

/* A host whose tasks run in its own mode. */
static void parallel_for(void *user, uint32_t count, uint32_t min_range, shx_range_fn function, void *task) {
  (void)min_range;
  const unsigned before = mode();
  *(unsigned *)user = before;
  for (uint32_t item = 0; item < count; item++) {
    set_mode(HOSTILE);
    function(task, item, item + 1, 0);
    EXPECT(mode() == HOSTILE);
  }
  set_mode(before);
}

static uint64_t hash_in(unsigned wanted, int host_tasks, int contact) {
  unsigned seen_by_tasks = 0;
  shx_solver_def def;
  EXPECT(shx_solver_def_init(&def, sizeof def) == SHX_OK);
  def.log = log_message;
  def.log_level = SHX_LOG_DEBUG;
  if (host_tasks) {
    def.parallel_for = parallel_for;
    def.parallel_for_user = &seen_by_tasks;
  }
  shx_solver *solver;
  shx_strand_id ids[SCENE_STRANDS];
  EXPECT(shx_solver_create(&def, &solver) == SHX_OK);
  add_scene(solver, ids);
  /* A mode that flushes or rounds otherwise matters for the host's own numbers in run_scene: they are made in the plain mode. */
  shx_frame roots[10][SCENE_STRANDS];
  for (int frame = 0; frame < 10; frame++)
    for (int i = 0; i < SCENE_STRANDS; i++) {
      const shx_frame root = {{0.01 * frame, 0.01 * i, 0.0}, {0.0, 0.0, 0.0, 1.0}};
      roots[frame][i] = root;
    }
  const double dt = 1.0 / 60;
  set_mode(wanted);
  if (contact)
    add_obstacles(solver, ids);
  for (int frame = 0; frame < 10; frame++) {
    const shx_input input = {roots[frame], 0, SCENE_STRANDS, SHX_FORMAT_FRAME, 0};
    const shx_result moved = shx_solver_set_root_frames(solver, ids, SCENE_STRANDS, &input, dt);
    const shx_result stepped = shx_solver_step(solver, dt, 2, NULL);
    const unsigned after = mode();
    if (moved != SHX_OK || stepped != SHX_OK || after != wanted) {
      set_mode(PLAIN);
      fprintf(stderr, "results %d, %d; mode 0x%x after a call in mode 0x%x\n", moved, stepped, after, wanted);
      exit(1);
    }
  }
  (void)shx_solver_step(solver, -1.0, 1, NULL); /* a failing call restores it too */
  const unsigned after = mode();
  set_mode(PLAIN);
  EXPECT(after == wanted);
  EXPECT(seen_by_log == wanted);
  EXPECT(!host_tasks || seen_by_tasks == wanted);
  const uint64_t hash = state_hash(solver);
  size_t touching = 0;
  EXPECT(shx_solver_contact_count(solver, &touching) == SHX_OK && (touching > 0) == contact);
  shx_solver_destroy(solver);
  return hash;
}

int main(void) {
  for (int contact = 0; contact <= 1; contact++) {
    const uint64_t plain = hash_in(PLAIN, 0, contact);
    EXPECT(hash_in(HOSTILE, 0, contact) == plain);
    EXPECT(hash_in(HOSTILE, 1, contact) == plain);
    EXPECT(hash_in(PLAIN, 1, contact) == plain);
  }
  printf("the same bits in every floating-point mode, and the mode is the host's again\n");
  return 0;
}
