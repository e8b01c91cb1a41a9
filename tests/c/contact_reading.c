/* What can be read of contact and constraints, and filters and friction that are each strand's and each body's own: wrenches against the
 * contact list, constraint forces and torques against statics, sets of constraints that decide the same twice or contradict each other. */
#include <math.h>
#include "expect.h"

static const double H = 1.0 / 60;
static const double GRAVITY = 9.81;

static shx_frame at(double x, double y, double z) {
  const shx_frame frame = {{x, y, z}, {0, 0, 0, 1}};
  return frame;
}

static shx_strand_def limp(double x, double y, double z) {
  shx_strand_def def;
  EXPECT(shx_strand_def_init(&def, sizeof def) == SHX_OK);
  def.length = 0.1;
  def.element_count = 5;
  def.viscosity = 0.05;
  def.air_drag = 2e-4;
  def.root.origin[0] = x;
  def.root.origin[1] = y;
  def.root.origin[2] = z;
  return def;
}

static shx_strand_id add(shx_solver *solver, const shx_strand_def *def) {
  shx_strand_id id;
  EXPECT(shx_solver_add_strands(solver, def, sizeof *def, 1, &id) == SHX_OK);
  return id;
}

static double weight_of(const shx_strand_def *def) {
  return def->density * 3.14159265358979323846 * def->radius[0] * def->radius[1] * def->length * GRAVITY;
}

static void point_at(const shx_solver *solver, shx_strand_id id, double arclength, double *point) {
  const shx_output out = {point, 0, 1, SHX_FORMAT_F64X3, 0};
  EXPECT(shx_solver_sample_at(solver, id, &arclength, 1, NULL, &out, NULL, NULL) == SHX_OK);
}

static void steps(shx_solver *solver, int count, shx_step_report *report) {
  EXPECT(shx_step_report_init(report, sizeof *report) == SHX_OK);
  for (int i = 0; i < count; i++)
    EXPECT(shx_solver_step(solver, H, 1, report) == SHX_OK);
}

static void add_cross(double *sum, const double *arm, const double *force) {
  sum[0] += arm[1] * force[2] - arm[2] * force[1];
  sum[1] += arm[2] * force[0] - arm[0] * force[2];
  sum[2] += arm[0] * force[1] - arm[1] * force[0];
}

static double norm(const double *v) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

static double apart(const double *a, const double *b) {
  const double way[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return norm(way);
}

/* A wisp across another, a ball under the far end of each: what each body bears is the sum over its own contacts, force and torque about its
 * origin; of strands each contact tells the partner's place, at the far side of the gap. */
static void wrenches(void) {
  shx_solver *solver;
  EXPECT(shx_solver_create(NULL, &solver) == SHX_OK);
  shx_contact_options options;
  EXPECT(shx_contact_options_init(&options, sizeof options) == SHX_OK);
  options.model = SHX_CONTACT_COULOMB;
  options.hair_contact = 1;
  EXPECT(shx_solver_set_contact_options(solver, &options) == SHX_OK);
  shx_strand_def below = limp(0, 0, 0), above = limp(0.03, -0.05, 0.01);
  /* The second lies across the first: its tangent is y. */
  above.root.rotation[2] = above.root.rotation[3] = sqrt(0.5);
  const shx_strand_id strands[2] = {add(solver, &below), add(solver, &above)};
  shx_strand_contact contact;
  EXPECT(shx_strand_contact_init(&contact, sizeof contact) == SHX_OK);
  contact.wisp_radius = 2e-3;
  EXPECT(shx_solver_set_strand_contact(solver, strands, 2, &contact, 0) == SHX_OK);
  shx_body_def balls[2];
  shx_body_id ids[2];
  for (int i = 0; i < 2; i++) {
    EXPECT(shx_body_def_init(&balls[i], sizeof balls[i]) == SHX_OK);
    balls[i].shape = SHX_SHAPE_SPHERE;
    balls[i].radius = 0.02;
    balls[i].pose = i == 0 ? at(0.031, 0.03, -0.03) : at(0.08, 0.001, -0.025);
  }
  EXPECT(shx_solver_add_bodies(solver, balls, sizeof balls[0], 2, ids) == SHX_OK);
  shx_step_report report;
  steps(solver, 180, &report);
  static shx_contact list[64];
  size_t count = 0, of_body[2] = {0, 0}, of_hair = 0;
  EXPECT(shx_solver_contacts(solver, list, sizeof list[0], 64, &count) == SHX_OK && count <= 64);
  double force[2][3], torque[2][3], sum[2][3] = {{0}}, moment[2][3] = {{0}};
  for (size_t i = 0; i < count; i++) {
    const shx_contact *touch = &list[i];
    double here[3];
    point_at(solver, touch->strand, touch->arclength, here);
    EXPECT(apart(here, touch->position) < 1e-9);
    if (touch->partner == SHX_PARTNER_BODY) {
      const int which = touch->body.bits == ids[1].bits;
      EXPECT(touch->body.bits == ids[which].bits && touch->other_strand.bits == 0);
      double surface[3], arm[3], reaction[3];
      for (int axis = 0; axis < 3; axis++) {
        surface[axis] = touch->position[axis] - touch->normal[axis] * (touch->gap + contact.radius);
        arm[axis] = surface[axis] - balls[which].pose.origin[axis];
        reaction[axis] = -touch->force[axis];
        sum[which][axis] += reaction[axis];
      }
      /* The surface is where the normal begins. */
      EXPECT(fabs(norm(arm) - balls[which].radius) < 1e-6);
      add_cross(moment[which], arm, reaction);
      of_body[which]++;
    } else {
      double other[3];
      EXPECT(touch->partner == SHX_PARTNER_STRAND && touch->body.bits == 0);
      EXPECT(touch->strand.bits == strands[0].bits && touch->other_strand.bits == strands[1].bits);
      point_at(solver, touch->other_strand, touch->other_arclength, other);
      for (int axis = 0; axis < 3; axis++)
        other[axis] += touch->normal[axis] * (touch->gap + 2 * contact.wisp_radius);
      EXPECT(apart(other, touch->position) < 1e-6);
      of_hair++;
    }
  }
  EXPECT(of_body[0] > 0 && of_body[1] > 0 && of_hair > 0);
  const shx_output force_out = {force, 0, 2, SHX_FORMAT_F64X3, 0}, torque_out = {torque, 0, 2, SHX_FORMAT_F64X3, 0};
  EXPECT(shx_solver_body_wrenches(solver, ids, 2, &force_out, &torque_out) == SHX_OK);
  for (int i = 0; i < 2; i++) {
    EXPECT(norm(force[i]) > 1e-2 * weight_of(&below) && norm(torque[i]) > 0);
    EXPECT(apart(force[i], sum[i]) < 1e-12 * norm(force[i]));
    /* The arms above are a micrometre uncertain: a curved surface's point is where it was looked at last. */
    EXPECT(apart(torque[i], moment[i]) < 2e-6 * norm(force[i]));
  }
  shx_solver_destroy(solver);
}

/* A strand between its follicle and a clamp: what both bear is the weight, force and torque. */
static void forces_and_torques(void) {
  shx_solver *solver;
  EXPECT(shx_solver_create(NULL, &solver) == SHX_OK);
  shx_strand_def def = limp(0, 0, 0);
  def.element_count = 10;
  const shx_strand_id strand = add(solver, &def);
  shx_constraint_def clamp;
  EXPECT(shx_constraint_def_init(&clamp, sizeof clamp) == SHX_OK);
  clamp.kind = SHX_CONSTRAINT_FRAME;
  clamp.strand = strand;
  clamp.arclength = 0.1;
  /* Turned by 60 degrees about y and 20 about x, so that it twists and bends. */
  const double a = 30 * 3.14159265358979 / 180, b = 10 * 3.14159265358979 / 180;
  const shx_frame target = {{0.07, 0.01, -0.02}, {cos(a) * sin(b), sin(a) * cos(b), -sin(a) * sin(b), cos(a) * cos(b)}};
  clamp.target = target;
  shx_constraint_id id;
  EXPECT(shx_solver_add_constraints(solver, &clamp, sizeof clamp, 1, &id) == SHX_OK);
  shx_step_report report;
  steps(solver, 600, &report);
  shx_constraint_state state;
  EXPECT(shx_solver_constraint_states(solver, &id, 1, &state, sizeof state) == SHX_OK);
  EXPECT(state.status == SHX_CONSTRAINT_STATUS_SATISFIED && state.error < 1e-9);
  double force[3], torque[3], middle[3] = {0, 0, 0}, point[3];
  const shx_output force_out = {force, 0, 1, SHX_FORMAT_F64X3, 0}, torque_out = {torque, 0, 1, SHX_FORMAT_F64X3, 0};
  EXPECT(shx_solver_root_wrenches(solver, &strand, 1, &force_out, &torque_out) == SHX_OK);
  const double weight = weight_of(&def);
  for (int k = 0; k < 1000; k++) {
    point_at(solver, strand, 1e-4 * (k + 0.5), point);
    for (int axis = 0; axis < 3; axis++)
      middle[axis] += point[axis] / 1000;
  }
  /* On the strand: weight at its middle, the clamp's force at its tip and its torque; the follicle bears their sum. */
  double balance[3] = {-force[0] + state.force[0], -force[1] + state.force[1], -force[2] + state.force[2] - weight};
  const double down[3] = {0, 0, -weight};
  double moment[3] = {state.torque[0] - torque[0], state.torque[1] - torque[1], state.torque[2] - torque[2]};
  add_cross(moment, middle, down);
  add_cross(moment, target.origin, state.force);
  EXPECT(norm(state.force) > weight && norm(state.torque) > 1e-2 * weight * 0.1);
  EXPECT(norm(balance) < 1e-6 * norm(state.force));
  EXPECT(norm(moment) < 1e-6 * norm(state.force) * 0.1);
  shx_solver_destroy(solver);
}

/* Sets that decide the same twice, and sets that contradict each other, are told apart, and from such as hold. */
static void over_determined(void) {
  shx_solver *solver;
  EXPECT(shx_solver_create(NULL, &solver) == SHX_OK);
  shx_strand_id strands[5];
  for (int i = 0; i < 5; i++) {
    shx_strand_def def = limp(0, 0.02 * i, 0);
    strands[i] = add(solver, &def);
  }
  enum { COUNT = 9 };
  shx_constraint_def defs[COUNT];
  for (int i = 0; i < COUNT; i++)
    EXPECT(shx_constraint_def_init(&defs[i], sizeof defs[i]) == SHX_OK);
  const struct { int strand; double arclength; double x, y, z; } pins[6] = {
    {0, 0.1, 0.08, 0, -0.01}, {0, 0.1, 0.08, 0, -0.01},       /* twice the same */
    {1, 0.1, 0.08, 0.02, -0.01}, {1, 0.1, 0.08, 0.02, -0.02}, /* at two places at once */
    {2, 0.1, 0.08, 0.04, -0.01}, {2, 0.05, 0.045, 0.04, -0.01},  /* two points of a strand: both may hold */
  };
  for (int i = 0; i < 6; i++) {
    defs[i].strand = strands[pins[i].strand];
    defs[i].arclength = pins[i].arclength;
    defs[i].target = at(pins[i].x, pins[i].y, pins[i].z);
  }
  /* A tie, and two pins that hold its ends where the tie has them: the tie is decided. */
  defs[6].kind = SHX_CONSTRAINT_TIE;
  defs[6].strand = strands[3];
  defs[6].arclength = 0.1;
  defs[6].other_strand = strands[4];
  defs[6].other_arclength = 0.1;
  for (int i = 7; i < COUNT; i++) {
    defs[i].strand = strands[i - 4];
    defs[i].arclength = 0.1;
    defs[i].target = at(0.08, 0.07, -0.01);
  }
  shx_constraint_id ids[COUNT];
  EXPECT(shx_solver_add_constraints(solver, defs, sizeof defs[0], COUNT, ids) == SHX_OK);
  shx_step_report report;
  steps(solver, 60, &report);
  shx_constraint_state states[COUNT];
  EXPECT(shx_solver_constraint_states(solver, ids, COUNT, states, sizeof states[0]) == SHX_OK);
  int dependent = 0;
  for (int i = 0; i < COUNT; i++) {
    dependent += (i < 2 || i > 5) && states[i].status == SHX_CONSTRAINT_STATUS_REDUNDANT;
    EXPECT((states[i].status == SHX_CONSTRAINT_STATUS_VIOLATED) == (states[i].error > 1e-8));
    EXPECT(isfinite(norm(states[i].force)) && isfinite(norm(states[i].torque)));
  }
  for (int i = 0; i < 2; i++)
    EXPECT(states[i].status != SHX_CONSTRAINT_STATUS_VIOLATED && states[i].error < 1e-9);
  EXPECT(states[0].status == SHX_CONSTRAINT_STATUS_REDUNDANT || states[1].status == SHX_CONSTRAINT_STATUS_REDUNDANT);
  /* Between the two places, one centimetre apart, no point is nearer than half of it to both. */
  EXPECT(states[2].status == SHX_CONSTRAINT_STATUS_VIOLATED || states[3].status == SHX_CONSTRAINT_STATUS_VIOLATED);
  EXPECT(fmax(states[2].error, states[3].error) > 0.005 - 1e-6 && fmax(states[2].error, states[3].error) < 0.0101);
  EXPECT(states[4].status == SHX_CONSTRAINT_STATUS_SATISFIED && states[5].status == SHX_CONSTRAINT_STATUS_SATISFIED);
  /* Three times three directions hold six coordinates: one of the three constraints is decided by the others. */
  EXPECT(dependent >= 2);
  for (int i = 6; i < COUNT; i++)
    EXPECT(states[i].status != SHX_CONSTRAINT_STATUS_VIOLATED && states[i].error < 1e-9);
  EXPECT(report.max_constraint_error > 0.005 - 1e-6 && report.unconverged_islands > 0);
  shx_solver_destroy(solver);
}

/* One slope, four strands across it: friction is the strand's times the body's, and each slides as its own says; a strand of another
 * group falls through; strands of groups that do not meet pass through each other, of such as do they do not. */
static void filters_and_friction(void) {
  const double slope = 0.3;
  shx_solver_def def;
  EXPECT(shx_solver_def_init(&def, sizeof def) == SHX_OK);
  def.gravity[1] = GRAVITY * sin(slope);
  def.gravity[2] = -GRAVITY * cos(slope);
  shx_solver *solver;
  EXPECT(shx_solver_create(&def, &solver) == SHX_OK);
  shx_strand_id strands[5];
  shx_strand_contact contacts[5];
  for (int i = 0; i < 5; i++) {
    shx_strand_def strand = limp(i < 2 || i == 4 ? 0.0 : 0.5, 0.1 * i, 50e-6);
    strand.youngs_modulus = 1e6;
    strand.viscosity = 0;
    strand.air_drag = 0;
    strands[i] = add(solver, &strand);
    EXPECT(shx_strand_contact_init(&contacts[i], sizeof contacts[i]) == SHX_OK);
    /* tan 0.3 is 0.309. On the first floor, of friction 1: below and above; on the second, of friction 2: above and below, twice. */
    const double friction[5] = {0.25, 0.35, 0.25, 0.125, 0.35};
    contacts[i].friction_along = contacts[i].friction_against = friction[i];
  }
  contacts[4].groups = contacts[4].mask = 4;
  EXPECT(shx_solver_set_strand_contact(solver, strands, 5, contacts, sizeof contacts[0]) == SHX_OK);
  shx_body_def floors[2];
  shx_body_id ids[2];
  for (int i = 0; i < 2; i++) {
    EXPECT(shx_body_def_init(&floors[i], sizeof floors[i]) == SHX_OK);
    floors[i].shape = SHX_SHAPE_BOX;
    floors[i].half_extents[0] = 0.2;
    floors[i].half_extents[1] = 1;
    floors[i].half_extents[2] = 0.1;
    floors[i].pose = at(0.5 * i, 0, -0.1);
    floors[i].friction_scale = 1 + i;
    floors[i].groups = floors[i].mask = 1;
  }
  EXPECT(shx_solver_add_bodies(solver, floors, sizeof floors[0], 2, ids) == SHX_OK);
  double before[5][3], after[5][3];
  for (int i = 0; i < 5; i++)
    point_at(solver, strands[i], 0.1, before[i]);
  shx_step_report report;
  steps(solver, 90, &report);
  for (int i = 0; i < 5; i++)
    point_at(solver, strands[i], 0.1, after[i]);
  const int slides[4] = {1, 0, 0, 1};
  for (int i = 0; i < 4; i++)
    EXPECT(slides[i] ? after[i][1] - before[i][1] > 5e-3 : fabs(after[i][1] - before[i][1]) < 1e-5);
  EXPECT(after[4][2] < -0.05);
  shx_solver_destroy(solver);

  for (int meet = 0; meet < 2; meet++) {
    EXPECT(shx_solver_create(NULL, &solver) == SHX_OK);
    shx_contact_options options;
    EXPECT(shx_contact_options_init(&options, sizeof options) == SHX_OK);
    options.hair_contact = 1;
    EXPECT(shx_solver_set_contact_options(solver, &options) == SHX_OK);
    shx_strand_def held = limp(0, 0, 0), falling = limp(0.05, -0.05, 0.01);
    held.youngs_modulus = 1e11;
    falling.youngs_modulus = 1e7;
    falling.root.rotation[2] = falling.root.rotation[3] = sqrt(0.5);
    const shx_strand_id pair[2] = {add(solver, &held), add(solver, &falling)};
    /* Each is in a group of its own; the first lets the second's in, the second the first's or not. */
    for (uint32_t i = 0; i < 2; i++) {
      EXPECT(shx_strand_contact_init(&contacts[i], sizeof contacts[i]) == SHX_OK);
      contacts[i].wisp_radius = 1e-3;
      contacts[i].groups = 1u << i;
      contacts[i].mask = i == 0 ? 3 : (meet ? 1 : 2);
    }
    EXPECT(shx_solver_set_strand_contact(solver, pair, 2, contacts, sizeof contacts[0]) == SHX_OK);
    int touched = 0;
    for (int step = 0; step < 60; step++) {
      steps(solver, 1, &report);
      touched += report.contacts > 0;
    }
    double low[3];
    point_at(solver, pair[1], 0.1, low);
    EXPECT(meet ? touched > 10 : touched == 0);
    EXPECT(low[2] < -0.03);
    shx_solver_destroy(solver);
  }
}

int main(void) {
  wrenches();
  forces_and_torques();
  over_determined();
  filters_and_friction();
  printf("wrenches, constraint forces and dependent constraints are what statics says\n");
  return 0;
}
