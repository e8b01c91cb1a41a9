/* Rule 8: dlclose after destroy unloads the library, 100 times, after serial, pooled and dense solvers, contact, static rests, errors
 * and fits.
 *   unload LIBRARY.so */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "superhelix.h"

static int mapped(void) {
  FILE *maps = fopen("/proc/self/maps", "r");
  char line[1024];
  int found = 0;
  while (maps != NULL && fgets(line, sizeof line, maps) != NULL)
    found |= strstr(line, "libsuperhelix") != NULL;
  if (maps == NULL || fclose(maps) != 0)
    exit(3);
  return found;
}

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

/* Render hair of a pool of its own, on a scattered scalp. */
static void render(uint32_t workers) {
  LOAD(shx_scalp_def_init);
  LOAD(shx_scalp_create);
  LOAD(shx_scatter_def_init);
  LOAD(shx_scalp_scatter);
  LOAD(shx_scalp_root_frames);
  LOAD(shx_scalp_destroy);
  LOAD(shx_render_settings_init);
  LOAD(shx_render_guides_init);
  LOAD(shx_render_hair_create);
  LOAD(shx_render_hair_destroy);
  LOAD(shx_render_pose_create);
  LOAD(shx_render_pose_set_guides);
  LOAD(shx_render_pose_evaluate);
  LOAD(shx_render_pose_destroy);
  static const double corners[4][3] = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
  static const uint32_t triangles[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  shx_scalp_def scalp_def;
  MUST(p_shx_scalp_def_init(&scalp_def, sizeof scalp_def));
  scalp_def.vertices = (shx_input){corners, 0, 4, SHX_FORMAT_F64X3, 0};
  scalp_def.triangles = &triangles[0][0];
  scalp_def.triangle_count = 4;
  shx_scalp *scalp;
  MUST(p_shx_scalp_create(&scalp_def, &scalp));
  shx_scatter_def scatter;
  MUST(p_shx_scatter_def_init(&scatter, sizeof scatter));
  scatter.count = 400;
  static shx_follicle follicles[400];
  static shx_frame frames[400];
  size_t count;
  MUST(p_shx_scalp_scatter(scalp, &scatter, follicles, 400, &count, NULL));
  const shx_output places = {frames, 0, 400, SHX_FORMAT_FRAME, 0};
  MUST(p_shx_scalp_root_frames(scalp, NULL, follicles, 400, &places));
  shx_render_settings settings;
  MUST(p_shx_render_settings_init(&settings, sizeof settings));
  settings.points_per_strand = 2;
  settings.interpolation = SHX_INTERPOLATION_CURVATURE;
  settings.worker_count = workers;
  shx_render_guides guides;
  MUST(p_shx_render_guides_init(&guides, sizeof guides));
  guides.guide_count = 2;
  guides.points = scalp_def.vertices;
  const shx_input roots = {frames, sizeof frames[0], 400, SHX_FORMAT_F64X3, 0};
  shx_render_hair *hair;
  MUST(p_shx_render_hair_create(&settings, &guides, &roots, &hair));
  shx_render_pose *pose;
  MUST(p_shx_render_pose_create(hair, &pose));
  MUST(p_shx_render_pose_set_guides(pose, &guides));
  static float points[400][2][3];
  const shx_output out = {points, 0, 800, SHX_FORMAT_F32X3, 0};
  MUST(p_shx_render_pose_evaluate(pose, NULL, &out, NULL, NULL));
  p_shx_render_hair_destroy(hair);
  p_shx_render_pose_destroy(pose);
  p_shx_scalp_destroy(scalp);
}

static void use(uint32_t workers, uint32_t linear_solver) {
  render(workers);

  LOAD(shx_solver_def_init);
  LOAD(shx_strand_def_init);
  LOAD(shx_solver_create);
  LOAD(shx_solver_add_strands);
  LOAD(shx_solver_step);
  LOAD(shx_solver_destroy);
  LOAD(shx_solver_settle);
  LOAD(shx_body_def_init);
  LOAD(shx_solver_add_bodies);
  LOAD(shx_strand_contact_init);
  LOAD(shx_solver_set_strand_contact);
  LOAD(shx_contact_options_init);
  LOAD(shx_solver_set_contact_options);
  LOAD(shx_constraint_def_init);
  LOAD(shx_solver_add_constraints);
  LOAD(shx_last_error);
  shx_solver_def def;
  MUST(p_shx_solver_def_init(&def, sizeof def));
  def.worker_count = workers;
  def.linear_solver = linear_solver;
  shx_solver *solver;
  MUST(p_shx_solver_create(&def, &solver));
  shx_strand_def strands[20];
  shx_strand_id ids[20];
  for (int i = 0; i < 20; i++) {
    MUST(p_shx_strand_def_init(&strands[i], sizeof strands[i]));
    strands[i].length = 0.1;
    strands[i].element_count = 12;
    strands[i].root.origin[1] = 0.001 * i;
  }
  MUST(p_shx_solver_add_strands(solver, strands, sizeof strands[0], 20, ids));
  /* Hair on hair, on a mesh and a hull, and a pin. */
  static const double corners[4][3] = {{0, 0, -0.05}, {0.05, 0, -0.05}, {0, 0.05, -0.05}, {0, 0, 0}};
  static const uint32_t triangles[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const shx_input vertices = {corners, 0, 4, SHX_FORMAT_F64X3, 0};
  shx_body_def bodies[2];
  shx_body_id body_ids[2];
  for (int i = 0; i < 2; i++) {
    MUST(p_shx_body_def_init(&bodies[i], sizeof bodies[i]));
    bodies[i].shape = i == 0 ? SHX_SHAPE_MESH : SHX_SHAPE_HULL;
    bodies[i].vertices = vertices;
    bodies[i].triangles = &triangles[0][0];
    bodies[i].triangle_count = 4;
  }
  MUST(p_shx_solver_add_bodies(solver, bodies, sizeof bodies[0], 2, body_ids));
  shx_contact_options options;
  MUST(p_shx_contact_options_init(&options, sizeof options));
  options.hair_contact = 1;
  options.model = SHX_CONTACT_PENALTY;
  MUST(p_shx_solver_set_contact_options(solver, &options));
  shx_strand_contact contact;
  MUST(p_shx_strand_contact_init(&contact, sizeof contact));
  contact.wisp_radius = 0.001;
  MUST(p_shx_solver_set_strand_contact(solver, ids, 3, &contact, 0));
  shx_constraint_def pin;
  shx_constraint_id pin_id;
  MUST(p_shx_constraint_def_init(&pin, sizeof pin));
  pin.strand = ids[4];
  pin.arclength = 0.1;
  pin.target.origin[0] = 0.09;
  MUST(p_shx_solver_add_constraints(solver, &pin, sizeof pin, 1, &pin_id));
  MUST(p_shx_solver_step(solver, 0.01, 1, NULL));
  MUST(p_shx_solver_settle(solver, ids, workers > 1 ? 10 : 2, NULL, NULL, NULL, NULL, NULL));
  char text[64];
  if (p_shx_solver_step(solver, -1.0, 1, NULL) != SHX_ERROR_INVALID_ARGUMENT || p_shx_last_error(text, sizeof text) == 0)
    exit(1);
  p_shx_solver_destroy(solver);
}

static void fit(void) {
  LOAD(shx_polyline_fit_init);
  LOAD(shx_fit_polyline);
  LOAD(shx_sag_free_curvatures);
  LOAD(shx_strand_def_init);
  const double points[4][3] = {{0, 0, 0}, {0.01, 0, 0.001}, {0.02, 0.004, 0}, {0.03, 0, 0}};
  const double gravity[3] = {0, 0, -9.81};
  const shx_input polyline = {points, 0, 4, SHX_FORMAT_F64X3, 0};
  double lengths[3], rows[3][3], natural[3][3];
  shx_polyline_fit fitted;
  shx_strand_def def;
  MUST(p_shx_polyline_fit_init(&fitted, sizeof fitted));
  MUST(p_shx_fit_polyline(&polyline, 3, &fitted, lengths, &rows[0][0], 3));
  MUST(p_shx_strand_def_init(&def, sizeof def));
  def.element_count = 3;
  def.length = 0.03;
  MUST(p_shx_sag_free_curvatures(&def, &rows[0][0], 3, gravity, &natural[0][0]));
}

static void fit_many(void) {
  LOAD(shx_fit_options_init);
  LOAD(shx_fit_input_init);
  LOAD(shx_fit_strands);
  LOAD(shx_spline_def_init);
  LOAD(shx_spline_points);
  const double points[8][3] = {{0, 0, 0}, {0.01, 0, 0.001}, {0.02, 0.004, 0}, {0.03, 0, 0}, {0, 0, 0}, {0, 0.02, 0}, {0, 0.03, 0.01}, {0, 0.03, 0.02}};
  const uint32_t counts[2] = {4, 4};
  double lengths[6], rows[6][3];
  shx_fit_options options;
  shx_fit_input curves;
  shx_fitted_strand strands[2];
  MUST(p_shx_fit_input_init(&curves, sizeof curves));
  curves.curve_count = 2;
  curves.points = (shx_input){points, 0, 8, SHX_FORMAT_F64X3, 0};
  curves.point_counts = counts;
  for (uint32_t workers = 1; workers <= 2; workers++) {
    MUST(p_shx_fit_options_init(&options, sizeof options));
    options.element_count = 3;
    options.worker_count = workers;
    MUST(p_shx_fit_strands(&options, &curves, strands, 0, lengths, &rows[0][0], 6));
  }
  shx_spline_def spline;
  MUST(p_shx_spline_def_init(&spline, sizeof spline));
  spline.ends = SHX_SPLINE_ENDS_OPEN;
  spline.controls = (shx_input){points, 0, 4, SHX_FORMAT_F64X3, 0};
  size_t count;
  MUST(p_shx_spline_points(&spline, NULL, NULL, &count));
}

static void fit_friction(void) {
  LOAD(shx_strand_def_init);
  LOAD(shx_friction_fit_def_init);
  LOAD(shx_friction_fit_report_init);
  LOAD(shx_solver_def_init);
  LOAD(shx_fit_friction);
  const double times[5] = {0.0, 0.02, 0.04, 0.06, 0.08}, spans[5] = {0.1, 0.09, 0.08, 0.09, 0.1};
  const double natural[2][3] = {{1, 20, 0}, {1, 20, 0}};
  shx_strand_def strand;
  shx_friction_fit_def friction;
  shx_friction_fit_report report;
  shx_solver_def solver;
  MUST(p_shx_strand_def_init(&strand, sizeof strand));
  strand.element_count = 2;
  strand.length = 0.1;
  strand.natural_curvatures = &natural[0][0];
  MUST(p_shx_friction_fit_def_init(&friction, sizeof friction));
  friction.coefficients = SHX_FRICTION_INTERNAL;
  friction.grid_points = 2;
  friction.max_iterations = 2;
  friction.time_step = 0.02;
  friction.oscillation_amplitude = 0.01;
  friction.oscillation_frequency = 5.0;
  MUST(p_shx_friction_fit_report_init(&report, sizeof report));
  for (uint32_t workers = 1; workers <= 2; workers++) {
    MUST(p_shx_solver_def_init(&solver, sizeof solver));
    solver.worker_count = workers;
    MUST(p_shx_fit_friction(&solver, &strand, &friction, times, spans, 5, &report, NULL));
  }
}

int main(int argc, char **argv) {
  if (argc != 2)
    return 2;
  for (int round = 0; round < 100; round++) {
    library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
    if (library == NULL || !mapped()) {
      fprintf(stderr, "%s\n", dlerror());
      return 1;
    }
    use(round % 4 == 1 ? 3 : 1, 1 + (uint32_t)(round / 4 % 4));
    if (round % 4 == 2) {
      fit();
      fit_many();
    }
    if (round % 4 == 3)
      fit_friction();
    if (dlclose(library) != 0 || mapped()) {
      fprintf(stderr, "round %d: the library is still mapped after dlclose\n", round);
      return 1;
    }
  }
  printf("loaded, used and unloaded 100 times\n");
  return 0;
}
