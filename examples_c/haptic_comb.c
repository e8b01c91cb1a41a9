/* A hand combs hair through a haptic device: haptic_comb [SECONDS [STRANDS [FORCE.csv]]].
   The device's thread runs at 1 kHz, the simulation at 120 Hz beside it; neither waits for the other. Hand and device are simulated
   here: a mass that a spring and a damper draw along the strokes of a comb, and that feels the force as a hand would. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <pthread.h>
#include <time.h>
#include "check.h"

enum { TEETH = 7, RATE = 1000, FRAMES = 120 };
static const double PI = 3.14159265358979323846;

/* What device and main thread share: the haptic object, and, once both have ended, the numbers. */
typedef struct shared {
  shx_haptic *haptic;
  struct timespec start;
  int seconds;
  FILE *file;
  long late;                             /* wake-ups more than a millisecond after their time */
  double longest, wake, strongest;       /* an update's processor time, the latest wake-up, s; the largest force, N */
  shx_haptic_state state;
} shared;

static double seconds_of(const struct timespec *time) { return (double)time->tv_sec + 1e-9 * (double)time->tv_nsec; }

static struct timespec at(const struct timespec *start, double seconds) {
  const double whole = floor(seconds);
  struct timespec time = {start->tv_sec + (time_t)whole, start->tv_nsec + (long)(1e9 * (seconds - whole))};
  if (time.tv_nsec >= 1000000000L) {
    time.tv_sec += 1;
    time.tv_nsec -= 1000000000L;
  }
  return time;
}

/* Sleeps until then, and says how late it woke. */
static double sleep_until(const struct timespec *start, double seconds) {
  const struct timespec until = at(start, seconds);
  struct timespec now;
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL) != 0) {
  }
  clock_gettime(CLOCK_MONOTONIC, &now);
  return seconds_of(&now) - seconds_of(&until);
}

/* Where the hand wants the comb: into the hair, down by 13 cm, out, and back up, every three seconds. */
static void stroke(double time, double wish[3]) {
  const double phase = fmod(time, 3.0);
  const double in = phase < 0.6 ? phase / 0.6 : phase < 2.0 ? 1.0 : phase < 2.4 ? 1.0 - (phase - 2.0) / 0.4 : 0.0;
  const double down = phase < 0.6 ? 0.0 : phase < 2.0 ? (phase - 0.6) / 1.4 : phase < 2.4 ? 1.0 : 1.0 - (phase - 2.4) / 0.6;
  wish[0] = -0.06 * (1.0 - 0.5 * (1.0 - cos(PI * in)));
  wish[1] = 0.019;
  wish[2] = -0.03 - 0.13 * 0.5 * (1.0 - cos(PI * down));
}

static double thread_time(void) {
  struct timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return seconds_of(&time);
}

static void *device(void *data) {
  shared *all = data;
  const double mass = 0.15, grip = 300.0, damping = 12.0, dt = 1.0 / RATE;
  double position[3], wish[3], velocity[6] = {0}, wrench[6] = {0};
  shx_frame pose = {{0}, {0.0, 0.0, 0.0, 1.0}};
  stroke(0.0, position);
  for (long tick = 0; tick < (long)all->seconds * RATE; tick++) {
    const double late = sleep_until(&all->start, dt * (double)tick);
    all->wake = fmax(all->wake, late);
    all->late += late > dt;
    stroke(dt * (double)tick, wish);
    for (int axis = 0; axis < 3; axis++) { /* the hand and its device */
      velocity[axis] += dt / mass * (grip * (wish[axis] - position[axis]) - damping * velocity[axis] + wrench[axis]);
      pose.origin[axis] = position[axis] += dt * velocity[axis];
    }
    const double before = thread_time();
    CHECK(shx_haptic_update(all->haptic, &pose, velocity, dt, wrench, &all->state));
    all->longest = fmax(all->longest, thread_time() - before);
    const double force = sqrt(wrench[0] * wrench[0] + wrench[1] * wrench[1] + wrench[2] * wrench[2]);
    all->strongest = fmax(all->strongest, force);
    if (all->file != NULL)
      fprintf(all->file, "%.3f,%g,%g,%g,%g,%g,%g,%u,%u\n", dt * (double)tick, position[0], position[1], position[2], wrench[0],
              wrench[1], wrench[2], (unsigned)all->state.contacts, (unsigned)all->state.pressing);
  }
  return NULL;
}

/* Wavy hair of 15 cm that hangs from rows of follicles, and at rest. */
static void grow(shx_solver *solver, int count) {
  shx_strand_def *defs = calloc((size_t)count, sizeof *defs);
  shx_strand_id *ids = calloc((size_t)count, sizeof *ids);
  const double natural[5][3] = {{0.0, 15.0, 4.5}, {0.0, 15.0, 4.5}, {0.0, 15.0, 4.5}, {0.0, 15.0, 4.5}, {0.0, 15.0, 4.5}};
  if (defs == NULL || ids == NULL)
    exit(EXIT_FAILURE);
  for (int i = 0; i < count; i++) {
    shx_strand_def *def = &defs[i];
    CHECK(shx_strand_def_init(def, sizeof *def));
    def->length = 0.15;
    def->element_count = 5;
    def->natural_curvatures = &natural[0][0];
    def->internal_friction = 1e-10;
    def->viscosity = 2e-3;
    def->air_drag = 1e-5;
    def->root.origin[0] = 0.002 * (i / 20);
    def->root.origin[1] = 0.002 * (i % 20);
    def->root.rotation[1] = def->root.rotation[3] = sqrt(0.5); /* the tangent, x, turned down */
  }
  CHECK(shx_solver_add_strands(solver, defs, sizeof defs[0], (size_t)count, ids));
  shx_strand_contact contact;
  CHECK(shx_strand_contact_init(&contact, sizeof contact));
  contact.exempt_length = 0.01;
  CHECK(shx_solver_set_strand_contact(solver, ids, (size_t)count, &contact, 0));
  free(defs);
  free(ids);
}

int main(int argc, char **argv) {
  const int seconds = argc > 1 ? atoi(argv[1]) : 6, strands = argc > 2 ? atoi(argv[2]) : 200;
  if (seconds < 1 || strands < 1) {
    fprintf(stderr, "usage: haptic_comb [SECONDS [STRANDS [FORCE.csv]]]\n");
    return EXIT_FAILURE;
  }
  shx_solver *solver;
  CHECK(shx_solver_create(NULL, &solver));
  grow(solver, strands);
  for (int i = 0; i < 60; i++)
    CHECK(shx_solver_step(solver, 1.0 / 60.0, 1, NULL));

  shx_body_def teeth[TEETH];
  shx_body_id ids[TEETH];
  for (int i = 0; i < TEETH; i++) { /* 2 mm thick, 6 mm apart, along x: all in the comb's own frame */
    CHECK(shx_body_def_init(&teeth[i], sizeof teeth[i]));
    teeth[i].shape = SHX_SHAPE_CAPSULE;
    teeth[i].radius = 0.001;
    teeth[i].a[0] = -0.03;
    teeth[i].b[0] = 0.05;
    teeth[i].a[1] = teeth[i].b[1] = 0.006 * (i - TEETH / 2);
    stroke(0.0, teeth[i].pose.origin);
  }
  CHECK(shx_solver_add_bodies(solver, teeth, sizeof teeth[0], TEETH, ids));

  shared all = {0};
  shx_haptic_def def;
  CHECK(shx_haptic_def_init(&def, sizeof def));
  def.max_force = 3.0; /* what the device can hold */
  CHECK(shx_haptic_create(solver, &def, ids, TEETH, &all.haptic));
  CHECK(shx_haptic_state_init(&all.state, sizeof all.state));
  all.seconds = seconds;
  if (argc > 3) {
    all.file = fopen(argv[3], "w");
    if (all.file == NULL) {
      perror(argv[3]);
      return EXIT_FAILURE;
    }
    fprintf(all.file, "seconds,x,y,z,force_x,force_y,force_z,contacts,pressing\n");
  }

  pthread_t thread;
  clock_gettime(CLOCK_MONOTONIC, &all.start);
  if (pthread_create(&thread, NULL, device, &all) != 0) {
    fprintf(stderr, "pthread_create failed\n");
    return EXIT_FAILURE;
  }
  /* The simulation, in real time: a step may not take longer than there is. */
  shx_step_limits limits;
  shx_step_report report;
  CHECK(shx_step_limits_init(&limits, sizeof limits));
  CHECK(shx_step_report_init(&report, sizeof report));
  limits.max_seconds = 0.7 / FRAMES;
  long late = 0;
  double slowest = 0.0;
  for (long frame = 0; frame < (long)seconds * FRAMES; frame++) {
    late += sleep_until(&all.start, (double)frame / FRAMES) > 1.0 / FRAMES;
    CHECK(shx_haptic_before_step(all.haptic, solver, 1.0 / FRAMES));
    CHECK(shx_solver_step_with_limits(solver, 1.0 / FRAMES, 1, &limits, &report));
    CHECK(shx_haptic_after_step(all.haptic, solver));
    slowest = fmax(slowest, report.seconds);
  }
  pthread_join(thread, NULL);
  if (all.file != NULL)
    fclose(all.file);

  printf("%d s, %d strands: largest force %.2f mN\n", seconds, strands, 1e3 * all.strongest);
  printf("device: longest update %.3f ms of processor time, %ld late wake-ups of %d, the latest by %.2f ms\n", 1e3 * all.longest,
         all.late, seconds * RATE, 1e3 * all.wake);
  printf("simulation: %u models, slowest step %.2f ms, %ld late frames of %d\n", (unsigned)all.state.model_count, 1e3 * slowest,
         late, seconds * FRAMES);
  printf("energy: the hand gave %.3g J and received %.3g J, never more than %.3g J beyond what it gave\n", all.state.energy_given,
         all.state.energy_received, all.state.max_energy_excess);
  shx_haptic_destroy(all.haptic);
  shx_solver_destroy(solver);
  return all.longest < 1e-3 && all.state.max_energy_excess <= def.energy_allowance ? EXIT_SUCCESS : EXIT_FAILURE;
}
