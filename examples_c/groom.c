/* A groom on a moving head: reads a groom file, fits strands to its polylines, gives them the natural shapes that hold them up under
 * gravity, moves the head as recorded, steps, and writes every frame. With a body the hair is kept out of it and off itself, and render hair
 * grows on it.
 *
 *   groom GROOM HEAD.csv OUTPUT_DIRECTORY [--scale METRES_PER_UNIT] [--seconds 3] [--rate 60] [--substeps 1] [--every 1] [--elements 0]
 *         [--threads 1] [--format obj|hair] [--body MESH.obj] [--wisp METRES] [--hairs N --render DIRECTORY]
 *
 * GROOM       .hair, .tfx or .obj, y up, the first point of each strand is its root
 * HEAD.csv    a line of titles, then time (s), position (m), unit quaternion w, x, y, z: the head turns about the middle of the roots
 * --every n   takes every nth strand; --elements 0 takes one element for two points of the longest strand, 4 to 32
 * --body      a head in the groom's units and axes that goes with the roots; strands then are wisps of a head of hair
 * --wisp r    strands touch each other as wisps of that radius
 * --hairs n   n render hairs that follow the strands, into --render's DIRECTORY; needs --body, on which they grow */
#include <math.h>
#include <string.h>
#include <time.h>
#include "check.h"
#include "mesh.h"
#include "motion.h"

/* ---- options -------------------------------------------------------------------------------------------------------- */

typedef struct options {
  const char *groom, *head, *directory, *format, *body, *render;
  double scale, seconds, rate, wisp;
  long every, elements, threads, substeps, hairs;
} options;

static void usage(const char *problem) {
  fprintf(stderr, "%s\nusage: groom GROOM HEAD.csv OUTPUT_DIRECTORY [--scale M] [--seconds S] [--rate HZ] [--substeps N] [--every N] "
                  "[--elements N] [--threads N] [--format obj|hair] [--body MESH.obj] [--wisp M] [--hairs N --render DIR]\n", problem);
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
  options o = {NULL, NULL, NULL, "obj", NULL, NULL, 1.0, 3.0, 60.0, 0.0, 1, 0, 1, 1, 0};
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
    else if (strcmp(argv[i], "--substeps") == 0)
      o.substeps = (long)number(value, 1, 1000);
    else if (strcmp(argv[i], "--wisp") == 0)
      o.wisp = number(value, 0.0, 1.0);
    else if (strcmp(argv[i], "--hairs") == 0)
      o.hairs = (long)number(value, 0, 1e6);
    else if (strcmp(argv[i], "--body") == 0 && i + 1 < argc)
      o.body = value;
    else if (strcmp(argv[i], "--render") == 0 && i + 1 < argc)
      o.render = value;
    else if (strcmp(argv[i], "--format") == 0 && (strcmp(value, "obj") == 0 || strcmp(value, "hair") == 0))
      o.format = value;
    else
      usage(argv[i]);
  }
  if (o.hairs > 0 && (o.body == NULL || o.render == NULL))
    usage("--hairs needs --body and --render");
  return o;
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
  shx_fit_input what;
  CHECK(shx_fit_options_init(&how, sizeof how));
  CHECK(shx_fit_input_init(&what, sizeof what));
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
    if (fitted[i].result != SHX_OK) /* of no use: all points at one place */
      continue;
    shx_strand_def *def = &g.defs[g.strand_count];
    CHECK(shx_strand_def_init(def, sizeof *def));
    CHECK(shx_strand_def_set_fit(def, &fitted[i], g.lengths + i * how.element_count, g.shapes + 3 * i * how.element_count));
    g.rest_roots[g.strand_count] = def->root;
    def->internal_friction = 1e-10;
    /* Measured on real hair, disciplined and fuzzy: nothing else damps a bare hair without contact. */
    def->air_drag = o->body != NULL ? 5e-6 : 5e-5;
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
  double turn[4];
  turn_since(first, now, turn);
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

/* ---- the head ------------------------------------------------------------------------------------------------------- */

/* Nodes of the head's grid of distances are so far apart, and it reaches so far beyond the skin, m. */
static const double GRID_CELL = 0.004, GRID_BAND = 0.035;

/* A guide of a head of hair stands for hundreds of hairs that hold together: the strands become such wisps, and rest as they are drawn. */
static void make_wisps(const groom *g, shx_solver *solver, const shx_strand_id *ids) {
  shx_wisp wisp;
  shx_material hair, all;
  double margin;
  CHECK(shx_wisp_init(&wisp, sizeof wisp));
  CHECK(shx_material_init(&hair, sizeof hair));
  CHECK(shx_material_init(&all, sizeof all));
  CHECK(shx_solver_get_material(solver, ids[0], &hair)); /* that of all of them */
  CHECK(shx_wisp_material(&wisp, &hair, &all, NULL, &margin));
  CHECK(shx_solver_set_materials(solver, ids, g->strand_count, &all, sizeof all, 1));
  double *scales = allocate(g->strand_count, sizeof *scales);
  CHECK(shx_solver_stiffen_strands(solver, ids, g->strand_count, SHX_STIFFEN_YOUNGS_MODULUS, margin, scales));
  size_t stiffened = 0;
  for (size_t i = 0; i < g->strand_count; i++)
    stiffened += scales[i] > 1.0;
  printf("wisps of %g hairs, hold %g; %zu made stiffer to rest as drawn\n", wisp.hairs, wisp.hold, stiffened);
  free(scales);
}

/* The cheap model of contact: springs. The overlaps that the groom is drawn with are permitted. */
static void set_contact(const options *o, const groom *g, shx_solver *solver, const shx_strand_id *ids) {
  shx_contact_options contact;
  CHECK(shx_contact_options_init(&contact, sizeof contact));
  contact.model = SHX_CONTACT_PENALTY;
  contact.hair_contact = o->wisp > 0.0;
  CHECK(shx_solver_set_contact_options(solver, &contact));
  shx_strand_contact strand;
  CHECK(shx_strand_contact_init(&strand, sizeof strand));
  strand.wisp_radius = o->wisp;
  CHECK(shx_solver_set_strand_contact(solver, ids, g->strand_count, &strand, 0));
}

/* The head goes where its roots go. */
static void move_head(const groom *g, const pose *first, const pose *now, shx_solver *solver, shx_body_id id, double seconds) {
  shx_frame frame = {{0.0}, {0.0}};
  turn_since(first, now, frame.rotation);
  double arm[3];
  for (int k = 0; k < 3; k++)
    arm[k] = -g->pivot[k];
  rotate(frame.rotation, arm, frame.origin);
  for (int k = 0; k < 3; k++)
    frame.origin[k] += g->pivot[k] + now->position[k] - first->position[k];
  const shx_input input = {&frame, 0, 1, SHX_FORMAT_FRAME, 0};
  CHECK(shx_solver_set_body_frames(solver, &id, 1, &input, seconds));
}

/* ---- render hair ---------------------------------------------------------------------------------------------------- */

enum { HAIR_POINTS = 16 };

typedef struct render {
  shx_render_hair *hair;
  shx_render_pose *pose;
  size_t count;
  float *points;
  uint32_t *point_counts;
} render;

/* The map from guides to render hair, made once while the guides rest. */
static render grow(const options *o, const groom *g, const mesh *head, const shx_solver *solver, const shx_strand_id *ids) {
  shx_scalp_def on;
  CHECK(shx_scalp_def_init(&on, sizeof on));
  on.vertices = (shx_input){head->vertices, 0, head->vertex_count, SHX_FORMAT_F64X3, 0};
  on.triangles = head->triangles;
  on.triangle_count = head->triangle_count;
  shx_scalp *scalp;
  CHECK(shx_scalp_create(&on, &scalp));
  shx_scatter_def scatter;
  CHECK(shx_scatter_def_init(&scatter, sizeof scatter));
  scatter.count = (size_t)o->hairs;
  scatter.guide_roots = (shx_input){g->rest_roots, sizeof *g->rest_roots, g->strand_count, SHX_FORMAT_F64X3, 0}; /* not on face, ears and neck */
  shx_follicle *follicles = allocate((size_t)o->hairs, sizeof *follicles);
  render r = {NULL, NULL, 0, NULL, NULL};
  CHECK(shx_scalp_scatter(scalp, &scatter, follicles, (size_t)o->hairs, &r.count, NULL));
  shx_frame *roots = allocate(r.count, sizeof *roots);
  const shx_output frames = {roots, 0, r.count, SHX_FORMAT_FRAME, 0};
  CHECK(shx_scalp_root_frames(scalp, &on.vertices, follicles, r.count, &frames));

  shx_render_settings settings;
  CHECK(shx_render_settings_init(&settings, sizeof settings));
  settings.points_per_strand = HAIR_POINTS;
  settings.frizz = 5e-4;
  settings.worker_count = (uint32_t)o->threads;
  const shx_input at = {roots, 0, r.count, SHX_FORMAT_FRAME, 0};
  CHECK(shx_solver_create_render_hair(solver, ids, g->strand_count, &settings, &at, &r.hair));
  CHECK(shx_render_pose_create(r.hair, &r.pose));
  r.points = allocate(3 * HAIR_POINTS * r.count, sizeof *r.points);
  r.point_counts = allocate(r.count, sizeof *r.point_counts);
  for (size_t i = 0; i < r.count; i++)
    r.point_counts[i] = HAIR_POINTS;
  free(roots);
  free(follicles);
  shx_scalp_destroy(scalp);
  return r;
}

static void write_render_frame(const options *o, const groom *g, const render *r, const shx_solver *solver, const shx_strand_id *ids,
                               long frame) {
  const shx_output output = {r->points, 0, HAIR_POINTS * r->count, SHX_FORMAT_F32X3, 0};
  CHECK(shx_solver_set_render_pose(solver, ids, g->strand_count, 0, r->pose));
  CHECK(shx_solver_evaluate_render_pose(solver, r->pose, NULL, &output, NULL, NULL)); /* out of the head */
  char path[1024];
  snprintf(path, sizeof path, "%s/hair.%04ld.hair", o->render, frame);
  const shx_input drawn = {r->points, 0, HAIR_POINTS * r->count, SHX_FORMAT_F32X3, 0};
  CHECK(shx_curves_write_points(path, &drawn, r->point_counts, r->count));
}

static void free_render(render *r) {
  shx_render_pose_destroy(r->pose);
  shx_render_hair_destroy(r->hair);
  free(r->points);
  free(r->point_counts);
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
  CHECK(shx_curves_write_points(path, &drawn, g->point_counts, g->strand_count));
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
  CHECK(shx_solver_adopt_rest_shapes(solver, ids, g.strand_count)); /* the groom as it is drawn is its shape at rest */
  mesh body = {NULL, NULL, 0, 0};
  shx_body_id body_id = {0};
  render r = {NULL, NULL, 0, NULL, NULL};
  if (o.body != NULL) {
    body = read_mesh(o.body, o.scale);
    make_wisps(&g, solver, ids);
    set_contact(&o, &g, solver, ids);
    body_id = add_head(solver, &body, GRID_CELL, GRID_BAND);
    CHECK(shx_solver_permit_overlaps(solver, ids, g.strand_count));
    printf("%s: %zu triangles, a grid of distances %g mm apart\n", o.body, body.triangle_count, 1000.0 * GRID_CELL);
  }
  if (o.hairs > 0) {
    r = grow(&o, &g, &body, solver, ids);
    printf("%zu render hairs grow on it\n", r.count);
  }

  shx_frame *roots = allocate(g.strand_count, sizeof *roots);
  float *points = allocate(3 * g.point_total, sizeof *points);
  const long frames = lround(o.seconds * o.rate);
  const pose first = pose_at(&head, head.poses[0].time);
  double stepping = 0.0, iterations = 0.0;
  uint64_t unconverged = 0, quarantined = 0;
  shx_step_report report;
  CHECK(shx_step_report_init(&report, sizeof report));
  write_frame(&o, &g, solver, ids, 0, points);
  if (r.count > 0)
    write_render_frame(&o, &g, &r, solver, ids, 0);
  for (long frame = 1; frame <= frames; frame++) {
    const pose now = pose_at(&head, head.poses[0].time + (double)frame / o.rate);
    move_roots(&g, &first, &now, roots);
    const shx_input input = {roots, 0, g.strand_count, SHX_FORMAT_FRAME, 0};
    CHECK(shx_solver_set_root_frames(solver, ids, g.strand_count, &input, 1.0 / o.rate));
    if (o.body != NULL)
      move_head(&g, &first, &now, solver, body_id, 1.0 / o.rate);
    CHECK(shx_solver_step(solver, 1.0 / o.rate, (uint32_t)o.substeps, &report));
    stepping += report.seconds;
    iterations += report.mean_iterations;
    unconverged += report.unconverged;
    quarantined += report.quarantined;
    if (frame % 30 == 0)
      printf("%6.2f s: %.2f iterations a strand (most %u), residual %.1e rad, %.2f ms a step, energy %.3e J\n",
             (double)frame / o.rate, report.mean_iterations, report.max_iterations, report.max_residual, 1000.0 * report.seconds,
             report.kinetic_energy + report.elastic_energy + report.gravity_energy);
    write_frame(&o, &g, solver, ids, frame, points);
    if (r.count > 0)
      write_render_frame(&o, &g, &r, solver, ids, frame);
  }
  printf("%ld frames of %zu strands in %s: stepping %.2f s (%.3f of real time), %.2f iterations a step, %llu unconverged, "
         "%llu quarantined\n",
         frames + 1, g.strand_count, o.directory, stepping, o.seconds > 0.0 ? stepping / o.seconds : 0.0,
         frames > 0 ? iterations / (double)frames : 0.0, (unsigned long long)unconverged, (unsigned long long)quarantined);

  free(points);
  free(roots);
  free(ids);
  if (r.count > 0)
    free_render(&r);
  free_mesh(&body);
  shx_solver_destroy(solver);
  free_groom(&g);
  free(head.poses);
  return quarantined == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
