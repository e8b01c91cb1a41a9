/* Guides are placed on a scalp, fitted to drawn curves, brushed and made to rest as they are; then the head turns, and many render
 * strands follow them into a cache with velocities: render [CACHE.usda], by default render.usda. */
#include <math.h>
#include "check.h"

enum { SIDE = 13, VERTICES = SIDE * SIDE, TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1) };
enum { GUIDES = 48, DRAWN = 12, ELEMENTS = 10, HAIRS = 1200, POINTS = 12, FRAMES = 12 };
static const double RADIUS = 0.09, LENGTH = 0.12, RATE = 24.0; /* frames a second */

static double vertices[VERTICES][3], drawn[GUIDES][DRAWN][3], lengths[GUIDES][ELEMENTS], shapes[GUIDES][ELEMENTS][3];
static uint32_t triangles[TRIANGLES][3], drawn_counts[GUIDES], hair_counts[HAIRS];
static shx_follicle guide_places[GUIDES], hair_places[HAIRS];
static shx_frame guide_roots[GUIDES], hair_roots[HAIRS];
static shx_strand_id ids[GUIDES];
static float points[HAIRS][POINTS][3], velocities[HAIRS][POINTS][3];

/* The host's own arrays as calls see them. */
#define IN(array, count, format) (&(const shx_input){array, 0, count, format, 0})
#define OUT(array, count, format) (&(const shx_output){array, 0, count, format, 0})

/* The scalp, the top of a sphere, turned about the vertical. */
static void set_head(double turn) {
  for (int i = 0; i < VERTICES; i++) {
    const double x = 0.1 * (i % SIDE) / (SIDE - 1) - 0.05, y = 0.1 * (i / SIDE) / (SIDE - 1) - 0.05;
    vertices[i][0] = x * cos(turn) - y * sin(turn);
    vertices[i][1] = x * sin(turn) + y * cos(turn);
    vertices[i][2] = sqrt(RADIUS * RADIUS - x * x - y * y);
  }
}

/* Roots on the current scalp. */
static void follow(const shx_scalp *scalp, const shx_follicle *places, size_t count, shx_frame *roots) {
  CHECK(shx_scalp_root_frames(scalp, IN(vertices, VERTICES, SHX_FORMAT_F64X3), places, count, OUT(roots, count, SHX_FORMAT_FRAME)));
}

static shx_scalp *make_scalp(void) {
  set_head(0.0);
  for (uint32_t i = 0; i < TRIANGLES; i++) { /* two for each square of the mesh */
    const uint32_t corner = i / 2 % (SIDE - 1) + SIDE * (i / 2 / (SIDE - 1));
    triangles[i][0] = corner;
    triangles[i][1] = i % 2 == 0 ? corner + 1 : corner + SIDE + 1;
    triangles[i][2] = i % 2 == 0 ? corner + SIDE + 1 : corner + SIDE;
  }
  shx_scalp_def def;
  CHECK(shx_scalp_def_init(&def, sizeof def));
  def.vertices = *IN(vertices, VERTICES, SHX_FORMAT_F64X3);
  def.triangles = &triangles[0][0];
  def.triangle_count = TRIANGLES;
  shx_scalp *scalp;
  CHECK(shx_scalp_create(&def, &scalp));
  size_t made;
  shx_scatter_def scatter;
  CHECK(shx_scatter_def_init(&scatter, sizeof scatter));
  scatter.count = GUIDES;
  CHECK(shx_scalp_scatter(scalp, &scatter, guide_places, GUIDES, &made, NULL));
  scatter.count = HAIRS;
  CHECK(shx_scalp_scatter(scalp, &scatter, hair_places, HAIRS, &made, NULL));
  follow(scalp, guide_places, GUIDES, guide_roots);
  follow(scalp, hair_places, HAIRS, hair_roots);
  return scalp;
}

/* Curves as an artist might draw them, and strands for all of them at once; one side brushed; all made to rest as they are, stably. */
static void add_guides(shx_solver *solver) {
  for (int i = 0; i < GUIDES; i++) {
    drawn_counts[i] = DRAWN;
    for (int k = 0; k < 3 * DRAWN; k++) {
      const double s = LENGTH * (k / 3) / (DRAWN - 1), aside[3] = {6.0 * s * s, 0.0, -3.0 * s * s};
      drawn[i][k / 3][k % 3] = guide_roots[i].origin[k % 3] * (1.0 + (s - 3.0 * s * s) / RADIUS) + aside[k % 3];
    }
  }
  shx_fit_input curves;
  CHECK(shx_fit_input_init(&curves, sizeof curves));
  curves.curve_count = GUIDES;
  curves.points = *IN(drawn, GUIDES * DRAWN, SHX_FORMAT_F64X3);
  curves.point_counts = drawn_counts;
  curves.roots = *IN(guide_roots, GUIDES, SHX_FORMAT_FRAME);
  shx_fitted_strand fitted[GUIDES];
  CHECK(shx_fit_strands(NULL, &curves, fitted, 0, &lengths[0][0], &shapes[0][0][0], GUIDES * ELEMENTS));
  shx_strand_def defs[GUIDES];
  for (int i = 0; i < GUIDES; i++) {
    CHECK(shx_strand_def_init(&defs[i], sizeof defs[i]));
    CHECK(shx_strand_def_set_fit(&defs[i], &fitted[i], lengths[i], &shapes[i][0][0]));
    defs[i].air_drag = 2e-5;
  }
  CHECK(shx_solver_add_strands(solver, defs, sizeof defs[0], GUIDES, ids));

  shx_brush brush;
  CHECK(shx_brush_init(&brush, sizeof brush));
  brush.centre[0] = brush.centre[2] = 0.1;
  brush.radius = brush.displacement[1] = 0.05;
  CHECK(shx_solver_brush_strands(solver, ids, GUIDES, &brush, NULL, NULL, NULL));
  CHECK(shx_solver_stiffen_strands(solver, ids, GUIDES, SHX_STIFFEN_YOUNGS_MODULUS, 0.05, NULL));
}

int main(int argc, char **argv) {
  shx_solver *solver;
  CHECK(shx_solver_create(NULL, &solver));
  shx_scalp *scalp = make_scalp();
  add_guides(solver);

  /* The map from guides to render strands, made once while the guides rest, and the pose, set each frame. */
  shx_render_settings settings;
  CHECK(shx_render_settings_init(&settings, sizeof settings));
  settings.points_per_strand = POINTS;
  shx_render_view view;
  CHECK(shx_render_view_init(&view, sizeof view));
  view.roots = *IN(hair_roots, HAIRS, SHX_FORMAT_FRAME);
  shx_render_hair *hair;
  shx_render_pose *pose;
  CHECK(shx_solver_create_render_hair(solver, ids, GUIDES, &settings, &view.roots, &hair));
  CHECK(shx_render_pose_create(hair, &pose));

  shx_curve_data first;
  CHECK(shx_curve_data_init(&first, sizeof first));
  for (int i = 0; i < HAIRS; i++) hair_counts[i] = POINTS;
  first.strand_count = HAIRS;
  first.point_counts = hair_counts;
  first.points = *IN(points, HAIRS * POINTS, SHX_FORMAT_F32X3);
  first.velocities = *IN(velocities, HAIRS * POINTS, SHX_FORMAT_F32X3);
  first.metres_per_unit = 1.0;
  first.up_axis = SHX_UP_AXIS_Z;
  shx_curve_cache_writer *cache;
  CHECK(shx_curve_cache_writer_create(argc > 1 ? argv[1] : "render.usda", &first, RATE, &cache));
  for (int frame = 0; frame <= FRAMES; frame++) {
    set_head(0.6 * (1.0 - cos(6.0 * frame / RATE)));
    follow(scalp, guide_places, GUIDES, guide_roots);
    follow(scalp, hair_places, HAIRS, hair_roots);
    if (frame > 0) {
      CHECK(shx_solver_set_root_frames(solver, ids, GUIDES, IN(guide_roots, GUIDES, SHX_FORMAT_FRAME), 1.0 / RATE));
      CHECK(shx_solver_step(solver, 1.0 / RATE, 2, NULL));
    }
    CHECK(shx_solver_set_render_pose(solver, ids, GUIDES, 1, pose));
    CHECK(shx_render_pose_evaluate(pose, &view, OUT(points, HAIRS * POINTS, SHX_FORMAT_F32X3), NULL,
                                   OUT(velocities, HAIRS * POINTS, SHX_FORMAT_F32X3)));
    CHECK(shx_curve_cache_writer_write(cache, frame / RATE, &first.points, &first.velocities));
  }
  CHECK(shx_curve_cache_writer_finish(cache));
  printf("%d frames of %d strands from %d guides\n", FRAMES + 1, HAIRS, GUIDES);
  shx_render_pose_destroy(pose);
  shx_render_hair_destroy(hair);
  shx_scalp_destroy(scalp);
  shx_solver_destroy(solver);
  return EXIT_SUCCESS;
}
