/* shx_solver_settle: cantilevers against tests/data/reference/physics.json (the exact answer for one element, the continuous rod for
 * forty), an upright strand that must fall, what the outputs say, and rest afterwards; shapes taken in the middle of a run. */
#include <math.h>
#include "expect.h"

static int loops = 0;

static void parallel_for(void *user, uint32_t count, uint32_t min_range, shx_range_fn function, void *task) {
  (void)user;
  (void)min_range;
  loops++;
  function(task, 0, count, 0);
}

/* 0.1 m, 50 um; Young's modulus such that rho S g L^3 / EI is gamma. */
static shx_strand_def rod(double gamma, uint32_t elements) {
  shx_strand_def def;
  EXPECT(shx_strand_def_init(&def, sizeof def) == SHX_OK);
  def.element_count = elements;
  def.length = 0.1;
  def.youngs_modulus = 4 * 1300 * 9.81 * 0.001 / (50e-6 * 50e-6 * gamma);
  return def;
}

static void tip_of(const shx_solver *solver, shx_strand_id id, double tip[3]) {
  const double end = 0.1;
  const shx_output points = {tip, 0, 1, SHX_FORMAT_F64X3, 0};
  EXPECT(shx_solver_sample_at(solver, id, &end, 1, NULL, &points, NULL, NULL) == SHX_OK);
  for (int axis = 0; axis < 3; axis++)
    tip[axis] /= 0.1;
}

/* Shapes taken as they are in the middle of a run: natural, or rested in; how much stiffer an upright strand would have to be. */
static void shapes_taken(void) {
  shx_solver *solver;
  EXPECT(shx_solver_create(NULL, &solver) == SHX_OK);
  shx_strand_def strands[2] = {rod(10, 4), rod(20, 20)};
  const double half = sqrt(0.5), upright[4] = {0, -half, 0, half};
  memcpy(strands[1].root.rotation, upright, sizeof upright);
  shx_strand_id ids[2];
  EXPECT(shx_solver_add_strands(solver, strands, sizeof strands[0], 2, ids) == SHX_OK);
  double eigenvalues[2], youngs[2], radii[2];
  EXPECT(shx_solver_shape_stability(solver, ids, 2, 0, eigenvalues, youngs, radii) == SHX_OK);
  EXPECT(eigenvalues[0] > 0.1 && youngs[0] == 1 && radii[0] == 1);
  EXPECT(eigenvalues[1] < 0 && fabs(youngs[1] * 7.837347 / 20 - 1) < 3e-3); /* Greenhill; twenty elements are 1e-3 off */
  EXPECT(fabs(radii[1] * radii[1] - youngs[1]) < 1e-12);
  EXPECT(shx_solver_shape_stability(solver, ids, 2, 0.5, NULL, NULL, NULL) == SHX_OK);

  for (int step = 0; step < 6; step++)
    EXPECT(shx_solver_step(solver, 1.0 / 60, 1, NULL) == SHX_OK);
  double taken[24][3], later[24][3], natural[4][3], rates[4][3];
  EXPECT(shx_solver_get_shapes(solver, ids, 2, &taken[0][0], 24) == SHX_OK);
  EXPECT(fabs(taken[0][1]) + fabs(taken[0][2]) > 0.1);
  EXPECT(shx_solver_adopt_rest_shapes(solver, ids, 1) == SHX_OK);
  EXPECT(shx_solver_get_curvatures(solver, ids[0], NULL, &rates[0][0], 4) == SHX_OK);
  EXPECT(fabs(rates[0][1]) + fabs(rates[0][2]) > 0.1); /* it goes on to move */
  EXPECT(shx_solver_set_shapes(solver, ids, 2, &taken[0][0], 24) == SHX_OK);
  for (int step = 0; step < 60; step++)
    EXPECT(shx_solver_step(solver, 1.0 / 60, 1, NULL) == SHX_OK);
  EXPECT(shx_solver_get_shapes(solver, ids, 2, &later[0][0], 24) == SHX_OK);
  for (int element = 0; element < 4; element++)
    for (int axis = 0; axis < 3; axis++)
      EXPECT(fabs(later[element][axis] - taken[element][axis]) < 1e-6);

  EXPECT(shx_solver_adopt_natural_shapes(solver, ids, 2) == SHX_OK);
  EXPECT(shx_solver_get_natural_curvatures(solver, ids[0], &natural[0][0], 4) == SHX_OK);
  EXPECT(memcmp(natural, later, sizeof natural) == 0);
  EXPECT(shx_solver_adopt_natural_shapes(solver, NULL, 0) == SHX_OK && shx_solver_get_shapes(solver, NULL, 0, NULL, 0) == SHX_OK);
  shx_solver_destroy(solver);
}

int main(void) {
  shx_solver_def def;
  EXPECT(shx_solver_def_init(&def, sizeof def) == SHX_OK);
  def.parallel_for = parallel_for;
  def.quadrature_tolerance = 1e-12; /* one element is held to its exact answer */
  shx_solver *solver;
  EXPECT(shx_solver_create(&def, &solver) == SHX_OK);

  shx_strand_def strands[3] = {rod(10, 1), rod(10, 40), rod(20, 10)};
  const double half = sqrt(0.5);
  const double upright[4] = {0, -half, 0, half}; /* x to z */
  memcpy(strands[2].root.rotation, upright, sizeof upright);
  shx_strand_id ids[3];
  EXPECT(shx_solver_add_strands(solver, strands, sizeof strands[0], 3, ids) == SHX_OK);

  /* Without the eigenvalue the upright strand stays where symmetry holds it. */
  shx_settle_def settle;
  shx_settle_report report;
  shx_strand_status status[3];
  double eigenvalues[3], residuals[3], tip[3];
  EXPECT(shx_settle_def_init(&settle, sizeof settle) == SHX_OK);
  EXPECT(shx_settle_report_init(&report, sizeof report) == SHX_OK);
  settle.check_stability = 0;
  EXPECT(shx_solver_settle(solver, ids, 3, &settle, &report, status, eigenvalues, residuals) == SHX_OK);
  EXPECT(report.unconverged == 0 && report.unstable == 0 && report.saddles == 0 && isnan(report.smallest_eigenvalue));
  EXPECT(status[2] == SHX_OK && isnan(eigenvalues[2]) && residuals[2] <= settle.tolerance);
  tip_of(solver, ids[2], tip);
  EXPECT(fabs(tip[2] - 1) < 1e-9);

  /* With it, it is left. */
  EXPECT(shx_solver_settle(solver, ids, 3, NULL, &report, status, eigenvalues, residuals) == SHX_OK);
  EXPECT(report.struct_size == sizeof report && report.unconverged == 0 && report.unstable == 0 && report.saddles >= 1);
  EXPECT(report.iterations > 0 && report.max_residual <= 1e-10 && report.seconds > 0);
  double smallest = INFINITY;
  for (int i = 0; i < 3; i++) {
    /* The fallen strand may turn about the vertical for nothing: 0 within rounding. */
    EXPECT(status[i] == SHX_OK && eigenvalues[i] > (i == 2 ? -1e-9 : 0.1) && residuals[i] <= 1e-10);
    smallest = fmin(smallest, eigenvalues[i]);
  }
  EXPECT(report.smallest_eigenvalue == smallest);
  tip_of(solver, ids[2], tip);
  EXPECT(tip[2] < 0.1);

  /* The reference: one element has an exact answer, forty are 1.2e-4 L from the continuous rod. */
  tip_of(solver, ids[0], tip);
  EXPECT(fabs(tip[0] - 0.7477875297) < 1e-9 && fabs(tip[1]) < 1e-12 && fabs(tip[2] + 0.5578279213) < 1e-9);
  tip_of(solver, ids[1], tip);
  EXPECT(hypot(tip[0] - 0.6563537612, tip[2] + 0.7001997155) < 2e-4);

  /* What has settled rests, and hangs its weight on its root. */
  double before[3], force[3], torque[3];
  tip_of(solver, ids[2], before);
  EXPECT(loops == 2); /* on the host's tasks */
  loops = 0;
  for (int step = 0; step < 30; step++)
    EXPECT(shx_solver_step(solver, 1.0 / 60, 1, NULL) == SHX_OK);
  EXPECT(loops == 30);
  tip_of(solver, ids[2], tip);
  EXPECT(fabs(tip[0] - before[0]) < 1e-6 && fabs(tip[1] - before[1]) < 1e-6 && fabs(tip[2] - before[2]) < 1e-6);
  const shx_output force_out = {force, 0, 1, SHX_FORMAT_F64X3, 0}, torque_out = {torque, 0, 1, SHX_FORMAT_F64X3, 0};
  EXPECT(shx_solver_root_wrenches(solver, &ids[2], 1, &force_out, &torque_out) == SHX_OK);
  const double weight = 1300 * 3.14159265358979 * 50e-6 * 50e-6 * 0.1 * 9.81;
  EXPECT(fabs(force[2] / weight + 1) < 1e-6);

  /* One step of a search is not enough, and it says so. */
  settle.check_stability = 1;
  settle.max_steps = 1;
  EXPECT(shx_solver_reset_strands(solver, ids, 3) == SHX_OK);
  EXPECT(shx_solver_settle(solver, &ids[1], 1, &settle, &report, status, eigenvalues, residuals) == SHX_OK);
  EXPECT(report.unconverged == 1 && status[0] == SHX_STRAND_UNCONVERGED && residuals[0] > settle.tolerance);
  EXPECT(shx_solver_strand_status(solver, &ids[1], 1, status) == SHX_OK && status[0] == SHX_STRAND_UNCONVERGED);
  EXPECT(shx_solver_settle(solver, NULL, 0, NULL, &report, NULL, NULL, NULL) == SHX_OK && report.iterations == 0);
  shx_solver_destroy(solver);
  shapes_taken();
  printf("cantilevers lie where theory has them; an upright strand falls; shapes taken stay\n");
  return 0;
}
