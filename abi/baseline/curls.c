/* The four hair types of "Super-Helices for Predicting the Dynamics of Natural Hair" (Bertails et al. 2006, appendix B) side by
 * side: released from their natural shape, they settle under gravity; then the head moves sideways and back.
 *
 *   curls [FILE.obj]        the end shape is written to FILE.obj (default curls.obj) */
#include <math.h>
#include "check.h"

#define PI 3.14159265358979323846
enum { TYPES = 4, ELEMENTS = 40, POINTS = 200, FRAMES_PER_SECOND = 60 };

typedef struct hair_type {
  const char *name;
  double radius;         /* mean of the section, m */
  double ellipticity;    /* largest over smallest semi-axis */
  double helix_radius;   /* r_h, m; 0: straight */
  double helix_pitch;     /* m */
  double youngs_modulus; /* Pa */
  double air_drag;       /* kg/(m s): more for fuzzy hair */
} hair_type;

static const hair_type hair_types[TYPES] = {
    {"Asian, smooth", 50e-6, 1.0, 0.0, 0.0, 1.0e9, 5e-6},
    {"Caucasian 1, wavy", 35e-6, 1.1, 0.01, 0.005, 2.0e9, 5e-6},
    {"Caucasian 2, curly", 50e-6, 1.1, 0.006, 0.005, 1.5e9, 1e-5},
    {"African, fuzzy", 50e-6, 1.2, 0.001, 0.01, 0.5e9, 5e-5},
};

/* The root of a type: 6 cm apart, the strand leaves downwards. A quarter turn about y takes x to -z. */
static shx_frame root_of(int type, double sideways) {
  const shx_frame frame = {{0.06 * type, sideways, 0.0}, {0.0, sqrt(0.5), 0.0, sqrt(0.5)}};
  return frame;
}

static void describe(const hair_type *type, int index, double natural[ELEMENTS][3], shx_strand_def *def) {
  CHECK(shx_strand_def_init(def, sizeof *def));
  def->length = 0.2;
  def->element_count = ELEMENTS;
  def->radius[0] = type->radius * sqrt(type->ellipticity);
  def->radius[1] = type->radius / sqrt(type->ellipticity);
  def->youngs_modulus = type->youngs_modulus;
  def->poisson_ratio = 0.48;
  def->internal_friction = 1e-10;
  def->air_drag = type->air_drag;
  def->root = root_of(index, 0.0);
  /* Section 4.2: curvature 1 / r_h, twist step / (2 pi r_h^2). */
  const double r = type->helix_radius;
  for (int element = 0; element < ELEMENTS; element++) {
    natural[element][0] = r > 0.0 ? type->helix_pitch / (2.0 * PI * r * r) : 0.0;
    natural[element][1] = r > 0.0 ? 1.0 / r : 0.0;
    natural[element][2] = 0.0;
  }
  def->natural_curvatures = &natural[0][0];
}

int main(int argc, char **argv) {
  const char *path = argc > 1 ? argv[1] : "curls.obj";

  shx_solver *solver;
  CHECK(shx_solver_create(NULL, &solver));
  static double natural[TYPES][ELEMENTS][3];
  shx_strand_def defs[TYPES];
  shx_strand_id ids[TYPES];
  for (int type = 0; type < TYPES; type++)
    describe(&hair_types[type], type, natural[type], &defs[type]);
  CHECK(shx_solver_add_strands(solver, defs, sizeof defs[0], TYPES, ids));

  printf("A head that sways 5 cm at 1 Hz; heights of the tips below the roots, cm\n%8s", "time, s");
  for (int type = 0; type < TYPES; type++)
    printf("  %20s", hair_types[type].name);
  printf("  iterations\n");

  shx_sample_def sampling;
  CHECK(shx_sample_def_init(&sampling, sizeof sampling));
  sampling.points_per_strand = POINTS;
  static float points[TYPES][POINTS][3];
  const shx_output output = {points, 0, TYPES * POINTS, SHX_FORMAT_F32X3, 0};
  shx_step_report report;
  CHECK(shx_step_report_init(&report, sizeof report));
  for (int frame = 1; frame <= 3 * FRAMES_PER_SECOND; frame++) {
    const double time = (double)frame / FRAMES_PER_SECOND;
    shx_frame roots[TYPES];
    for (int type = 0; type < TYPES; type++)
      roots[type] = root_of(type, time > 1.0 ? 0.05 * sin(2.0 * PI * (time - 1.0)) : 0.0);
    const shx_input input = {roots, 0, TYPES, SHX_FORMAT_FRAME, 0};
    CHECK(shx_solver_set_root_frames(solver, ids, TYPES, &input, 1.0 / FRAMES_PER_SECOND));
    CHECK(shx_solver_step(solver, 1.0 / FRAMES_PER_SECOND, 1, &report));
    if (frame % (FRAMES_PER_SECOND / 2) != 0)
      continue;
    CHECK(shx_solver_sample_strands(solver, ids, TYPES, &sampling, &output, NULL, NULL));
    printf("%8.2f", time);
    for (int type = 0; type < TYPES; type++)
      printf("  %20.2f", -100.0 * points[type][POINTS - 1][2]);
    printf("  %10.2f\n", report.mean_iterations);
  }

  const shx_input drawn = {points, 0, TYPES * POINTS, SHX_FORMAT_F32X3, 0};
  const uint32_t counts[TYPES] = {POINTS, POINTS, POINTS, POINTS};
  CHECK(shx_curves_write_points(path, &drawn, counts, TYPES));
  printf("%s: the strands at the end\n", path);
  shx_solver_destroy(solver);
  return EXIT_SUCCESS;
}
