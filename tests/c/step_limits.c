/* What a step may cost: a budget of work gives the same bits for any number of threads, a budget of seconds is kept, a flag that another thread sets
 * cancels within milliseconds; whatever ends a step, strands are finite, roots are where they were sent, and the report says why. A head that
 * jumps takes its hair along. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <pthread.h>
#include <time.h>
#include "expect.h"

enum { HAIRS = 120, ELEMENTS = 8, POINTS = 9 };
static const double H = 1.0 / 60, RADIUS = 0.09;

typedef struct head {
  shx_solver *solver;
  shx_strand_id ids[HAIRS];
  shx_frame roots[HAIRS];
  shx_body_id ball;
} head;

static void grow(head *h, uint32_t workers) {
  static double natural[ELEMENTS][3];
  static shx_strand_def defs[HAIRS];
  shx_solver_def def;
  EXPECT(shx_solver_def_init(&def, sizeof def) == SHX_OK && def.jump_acceleration == 200);
  def.worker_count = workers;
  EXPECT(shx_solver_create(&def, &h->solver) == SHX_OK);
  for (int e = 0; e < ELEMENTS; e++)
    natural[e][0] = 2, natural[e][1] = 6;
  for (int i = 0; i < HAIRS; i++) {
    EXPECT(shx_strand_def_init(&defs[i], sizeof defs[i]) == SHX_OK);
    const double z = 1 - 0.7 * (i + 0.5) / HAIRS, turn = 2.399963 * i, flat = sqrt(1 - z * z);
    const double up[3] = {flat * cos(turn), flat * sin(turn), z}, w = 1 + up[0];
    const double size = sqrt(up[2] * up[2] + up[1] * up[1] + w * w), q[4] = {0, -up[2] / size, up[1] / size, w / size};
    defs[i].length = 0.18;
    defs[i].element_count = ELEMENTS;
    defs[i].natural_curvatures = &natural[0][0];
    defs[i].air_drag = 1e-5;
    for (int k = 0; k < 4; k++)
      defs[i].root.rotation[k] = q[k];
    for (int k = 0; k < 3; k++)
      defs[i].root.origin[k] = RADIUS * up[k];
    h->roots[i] = defs[i].root;
  }
  EXPECT(shx_solver_add_strands(h->solver, defs, sizeof defs[0], HAIRS, h->ids) == SHX_OK);
  shx_strand_contact contact;
  EXPECT(shx_strand_contact_init(&contact, sizeof contact) == SHX_OK);
  contact.exempt_length = 0.015;
  contact.wisp_radius = 0.001;
  EXPECT(shx_solver_set_strand_contact(h->solver, h->ids, HAIRS, &contact, 0) == SHX_OK);
  shx_contact_options options;
  EXPECT(shx_contact_options_init(&options, sizeof options) == SHX_OK);
  options.hair_contact = 1;
  EXPECT(shx_solver_set_contact_options(h->solver, &options) == SHX_OK);
  shx_body_def ball;
  EXPECT(shx_body_def_init(&ball, sizeof ball) == SHX_OK);
  ball.shape = SHX_SHAPE_SPHERE;
  ball.radius = RADIUS - 0.002;
  EXPECT(shx_solver_add_bodies(h->solver, &ball, sizeof ball, 1, &h->ball) == SHX_OK);
}

/* Sends the head to x, with all its roots. */
static void send(head *h, double x) {
  shx_frame roots[HAIRS], pose = {{x, 0, 0}, {0, 0, 0, 1}};
  memcpy(roots, h->roots, sizeof roots);
  for (int i = 0; i < HAIRS; i++)
    roots[i].origin[0] += x;
  const shx_input in = {roots, 0, HAIRS, SHX_FORMAT_FRAME, 0}, body = {&pose, 0, 1, SHX_FORMAT_FRAME, 0};
  EXPECT(shx_solver_set_root_frames(h->solver, h->ids, HAIRS, &in, H) == SHX_OK);
  EXPECT(shx_solver_set_body_frames(h->solver, &h->ball, 1, &body, H) == SHX_OK);
}

/* Samples all strands: finite, each at its root; a hash of the bits. */
static uint64_t look(const head *h, double x) {
  static double points[HAIRS][POINTS][3];
  shx_sample_def def;
  EXPECT(shx_sample_def_init(&def, sizeof def) == SHX_OK);
  def.points_per_strand = POINTS;
  const shx_output out = {points, 0, HAIRS * POINTS, SHX_FORMAT_F64X3, 0};
  EXPECT(shx_solver_sample_strands(h->solver, h->ids, HAIRS, &def, &out, NULL, NULL) == SHX_OK);
  uint64_t hash = 0xcbf29ce484222325u;
  for (int i = 0; i < HAIRS; i++) {
    EXPECT(fabs(points[i][0][0] - h->roots[i].origin[0] - x) < 1e-12);
    for (int k = 0; k < POINTS; k++)
      for (int axis = 0; axis < 3; axis++)
        EXPECT(isfinite(points[i][k][axis]) && fabs(points[i][k][axis]) < 10);
  }
  const unsigned char *bytes = (const unsigned char *)points;
  for (size_t i = 0; i < sizeof points; i++)
    hash = (hash ^ bytes[i]) * 0x100000001b3u;
  return hash;
}

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Little work: something is left, the same for any number of threads. */
static uint64_t with_little_work(uint32_t workers) {
  head h;
  grow(&h, workers);
  shx_step_limits limits;
  EXPECT(shx_step_limits_init(&limits, sizeof limits) == SHX_OK && limits.max_work == 0 && limits.max_seconds == 0 && !limits.cancel);
  limits.max_work = 4000;
  shx_step_report report;
  EXPECT(shx_step_report_init(&report, sizeof report) == SHX_OK);
  int stopped = 0;
  for (int step = 1; step <= 30; step++) {
    const double x = 0.01 * sin(0.5 * step);
    send(&h, x);
    EXPECT(shx_solver_step_with_limits(h.solver, H, 1, &limits, &report) == SHX_OK);
    EXPECT(report.stop_reason == SHX_STOP_NONE || report.stop_reason == SHX_STOP_WORK);
    EXPECT((report.stop_reason == SHX_STOP_WORK) == (report.unfinished > 0) && report.unfinished <= report.unconverged);
    stopped += report.stop_reason == SHX_STOP_WORK;
    look(&h, x);
  }
  EXPECT(stopped > 5);
  const uint64_t hash = look(&h, 0.01 * sin(0.5 * 30));
  shx_solver_destroy(h.solver);
  return hash;
}

static void with_little_time(void) {
  head h;
  grow(&h, 1);
  shx_step_limits limits;
  EXPECT(shx_step_limits_init(&limits, sizeof limits) == SHX_OK);
  shx_step_report report;
  EXPECT(shx_step_report_init(&report, sizeof report) == SHX_OK);
  limits.max_seconds = -1;
  EXPECT(shx_solver_step_with_limits(h.solver, H, 1, &limits, &report) == SHX_ERROR_INVALID_ARGUMENT);
  EXPECT(shx_solver_step_with_limits(h.solver, H, 1, NULL, &report) == SHX_ERROR_NULL_ARGUMENT);
  limits.max_seconds = 1e-6; /* none: everything goes along with its root */
  send(&h, 0.01);
  EXPECT(shx_solver_step_with_limits(h.solver, H, 1, &limits, &report) == SHX_OK);
  EXPECT(report.stop_reason == SHX_STOP_TIME && report.unfinished == HAIRS && report.quarantined == 0);
  look(&h, 0.01);
  limits.max_seconds = 10;
  EXPECT(shx_solver_step_with_limits(h.solver, H, 1, &limits, &report) == SHX_OK && report.stop_reason == SHX_STOP_NONE);
  shx_solver_destroy(h.solver);
}

static void *cancel_soon(void *flag) {
  const struct timespec pause = {0, 3000000};
  nanosleep(&pause, NULL);
  __atomic_store_n((uint32_t *)flag, 1, __ATOMIC_RELAXED);
  return NULL;
}

static void cancelled(void) {
  head h;
  grow(&h, 2);
  shx_step_limits limits;
  EXPECT(shx_step_limits_init(&limits, sizeof limits) == SHX_OK);
  shx_step_report report;
  EXPECT(shx_step_report_init(&report, sizeof report) == SHX_OK);
  static uint32_t flag;
  limits.cancel = &flag;
  for (int step = 0; step < 40; step++)
    EXPECT(shx_solver_step_with_limits(h.solver, H, 1, &limits, &report) == SHX_OK && report.stop_reason == SHX_STOP_NONE);
  /* A step of very many substeps, which nobody would wait for. */
  send(&h, 0.02);
  pthread_t thread;
  EXPECT(pthread_create(&thread, NULL, cancel_soon, &flag) == 0);
  const double from = now();
  EXPECT(shx_solver_step_with_limits(h.solver, H, 100000, &limits, &report) == SHX_OK);
  EXPECT(pthread_join(thread, NULL) == 0);
  EXPECT(report.stop_reason == SHX_STOP_CANCELLED && report.unfinished > 0);
  EXPECT(now() - from < 5); /* (no promise of time on a machine that is busy) */
  look(&h, 0.02);
  flag = 0;
  EXPECT(shx_solver_step_with_limits(h.solver, H, 1, &limits, &report) == SHX_OK && report.stop_reason == SHX_STOP_NONE);
  shx_solver_destroy(h.solver);
}

static void jumped(void) {
  head h;
  grow(&h, 1);
  shx_step_report report;
  EXPECT(shx_step_report_init(&report, sizeof report) == SHX_OK);
  for (int step = 0; step < 20; step++)
    EXPECT(shx_solver_step(h.solver, H, 1, &report) == SHX_OK && report.jumped_roots == 0 && report.fast_body_pieces == 1);
  const uint64_t calm = report.work;
  send(&h, 1);
  EXPECT(shx_solver_step(h.solver, H, 1, &report) == SHX_OK);
  EXPECT(report.jumped_roots == HAIRS && report.quarantined == 0 && report.max_penetration < 1e-4 && report.work < 4 * calm + 1000);
  look(&h, 1);
  shx_solver_destroy(h.solver);
}

int main(void) {
  const uint64_t one = with_little_work(1);
  EXPECT(with_little_work(2) == one && with_little_work(5) == one);
  with_little_time();
  cancelled();
  jumped();
  return 0;
}
