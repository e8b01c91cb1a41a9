/* Bodies, contact and constraints from C: a strand lies on a sphere and on a mesh and its contacts bear what its root does not, a
 * comb's tooth pushes it, a pin carries it, a ring slides over it, an image goes on bit for bit, and what is removed is gone. */
#include <math.h>
#include "expect.h"

static const double H = 1.0 / 60;

static shx_frame at(double x, double y, double z) {
  const shx_frame frame = {{x, y, z}, {0, 0, 0, 1}};
  return frame;
}

static shx_body_def body(uint32_t shape) {
  shx_body_def def;
  EXPECT(shx_body_def_init(&def, sizeof def) == SHX_OK);
  EXPECT(def.friction_scale == 1.0 && def.mask == 0xffffffff && def.sides == SHX_SIDES_SOLID && def.normal[2] == 1.0);
  def.shape = shape;
  return def;
}

static shx_strand_id add_strand(shx_solver *solver, double z) {
  shx_strand_def def;
  shx_strand_id id;
  EXPECT(shx_strand_def_init(&def, sizeof def) == SHX_OK);
  def.length = 0.1;
  def.element_count = 5;
  def.viscosity = 0.05;
  def.air_drag = 2e-4;
  def.root.origin[2] = z;
  EXPECT(shx_solver_add_strands(solver, &def, sizeof def, 1, &id) == SHX_OK);
  return id;
}

static const double weight = 1300 * 3.14159265358979 * 50e-6 * 50e-6 * 0.1 * 9.81;

static double tip(const shx_solver *solver, shx_strand_id id, int axis) {
  const double end = 0.1;
  double point[3];
  const shx_output out = {point, 0, 1, SHX_FORMAT_F64X3, 0};
  EXPECT(shx_solver_sample_at(solver, id, &end, 1, NULL, &out, NULL, NULL) == SHX_OK);
  return point[axis];
}

static void steps(shx_solver *solver, int count, shx_step_report *report) {
  EXPECT(shx_step_report_init(report, sizeof *report) == SHX_OK);
  for (int i = 0; i < count; i++)
    EXPECT(shx_solver_step(solver, H, 1, report) == SHX_OK);
}

/* The strand rests on a body: what that bears is the weight but for the root's share, by contacts, by wrench, by root. */
static void rest(shx_solver *solver, shx_strand_id strand, shx_body_id id) {
  shx_step_report report;
  steps(solver, 240, &report);
  size_t count = 0, again = 77;
  EXPECT(shx_solver_contact_count(solver, &count) == SHX_OK && count > 0 && count == report.contacts && count < 64);
  struct { char note[12]; shx_contact contact; } list[64]; /* a stride, and any alignment */
  EXPECT(shx_solver_contacts(solver, &list[0].contact, sizeof list[0], 64, &again) == SHX_OK && again == count);
  double sum[3] = {0, 0, 0}, force[3], torque[3], root[3];
  for (size_t i = 0; i < count; i++) {
    const shx_contact *contact = &list[i].contact;
    EXPECT(contact->strand.bits == strand.bits && contact->partner == SHX_PARTNER_BODY && contact->body.bits == id.bits);
    EXPECT(contact->other_strand.bits == 0 && contact->arclength > 0 && contact->arclength <= 0.1);
    EXPECT(fabs(hypot(hypot(contact->normal[0], contact->normal[1]), contact->normal[2]) - 1) < 1e-12);
    EXPECT(contact->gap > -1e-5 && fabs(contact->position[2]) < 0.2);
    for (int axis = 0; axis < 3; axis++)
      sum[axis] += contact->force[axis];
  }
  const shx_output force_out = {force, 0, 1, SHX_FORMAT_F64X3, 0}, torque_out = {torque, 0, 1, SHX_FORMAT_F64X3, 0};
  const shx_output root_out = {root, 0, 1, SHX_FORMAT_F64X3, 0};
  EXPECT(shx_solver_body_wrenches(solver, &id, 1, &force_out, &torque_out) == SHX_OK);
  EXPECT(shx_solver_root_wrenches(solver, &strand, 1, &root_out, NULL) == SHX_OK);
  for (int axis = 0; axis < 3; axis++)
    EXPECT(fabs(sum[axis] + force[axis]) < 1e-15);
  /* What comes to rest by friction and drag has not quite: a thousandth of the weight. */
  EXPECT(sum[2] > 0.1 * weight && fabs(sum[2] - root[2] - weight) < 1e-3 * weight);
  EXPECT(report.max_penetration < 1e-5 && report.unconverged_islands == 0);
}

static const float roof_corners[6][3] = {{0, -0.05f, 0}, {0, 0.05f, 0}, {-0.02f, -0.05f, -0.03f}, {0.02f, -0.05f, -0.03f}, {-0.02f, 0.05f, -0.03f}, {0.02f, 0.05f, -0.03f}};

/* A mesh as a table: its top edge lies across the strand. */
static shx_body_def roof(void) {
  static const uint32_t triangles[8][3] = {{0, 3, 1}, {1, 3, 5}, {0, 1, 2}, {1, 4, 2}, {0, 2, 3}, {1, 5, 4}, {2, 4, 3}, {3, 4, 5}};
  const shx_input vertices = {roof_corners, 0, 6, SHX_FORMAT_F32X3, 0};
  shx_body_def def = body(SHX_SHAPE_MESH);
  def.vertices = vertices;
  def.triangles = &triangles[0][0];
  def.triangle_count = 8;
  def.pose = at(0.05, 0, -0.005);
  return def;
}

/* The same with contact at points: on a ball, and across the edge of a mesh. Surfaces give way there. */
static void at_points(void) {
  for (int edge = 0; edge < 2; edge++) {
    shx_solver *solver;
    EXPECT(shx_solver_create(NULL, &solver) == SHX_OK);
    const shx_strand_id strand = add_strand(solver, 0);
    shx_contact_options options;
    EXPECT(shx_contact_options_init(&options, sizeof options) == SHX_OK);
    options.model = SHX_CONTACT_AT_POINTS;
    EXPECT(shx_solver_set_contact_options(solver, &options) == SHX_OK);
    shx_strand_contact contact;
    EXPECT(shx_strand_contact_init(&contact, sizeof contact) == SHX_OK);
    EXPECT(shx_solver_set_strand_contact(solver, &strand, 1, &contact, 0) == SHX_OK);
    shx_body_def def = roof();
    shx_body_id id;
    if (!edge) {
      def = body(SHX_SHAPE_SPHERE);
      def.radius = 0.03;
      def.pose = at(0.05, 0, -0.032);
    }
    EXPECT(shx_solver_add_bodies(solver, &def, sizeof def, 1, &id) == SHX_OK);
    shx_step_report report;
    steps(solver, 240, &report);
    double force[3], torque[3], root[3];
    const shx_output force_out = {force, 0, 1, SHX_FORMAT_F64X3, 0}, torque_out = {torque, 0, 1, SHX_FORMAT_F64X3, 0};
    const shx_output root_out = {root, 0, 1, SHX_FORMAT_F64X3, 0};
    EXPECT(shx_solver_body_wrenches(solver, &id, 1, &force_out, &torque_out) == SHX_OK);
    EXPECT(shx_solver_root_wrenches(solver, &strand, 1, &root_out, NULL) == SHX_OK);
    /* An edge as sharp as this may enter the strand between two places, which are 3 mm apart, by half of that. */
    EXPECT(report.contacts > 0 && report.max_penetration < (edge ? 1.5e-3 : 5e-4));
    EXPECT(force[2] < -0.1 * weight && fabs(-force[2] - root[2] - weight) < 0.05 * weight);
    shx_solver_destroy(solver);
  }
}

static void bodies(void) {
  shx_solver *solver;
  EXPECT(shx_solver_create(NULL, &solver) == SHX_OK);
  const shx_strand_id strand = add_strand(solver, 0);
  shx_contact_options options;
  EXPECT(shx_contact_options_init(&options, sizeof options) == SHX_OK && options.model == SHX_CONTACT_COULOMB);
  options.model = 5; /* one more than there are */
  EXPECT(shx_solver_set_contact_options(solver, &options) == SHX_ERROR_INVALID_ARGUMENT);
  options.model = SHX_CONTACT_REGULARISED_PENALTY;
  EXPECT(shx_solver_set_contact_options(solver, &options) == SHX_OK);
  EXPECT(shx_solver_get_contact_options(solver, &options) == SHX_OK && options.model == SHX_CONTACT_REGULARISED_PENALTY);
  options.model = SHX_CONTACT_AT_POINTS;
  EXPECT(shx_solver_set_contact_options(solver, &options) == SHX_OK);
  EXPECT(shx_solver_get_contact_options(solver, &options) == SHX_OK && options.model == SHX_CONTACT_AT_POINTS);
  options.model = SHX_CONTACT_COULOMB;
  EXPECT(shx_solver_set_contact_options(solver, &options) == SHX_OK);
  memset(&options, 0, sizeof options);
  options.struct_size = sizeof options;
  EXPECT(shx_solver_get_contact_options(solver, &options) == SHX_OK && options.model == SHX_CONTACT_COULOMB && options.tolerance == 5e-5);

  shx_strand_contact contact, read;
  uint32_t touches = 9;
  EXPECT(shx_strand_contact_init(&contact, sizeof contact) == SHX_OK && shx_strand_contact_init(&read, sizeof read) == SHX_OK);
  EXPECT(shx_solver_get_strand_contact(solver, strand, &read, &touches) == SHX_OK && touches == 0);
  contact.friction_against = 0.4;
  EXPECT(shx_solver_set_strand_contact(solver, &strand, 1, &contact, 0) == SHX_OK);
  EXPECT(shx_solver_get_strand_contact(solver, strand, &read, &touches) == SHX_OK && touches == 1 && read.friction_against == 0.4);

  shx_body_def ball = body(SHX_SHAPE_SPHERE);
  shx_body_id id;
  ball.radius = 0.03;
  ball.pose = at(0.05, 0, -0.032);
  EXPECT(shx_solver_add_bodies(solver, &ball, sizeof ball, 1, &id) == SHX_OK && shx_solver_has_body(solver, id));
  rest(solver, strand, id);
  EXPECT(shx_solver_remove_bodies(solver, &id, 1) == SHX_OK && !shx_solver_has_body(solver, id));
  size_t count = 7;
  EXPECT(shx_solver_contact_count(solver, &count) == SHX_OK && count == 0);

  const shx_body_def table = roof();
  shx_strand_id again[1] = {strand};
  EXPECT(shx_solver_reset_strands(solver, again, 1) == SHX_OK);
  EXPECT(shx_solver_add_bodies(solver, &table, sizeof table, 1, &id) == SHX_OK);
  rest(solver, strand, id);

  /* It rises with what lies on it. */
  const double before = tip(solver, strand, 2);
  const shx_frame up = at(0.05, 0, 0.005);
  const shx_input frames = {&up, 0, 1, SHX_FORMAT_FRAME, 0};
  shx_step_report report;
  EXPECT(shx_solver_set_body_frames(solver, &id, 1, &frames, 0.2) == SHX_OK);
  steps(solver, 30, &report);
  shx_frame now;
  const shx_output frame_out = {&now, 0, 1, SHX_FORMAT_FRAME, 0};
  EXPECT(shx_solver_get_body_frames(solver, &id, 1, &frame_out) == SHX_OK && memcmp(&now, &up, sizeof now) == 0);
  EXPECT(tip(solver, strand, 2) > before + 0.01 && report.max_penetration < 1e-5);

  /* It deforms, its ridge a centimetre higher: the strand goes along. */
  float higher[6][3];
  memcpy(higher, roof_corners, sizeof higher);
  higher[0][2] = higher[1][2] = 0.01f;
  const shx_input new_vertices = {higher, 0, 6, SHX_FORMAT_F32X3, 0};
  const double low = tip(solver, strand, 2);
  EXPECT(shx_solver_set_body_vertices(solver, id, &new_vertices, 0.2) == SHX_OK);
  steps(solver, 30, &report);
  EXPECT(tip(solver, strand, 2) > low + 0.01 && report.max_penetration < 1e-5);

  /* A filter lets it through; so does a strand that touches nothing. */
  EXPECT(shx_solver_set_body_filter(solver, id, 2, 2) == SHX_OK);
  steps(solver, 120, &report);
  EXPECT(report.contacts == 0 && tip(solver, strand, 2) < -0.05);
  EXPECT(shx_solver_set_body_filter(solver, id, 1, 1) == SHX_OK && shx_solver_set_strand_contact(solver, &strand, 1, NULL, 0) == SHX_OK);
  steps(solver, 1, &report);
  EXPECT(report.contacts == 0);
  shx_solver_destroy(solver);
}

/* Bodies that share a mesh act alike and take its memory once; one that deforms leaves the others as they are. */
static void shared_shapes(void) {
  enum { SIDE = 60, VERTICES = SIDE * SIDE, TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1) };
  static double vertices[VERTICES][3];
  static uint32_t triangles[TRIANGLES][3];
  for (uint32_t k = 0, t = 0; k < VERTICES; k++) {
    const uint32_t x = k % SIDE, y = k / SIDE;
    vertices[k][0] = 0.005 * x - 0.15;
    vertices[k][1] = 0.005 * y - 0.15;
    if (x + 1 < SIDE && y + 1 < SIDE) {
      const uint32_t corner[2][3] = {{k, k + 1, k + SIDE}, {k + 1, k + SIDE + 1, k + SIDE}};
      memcpy(triangles[t], corner, sizeof corner);
      t += 2;
    }
  }
  shx_solver *solver;
  EXPECT(shx_solver_create(NULL, &solver) == SHX_OK);
  shx_body_def sheet = body(SHX_SHAPE_MESH);
  sheet.vertices = (shx_input){vertices, 0, VERTICES, SHX_FORMAT_F64X3, 0};
  sheet.triangles = &triangles[0][0];
  sheet.triangle_count = TRIANGLES;
  sheet.sides = SHX_SIDES_BOTH;
  sheet.pose = at(0, 0, -0.3);
  shx_body_id ids[3];
  uint64_t alone, shared, parted;
  EXPECT(shx_solver_add_bodies(solver, &sheet, sizeof sheet, 1, ids) == SHX_OK);
  EXPECT(shx_solver_memory_usage(solver, &alone) == SHX_OK);
  shx_body_def same[2] = {body(SHX_SHAPE_SHARED), body(SHX_SHAPE_SHARED)};
  for (int i = 0; i < 2; i++) {
    same[i].shape_of = ids[0];
    same[i].pose = at(1.0 * i, 0, -0.02);
  }
  EXPECT(shx_solver_add_bodies(solver, same, sizeof same[0], 2, ids + 1) == SHX_OK);
  EXPECT(shx_solver_memory_usage(solver, &shared) == SHX_OK && shared - alone < alone / 100);
  /* Removing the first takes the shape from nobody. */
  EXPECT(shx_solver_remove_bodies(solver, ids, 1) == SHX_OK);
  const shx_strand_id strand = add_strand(solver, 0);
  shx_strand_contact contact;
  EXPECT(shx_strand_contact_init(&contact, sizeof contact) == SHX_OK);
  EXPECT(shx_solver_set_strand_contact(solver, &strand, 1, &contact, sizeof contact) == SHX_OK);
  for (uint32_t k = 0; k < VERTICES; k++)
    vertices[k][2] = -0.1;
  EXPECT(shx_solver_set_body_vertices(solver, ids[2], &sheet.vertices, 0.0) == SHX_OK);
  shx_step_report report;
  steps(solver, 120, &report);
  EXPECT(report.contacts > 0 && tip(solver, strand, 2) > -0.021);
  EXPECT(shx_solver_memory_usage(solver, &parted) == SHX_OK && parted > alone + alone / 2);
  shx_solver_destroy(solver);
}

/* A grid that was baked is as good as the mesh within half a cell, also where a triangle is missing that nothing touches. */
static void grids(void) {
  const double corners[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}};
  const uint32_t triangles[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  double half[8][3];
  for (int i = 0; i < 24; i++)
    half[i / 3][i % 3] = 0.02 * corners[i / 3][i % 3];
  size_t size = 0, written = 0;
  shx_distance_grid_def baked;
  EXPECT(shx_distance_grid_def_init(&baked, sizeof baked) == SHX_OK && baked.triangle_count == 0 && baked.cell == 0 && baked.band == 0);
  baked.vertices = (shx_input){half, 0, 8, SHX_FORMAT_F64X3, 0};
  baked.triangles = &triangles[0][0];
  baked.triangle_count = 12;
  baked.cell = 0.002;
  baked.band = 0.006;
  EXPECT(shx_distance_grid_bake(&baked, NULL, 0, &size) == SHX_OK && size > 1000);
  void *image = malloc(size);
  EXPECT(image != NULL);
  EXPECT(shx_distance_grid_bake(&baked, image, size, &written) == SHX_OK && written == size);
  /* The same numbers of nodes, and one triangle of the lowest face less. Of half of the faces alone no inside is to be told. */
  void *open = malloc(size);
  EXPECT(open != NULL);
  baked.triangles = &triangles[1][0];
  baked.triangle_count = 11;
  EXPECT(shx_distance_grid_bake(&baked, open, size, &written) == SHX_OK && written == size);
  baked.triangles = &triangles[6][0];
  baked.triangle_count = 6;
  EXPECT(shx_distance_grid_bake(&baked, open, size, &written) == SHX_ERROR_INVALID_ARGUMENT);
  char text[512];
  EXPECT(shx_last_error(text, sizeof text) > 0 && strstr(text, "triangles is too open to have an inside") != NULL);
  double resting[3];
  for (int which = 0; which < 3; which++) {
    shx_solver *solver;
    EXPECT(shx_solver_create(NULL, &solver) == SHX_OK);
    const shx_strand_id strand = add_strand(solver, 0);
    shx_strand_contact contact;
    EXPECT(shx_strand_contact_init(&contact, sizeof contact) == SHX_OK);
    EXPECT(shx_solver_set_strand_contact(solver, &strand, 1, &contact, sizeof contact) == SHX_OK);
    shx_body_def def = body(which == 0 ? SHX_SHAPE_BOX : SHX_SHAPE_GRID);
    def.half_extents[0] = def.half_extents[1] = def.half_extents[2] = 0.02;
    def.grid = which == 1 ? image : open;
    def.grid_size = size;
    def.pose = at(0.08, 0, -0.03);
    shx_body_id id;
    EXPECT(shx_solver_add_bodies(solver, &def, sizeof def, 1, &id) == SHX_OK);
    shx_step_report report;
    steps(solver, 120, &report);
    EXPECT(report.contacts > 0);
    resting[which] = tip(solver, strand, 2);
    shx_solver_destroy(solver);
  }
  EXPECT(resting[0] > -0.02 && fabs(resting[0] - resting[1]) < 0.001 && fabs(resting[0] - resting[2]) < 0.001);
  free(image);
  free(open);
}

static void constraints(void) {
  shx_solver *solver;
  EXPECT(shx_solver_create(NULL, &solver) == SHX_OK);
  const shx_strand_id strands[3] = {add_strand(solver, 0), add_strand(solver, 0.1), add_strand(solver, 0.2)};
  shx_constraint_def defs[3];
  for (int i = 0; i < 3; i++) {
    EXPECT(shx_constraint_def_init(&defs[i], sizeof defs[i]) == SHX_OK);
    defs[i].strand = strands[i];
  }
  defs[0].arclength = 0.1;
  defs[0].target = at(0.08, 0, -0.01);
  defs[1].kind = SHX_CONSTRAINT_TIE;
  defs[1].arclength = 0.1;
  defs[1].other_strand = strands[0];
  defs[1].other_arclength = 0.05;
  defs[2].kind = SHX_CONSTRAINT_RING;
  defs[2].arclength = 0.06;
  defs[2].target = at(0.06, 0, 0.2);
  defs[2].friction_along = defs[2].friction_against = 0.05;
  shx_constraint_id ids[3];
  EXPECT(shx_solver_add_constraints(solver, defs, sizeof defs[0], 3, ids) == SHX_OK);
  shx_step_report report;
  steps(solver, 240, &report);
  EXPECT(report.max_constraint_error < 1e-9 && report.unconverged_islands == 0);
  shx_constraint_state states[3];
  EXPECT(shx_solver_constraint_states(solver, ids, 3, states, 0) == SHX_OK);
  EXPECT(states[0].status == SHX_CONSTRAINT_STATUS_SATISFIED && states[0].error < 1e-9 && states[0].arclength == 0.1);
  EXPECT(states[1].status == SHX_CONSTRAINT_STATUS_SATISFIED);
  /* Pin and roots carry the weights of the first two strands, which the tie joins. */
  double roots[3][3];
  const shx_output root_out = {roots, 0, 3, SHX_FORMAT_F64X3, 0};
  EXPECT(shx_solver_root_wrenches(solver, strands, 3, &root_out, NULL) == SHX_OK);
  EXPECT(fabs(states[0].force[2] - roots[0][2] - roots[1][2] - 2 * weight) < 1e-3 * weight);

  /* The ring moves off along the strand, which slips out of it. */
  const shx_frame away = at(0.12, 0, 0.17);
  const shx_input frames = {&away, 0, 1, SHX_FORMAT_FRAME, 0};
  EXPECT(states[2].status == SHX_CONSTRAINT_STATUS_SATISFIED);
  const double from = states[2].arclength;
  EXPECT(shx_solver_set_constraint_targets(solver, &ids[2], 1, &frames, 0.5) == SHX_OK);
  steps(solver, 6, &report);
  EXPECT(shx_solver_constraint_states(solver, &ids[2], 1, states, sizeof states[0]) == SHX_OK);
  EXPECT(states[0].status != SHX_CONSTRAINT_STATUS_RELEASED && states[0].arclength > from && states[0].error < 1e-7);
  steps(solver, 60, &report);
  EXPECT(shx_solver_constraint_states(solver, &ids[2], 1, states, 0) == SHX_OK && states[0].status == SHX_CONSTRAINT_STATUS_RELEASED);
  shx_frame target;
  const shx_output target_out = {&target, 0, 1, SHX_FORMAT_FRAME, 0};
  EXPECT(shx_solver_get_constraint_targets(solver, &ids[2], 1, &target_out) == SHX_OK && memcmp(&target, &away, sizeof away) == 0);

  /* A constraint goes with its strands; what is let go falls. */
  EXPECT(shx_solver_remove_strands(solver, &strands[1], 1) == SHX_OK && !shx_solver_has_constraint(solver, ids[1]));
  size_t count = 0;
  EXPECT(shx_solver_constraint_count(solver, &count) == SHX_OK && count == 2);
  EXPECT(shx_solver_constraint_ids(solver, ids, 3) == SHX_OK);
  EXPECT(shx_solver_remove_constraints(solver, ids, 2) == SHX_OK && !shx_solver_has_constraint(solver, ids[0]));
  steps(solver, 120, &report);
  EXPECT(tip(solver, strands[0], 2) < -0.05);
  shx_solver_destroy(solver);
}

/* Wisps of hair fall over a capsule that turns; the same from an image, on one thread or three. */
static void images(void) {
  uint64_t hashes[2];
  for (uint32_t workers = 1; workers <= 3; workers += 2) {
    shx_solver_def solver_def;
    EXPECT(shx_solver_def_init(&solver_def, sizeof solver_def) == SHX_OK);
    solver_def.worker_count = workers;
    shx_solver *solver;
    EXPECT(shx_solver_create(&solver_def, &solver) == SHX_OK);
    shx_contact_options options;
    EXPECT(shx_contact_options_init(&options, sizeof options) == SHX_OK);
    options.hair_contact = 1;
    options.model = SHX_CONTACT_PENALTY;
    EXPECT(shx_solver_set_contact_options(solver, &options) == SHX_OK);
    shx_strand_id strands[6];
    shx_strand_contact contacts[6];
    for (int i = 0; i < 6; i++) {
      strands[i] = add_strand(solver, 0.004 * i);
      EXPECT(shx_strand_contact_init(&contacts[i], sizeof contacts[i]) == SHX_OK);
      contacts[i].wisp_radius = 0.002 + 0.0001 * i;
      contacts[i].exempt_length = 0.01;
    }
    EXPECT(shx_solver_set_strand_contact(solver, strands, 6, contacts, sizeof contacts[0]) == SHX_OK);
    shx_body_def def = body(SHX_SHAPE_CAPSULE);
    def.radius = 0.005;
    def.a[1] = -0.05;
    def.b[1] = 0.05;
    def.pose = at(0.06, 0, -0.01);
    shx_body_id id;
    EXPECT(shx_solver_add_bodies(solver, &def, sizeof def, 1, &id) == SHX_OK);
    const shx_frame turned = {{0.06, 0.01, 0.0}, {0, 0, 0.6, 0.8}};
    const shx_input frames = {&turned, 0, 1, SHX_FORMAT_FRAME, 0};
    EXPECT(shx_solver_set_body_frames(solver, &id, 1, &frames, 1.0) == SHX_OK);
    shx_step_report report;
    steps(solver, 12, &report);
    size_t count = 0, size = 0, hair = 0;
    static shx_contact list[256];
    EXPECT(shx_solver_contacts(solver, list, 0, 256, &count) == SHX_OK);
    for (size_t i = 0; i < count; i++)
      hair += list[i].partner == SHX_PARTNER_STRAND && list[i].other_strand.bits != 0 && list[i].body.bits == 0;
    EXPECT(hair > 0 && hair < count);
    EXPECT(shx_solver_snapshot(solver, NULL, 0, &size) == SHX_OK);
    void *image = malloc(size);
    EXPECT(image != NULL && shx_solver_snapshot(solver, image, size, &size) == SHX_OK);
    steps(solver, 6, &report);
    const uint64_t first = state_hash(solver);
    EXPECT(shx_solver_restore(solver, image, size) == SHX_OK);
    steps(solver, 6, &report);
    EXPECT(state_hash(solver) == first);
    hashes[workers / 2] = first;
    free(image);
    shx_solver_destroy(solver);
  }
  EXPECT(hashes[0] == hashes[1]);
}

/* A strand that is drawn into a ball rests where that is allowed, and is pushed out where it is not. */
static void overlaps(void) {
  shx_solver *solver;
  shx_strand_contact contact;
  shx_body_id ball, in;
  shx_strand_id with;
  shx_step_report report;
  double depth = 0, hair = 7, along[8], shares[8], sunk[8];
  size_t stations = 0;
  EXPECT(shx_solver_create(NULL, &solver) == SHX_OK);
  const shx_strand_id strand = add_strand(solver, 0);
  shx_body_def def = body(SHX_SHAPE_SPHERE);
  def.radius = 0.02;
  def.pose = at(0.05, 0, -0.02 - 50e-6 + 1e-3);
  EXPECT(shx_solver_add_bodies(solver, &def, sizeof def, 1, &ball) == SHX_OK);
  EXPECT(shx_strand_contact_init(&contact, sizeof contact) == SHX_OK);
  EXPECT(shx_solver_set_strand_contact(solver, &strand, 1, &contact, 0) == SHX_OK);
  EXPECT(shx_solver_adopt_rest_shapes(solver, &strand, 1) == SHX_OK);
  EXPECT(shx_solver_overlaps(solver, &strand, 1, &hair, &with, &depth, &in) == SHX_OK);
  EXPECT(hair == 0 && with.bits == 0 && fabs(depth - 1e-3) < 1e-9 && in.bits == ball.bits);
  EXPECT(shx_solver_permit_overlaps(solver, &strand, 1) == SHX_OK);
  EXPECT(shx_solver_overlaps(solver, &strand, 1, NULL, NULL, &depth, NULL) == SHX_OK && depth < 1e-15);
  steps(solver, 60, &report);
  EXPECT(fabs(tip(solver, strand, 2)) < 1e-9 && report.contacts == 0);
  /* Kept by the host, taken away, given back. */
  EXPECT(shx_solver_get_permitted_overlap(solver, strand, along, shares, sunk, 5, &stations) == SHX_ERROR_BUFFER_TOO_SMALL);
  EXPECT(shx_solver_get_permitted_overlap(solver, strand, along, shares, sunk, 8, &stations) == SHX_OK && stations == 6);
  EXPECT(along[0] == 0 && fabs(along[5] - 0.1) < 1e-15 && shares[2] == 1 && fabs(sunk[2] - 1e-3) < 1e-9 && sunk[0] == 0);
  EXPECT(shx_solver_set_permitted_overlap(solver, strand, NULL, NULL, NULL, 0) == SHX_OK);
  EXPECT(shx_solver_get_permitted_overlap(solver, strand, NULL, NULL, NULL, 0, &stations) == SHX_OK && stations == 0);
  EXPECT(shx_solver_overlaps(solver, &strand, 1, NULL, NULL, &depth, NULL) == SHX_OK && fabs(depth - 1e-3) < 1e-9);
  EXPECT(shx_solver_set_permitted_overlap(solver, strand, along, shares, sunk, 6) == SHX_OK);
  EXPECT(shx_solver_overlaps(solver, &strand, 1, NULL, NULL, &depth, NULL) == SHX_OK && depth < 1e-15);
  EXPECT(shx_solver_set_permitted_overlap(solver, strand, NULL, NULL, NULL, 0) == SHX_OK);
  steps(solver, 60, &report);
  EXPECT(fabs(tip(solver, strand, 2)) > 1e-4);
  shx_solver_destroy(solver);
}

int main(void) {
  bodies();
  at_points();
  shared_shapes();
  grids();
  constraints();
  images();
  overlaps();
  printf("strands rest on bodies, are held, and slip out of rings\n");
  return 0;
}
