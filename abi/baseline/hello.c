/* One strand, held out level at its root, falls and swings for a second. */
#include "check.h"

int main(void) {
  shx_solver *solver;
  CHECK(shx_solver_create(NULL, &solver)); /* all defaults: gravity points to -z */

  shx_strand_def strand;
  CHECK(shx_strand_def_init(&strand, sizeof strand));
  strand.length = 0.2;      /* m */
  strand.element_count = 5; /* helical elements */
  strand.air_drag = 5e-6;   /* kg/(m s) */
  shx_strand_id id;
  CHECK(shx_solver_add_strands(solver, &strand, sizeof strand, 1, &id));

  double tip[3];
  const shx_output points = {tip, 0, 1, SHX_FORMAT_F64X3, 0};
  for (int frame = 0; frame < 60; frame++) {
    CHECK(shx_solver_step(solver, 1.0 / 60.0, 1, NULL));
    CHECK(shx_solver_sample_at(solver, id, &strand.length, 1, NULL, &points, NULL, NULL));
    if (frame % 10 == 9)
      printf("%.3f s: the tip is at (%.4f, %.4f, %.4f) m\n", (frame + 1) / 60.0, tip[0], tip[1], tip[2]);
  }

  shx_solver_destroy(solver);
  return EXIT_SUCCESS;
}
