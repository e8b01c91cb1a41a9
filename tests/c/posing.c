/* Strands posed from C: dragged, brushed, cut, grown, mirrored, an element changed, given another material, and stiffened; any number of
 * threads gives the same bits. */
#include <math.h>
#include "expect.h"

static void tip_of(const shx_solver *solver, shx_strand_id id, double arclength, double tip[3]) {
  const shx_output point = {tip, 0, 1, SHX_FORMAT_F64X3, 0};
  EXPECT(shx_solver_sample_at(solver, id, &arclength, 1, NULL, &point, NULL, NULL) == SHX_OK);
}

static double apart(const double a[3], const double b[3]) { return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]); }

static uint64_t play(uint32_t threads) {
  shx_solver_def def;
  EXPECT(shx_solver_def_init(&def, sizeof def) == SHX_OK);
  def.worker_count = threads;
  shx_solver *solver;
  EXPECT(shx_solver_create(&def, &solver) == SHX_OK);
  shx_strand_id ids[SCENE_STRANDS], images[SCENE_STRANDS];
  add_scene(solver, ids);

  /* Each tip 1 cm to the side, the two elements at the root as they are. */
  double arclengths[SCENE_STRANDS], targets[SCENE_STRANDS][3], distances[SCENE_STRANDS], tip[3];
  uint8_t movable[SCENE_STRANDS][SCENE_ELEMENTS], touched[SCENE_STRANDS];
  for (int i = 0; i < SCENE_STRANDS; i++) {
    arclengths[i] = 0.1 + 0.002 * i;
    tip_of(solver, ids[i], arclengths[i], targets[i]);
    targets[i][1] += 0.01;
    for (int element = 0; element < SCENE_ELEMENTS; element++) movable[i][element] = element >= 2;
  }
  shx_pose_options options;
  EXPECT(shx_pose_options_init(&options, sizeof options) == SHX_OK);
  options.movable = &movable[0][0];
  options.movable_count = sizeof movable;
  double before[SCENE_ELEMENTS][3], after[SCENE_ELEMENTS][3];
  EXPECT(shx_solver_get_shapes(solver, &ids[7], 1, &before[0][0], SCENE_ELEMENTS) == SHX_OK);
  const shx_input to = {targets, 0, SCENE_STRANDS, SHX_FORMAT_F64X3, 0};
  EXPECT(shx_solver_drag_strands(solver, ids, SCENE_STRANDS, arclengths, &to, &options, distances) == SHX_OK);
  EXPECT(shx_solver_get_shapes(solver, &ids[7], 1, &after[0][0], SCENE_ELEMENTS) == SHX_OK);
  EXPECT(memcmp(before, after, sizeof before / 3) == 0 && memcmp(before, after, sizeof before) != 0);
  for (int i = 0; i < SCENE_STRANDS; i++) {
    tip_of(solver, ids[i], arclengths[i], tip);
    EXPECT(distances[i] < 1e-6 && apart(tip, targets[i]) < 1e-6);
  }

  shx_brush brush;
  EXPECT(shx_brush_init(&brush, sizeof brush) == SHX_OK);
  memcpy(brush.centre, targets[12], sizeof brush.centre);
  brush.radius = 0.015;
  brush.displacement[2] = 0.01;
  EXPECT(shx_solver_brush_strands(solver, ids, SCENE_STRANDS, &brush, NULL, touched, distances) == SHX_OK);
  EXPECT(touched[12] == 1 && touched[36] == 0 && distances[36] == 0);
  tip_of(solver, ids[12], arclengths[12], tip);
  EXPECT(tip[2] - targets[12][2] > 0.007);
  tip_of(solver, ids[36], arclengths[36], tip);
  EXPECT(apart(tip, targets[36]) < 1e-6);

  /* Images in the plane y = 0, and those cut to half and grown again. */
  const double point[3] = {0, 0, 0}, normal[3] = {0, 2, 0};
  EXPECT(shx_solver_mirror_strands(solver, ids, SCENE_STRANDS, point, normal, images) == SHX_OK);
  double middle[3], image[3];
  for (int i = 0; i < SCENE_STRANDS; i++) {
    arclengths[i] *= 0.5;
    tip_of(solver, ids[i], arclengths[i], middle);
    tip_of(solver, images[i], arclengths[i], image);
    middle[1] = -middle[1];
    EXPECT(apart(middle, image) < 1e-14);
  }
  EXPECT(shx_solver_cut_strands(solver, images, SCENE_STRANDS, arclengths) == SHX_OK);
  size_t count = 0;
  EXPECT(shx_solver_get_element_count(solver, images[0], &count) == SHX_OK && count == SCENE_ELEMENTS / 2);
  tip_of(solver, images[36], arclengths[36], middle);
  EXPECT(apart(middle, image) < 1e-12);
  EXPECT(shx_solver_grow_strands(solver, images, SCENE_STRANDS, 0.03, 2, NULL) == SHX_OK);
  EXPECT(shx_solver_get_element_count(solver, images[0], &count) == SHX_OK && count == SCENE_ELEMENTS / 2 + 2);

  shx_element_change change;
  EXPECT(shx_element_change_init(&change, sizeof change) == SHX_OK);
  change.element = 4;
  change.twist = 0.5;
  change.length_scale = 2;
  EXPECT(shx_solver_change_elements(solver, images, 1, &change, sizeof change) == SHX_OK);
  double lengths[SCENE_ELEMENTS];
  EXPECT(shx_solver_get_element_lengths(solver, images[0], lengths, SCENE_ELEMENTS) == SHX_OK && lengths[4] == 0.03);

  shx_material material, got;
  EXPECT(shx_material_init(&material, sizeof material) == SHX_OK && shx_material_init(&got, sizeof got) == SHX_OK);
  EXPECT(shx_solver_get_material(solver, ids[0], &got) == SHX_OK && got.air_drag == 5e-6);
  material.youngs_modulus = 4e9;
  EXPECT(shx_solver_set_materials(solver, ids, SCENE_STRANDS, &material, sizeof material, 1) == SHX_OK);
  EXPECT(shx_solver_get_material(solver, ids[3], &got) == SHX_OK && memcmp(&got, &material, sizeof got) == 0);

  /* Upright strands of limp hair, stiffened until they stand; the others are as they were. */
  shx_strand_def upright[2];
  shx_strand_id standing[2];
  double scales[2], eigenvalues[2];
  for (int i = 0; i < 2; i++) {
    EXPECT(shx_strand_def_init(&upright[i], sizeof upright[i]) == SHX_OK);
    upright[i].length = i == 0 ? 0.3 : 0.05;
    upright[i].element_count = 10;
    upright[i].root.rotation[1] = -sqrt(0.5);
    upright[i].root.rotation[3] = sqrt(0.5);
  }
  EXPECT(shx_solver_add_strands(solver, upright, sizeof upright[0], 2, standing) == SHX_OK);
  EXPECT(shx_solver_shape_stability(solver, standing, 2, 0.1, eigenvalues, scales, NULL) == SHX_OK);
  EXPECT(eigenvalues[0] < 0 && eigenvalues[1] > 0.1 && scales[0] > 1 && scales[1] == 1);
  const double youngs = scales[0];
  EXPECT(shx_solver_stiffen_strands(solver, standing, 2, SHX_STIFFEN_YOUNGS_MODULUS, 0.1, scales) == SHX_OK);
  EXPECT(scales[0] == youngs && scales[1] == 1);
  EXPECT(shx_solver_get_material(solver, standing[0], &got) == SHX_OK && got.youngs_modulus == upright[0].youngs_modulus * youngs);
  EXPECT(shx_solver_shape_stability(solver, standing, 2, 0.1, eigenvalues, NULL, NULL) == SHX_OK);
  EXPECT(fabs(eigenvalues[0] - 0.1) < 1e-6);
  EXPECT(shx_solver_stiffen_strands(solver, standing, 2, SHX_STIFFEN_RADIUS, 0.5, scales) == SHX_OK);
  EXPECT(scales[0] > 1 && shx_solver_get_material(solver, standing[0], &got) == SHX_OK);
  EXPECT(got.radius[0] == upright[0].radius[0] * scales[0] && got.radius[1] == upright[0].radius[1] * scales[0]);
  EXPECT(shx_solver_stiffen_strands(solver, standing, 2, SHX_STIFFEN_RADIUS, 0.5, NULL) == SHX_OK);
  EXPECT(shx_solver_remove_strands(solver, standing, 2) == SHX_OK);

  /* The pose is the rest: a step moves nothing. */
  EXPECT(shx_solver_adopt_rest_shapes(solver, ids, SCENE_STRANDS) == SHX_OK);
  tip_of(solver, ids[20], arclengths[20], tip);
  EXPECT(shx_solver_step(solver, 1.0 / 60, 1, NULL) == SHX_OK);
  tip_of(solver, ids[20], arclengths[20], middle);
  EXPECT(apart(tip, middle) < 1e-9);
  const uint64_t hash = state_hash(solver);
  shx_solver_destroy(solver);
  return hash;
}

int main(void) {
  const uint64_t hash = play(0);
  EXPECT(play(2) == hash && play(5) == hash);
  return 0;
}
