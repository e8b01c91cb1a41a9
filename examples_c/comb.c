/* A tooth of a comb goes through hair on a head: what the hair does to it, and how deep it ever was in the hair. */
#include <math.h>
#include "check.h"

enum { STRANDS = 60, FRAMES = 60 };
static const double PI = 3.14159265358979323846, RADIUS = 0.09;

int main(void) {
  shx_solver *solver;
  CHECK(shx_solver_create(NULL, &solver));

  /* Hair of 12 cm around the crown of a spherical head, each strand along the radius (n0, the strand's tangent, is x turned). */
  static shx_strand_def defs[STRANDS];
  static shx_strand_id strands[STRANDS];
  for (int i = 0; i < STRANDS; i++) {
    const double tilt = 0.6 * sqrt((i + 0.5) / STRANDS), around = i * 2.399963; /* the golden angle spreads them evenly */
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

  /* Strands touch nothing until they are told to. Their first centimetre stands in the skin. */
  shx_strand_contact contact;
  CHECK(shx_strand_contact_init(&contact, sizeof contact));
  contact.exempt_length = 0.01;
  CHECK(shx_solver_set_contact(solver, strands, STRANDS, &contact, 0));

  /* The head, and a tooth 2 mm thick that stands beside it. */
  shx_body_def bodies[2];
  shx_body_id ids[2];
  for (int i = 0; i < 2; i++)
    CHECK(shx_body_def_init(&bodies[i], sizeof bodies[i]));
  bodies[0].shape = SHX_SHAPE_SPHERE;
  bodies[0].radius = RADIUS;
  bodies[1].shape = SHX_SHAPE_CAPSULE;
  bodies[1].radius = 0.001;
  bodies[1].a[2] = 0.002;
  bodies[1].b[2] = 0.1;
  bodies[1].pose.origin[0] = -0.2;
  bodies[1].pose.origin[2] = RADIUS;
  CHECK(shx_solver_add_bodies(solver, bodies, sizeof bodies[0], 2, ids));

  shx_step_report report;
  CHECK(shx_step_report_init(&report, sizeof report));
  for (int frame = 0; frame < 30; frame++) /* the hair falls onto the head */
    CHECK(shx_solver_step(solver, 1.0 / 60.0, 1, &report));
  printf("%u contacts with the head\n", (unsigned)report.contacts);

  double deepest = 0.0;
  for (int frame = 1; frame <= FRAMES; frame++) { /* through the hair and out again: 40 cm in a second */
    shx_frame pose = bodies[1].pose;
    pose.origin[0] = -0.2 * cos(PI * frame / FRAMES);
    const shx_input frames = {&pose, 0, 1, SHX_FORMAT_FRAME, 0};
    CHECK(shx_solver_set_body_frames(solver, &ids[1], 1, &frames, 1.0 / 60.0));
    CHECK(shx_solver_step(solver, 1.0 / 60.0, 1, &report));
    deepest = fmax(deepest, report.max_penetration);
    if (frame % 10 == 0) {
      double force[3];
      const shx_output out = {force, 0, 1, SHX_FORMAT_F64X3, 0};
      CHECK(shx_solver_body_wrenches(solver, &ids[1], 1, &out, NULL));
      printf("%.2f s: %3u contacts, the tooth feels (%7.1f, %7.1f, %7.1f) uN\n", frame / 60.0, (unsigned)report.contacts,
             1e6 * force[0], 1e6 * force[1], 1e6 * force[2]);
    }
  }
  printf("never deeper than %.1f um\n", 1e6 * deepest);
  shx_solver_destroy(solver);
  return EXIT_SUCCESS;
}
