/* superhelix_inline.h against the library: inputs and outputs, settings, generated hair, frames. C99 and C++17. */
#include "superhelix_inline.h"
#include "expect.h"

static int near_frame(const shx_frame *a, const shx_frame *b) {
  double dot = 0, worst = 0;
  for (int k = 0; k < 4; k++)
    dot += a->rotation[k] * b->rotation[k];
  for (int k = 0; k < 3; k++)
    worst = fmax(worst, fabs(a->origin[k] - b->origin[k]));
  return worst < 1e-12 && fabs(fabs(dot) - 1) < 1e-12;
}

/* A strand on a head that moves: where an attachment takes it. */
static void frames(void) {
  const shx_frame before = {{0.1, -0.2, 0.3}, {0.5, 0.5, -0.5, 0.5}}, after = {{-1, 2, 0.5}, {0.36, 0.48, 0, 0.8}};
  const shx_frame root = {{0.2, 0.1, 0.4}, {0, 0.6, 0, 0.8}};
  shx_solver *solver;
  shx_strand_def def;
  shx_strand_id id;
  shx_attachment *attachment;
  EXPECT(shx_solver_create(NULL, &solver) == SHX_OK);
  EXPECT(shx_strand_def_init(&def, sizeof def) == SHX_OK);
  def.length = 0.1;
  def.element_count = 3;
  def.root = root;
  EXPECT(shx_solver_add_strands(solver, &def, sizeof def, 1, &id) == SHX_OK);
  EXPECT(shx_attachment_create(solver, &before, &id, 1, NULL, 0, NULL, 0, &attachment) == SHX_OK);
  EXPECT(shx_attachment_teleport(attachment, solver, &after) == SHX_OK);
  shx_frame moved;
  const shx_output place = shx_make_output(&moved, 1, SHX_FORMAT_FRAME);
  EXPECT(shx_solver_get_root_frames(solver, &id, 1, &place) == SHX_OK);
  const shx_frame back = shx_frame_inverse(&before);
  const shx_frame local = shx_frame_compose(&back, &root);
  const shx_frame expected = shx_frame_compose(&after, &local);
  EXPECT(near_frame(&moved, &expected) && !near_frame(&moved, &root));
  const shx_frame none = shx_frame_compose(&back, &before), world = {{0, 0, 0}, {0, 0, 0, 1}};
  EXPECT(near_frame(&none, &world));
  /* An input that the library takes. */
  const shx_input roots = shx_make_input(&root, 1, SHX_FORMAT_FRAME);
  EXPECT(shx_solver_teleport_roots(solver, &id, 1, &roots) == SHX_OK);
  EXPECT(shx_solver_get_root_frames(solver, &id, 1, &place) == SHX_OK && near_frame(&moved, &root));
  shx_attachment_destroy(attachment);
  shx_solver_destroy(solver);
}

static void settings(void) {
  shx_settings chosen;
  shx_solver_def def;
  shx_solver *solver;
  shx_solver_options options;
  EXPECT(shx_settings_init(&chosen, sizeof chosen) == SHX_OK);
  EXPECT(shx_settings_suggest(0.02, 10, 0.2, 1.0 / 30, &chosen) == SHX_OK);
  EXPECT(shx_solver_def_init(&def, sizeof def) == SHX_OK);
  shx_apply_settings(&chosen, &def);
  EXPECT(shx_solver_create(&def, &solver) == SHX_OK);
  EXPECT(shx_solver_options_init(&options, sizeof options) == SHX_OK);
  EXPECT(shx_solver_get_options(solver, &options) == SHX_OK);
  EXPECT(options.integrator == chosen.integrator && options.max_iterations == chosen.max_iterations);
  EXPECT(options.max_subdivisions == chosen.max_subdivisions && options.tolerance == chosen.tolerance);
  EXPECT(options.error_tolerance == chosen.error_tolerance && options.quadrature_tolerance == chosen.quadrature_tolerance);
  shx_solver_destroy(solver);
}

static void hair(void) {
  shx_hair_type type;
  shx_hair_strands_def def;
  shx_hair_strand strand;
  shx_strand_def made;
  shx_strand_contact contact;
  const uint32_t count = 4;
  const double lengths[4] = {0.05, 0.05, 0.05, 0.05};
  double curvatures[4][3];
  EXPECT(shx_hair_type_init(&type, sizeof type) == SHX_OK);
  EXPECT(shx_hair_type_from_name("african", &type) == SHX_OK);
  EXPECT(shx_hair_strands_def_init(&def, sizeof def) == SHX_OK);
  def.hair_type = &type;
  def.strand_count = 1;
  def.element_counts = &count;
  def.element_lengths = lengths;
  EXPECT(shx_hair_strands(&def, &strand, 0, &curvatures[0][0], 4) == SHX_OK);
  EXPECT(shx_strand_def_init(&made, sizeof made) == SHX_OK);
  shx_apply_hair_strand(&strand, &made);
  EXPECT(made.radius[1] == strand.radius[1] && made.density == strand.density && made.youngs_modulus == strand.youngs_modulus);
  EXPECT(made.poisson_ratio == strand.poisson_ratio && made.internal_friction == strand.internal_friction);
  EXPECT(made.viscosity == strand.viscosity && made.air_drag == strand.air_drag && made.air_drag > 0);
  /* Turned about its tangent, x. */
  EXPECT(fabs(2 * atan2(made.root.rotation[0], made.root.rotation[3]) - strand.root_turn) < 1e-12);
  EXPECT(made.root.rotation[1] == 0 && made.root.rotation[2] == 0);
  EXPECT(shx_strand_contact_init(&contact, sizeof contact) == SHX_OK);
  shx_apply_hair_friction(&strand, &contact);
  EXPECT(contact.friction_along == strand.friction_along && contact.hair_friction_against == strand.friction_against);
}

int main(void) {
  frames();
  settings();
  hair();
  return 0;
}
