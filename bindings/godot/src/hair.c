#include "hair.h"

#include <stdlib.h>
#include <string.h>

#include "comb.h"

enum { DRAWN = 40 }; /* points of a combed curve */
static const double GRID_CELL = 0.005, GRID_BAND = 0.03; /* m */

/* Returns from the function with the result of a call that fails. */
#define TRY(call)                       \
  do {                                  \
    const shx_result tried = (call);    \
    if (tried != SHX_OK) return tried;  \
  } while (0)

void hair_options_init(hair_options *options) {
  const hair_options defaults = {300, 20000, 12, 10, 2, 0.225, 0.005, 0.015, 0.0, 0.45};
  *options = defaults;
}

void hair_free(hair *h) {
  shx_attachment_destroy(h->attachment);
  shx_render_pose_destroy(h->pose);
  shx_render_hair_destroy(h->render);
  shx_solver_destroy(h->solver);
  free(h->ids);
  memset(h, 0, sizeof *h);
}

/* ---- growing ---------------------------------------------------------------------------------------------------------- */

/* What growing needs, and the hair does not keep. */
typedef struct nursery {
  shx_scalp *scalp;
  shx_follicle *follicles;
  shx_frame *roots;
  double *curves, *lengths, *shapes;
  uint32_t *counts;
  shx_fitted_strand *fitted;
  shx_strand_def *defs;
  void *grid;
} nursery;

static void nursery_free(nursery *n) {
  shx_scalp_destroy(n->scalp);
  free(n->follicles);
  free(n->roots);
  free(n->curves);
  free(n->lengths);
  free(n->shapes);
  free(n->counts);
  free(n->fitted);
  free(n->defs);
  free(n->grid);
}

static void *room(size_t count, size_t size) { return calloc(count > 0 ? count : 1, size); }

static shx_result nursery_make(nursery *n, const hair_options *o) {
  const size_t most = o->guides > o->hairs ? o->guides : o->hairs, elements = o->guides * o->elements;
  n->follicles = room(most, sizeof *n->follicles);
  n->roots = room(most, sizeof *n->roots);
  n->curves = room(o->guides * DRAWN, 3 * sizeof *n->curves);
  n->counts = room(o->guides, sizeof *n->counts);
  n->fitted = room(o->guides, sizeof *n->fitted);
  n->lengths = room(elements, sizeof *n->lengths);
  n->shapes = room(elements, 3 * sizeof *n->shapes);
  n->defs = room(o->guides, sizeof *n->defs);
  const int there = n->follicles && n->roots && n->curves && n->counts && n->fitted && n->lengths && n->shapes && n->defs;
  return there ? SHX_OK : SHX_ERROR_OUT_OF_MEMORY;
}

/* Spreads `count` follicles over the scalp; their frames go to n->roots. */
static shx_result scatter(nursery *n, const hair_scalp *scalp, size_t count, uint64_t seed) {
  shx_scatter_def how;
  TRY(shx_scatter_def_init(&how, sizeof how));
  how.count = count;
  how.density = scalp->density;
  how.seed = seed;
  size_t made;
  TRY(shx_scalp_scatter(n->scalp, &how, n->follicles, count, &made, NULL));
  const shx_output frames = shx_make_output(n->roots, count, SHX_FORMAT_FRAME);
  return shx_scalp_root_frames(n->scalp, NULL, n->follicles, count, &frames);
}

/* The head as a grid of distances: as cheap as a sphere, however fine its mesh is. */
static shx_result add_head(hair *h, nursery *n, const hair_scalp *scalp) {
  shx_distance_grid_def mesh;
  TRY(shx_distance_grid_def_init(&mesh, sizeof mesh));
  mesh.vertices = shx_make_input(scalp->vertices, scalp->vertex_count, SHX_FORMAT_F32X3);
  mesh.triangles = scalp->triangles;
  mesh.triangle_count = scalp->triangle_count;
  mesh.cell = GRID_CELL;
  mesh.band = GRID_BAND;
  size_t size;
  TRY(shx_distance_grid_bake(&mesh, NULL, 0, &size));
  n->grid = room(size, 1);
  if (n->grid == NULL)
    return SHX_ERROR_OUT_OF_MEMORY;
  TRY(shx_distance_grid_bake(&mesh, n->grid, size, &size));
  shx_body_def body;
  TRY(shx_body_def_init(&body, sizeof body));
  body.shape = SHX_SHAPE_GRID;
  body.grid = n->grid;
  body.grid_size = size;
  return shx_solver_add_bodies(h->solver, &body, sizeof body, 1, &h->head);
}

static shx_result comb_guides(hair *h, nursery *n, const hair_scalp *scalp) {
  const hair_options *o = &h->options;
  comb style = comb_for(scalp->vertices, scalp->density, scalp->vertex_count);
  style.part = style.centre[0] + o->part;
  style.wave = o->wave;
  for (size_t i = 0; i < o->guides; i++) {
    /* n0 of a follicle's frame is the normal: x turned by the quaternion. */
    const double *q = n->roots[i].rotation, chance = (double)(i * 2654435761u % 1000) / 1000.0;
    const double normal[3] = {1 - 2 * (q[1] * q[1] + q[2] * q[2]), 2 * (q[0] * q[1] + q[3] * q[2]), 2 * (q[0] * q[2] - q[3] * q[1])};
    comb_curve(&style, n->roots[i].origin, normal, o->length * (0.92 + 0.08 * chance), chance, n->curves + 3 * DRAWN * i, DRAWN);
    n->counts[i] = DRAWN;
  }
  shx_push_out_def out;
  TRY(shx_push_out_def_init(&out, sizeof out));
  out.body = h->head;
  out.clearance = 0.002;
  out.point_counts = n->counts;
  out.curve_count = o->guides;
  return shx_solver_push_out_curves(h->solver, &out, n->curves, NULL, NULL, NULL);
}

/* Strands that have the shapes of the combed curves. */
static shx_result add_guides(hair *h, nursery *n) {
  const hair_options *o = &h->options;
  const size_t elements = o->guides * o->elements;
  shx_fit_options how;
  shx_fit_input curves;
  TRY(shx_fit_options_init(&how, sizeof how));
  TRY(shx_fit_input_init(&curves, sizeof curves));
  how.element_count = o->elements;
  how.length_mode = SHX_FIT_LENGTHS_EQUAL;
  how.worker_count = o->workers;
  curves.curve_count = o->guides;
  curves.points = shx_make_input(n->curves, o->guides * DRAWN, SHX_FORMAT_F64X3);
  curves.point_counts = n->counts;
  TRY(shx_fit_strands(&how, &curves, n->fitted, 0, n->lengths, n->shapes, elements));
  for (size_t i = 0; i < o->guides; i++) {
    TRY(shx_strand_def_init(&n->defs[i], sizeof n->defs[i]));
    TRY(shx_strand_def_set_fit(&n->defs[i], &n->fitted[i], n->lengths + i * o->elements, n->shapes + 3 * i * o->elements));
    n->defs[i].internal_friction = 1e-10;
    n->defs[i].air_drag = 1e-5;
  }
  return shx_solver_add_strands(h->solver, n->defs, sizeof *n->defs, o->guides, h->ids);
}

/* A guide stands for a lock of hairs, which rests as it was combed. */
static shx_result make_wisps(hair *h) {
  shx_wisp wisp;
  shx_material one, lock;
  double margin;
  TRY(shx_wisp_init(&wisp, sizeof wisp));
  wisp.hold = h->options.hold;
  TRY(shx_material_init(&one, sizeof one));
  TRY(shx_material_init(&lock, sizeof lock));
  TRY(shx_solver_get_material(h->solver, h->ids[0], &one)); /* that of all */
  TRY(shx_wisp_material(&wisp, &one, &lock, NULL, &margin));
  TRY(shx_solver_set_materials(h->solver, h->ids, h->options.guides, &lock, sizeof lock, 1));
  return shx_solver_stiffen_strands(h->solver, h->ids, h->options.guides, SHX_STIFFEN_YOUNGS_MODULUS, margin, NULL);
}

/* The cheap model of contact, cut short: what is left of a depth goes in the next frames. */
static shx_result set_contact(hair *h) {
  shx_contact_options contact;
  shx_strand_contact strand;
  TRY(shx_contact_options_init(&contact, sizeof contact));
  TRY(shx_strand_contact_init(&strand, sizeof strand));
  contact.model = SHX_CONTACT_PENALTY;
  contact.max_iterations = 2;
  contact.hair_contact = h->options.wisp_radius > 0.0;
  strand.radius = 0.0015; /* of a lock: what is drawn around it stays out too */
  strand.wisp_radius = h->options.wisp_radius;
  TRY(shx_solver_set_contact_options(h->solver, &contact));
  TRY(shx_solver_set_strand_contact(h->solver, h->ids, h->options.guides, &strand, 0));
  return shx_solver_permit_overlaps(h->solver, h->ids, h->options.guides);
}

/* The drawn strands, bound to the guides while these rest. */
static shx_result bind(hair *h, nursery *n) {
  const hair_options *o = &h->options;
  shx_render_settings look;
  TRY(shx_render_settings_init(&look, sizeof look));
  look.points_per_strand = o->points;
  look.curliness = 0.35;
  look.wisps_per_guide = 5;
  look.frizz = 4e-4;
  look.flyaway_fraction = 0.015;
  look.flyaway_distance = 3e-3;
  look.length_variation = 0.2;
  look.worker_count = o->workers;
  const shx_input roots = shx_make_input(n->roots, o->hairs, SHX_FORMAT_FRAME);
  TRY(shx_solver_create_render_hair(h->solver, h->ids, o->guides, &look, &roots, &h->render));
  return shx_render_pose_create(h->render, &h->pose);
}

static shx_result grow(const hair_scalp *scalp, hair *h, nursery *n) {
  const hair_options *o = &h->options;
  TRY(nursery_make(n, o));
  h->ids = room(o->guides, sizeof *h->ids);
  if (h->ids == NULL)
    return SHX_ERROR_OUT_OF_MEMORY;
  TRY(shx_step_report_init(&h->report, sizeof h->report));

  shx_solver_def def;
  TRY(shx_solver_def_init(&def, sizeof def));
  def.gravity[1] = -9.81;
  def.gravity[2] = 0.0;
  def.worker_count = o->workers;
  def.tolerance = 1e-3; /* for the eye */
  TRY(shx_solver_create(&def, &h->solver));

  shx_scalp_def on;
  TRY(shx_scalp_def_init(&on, sizeof on));
  on.vertices = shx_make_input(scalp->vertices, scalp->vertex_count, SHX_FORMAT_F32X3);
  on.triangles = scalp->triangles;
  on.triangle_count = scalp->triangle_count;
  TRY(shx_scalp_create(&on, &n->scalp));
  TRY(add_head(h, n, scalp));

  TRY(scatter(n, scalp, o->guides, 1));
  TRY(comb_guides(h, n, scalp));
  TRY(add_guides(h, n));
  TRY(make_wisps(h));
  TRY(set_contact(h));
  const shx_frame rest = {{0, 0, 0}, {0, 0, 0, 1}};
  TRY(shx_attachment_create(h->solver, &rest, h->ids, o->guides, &h->head, 1, NULL, 0, &h->attachment));

  TRY(scatter(n, scalp, o->hairs, 2));
  return bind(h, n);
}

shx_result hair_grow(const hair_scalp *scalp, const hair_options *options, hair *out) {
  nursery n;
  memset(&n, 0, sizeof n);
  memset(out, 0, sizeof *out);
  out->options = *options;
  const shx_result result = grow(scalp, out, &n);
  nursery_free(&n);
  if (result != SHX_OK)
    hair_free(out);
  return result;
}

/* ---- every frame ------------------------------------------------------------------------------------------------------ */

shx_result hair_move(hair *h, const shx_frame *pose, double seconds) { return shx_attachment_move(h->attachment, h->solver, pose, seconds); }

shx_result hair_teleport(hair *h, const shx_frame *pose) { return shx_attachment_teleport(h->attachment, h->solver, pose); }

shx_result hair_step(hair *h, double seconds, uint32_t substeps) { return shx_solver_step(h->solver, seconds, substeps, &h->report); }

shx_result hair_draw(hair *h, const hair_vertices *to) {
  TRY(shx_solver_set_render_pose(h->solver, h->ids, h->options.guides, 0, h->pose));
  const shx_output points = {to->positions, to->position_stride, to->count, SHX_FORMAT_F32X3, 0};
  const shx_output frames = {to->frames, to->frame_stride, to->count, SHX_FORMAT_F32X4, 0};
  return shx_solver_evaluate_render_pose(h->solver, h->pose, NULL, &points, &frames, NULL);
}

shx_result hair_shades(const hair *h, float *out) {
  const size_t count = h->options.hairs;
  uint32_t *guides = room(count, sizeof *guides), *wisps = room(count, sizeof *wisps);
  shx_result result = guides && wisps ? SHX_OK : SHX_ERROR_OUT_OF_MEMORY;
  if (result == SHX_OK)
    result = shx_render_hair_wisps(h->render, 0, count, guides, wisps);
  for (size_t i = 0; i < count && result == SHX_OK; i++) {
    const uint32_t lock = (guides[i] * 31u + wisps[i]) * 2654435761u, single = (uint32_t)i * 2246822519u;
    out[i] = (0.6f * (float)(lock >> 8) + 0.4f * (float)(single >> 8)) / 16777216.0f;
  }
  free(guides);
  free(wisps);
  return result;
}

void hair_inspect(const uint8_t *positions, const uint8_t *frames, size_t stride, size_t count, size_t points, double *longest, size_t *broken) {
  float last[3] = {0, 0, 0}, p[3], q[4];
  *longest = 0.0;
  *broken = 0;
  for (size_t i = 0; i < count; i++) {
    double unit = 0.0, square = 0.0;
    memcpy(p, positions + i * stride, sizeof p);
    memcpy(q, frames + i * stride, sizeof q);
    for (int k = 0; k < 4; k++)
      unit += (double)q[k] * q[k];
    for (int k = 0; k < 3; k++)
      square += ((double)p[k] - last[k]) * ((double)p[k] - last[k]);
    if (!isfinite(p[0] + p[1] + p[2]) || !(fabs(unit - 1.0) < 1e-3))
      ++*broken;
    else if (i % points != 0)
      *longest = fmax(*longest, sqrt(square));
    memcpy(last, p, sizeof last);
  }
}
