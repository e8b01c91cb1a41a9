/* A hand combs a groom through a haptic device, in real time:

     haptic_comb [--rings] GROOM BUST.obj OUT_DIRECTORY [SECONDS [METRES_PER_UNIT]]

   The teeth are bodies that hair slides along; with --rings they hold the hair that they run into until it is combed. GROOM is .hair, .tfx or .obj, y up; BUST the head that it grows on. The device's thread runs at 1 kHz, the simulation at 120 Hz beside
   it; neither waits for the other. Hand and device are simulated here: a mass that a spring and a damper pull along the strokes of a comb
   down the back of the head, and that feels the force as a hand would. OUT_DIRECTORY, which exists, gets force.csv, a line per
   millisecond, and hair.N.obj, the hair at four moments of the first stroke. Fails if the hand receives more energy than the haptic object
   allows; missed updates are only printed, since they depend on what else the machine is doing. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <pthread.h>
#include <string.h>
#include <time.h>
#include "check.h"
#include "mesh.h"

enum { TEETH = 7, RATE = 1000, FRAMES = 120, ELEMENTS = 8, MOMENTS = 4 };
static const double SPACING = 0.006, LENGTH = 0.04;                 /* m: between teeth, and of a tooth */
static const double PI = 3.14159265358979323846;
static const double STROKE = 3.0;                                   /* s, down and back up */
static const double MOMENT[MOMENTS] = {0.02, 0.8, 1.4, 2.0};        /* s: when the hair is written to a file */

/* ---- time ----------------------------------------------------------------------------------------------------------- */

static double seconds_of(const struct timespec *time) { return (double)time->tv_sec + 1e-9 * (double)time->tv_nsec; }

static double clock_seconds(clockid_t clock) {
  struct timespec time;
  clock_gettime(clock, &time);
  return seconds_of(&time);
}

/* Sleeps until then, and says how late it woke. */
static double sleep_until(const struct timespec *start, double seconds) {
  const double whole = floor(seconds);
  struct timespec until = {start->tv_sec + (time_t)whole, start->tv_nsec + (long)(1e9 * (seconds - whole))};
  if (until.tv_nsec >= 1000000000L) {
    until.tv_sec += 1;
    until.tv_nsec -= 1000000000L;
  }
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL) != 0) {
  }
  return clock_seconds(CLOCK_MONOTONIC) - seconds_of(&until);
}

/* ---- the hand ------------------------------------------------------------------------------------------------------- */

/* Shared by device and main thread: the haptic object and, once both have ended, the numbers. */
typedef struct shared {
  shx_haptic *haptic;
  struct timespec start;
  double seconds;
  FILE *file;
  long late, missed;                     /* wake-ups more than a millisecond late; updates that took more processor time than that */
  double longest, longest_wall, wake;    /* an update's processor time and wall time, the latest wake-up, s */
  double strongest, jump;                /* the largest force, and the largest change of it in an update, N */
  shx_haptic_state state;
} shared;

static double smooth(double part) { return part <= 0.0 ? 0.0 : part >= 1.0 ? 1.0 : 0.5 * (1.0 - cos(PI * part)); }

/* Where the hand wants the tips of the comb: in behind the head, down by 16 cm, through the outer half of the hair on the skull and all of it
   below, out, and back up. */
static void stroke(double time, double wish[3]) {
  const double t = fmod(time, STROKE), down = smooth((t - 0.5) / 1.5) * (1.0 - smooth((t - 2.3) / 0.6));
  const double in = smooth(t / 0.5) * (1.0 - smooth((t - 2.0) / 0.3));
  const double neck = 0.055 * smooth((down - 0.25) / 0.6);          /* the skin goes back from the comb below the skull */
  wish[0] = 0.0;
  wish[1] = 0.37 - 0.16 * down;
  wish[2] = -0.165 + in * (0.053 + neck);
}

/* Wisps that come through this box may meet the comb. */
static int is_near_strokes(const double point[3]) { return fabs(point[0]) < 0.05 && point[2] < -0.03; }

static void *device(void *data) {
  shared *all = data;
  const double mass = 0.15, grip = 300.0, damping = 12.0, dt = 1.0 / RATE;
  double position[3], wish[3], velocity[6] = {0}, wrench[6] = {0};
  shx_frame pose = {{0}, {0.0, 0.0, 0.0, 1.0}};
  stroke(0.0, position);
  for (long tick = 0; (double)tick < all->seconds * RATE; tick++) {
    const double late = sleep_until(&all->start, dt * (double)tick);
    all->wake = fmax(all->wake, late);
    all->late += late > dt;
    stroke(dt * (double)tick, wish);
    for (int axis = 0; axis < 3; axis++) { /* the hand and its device */
      velocity[axis] += dt / mass * (grip * (wish[axis] - position[axis]) - damping * velocity[axis] + wrench[axis]);
      pose.origin[axis] = position[axis] += dt * velocity[axis];
    }
    double before[3];
    for (int axis = 0; axis < 3; axis++)
      before[axis] = wrench[axis];
    const double own = clock_seconds(CLOCK_THREAD_CPUTIME_ID), wall = clock_seconds(CLOCK_MONOTONIC);
    CHECK(shx_haptic_update(all->haptic, &pose, velocity, dt, wrench, &all->state));
    const double took = clock_seconds(CLOCK_THREAD_CPUTIME_ID) - own;
    all->longest_wall = fmax(all->longest_wall, clock_seconds(CLOCK_MONOTONIC) - wall);
    all->longest = fmax(all->longest, took);
    all->missed += took > dt;
    double force = 0.0, jump = 0.0;
    for (int axis = 0; axis < 3; axis++) {
      force += wrench[axis] * wrench[axis];
      jump += (wrench[axis] - before[axis]) * (wrench[axis] - before[axis]);
    }
    all->strongest = fmax(all->strongest, sqrt(force));
    all->jump = fmax(all->jump, sqrt(jump));
    fprintf(all->file, "%.3f,%.6f,%.6f,%.6f,%g,%g,%g,%u,%u,%u\n", dt * (double)tick, position[0], position[1], position[2], wrench[0],
            wrench[1], wrench[2], (unsigned)all->state.contacts, (unsigned)all->state.pressing, (unsigned)all->state.limits);
  }
  return NULL;
}

/* ---- the hair ------------------------------------------------------------------------------------------------------- */

static const double gravity[3] = {0.0, -9.81, 0.0}; /* y is up */

/* The head of an OBJ file. */
static shx_body_id read_head(shx_solver *solver, const char *path, double scale) {
  mesh head = read_mesh(path, scale);
  const shx_body_id id = add_head(solver, &head, 0.004, 0.035);
  free_mesh(&head);
  return id;
}

/* A groom's guides as wisps that rest as they are drawn; those near the strokes collide with head and comb. Gives how many there are. */
static size_t add_hair(shx_solver *solver, const char *path, double scale, shx_body_id head, shx_strand_id **out_ids) {
  shx_curves *curves;
  size_t count, total, strands = 0;
  CHECK(shx_curves_read(path, &curves));
  CHECK(shx_curves_count(curves, &count, &total));
  uint32_t *counts = allocate(count, sizeof *counts);
  double *points = allocate(3 * total, sizeof *points);
  CHECK(shx_curves_point_counts(curves, counts, count));
  const shx_output out = {points, 0, total, SHX_FORMAT_F64X3, 0};
  CHECK(shx_curves_points(curves, 0, count, scale, &out));
  shx_curves_destroy(curves);

  /* A wisp of the default kind, and the room that it takes. */
  shx_wisp wisp;
  shx_material hair, material;
  double margin;
  CHECK(shx_wisp_init(&wisp, sizeof wisp));
  CHECK(shx_material_init(&hair, sizeof hair));
  CHECK(shx_material_init(&material, sizeof material));
  hair.internal_friction = 1e-10;
  hair.air_drag = 5e-6;
  CHECK(shx_wisp_material(&wisp, &hair, &material, NULL, &margin));

  shx_push_out_def push;
  CHECK(shx_push_out_def_init(&push, sizeof push));
  push.body = head;
  push.clearance = material.radius[0];
  push.point_counts = counts;
  push.curve_count = count;
  CHECK(shx_solver_push_out_curves(solver, &push, points, NULL, NULL, NULL));

  shx_fit_options how;
  shx_fit_input what;
  CHECK(shx_fit_options_init(&how, sizeof how));
  CHECK(shx_fit_input_init(&what, sizeof what));
  how.element_count = ELEMENTS;
  what.curve_count = count;
  what.points = (shx_input){points, 0, total, SHX_FORMAT_F64X3, 0};
  what.point_counts = counts;
  shx_fitted_strand *fitted = allocate(count, sizeof *fitted);
  shx_strand_def *defs = allocate(count, sizeof *defs);
  double *lengths = allocate(ELEMENTS * count, sizeof *lengths), *shapes = allocate(3 * ELEMENTS * count, sizeof *shapes);
  CHECK(shx_fit_strands(&how, &what, fitted, 0, lengths, shapes, ELEMENTS * count));
  int *near = allocate(count, sizeof *near);
  for (size_t i = 0, first = 0; i < count; first += counts[i++]) {
    if (fitted[i].result != SHX_OK) /* of no use: all points at one place */
      continue;
    for (size_t point = first; point < first + counts[i]; point++)
      near[strands] |= is_near_strokes(points + 3 * point);
    CHECK(shx_strand_def_init(&defs[strands], sizeof defs[strands]));
    CHECK(shx_strand_def_set_fit(&defs[strands], &fitted[i], lengths + i * ELEMENTS, shapes + 3 * i * ELEMENTS));
    strands++;
  }
  shx_strand_id *ids = allocate(strands, sizeof *ids);
  CHECK(shx_solver_add_strands(solver, defs, sizeof *defs, strands, ids));
  CHECK(shx_solver_set_materials(solver, ids, strands, &material, sizeof material, 1));
  CHECK(shx_solver_adopt_rest_shapes(solver, ids, strands));
  CHECK(shx_solver_stiffen_strands(solver, ids, strands, SHX_STIFFEN_YOUNGS_MODULUS, margin, NULL));
  shx_strand_contact contact;
  CHECK(shx_strand_contact_init(&contact, sizeof contact));
  contact.radius = material.radius[0];
  size_t combed = 0;
  shx_strand_id *meeting = allocate(strands, sizeof *meeting);
  for (size_t i = 0; i < strands; i++)
    if (near[i])
      meeting[combed++] = ids[i];
  CHECK(shx_solver_set_strand_contact(solver, meeting, combed, &contact, 0));
  CHECK(shx_solver_permit_overlaps(solver, meeting, combed));
  printf("%zu wisps, %zu of them near the comb\n", strands, combed);
  free(meeting);
  free(near);
  free(counts);
  free(points);
  free(fitted);
  free(defs);
  free(lengths);
  free(shapes);
  *out_ids = ids;
  return strands;
}

static void write_hair(const shx_solver *solver, const shx_strand_id *ids, size_t count, const char *directory, int moment) {
  enum { POINTS = 24 };
  float *points = allocate(3 * POINTS * count, sizeof *points);
  uint32_t *counts = allocate(count, sizeof *counts);
  for (size_t i = 0; i < count; i++)
    counts[i] = POINTS;
  shx_sample_def sampling;
  CHECK(shx_sample_def_init(&sampling, sizeof sampling));
  sampling.points_per_strand = POINTS;
  const shx_output output = {points, 0, POINTS * count, SHX_FORMAT_F32X3, 0};
  CHECK(shx_solver_sample_strands(solver, ids, count, &sampling, &output, NULL, NULL));
  char path[1024];
  snprintf(path, sizeof path, "%s/hair.%d.obj", directory, moment);
  const shx_input drawn = {points, 0, POINTS * count, SHX_FORMAT_F32X3, 0};
  CHECK(shx_curves_write_points(path, &drawn, counts, count));
  free(points);
  free(counts);
}

/* Seven teeth 2 mm thick and 6 mm apart, which point at the head from behind, z, from the comb's own frame on. Gives how many bodies there are. */
static size_t add_comb(shx_solver *solver, shx_body_id ids[TEETH]) {
  shx_body_def teeth[TEETH];
  for (int i = 0; i < TEETH; i++) {
    CHECK(shx_body_def_init(&teeth[i], sizeof teeth[i]));
    teeth[i].shape = SHX_SHAPE_CAPSULE;
    teeth[i].radius = 0.001;
    teeth[i].a[0] = teeth[i].b[0] = SPACING * (i - TEETH / 2);
    teeth[i].a[2] = -LENGTH;
    stroke(0.0, teeth[i].pose.origin);
  }
  CHECK(shx_solver_add_bodies(solver, teeth, sizeof teeth[0], TEETH, ids));
  return TEETH;
}

/* The back of the same comb, for teeth that hold hair: bodies there would push it off them. */
static size_t add_back(shx_solver *solver, shx_body_id *id) {
  shx_body_def back;
  CHECK(shx_body_def_init(&back, sizeof back));
  back.shape = SHX_SHAPE_CAPSULE;
  back.radius = 0.003;
  back.b[0] = SPACING * (TEETH / 2);
  back.a[0] = -back.b[0];
  back.a[2] = back.b[2] = -LENGTH;
  stroke(0.0, back.pose.origin);
  CHECK(shx_solver_add_bodies(solver, &back, sizeof back, 1, id));
  return 1;
}

/* Teeth that hold the hair that they run into. */
static size_t add_rings(shx_haptic *haptic, const shx_solver *solver, const shx_strand_id *ids, size_t count) {
  shx_tool_def teeth;
  shx_ring_comb_def rings;
  size_t index;
  CHECK(shx_tool_def_init(&teeth, sizeof teeth));
  CHECK(shx_ring_comb_def_init(&rings, sizeof rings));
  teeth.kind = SHX_TOOL_COMB;
  teeth.tooth_count = TEETH;
  teeth.spacing = SPACING;
  teeth.length = LENGTH;
  teeth.radius = 0.001;
  shx_frame frame = {{0}, {0.0, 0.0, 0.0, 1.0}};
  stroke(0.0, frame.origin);
  frame.origin[2] -= LENGTH;
  CHECK(shx_haptic_add_ring_comb(haptic, solver, &teeth, &frame, &rings, ids, count, &index));
  return index;
}

int main(int argc, char **argv) {
  const int rings = argc > 1 && strcmp(argv[1], "--rings") == 0;
  argc -= rings;
  argv += rings;
  const double seconds = argc > 4 ? atof(argv[4]) : 6.0, scale = argc > 5 ? atof(argv[5]) : 0.01;
  if (argc < 4 || !(seconds > 0.0) || !(scale > 0.0)) {
    fprintf(stderr, "usage: haptic_comb [--rings] GROOM BUST.obj OUT_DIRECTORY [SECONDS [METRES_PER_UNIT]]\n");
    return 2;
  }
  shx_solver_def hair;
  CHECK(shx_solver_def_init(&hair, sizeof hair));
  for (int axis = 0; axis < 3; axis++)
    hair.gravity[axis] = gravity[axis];
  shx_solver *solver;
  CHECK(shx_solver_create(&hair, &solver));
  shx_strand_id *ids;
  const size_t count = add_hair(solver, argv[1], scale, read_head(solver, argv[2], scale), &ids);
  shx_body_id comb[TEETH];
  const size_t bodies = rings ? add_back(solver, comb) : add_comb(solver, comb);

  shared all = {0};
  shx_haptic_def def;
  CHECK(shx_haptic_def_init(&def, sizeof def));
  def.max_force = 3.0; /* what the device can hold */
  CHECK(shx_haptic_create(solver, &def, comb, bodies, &all.haptic));
  const size_t ring_comb = rings ? add_rings(all.haptic, solver, ids, count) : 0;
  CHECK(shx_haptic_state_init(&all.state, sizeof all.state));
  all.seconds = seconds;
  char path[1024];
  snprintf(path, sizeof path, "%s/force.csv", argv[3]);
  all.file = fopen(path, "w");
  if (all.file == NULL) {
    perror(path);
    return EXIT_FAILURE;
  }
  fprintf(all.file, "seconds,x,y,z,force_x,force_y,force_z,contacts,pressing,limits\n");

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
  shx_ring_comb_report teeth;
  unsigned caught = 0, combed = 0, let_go = 0;
  long late = 0, cut = 0;
  int moment = 0;
  double slowest = 0.0;
  for (long frame = 0; (double)frame < seconds * FRAMES; frame++) {
    const double time = (double)frame / FRAMES;
    late += sleep_until(&all.start, time) > 1.0 / FRAMES;
    CHECK(shx_haptic_before_step(all.haptic, solver, 1.0 / FRAMES));
    CHECK(shx_solver_step_with_limits(solver, 1.0 / FRAMES, 1, &limits, &report));
    CHECK(shx_haptic_after_step(all.haptic, solver));
    if (rings) {
      CHECK(shx_haptic_ring_comb_report(all.haptic, ring_comb, &teeth));
      caught += teeth.caught;
      combed += teeth.combed;
      let_go += teeth.let_go;
    }
    slowest = fmax(slowest, report.seconds);
    cut += report.unconverged > 0;
    if (moment < MOMENTS && time >= MOMENT[moment])
      write_hair(solver, ids, count, argv[3], moment++);
  }
  pthread_join(thread, NULL);
  fclose(all.file);

  printf("%.3g s of combing: largest force %.2f mN, largest change in a millisecond %.2f mN\n", seconds,
         1e3 * all.strongest, 1e3 * all.jump);
  printf("device: longest update %.3f ms of processor time, %.3f ms by the clock; %ld missed, %ld late wake-ups, the latest by %.2f ms\n",
         1e3 * all.longest, 1e3 * all.longest_wall, all.missed, all.late, 1e3 * all.wake);
  printf("simulation: %u models, slowest step %.2f ms, %ld steps with strands unconverged, %ld late frames\n",
         (unsigned)all.state.model_count, 1e3 * slowest, cut, late);
  printf("energy: the hand gave %.3g J and received %.3g J, never more than %.3g J beyond what it gave\n", all.state.energy_given,
         all.state.energy_received, all.state.max_energy_excess);
  if (rings)
    printf("rings: caught %u wisps, combed %u of them to the tip, let go of %u that pulled too hard\n", caught, combed, let_go);
  CHECK(shx_haptic_release_ring_combs(all.haptic, solver));
  shx_haptic_destroy(all.haptic);
  shx_solver_destroy(solver);
  free(ids);
  return all.state.max_energy_excess <= def.energy_allowance ? EXIT_SUCCESS : EXIT_FAILURE;
}
