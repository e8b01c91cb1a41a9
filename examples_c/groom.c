/* A groom on a moving head: reads a groom file, fits strands to its polylines, gives them the natural shapes that hold them up under
 * gravity, moves the head as recorded, steps, and writes every frame.
 *
 *   groom GROOM HEAD.csv OUTPUT_DIRECTORY [--scale METRES_PER_UNIT] [--seconds 3] [--rate 60] [--every 1] [--elements 0]
 *         [--threads 1] [--format obj|hair]
 *
 * GROOM       .hair, .tfx or .obj, y up, the first point of each strand is its root
 * HEAD.csv    a line of titles, then time (s), position (m), unit quaternion w, x, y, z: the head turns about the middle of the roots
 * --every n   takes every nth strand; --elements 0 takes one element for two points of the longest strand, 4 to 32 */
#include <math.h>
#include <string.h>
#include <time.h>
#include "check.h"

static void *allocate(size_t count, size_t size) {
  void *memory = calloc(count > 0 ? count : 1, size);
  if (memory == NULL) {
    fprintf(stderr, "out of memory\n");
    exit(EXIT_FAILURE);
  }
  return memory;
}

/* ---- options -------------------------------------------------------------------------------------------------------- */

typedef struct options {
  const char *groom, *head, *directory, *format;
  double scale, seconds, rate;
  long every, elements, threads;
} options;

static void usage(const char *problem) {
  fprintf(stderr, "%s\nusage: groom GROOM HEAD.csv OUTPUT_DIRECTORY [--scale M] [--seconds S] [--rate HZ] [--every N] "
                  "[--elements N] [--threads N] [--format obj|hair]\n", problem);
  exit(2);
}

static double number(const char *text, double least, double most) {
  char *end;
  const double value = strtod(text, &end);
  if (end == text || *end != '\0' || !(value >= least && value <= most)) {
    char problem[200];
    snprintf(problem, sizeof problem, "%.100s is not a number from %g to %g", text, least, most);
    usage(problem);
  }
  return value;
}

static options read_options(int argc, char **argv) {
  options o = {NULL, NULL, NULL, "obj", 1.0, 3.0, 60.0, 1, 0, 1};
  if (argc < 4)
    usage("three arguments are needed");
  o.groom = argv[1];
  o.head = argv[2];
  o.directory = argv[3];
  for (int i = 4; i < argc; i += 2) {
    const char *value = i + 1 < argc ? argv[i + 1] : "";
    if (strcmp(argv[i], "--scale") == 0)
      o.scale = number(value, 1e-9, 1e9);
    else if (strcmp(argv[i], "--seconds") == 0)
      o.seconds = number(value, 0.0, 1e6);
    else if (strcmp(argv[i], "--rate") == 0)
      o.rate = number(value, 1.0, 1e6);
    else if (strcmp(argv[i], "--every") == 0)
      o.every = (long)number(value, 1, 1e9);
    else if (strcmp(argv[i], "--elements") == 0)
      o.elements = (long)number(value, 0, 1000);
    else if (strcmp(argv[i], "--threads") == 0)
      o.threads = (long)number(value, 1, 256);
    else if (strcmp(argv[i], "--format") == 0 && (strcmp(value, "obj") == 0 || strcmp(value, "hair") == 0))
      o.format = value;
    else
      usage(argv[i]);
  }
  return o;
}

/* ---- the head's motion ---------------------------------------------------------------------------------------------- */

typedef struct pose {
  double time, position[3], rotation[4]; /* x, y, z, w */
} pose;

typedef struct motion {
  pose *poses;
  size_t count;
} motion;

static motion read_motion(const char *path) {
  FILE *file = fopen(path, "r");
  char line[512];
  if (file == NULL || fgets(line, sizeof line, file) == NULL) {
    fprintf(stderr, "%s: cannot be read\n", path);
    exit(EXIT_FAILURE);
  }
  motion m = {NULL, 0};
  size_t capacity = 0;
  while (fgets(line, sizeof line, file) != NULL) {
    pose p;
    double *q = p.rotation;
    if (sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &p.time, &p.position[0], &p.position[1], &p.position[2], &q[3], &q[0],
               &q[1], &q[2]) != 8) {
      fprintf(stderr, "%s: line %zu does not hold eight numbers\n", path, m.count + 2);
      exit(EXIT_FAILURE);
    }
    if (m.count == capacity) {
      capacity = capacity == 0 ? 256 : 2 * capacity;
      m.poses = realloc(m.poses, capacity * sizeof *m.poses);
      if (m.poses == NULL)
        exit(EXIT_FAILURE);
    }
    m.poses[m.count++] = p;
  }
  fclose(file);
  if (m.count == 0) {
    fprintf(stderr, "%s: holds no pose\n", path);
    exit(EXIT_FAILURE);
  }
  return m;
}

/* The pose at a time, between the two recorded ones; held at both ends. */
static pose pose_at(const motion *m, double time) {
  size_t i = 0;
  while (i + 1 < m->count && m->poses[i + 1].time <= time)
    i++;
  pose a = m->poses[i];
  if (i + 1 == m->count || time <= a.time)
    return a;
  const pose *b = &m->poses[i + 1];
  const double u = (time - a.time) / (b->time - a.time);
  double cosine = 0.0, norm = 0.0;
  for (int k = 0; k < 4; k++)
    cosine += a.rotation[k] * b->rotation[k];
  for (int k = 0; k < 3; k++)
    a.position[k] += u * (b->position[k] - a.position[k]);
  for (int k = 0; k < 4; k++) {
    a.rotation[k] += u * ((cosine < 0.0 ? -1.0 : 1.0) * b->rotation[k] - a.rotation[k]);
    norm += a.rotation[k] * a.rotation[k];
  }
  for (int k = 0; k < 4; k++)
    a.rotation[k] /= sqrt(norm);
  a.time = time;
  return a;
}

/* ---- small algebra of quaternions x, y, z, w ------------------------------------------------------------------------ */

static void multiply(const double a[4], const double b[4], double out[4]) {
  const double q[4] = {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
                       a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
  memcpy(out, q, sizeof q);
}

static void rotate(const double q[4], const double v[3], double out[3]) {
  const double inverse[4] = {-q[0], -q[1], -q[2], q[3]}, pure[4] = {v[0], v[1], v[2], 0.0};
  double turned[4];
  multiply(q, pure, turned);
  multiply(turned, inverse, turned);
  memcpy(out, turned, 3 * sizeof *out);
}

/* ---- the groom ------------------------------------------------------------------------------------------------------ */

typedef struct groom {
  size_t strand_count, point_total;
  shx_strand_def *defs;
  uint32_t *point_counts;
  shx_frame *rest_roots;
  double *lengths, *shapes; /* what the definitions point to */
  double pivot[3]; /* the middle of the roots */
} groom;

static const double gravity[3] = {0.0, -9.81, 0.0}; /* y is up */

/* Reads the file, and fits strands to its polylines, all in one call. */
static groom read_groom(const options *o) {
  shx_curves *curves;
  size_t in_file, total;
  CHECK(shx_curves_read(o->groom, &curves));
  CHECK(shx_curves_count(curves, &in_file, &total));
  uint32_t *counts = allocate(in_file, sizeof *counts), most = 0;
  float *points = allocate(3 * total, sizeof *points);
  CHECK(shx_curves_point_counts(curves, counts, in_file));
  const shx_output all = {points, 0, total, SHX_FORMAT_F32X3, 0};
  CHECK(shx_curves_points(curves, 0, in_file, o->scale, &all));
  shx_curves_destroy(curves);

  /* Those that are taken move to the front. */
  size_t taken = 0, from = 0, to = 0;
  for (size_t i = 0; i < in_file; i++) {
    const uint32_t count = counts[i];
    if (i % (size_t)o->every == 0) {
      memmove(points + 3 * to, points + 3 * from, 3 * (size_t)count * sizeof *points);
      counts[taken++] = count;
      to += count;
      most = count > most ? count : most;
    }
    from += count;
  }

  shx_fit_options how;
  shx_fit_curves what;
  CHECK(shx_fit_options_init(&how, sizeof how));
  CHECK(shx_fit_curves_init(&what, sizeof what));
  how.element_count = o->elements > 0 ? (uint32_t)o->elements : most / 2 < 4 ? 4 : most / 2 > 32 ? 32 : most / 2;
  how.worker_count = (uint32_t)o->threads;
  what.curve_count = taken;
  what.points = (shx_input){points, 0, to, SHX_FORMAT_F32X3, 0};
  what.point_counts = counts;
  groom g = {0, 0, allocate(taken, sizeof *g.defs), allocate(taken, sizeof *g.point_counts), allocate(taken, sizeof *g.rest_roots),
             NULL, NULL, {0.0, 0.0, 0.0}};
  const size_t elements = taken * how.element_count;
  shx_fitted_strand *fitted = allocate(taken, sizeof *fitted);
  g.lengths = allocate(elements, sizeof *g.lengths);
  g.shapes = allocate(3 * elements, sizeof *g.shapes);
  CHECK(shx_fit_strands(&how, &what, fitted, 0, g.lengths, g.shapes, elements));

  double worst = 0.0, sum = 0.0;
  for (size_t i = 0; i < taken; i++) {
    if (fitted[i].status != SHX_OK) /* of no use: all points at one place */
      continue;
    shx_strand_def *def = &g.defs[g.strand_count];
    CHECK(shx_strand_def_init(def, sizeof *def));
    CHECK(shx_strand_def_set_fit(def, &fitted[i], g.lengths + i * how.element_count, g.shapes + 3 * i * how.element_count));
    g.rest_roots[g.strand_count] = def->root;
    def->internal_friction = 1e-10;
    /* The upper end of what was measured on real wisps (5e-6 to 5e-5): nothing else damps a strand that touches no other. */
    def->air_drag = 5e-5;
    worst = fitted[i].rms_error > worst ? fitted[i].rms_error : worst;
    sum += fitted[i].rms_error;
    for (int k = 0; k < 3; k++)
      g.pivot[k] += fitted[i].root.origin[k];
    g.point_counts[g.strand_count++] = counts[i];
    g.point_total += counts[i];
  }
  if (g.strand_count == 0) {
    fprintf(stderr, "%s: no strand could be fitted\n", o->groom);
    exit(EXIT_FAILURE);
  }
  for (int k = 0; k < 3; k++)
    g.pivot[k] /= (double)g.strand_count;
  printf("%s: %zu of %zu strands taken, %zu of no length left out; fitted to %.2f mm (mean; worst %.2f mm)\n", o->groom,
         g.strand_count, in_file, taken - g.strand_count, 1000.0 * sum / (double)g.strand_count, 1000.0 * worst);
  free(fitted);
  free(points);
  free(counts);
  return g;
}

static void free_groom(groom *g) {
  free(g->defs);
  free(g->point_counts);
  free(g->rest_roots);
  free(g->lengths);
  free(g->shapes);
}

/* Where the head has taken the roots, relative to its first pose. */
static void move_roots(const groom *g, const pose *first, const pose *now, shx_frame *roots) {
  const double back[4] = {-first->rotation[0], -first->rotation[1], -first->rotation[2], first->rotation[3]};
  double turn[4];
  multiply(now->rotation, back, turn);
  for (size_t i = 0; i < g->strand_count; i++) {
    double arm[3], turned[3];
    for (int k = 0; k < 3; k++)
      arm[k] = g->rest_roots[i].origin[k] - g->pivot[k];
    rotate(turn, arm, turned);
    for (int k = 0; k < 3; k++)
      roots[i].origin[k] = g->pivot[k] + turned[k] + now->position[k] - first->position[k];
    multiply(turn, g->rest_roots[i].rotation, roots[i].rotation);
  }
}

/* ---- frames --------------------------------------------------------------------------------------------------------- */

/* Samples each strand at as many points as its polyline had, and writes a frame of the cache. */
static void write_frame(const options *o, const groom *g, const shx_solver *solver, const shx_strand_id *ids, long frame,
                        float *points) {
  size_t first = 0;
  for (size_t i = 0; i < g->strand_count; i++) {
    shx_sample_def sampling;
    CHECK(shx_sample_def_init(&sampling, sizeof sampling));
    sampling.points_per_strand = g->point_counts[i];
    const shx_output output = {points + 3 * first, 0, g->point_counts[i], SHX_FORMAT_F32X3, 0};
    CHECK(shx_solver_sample_strands(solver, &ids[i], 1, &sampling, &output, NULL, NULL));
    first += g->point_counts[i];
  }
  char path[1024];
  snprintf(path, sizeof path, "%s/groom.%04ld.%s", o->directory, frame, o->format);
  const shx_input drawn = {points, 0, g->point_total, SHX_FORMAT_F32X3, 0};
  CHECK(shx_curves_write(path, &drawn, g->point_counts, g->strand_count));
}

int main(int argc, char **argv) {
  const options o = read_options(argc, argv);
  const clock_t started = clock();
  const motion head = read_motion(o.head);
  groom g = read_groom(&o);
  printf("fitting took %.2f s of processor time\n", (double)(clock() - started) / CLOCKS_PER_SEC);

  shx_solver_def def;
  CHECK(shx_solver_def_init(&def, sizeof def));
  memcpy(def.gravity, gravity, sizeof gravity);
  def.worker_count = (uint32_t)o.threads;
  shx_solver *solver;
  CHECK(shx_solver_create(&def, &solver));
  shx_strand_id *ids = allocate(g.strand_count, sizeof *ids);
  CHECK(shx_solver_add_strands(solver, g.defs, sizeof *g.defs, g.strand_count, ids));
  CHECK(shx_solver_take_rest_shapes(solver, ids, g.strand_count)); /* the groom as it is drawn is its shape at rest */

  shx_frame *roots = allocate(g.strand_count, sizeof *roots);
  float *points = allocate(3 * g.point_total, sizeof *points);
  const long frames = lround(o.seconds * o.rate);
  const pose first = pose_at(&head, head.poses[0].time);
  double stepping = 0.0, iterations = 0.0;
  uint64_t unconverged = 0, quarantined = 0;
  shx_step_report report;
  CHECK(shx_step_report_init(&report, sizeof report));
  write_frame(&o, &g, solver, ids, 0, points);
  for (long frame = 1; frame <= frames; frame++) {
    const pose now = pose_at(&head, head.poses[0].time + (double)frame / o.rate);
    move_roots(&g, &first, &now, roots);
    const shx_input input = {roots, 0, g.strand_count, SHX_FORMAT_FRAME, 0};
    CHECK(shx_solver_set_root_frames(solver, ids, g.strand_count, &input, 1.0 / o.rate));
    CHECK(shx_solver_step(solver, 1.0 / o.rate, 1, &report));
    stepping += report.seconds;
    iterations += report.mean_iterations;
    unconverged += report.unconverged;
    quarantined += report.quarantined;
    if (frame % 30 == 0)
      printf("%6.2f s: %.2f iterations a strand (most %u), residual %.1e rad, %.2f ms a step, energy %.3e J\n",
             (double)frame / o.rate, report.mean_iterations, report.max_iterations, report.max_residual, 1000.0 * report.seconds,
             report.kinetic_energy + report.elastic_energy + report.gravity_energy);
    write_frame(&o, &g, solver, ids, frame, points);
  }
  printf("%ld frames of %zu strands in %s: stepping %.2f s (%.3f of real time), %.2f iterations a step, %llu unconverged, "
         "%llu quarantined\n",
         frames + 1, g.strand_count, o.directory, stepping, o.seconds > 0.0 ? stepping / o.seconds : 0.0,
         frames > 0 ? iterations / (double)frames : 0.0, (unsigned long long)unconverged, (unsigned long long)quarantined);

  free(points);
  free(roots);
  free(ids);
  shx_solver_destroy(solver);
  free_groom(&g);
  free(head.poses);
  return quarantined == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
