/* Rule 8: fork does not hang. A child of a process with a pooled solver steps it, to the same bits, and frees it. */
#define _POSIX_C_SOURCE 200809L
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>
#include "expect.h"

int main(void) {
  shx_solver_def def;
  EXPECT(shx_solver_def_init(&def, sizeof def) == SHX_OK);
  def.worker_count = 3;
  shx_solver *solver;
  shx_strand_id ids[SCENE_STRANDS];
  EXPECT(shx_solver_create(&def, &solver) == SHX_OK);
  add_scene(solver, ids);
  run_scene(solver, ids);

  int ends[2];
  EXPECT(pipe(ends) == 0);
  const pid_t child = fork();
  EXPECT(child >= 0);
  if (child == 0) {
    alarm(60); /* a hang ends with a signal */
    run_scene(solver, ids);
    const uint64_t hash = state_hash(solver);
    shx_solver_destroy(solver);
    shx_solver *fresh; /* a pool of the child's own works too */
    EXPECT(shx_solver_create(&def, &fresh) == SHX_OK);
    add_scene(fresh, ids);
    run_scene(fresh, ids);
    shx_solver_destroy(fresh);
    EXPECT(write(ends[1], &hash, sizeof hash) == (ssize_t)sizeof hash);
    _exit(0);
  }
  run_scene(solver, ids);
  uint64_t theirs = 0;
  int status = 0;
  EXPECT(waitpid(child, &status, 0) == child);
  EXPECT(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT(read(ends[0], &theirs, sizeof theirs) == (ssize_t)sizeof theirs);
  EXPECT(theirs == state_hash(solver));
  shx_solver_destroy(solver);
  printf("the child stepped to the same bits and ended\n");
  return 0;
}
