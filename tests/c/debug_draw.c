/* shx_solver_debug_draw and shx_solver_set_wind_field through the C interface: batches, layers, the host's space, what is refused, re-entry. */
#include <math.h>
#include "expect.h"

typedef struct drawing {
  shx_solver *solver;
  size_t lines, points, largest, batches;
  uint32_t layers;
  double lowest, highest, first[3];
  shx_result changing, reading;
} drawing;

static void add(drawing *d, const shx_debug_vertex *vertices, size_t count) {
  if (d->lines + d->points == 0)
    memcpy(d->first, vertices[0].position, sizeof d->first);
  d->batches++;
  if (count > d->largest)
    d->largest = count;
  for (size_t i = 0; i < count; i++) {
    d->layers |= vertices[i].layer;
    d->lowest = fmin(d->lowest, vertices[i].position[2]);
    d->highest = fmax(d->highest, vertices[i].position[2]);
    EXPECT(vertices[i].color <= 0xffffff);
  }
}

static void lines(void *user, const shx_debug_vertex *vertices, size_t count) {
  drawing *d = user;
  EXPECT(count % 2 == 0);
  add(d, vertices, count);
  d->lines += count / 2;
  size_t strands = 0;
  d->reading = shx_solver_strand_count(d->solver, &strands);
  d->changing = shx_solver_step(d->solver, 0.01, 1, NULL);
}

static void points(void *user, const shx_debug_vertex *vertices, size_t count) {
  drawing *d = user;
  add(d, vertices, count);
  d->points += count;
}

static drawing drawn(shx_solver *solver, shx_debug_draw_def def) {
  drawing d = {solver, 0, 0, 0, 0, 0, INFINITY, -INFINITY, {0, 0, 0}, SHX_OK, SHX_OK};
  def.lines = lines;
  def.points = points;
  def.user = &d;
  EXPECT(shx_solver_debug_draw(solver, &def) == SHX_OK);
  return d;
}

static void debug_draw(void) {
  shx_solver *solver;
  shx_strand_id ids[SCENE_STRANDS];
  EXPECT(shx_solver_create(NULL, &solver) == SHX_OK);
  add_scene(solver, ids);
  add_obstacles(solver, ids);
  run_scene(solver, ids);
  const uint64_t hash = state_hash(solver);
  shx_debug_draw_def def;
  EXPECT(shx_debug_draw_def_init(&def, sizeof def) == SHX_OK);
  EXPECT(def.layers == (SHX_DEBUG_CENTRELINES | SHX_DEBUG_CONTACTS | SHX_DEBUG_BODIES) && def.points_per_strand == 17);

  def.layers = SHX_DEBUG_CENTRELINES;
  def.points_per_strand = 33;
  drawing d = drawn(solver, def);
  EXPECT(d.lines == SCENE_STRANDS * 32 && d.points == 0 && d.layers == SHX_DEBUG_CENTRELINES);
  EXPECT(d.largest <= 1024 && d.batches == (SCENE_STRANDS * 64 + 1023) / 1024);
  EXPECT(d.reading == SHX_OK && d.changing == SHX_ERROR_BUSY);
  /* Centimetres, z down. */
  const double lowest = d.lowest, highest = d.highest, start = d.first[0];
  def.x_axis[0] = def.y_axis[1] = 100;
  def.z_axis[2] = -100;
  def.translation[0] = 7;
  def.origin[0] = 0.02;
  d = drawn(solver, def);
  EXPECT(fabs(d.lowest + 100 * highest) < 1e-9 && fabs(d.highest + 100 * lowest) < 1e-9);
  EXPECT(fabs(d.first[0] - (100 * (start - 0.02) + 7)) < 1e-9);

  EXPECT(shx_debug_draw_def_init(&def, sizeof def) == SHX_OK);
  def.layers = SHX_DEBUG_CONTACTS | SHX_DEBUG_CONSTRAINTS;
  d = drawn(solver, def);
  size_t contacts = 0;
  EXPECT(shx_solver_contact_count(solver, &contacts) == SHX_OK && contacts > 0);
  EXPECT(d.points == contacts + 1 && d.lines >= 2 * contacts && d.layers == def.layers);
  def.layers = 63;
  d = drawn(solver, def);
  EXPECT(d.layers == (63 & ~(uint32_t)SHX_DEBUG_CENTRELINES)); /* islands in their place */
  EXPECT(state_hash(solver) == hash);

  EXPECT(shx_solver_debug_draw(solver, &def) == SHX_ERROR_NULL_ARGUMENT);
  def.lines = lines;
  def.user = &d;
  def.layers = 64;
  EXPECT(shx_solver_debug_draw(solver, &def) == SHX_ERROR_INVALID_ARGUMENT);
  EXPECT(shx_solver_debug_draw(solver, NULL) == SHX_ERROR_NULL_ARGUMENT);
  shx_solver_destroy(solver);
}

typedef struct wind {
  shx_solver *solver;
  size_t points, calls;
  double velocity[3], latest;
  shx_result again;
} wind;

static void field(void *user, double seconds, const double *positions, double *velocities, size_t count) {
  wind *w = user;
  w->calls++;
  w->points += count;
  w->latest = seconds;
  w->again = shx_solver_step(w->solver, 0.01, 1, NULL);
  for (size_t i = 0; i < count; i++) {
    EXPECT(isfinite(positions[3 * i]) && velocities[3 * i] == 0);
    memcpy(velocities + 3 * i, w->velocity, sizeof w->velocity);
  }
}

static void wind_field(void) {
  const double velocity[3] = {1.0, -2.0, 0.5}, calm[3] = {0, 0, 0};
  uint64_t hashes[2];
  for (int by_field = 0; by_field <= 1; by_field++) {
    shx_solver *solver;
    shx_strand_id ids[SCENE_STRANDS];
    EXPECT(shx_solver_create(NULL, &solver) == SHX_OK);
    add_scene(solver, ids);
    wind w = {solver, 0, 0, {velocity[0], velocity[1], velocity[2]}, 0, SHX_OK};
    if (by_field)
      EXPECT(shx_solver_set_wind_field(solver, field, &w) == SHX_OK);
    else
      EXPECT(shx_solver_set_wind(solver, velocity) == SHX_OK);
    EXPECT(shx_solver_step(solver, 0.04, 4, NULL) == SHX_OK);
    EXPECT(!by_field || (w.points >= 4 * SCENE_STRANDS * SCENE_ELEMENTS * 3 && w.again == SHX_ERROR_BUSY && fabs(w.latest - 0.04) < 1e-12));
    /* Removed, it is not called. */
    const size_t calls = w.calls;
    EXPECT(shx_solver_set_wind(solver, calm) == SHX_OK);
    EXPECT(shx_solver_set_wind_field(solver, NULL, NULL) == SHX_OK);
    EXPECT(shx_solver_step(solver, 0.04, 4, NULL) == SHX_OK);
    EXPECT(w.calls == calls);
    hashes[by_field] = state_hash(solver);
    shx_solver_destroy(solver);
  }
  EXPECT(hashes[0] == hashes[1]);
  EXPECT(shx_solver_set_wind_field(NULL, field, NULL) == SHX_ERROR_NULL_ARGUMENT);
}

int main(void) {
  debug_draw();
  wind_field();
  return 0;
}
