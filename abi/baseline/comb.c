/* A comb goes through hair on a head: what the hair does to it, and how deep hair and comb ever were in each other. */
#include <math.h>
#include "check.h"

enum { STRANDS = 40, TEETH = 9, FRAMES = 60 };
static const double PI = 3.14159265358979323846, RADIUS = 0.09;

int main(void) {
  shx_solver *solver;
  CHECK(shx_solver_create(NULL, &solver));

  /* Hair of 12 cm on one side of a spherical head, each strand along the radius (n0, the strand's tangent, is x turned). */
  static shx_strand_def defs[STRANDS];
  static shx_strand_id strands[STRANDS];
  for (int i = 0; i < STRANDS; i++) {
    const double tilt = 1.2 + 0.2 * (i / 20), around = 0.04 * (i % 20 - 9.5) + 0.01 * (i / 20);
    const double up[3] = {sin(tilt) * cos(around), sin(tilt) * sin(around), cos(tilt)};
    shx_strand_def *def = &defs[i];
    CHECK(shx_strand_def_init(def, sizeof *def));
    def->length = 0.12;
    def->element_count = 6;
    def->air_drag = 2e-5;
    /* The quaternion from x to up: their cross product and one more than their dot product, normalised. */
    const double w = 1.0 + up[0], norm = sqrt(w * w + up[1] * up[1] + up[2] * up[2]);
    def->root.rotation[1] = -up[2] / norm;
    def->root.rotation[2] = up[1] / norm;
    def->root.rotation[3] = w / norm;
    for (int axis = 0; axis < 3; axis++)
      def->root.origin[axis] = RADIUS * up[axis];
  }
  CHECK(shx_solver_add_strands(solver, defs, sizeof defs[0], STRANDS, strands));

  /* Strands have no contact until it is set. Their first centimetre is in the skin. */
  shx_strand_contact contact;
  CHECK(shx_strand_contact_init(&contact, sizeof contact));
  contact.exempt_length = 0.01;
  CHECK(shx_solver_set_strand_contact(solver, strands, STRANDS, &contact, 0));

  /* The head, and a comb of nine teeth 2 mm thick, 1 cm apart, above the hair. */
  shx_body_def bodies[1 + TEETH];
  shx_body_id ids[1 + TEETH];
  for (int i = 0; i <= TEETH; i++) {
    CHECK(shx_body_def_init(&bodies[i], sizeof bodies[i]));
    bodies[i].shape = i == 0 ? SHX_SHAPE_SPHERE : SHX_SHAPE_CAPSULE;
    bodies[i].radius = i == 0 ? RADIUS : 0.001;
    if (i > 0) {
      bodies[i].b[0] = 0.06; /* the capsule's axis, from a, the body's origin, away from the head */
      bodies[i].pose.origin[0] = RADIUS + 0.004;
      bodies[i].pose.origin[1] = 0.01 * (i - 1 - TEETH / 2);
      bodies[i].pose.origin[2] = 0.12;
    }
  }
  CHECK(shx_solver_add_bodies(solver, bodies, sizeof bodies[0], 1 + TEETH, ids));

  shx_step_report report;
  CHECK(shx_step_report_init(&report, sizeof report));
  for (int frame = 0; frame < 30; frame++) /* the hair falls */
    CHECK(shx_solver_step(solver, 1.0 / 60.0, 1, &report));

  double deepest = 0.0;
  for (int frame = 1; frame <= FRAMES; frame++) { /* down through the hair, 25 cm in a second */
    shx_frame poses[TEETH];
    for (int i = 0; i < TEETH; i++) {
      poses[i] = bodies[1 + i].pose;
      poses[i].origin[2] = 0.12 - 0.125 * (1.0 - cos(PI * frame / FRAMES));
    }
    const shx_input frames = {poses, 0, TEETH, SHX_FORMAT_FRAME, 0};
    CHECK(shx_solver_set_body_frames(solver, &ids[1], TEETH, &frames, 1.0 / 60.0));
    CHECK(shx_solver_step(solver, 1.0 / 60.0, 4, &report)); /* a tooth goes less than its thickness in a substep */
    deepest = fmax(deepest, report.max_penetration);
    if (frame % 6 == 0) {
      double forces[TEETH][3], sum[3] = {0.0, 0.0, 0.0};
      const shx_output out = {forces, 0, TEETH, SHX_FORMAT_F64X3, 0};
      CHECK(shx_solver_body_wrenches(solver, &ids[1], TEETH, &out, NULL));
      for (int i = 0; i < TEETH; i++)
        for (int axis = 0; axis < 3; axis++)
          sum[axis] += forces[i][axis];
      printf("%.2f s: %3u contacts, the comb feels (%7.1f, %7.1f, %7.1f) uN\n", frame / 60.0, (unsigned)report.contacts,
             1e6 * sum[0], 1e6 * sum[1], 1e6 * sum[2]);
    }
  }
  printf("never deeper than %.1f um\n", 1e6 * deepest);
  shx_solver_destroy(solver);
  return EXIT_SUCCESS;
}
