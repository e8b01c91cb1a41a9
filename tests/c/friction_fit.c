/* Fits the air drag to a pendulum recorded in a table time_s,offset_m,root_x_m,root_y_m,root_z_m, whose true value is known:
 *   friction_fit CURVE.csv TRUE_VALUE */
#include <math.h>
#include "expect.h"

enum { MOST = 1000 };

static double times[MOST], values[MOST], curve[MOST];
static shx_frame frames[MOST];

static size_t read_curve(const char *path) {
  FILE *file = fopen(path, "r");
  char header[200];
  size_t count = 0;
  EXPECT(file != NULL && fgets(header, sizeof header, file) != NULL && strncmp(header, "time_s,offset_m,", 16) == 0);
  while (count < MOST) {
    double *root = frames[count].origin;
    if (fscanf(file, "%lf,%lf,%lf,%lf,%lf", &times[count], &values[count], &root[0], &root[1], &root[2]) != 5)
      break;
    const double down[4] = {0.0, sqrt(0.5), 0.0, sqrt(0.5)}; /* x, the tangent, turned to -z */
    memcpy(frames[count].rotation, down, sizeof down);
    count++;
  }
  fclose(file);
  return count;
}

int main(int argc, char **argv) {
  EXPECT(argc == 3);
  const size_t count = read_curve(argv[1]);
  const double truth = atof(argv[2]);
  EXPECT(count > 100 && count < MOST && truth > 0.0);

  shx_strand_def strand;
  EXPECT(shx_strand_def_init(&strand, sizeof strand) == SHX_OK);
  strand.length = 0.2;
  strand.element_count = 2;
  strand.youngs_modulus = 1e9;
  strand.internal_friction = 2e-12;
  shx_friction_fit_def friction;
  EXPECT(shx_friction_fit_def_init(&friction, sizeof friction) == SHX_OK);
  friction.coefficients = SHX_FRICTION_AIR_DRAG;
  friction.observable = SHX_OBSERVABLE_OFFSET;
  friction.root_times = times;
  friction.root_frames = frames;
  friction.root_count = count;
  shx_friction_fit_report report;
  EXPECT(shx_friction_fit_report_init(&report, sizeof report) == SHX_OK);
  EXPECT(shx_fit_friction(NULL, &strand, &friction, times, values, count, &report, curve) == SHX_OK);

  const shx_fitted_coefficient drag = report.air_drag;
  EXPECT(report.struct_size == sizeof report && report.converged == 1 && report.unconverged == 0);
  EXPECT(drag.status == SHX_COEFFICIENT_DETERMINED && drag.standard_error < 0.01 * drag.value);
  EXPECT(fabs(drag.value - truth) < 3.0 * drag.standard_error && fabs(drag.step_sensitivity) < 1e-3);
  EXPECT(drag.excluded_below < truth && truth < drag.excluded_above);
  EXPECT(report.internal_friction.status == SHX_COEFFICIENT_NOT_FITTED && report.internal_friction.value == 2e-12);
  EXPECT(report.first_compared == 0 && report.compared == count && report.offset == 0.0);
  double square = 0.0;
  for (size_t i = 0; i < count; i++)
    square += (curve[i] - values[i]) * (curve[i] - values[i]);
  EXPECT(fabs(sqrt(square / (double)count) / report.rms_residual - 1.0) < 1e-9);

  /* A solver of one's own with threads of its own, a guess in place of the grid, half a second left out: the same within the errors. */
  shx_solver_def solver;
  EXPECT(shx_solver_def_init(&solver, sizeof solver) == SHX_OK);
  solver.worker_count = 2;
  friction.grid_points = 0;
  friction.air_drag_guess = 3e-6;
  friction.discard = 0.5;
  friction.fit_offset = 1;
  curve[count - 30] = 7.0;
  EXPECT(shx_fit_friction(&solver, &strand, &friction, times, values, count, &report, curve) == SHX_OK);
  EXPECT(report.first_compared == 30 && report.compared == count - 30 && curve[count - 30] == 7.0);
  EXPECT(fabs(report.air_drag.value - drag.value) < 3.0 * drag.standard_error && fabs(report.offset) < 1e-3);

  /* What moves nothing says nothing. */
  friction.coefficients = SHX_FRICTION_INTERNAL;
  friction.internal_friction_guess = 1e-10;
  friction.root_count = 0;
  EXPECT(shx_fit_friction(&solver, &strand, &friction, times, values, count, &report, NULL) == SHX_OK);
  EXPECT(report.internal_friction.status == SHX_COEFFICIENT_UNDETERMINED);
  printf("air drag %.3e +- %.1e kg/(m s), %u simulations\n", drag.value, drag.standard_error, (unsigned)report.simulations);
  return 0;
}
