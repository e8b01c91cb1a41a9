/* Rule 1: no process-wide state. Two copies of the library in one process, as two plug-ins would carry them, know nothing of each other:
 * errors, solvers and pools are each copy's own, and unloading one leaves the other at work.
 *   two_copies A.so B.so */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "superhelix.h"

typedef struct copy {
  void *library;
  shx_solver *solver;
  shx_strand_id id;
} copy;

static void *symbol(void *library, const char *name) {
  void *address = dlsym(library, name);
  if (address == NULL) {
    fprintf(stderr, "%s\n", dlerror());
    exit(1);
  }
  return address;
}

/* ISO C has no conversion from object to function pointers; POSIX does. */
#define LOAD(library, name) __typeof__(&name) p_##name; do { void *address = symbol(library, #name); memcpy(&p_##name, &address, sizeof address); } while (0)
#define EXPECT(condition) do { if (!(condition)) { fprintf(stderr, "line %d: not so: %s\n", __LINE__, #condition); exit(1); } } while (0)

static copy load(const char *path) {
  copy c;
  c.library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  EXPECT(c.library != NULL);
  LOAD(c.library, shx_solver_def_init);
  LOAD(c.library, shx_solver_create);
  LOAD(c.library, shx_strand_def_init);
  LOAD(c.library, shx_solver_add_strands);
  shx_solver_def def;
  EXPECT(p_shx_solver_def_init(&def, sizeof def) == SHX_OK);
  def.worker_count = 2;
  EXPECT(p_shx_solver_create(&def, &c.solver) == SHX_OK);
  shx_strand_def strand;
  EXPECT(p_shx_strand_def_init(&strand, sizeof strand) == SHX_OK);
  strand.length = 0.1;
  strand.element_count = 5;
  EXPECT(p_shx_solver_add_strands(c.solver, &strand, sizeof strand, 1, &c.id) == SHX_OK);
  return c;
}

static uint64_t step(copy c) {
  LOAD(c.library, shx_solver_step);
  LOAD(c.library, shx_solver_state_hash);
  uint64_t hash = 0;
  EXPECT(p_shx_solver_step(c.solver, 0.01, 1, NULL) == SHX_OK);
  EXPECT(p_shx_solver_state_hash(c.solver, &hash) == SHX_OK);
  return hash;
}

static void unload(copy c) {
  LOAD(c.library, shx_solver_destroy);
  p_shx_solver_destroy(c.solver);
  EXPECT(dlclose(c.library) == 0);
}

int main(int argc, char **argv) {
  EXPECT(argc == 3);
  const copy a = load(argv[1]), b = load(argv[2]);
  EXPECT(a.library != b.library && symbol(a.library, "shx_version") != symbol(b.library, "shx_version"));
  EXPECT(step(a) == step(b));
  LOAD(a.library, shx_solver_step);
  EXPECT(p_shx_solver_step(a.solver, -1.0, 1, NULL) == SHX_ERROR_INVALID_ARGUMENT);
  LOAD(a.library, shx_last_error);
  size_t (*other_last_error)(char *, size_t);
  void *address = symbol(b.library, "shx_last_error");
  memcpy(&other_last_error, &address, sizeof address);
  EXPECT(p_shx_last_error(NULL, 0) > 0 && other_last_error(NULL, 0) == 0);
  LOAD(b.library, shx_solver_has_strand);
  EXPECT(p_shx_solver_has_strand(b.solver, b.id) && !p_shx_solver_has_strand(b.solver, a.id));
  unload(a);
  step(b);
  unload(b);
  printf("two copies, nothing shared\n");
  return 0;
}
