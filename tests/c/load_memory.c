/* What loading, using and unloading the library leaves on the heap of the process: nothing of its own. A pool of threads leaves the collector of
 * crossbeam-epoch, a static of rayon's, 11 kB a round.
 *   load_memory LIBRARY.so [ROUNDS] */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "superhelix.h"

static void *library;

static void *symbol(const char *name) {
  void *address = dlsym(library, name);
  if (address == NULL) {
    fprintf(stderr, "%s\n", dlerror());
    exit(1);
  }
  return address;
}

/* ISO C has no conversion from object to function pointers; POSIX does. */
#define LOAD(name) __typeof__(&name) p_##name; do { void *address = symbol(#name); memcpy(&p_##name, &address, sizeof address); } while (0)
#define MUST(call) do { if ((call) != SHX_OK) { fprintf(stderr, "line %d: %s\n", __LINE__, #call); exit(1); } } while (0)

static void use(uint32_t workers) {
  LOAD(shx_solver_def_init);
  LOAD(shx_strand_def_init);
  LOAD(shx_solver_create);
  LOAD(shx_solver_add_strands);
  LOAD(shx_solver_step);
  LOAD(shx_solver_settle);
  LOAD(shx_solver_destroy);
  shx_solver_def def;
  MUST(p_shx_solver_def_init(&def, sizeof def));
  def.worker_count = workers;
  shx_solver *solver;
  MUST(p_shx_solver_create(&def, &solver));
  shx_strand_def strands[40];
  shx_strand_id ids[40];
  for (int i = 0; i < 40; i++) {
    MUST(p_shx_strand_def_init(&strands[i], sizeof strands[i]));
    strands[i].length = 0.1;
    strands[i].element_count = 8;
  }
  MUST(p_shx_solver_add_strands(solver, strands, sizeof strands[0], 40, ids));
  MUST(p_shx_solver_step(solver, 0.01, 2, NULL));
  MUST(p_shx_solver_settle(solver, ids, 2, NULL, NULL, NULL, NULL, NULL));
  p_shx_solver_destroy(solver);
}

/* Bytes that are allocated, in all arenas. */
static size_t held(void) {
  const struct mallinfo2 all = mallinfo2();
  return all.uordblks + all.hblkhd;
}

int main(int argc, char **argv) {
  if (argc < 2 || argc > 3)
    return 2;
  const int rounds = argc == 3 ? atoi(argv[2]) : 200;
  for (uint32_t workers = 1; workers <= 3; workers += 2) {
    size_t before = 0;
    /* The first rounds fill what the C library keeps for itself. */
    for (int round = -10; round < rounds; round++) {
      if (round == 0)
        before = held();
      library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
      if (library == NULL) {
        fprintf(stderr, "%s\n", dlerror());
        return 1;
      }
      use(workers);
      if (dlclose(library) != 0)
        return 1;
    }
    const double grown = ((double)held() - (double)before) / rounds;
    printf("%u workers: %.0f bytes a round\n", (unsigned)workers, grown);
    if (grown > (workers == 1 ? 1024 : 16384))
      return 1;
  }
  return 0;
}
