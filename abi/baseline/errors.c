/* Every class of bad input, and what one gets: a code, a text that names the argument and the value, and nothing changed. */
#include <math.h>
#include <string.h>
#include "check.h"

static int surprises = 0;

/* Prints what a call gave and compares it with what it should have given. */
static void show(const char *what, shx_result expected, shx_result result) {
  char text[256] = "";
  if (result != SHX_OK)
    shx_last_error(text, sizeof text);
  printf("%-34s %-28s %s\n", what, shx_result_name(result), text);
  if (result != expected) {
    printf("  but %s was expected\n", shx_result_name(expected));
    surprises++;
  }
}

typedef struct host {
  shx_solver *solver;
  shx_result seen;
} host;

/* A callback that breaks the rule: it calls the solver that is calling it. */
static void reenter(void *user, uint32_t level, const char *message) {
  host *self = user;
  (void)level;
  (void)message;
  if (self->solver != NULL)
    self->seen = shx_solver_step(self->solver, 0.01, 1, NULL);
}

int main(void) {
  host self = {NULL, SHX_OK};
  shx_solver_def def;
  CHECK(shx_solver_def_init(&def, sizeof def));
  def.log = reenter;
  def.log_user = &self;
  def.log_level = SHX_LOG_DEBUG;
  shx_solver *solver, *other;
  CHECK(shx_solver_create(&def, &solver));
  CHECK(shx_solver_create(NULL, &other));

  shx_strand_def strand;
  CHECK(shx_strand_def_init(&strand, sizeof strand));
  strand.length = 0.1;
  strand.element_count = 4;
  shx_strand_id ids[2], foreign;
  CHECK(shx_solver_add_strands(solver, &strand, sizeof strand, 1, ids));
  CHECK(shx_solver_add_strands(other, &strand, sizeof strand, 1, &foreign));
  uint64_t before, after;
  CHECK(shx_solver_state_hash(solver, &before));

  size_t count;
  show("a null argument", SHX_ERROR_NULL_ARGUMENT, shx_solver_strand_count(solver, NULL));
  show("a null solver", SHX_ERROR_NULL_ARGUMENT, shx_solver_strand_count(NULL, &count));
  show("a time that is not a number", SHX_ERROR_INVALID_ARGUMENT, shx_solver_step(solver, NAN, 1, NULL));
  show("no substeps", SHX_ERROR_INVALID_ARGUMENT, shx_solver_step(solver, 0.01, 0, NULL));

  shx_strand_def bad = strand;
  bad.length = -1.0;
  show("a negative length", SHX_ERROR_INVALID_ARGUMENT, shx_solver_add_strands(solver, &bad, sizeof bad, 1, ids + 1));
  bad = strand;
  bad.root.rotation[3] = 2.0;
  show("a quaternion of length 2", SHX_ERROR_INVALID_ARGUMENT, shx_solver_add_strands(solver, &bad, sizeof bad, 1, ids + 1));
  memset(&bad, 0, sizeof bad);
  show("a definition without its _init", SHX_ERROR_STRUCT_SIZE, shx_solver_add_strands(solver, &bad, sizeof bad, 1, ids + 1));

  double rows[4][3], natural[4][3] = {{0}};
  show("a buffer of three rows for four", SHX_ERROR_BUFFER_TOO_SMALL,
       shx_solver_get_curvatures(solver, ids[0], &rows[0][0], NULL, 3));
  show("three rows for four elements", SHX_ERROR_INVALID_ARGUMENT,
       shx_solver_set_natural_curvatures(solver, ids[0], &natural[0][0], 3));
  natural[2][1] = INFINITY;
  show("an infinite curvature", SHX_ERROR_INVALID_ARGUMENT,
       shx_solver_set_natural_curvatures(solver, ids[0], &natural[0][0], 4));
  show("another solver's strand", SHX_ERROR_INVALID_ID, shx_solver_get_curvatures(solver, foreign, &rows[0][0], NULL, 4));
  CHECK(shx_solver_remove_strands(other, &foreign, 1));
  show("a removed strand", SHX_ERROR_INVALID_ID, shx_solver_get_curvatures(other, foreign, &rows[0][0], NULL, 4));

  shx_solver_def unsupported;
  shx_solver *none = NULL;
  CHECK(shx_solver_def_init(&unsupported, sizeof unsupported));
  unsupported.precision = SHX_PRECISION_F32;
  unsupported.integrator = SHX_INTEGRATOR_REFERENCE;
  show("the reference integrator in single precision", SHX_ERROR_UNSUPPORTED, shx_solver_create(&unsupported, &none));
  CHECK(shx_solver_def_init(&unsupported, sizeof unsupported));
  unsupported.integrator = 77;
  show("an unknown integrator", SHX_ERROR_INVALID_ARGUMENT, shx_solver_create(&unsupported, &none));

  shx_curves *curves = NULL;
  show("a file that is not there", SHX_ERROR_FILE, shx_curves_read("no_such_groom.hair", &curves));
  show("a file that is no groom", SHX_ERROR_FILE, shx_curves_read("/dev/null", &curves));
  show("an image that is none", SHX_ERROR_SNAPSHOT, shx_solver_restore(solver, "not an image", 12));
  if (none != NULL || curves != NULL) {
    printf("an output was written although the call failed\n");
    surprises++;
  }

  CHECK(shx_solver_state_hash(solver, &after));
  printf("The solver's state hash is %s.\n", before == after ? "unchanged by all that" : "CHANGED");
  if (before != after)
    surprises++;

  self.solver = solver;
  CHECK(shx_solver_step(solver, 0.01, 1, NULL));
  show("a call from a callback", SHX_ERROR_BUSY, self.seen);

  shx_solver_destroy(solver);
  shx_solver_destroy(other);
  return surprises == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
