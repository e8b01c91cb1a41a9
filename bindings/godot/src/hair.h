/* A head of hair for a game engine, on superhelix.h alone: nothing here knows which engine hosts it. Lengths in metres, y up, right-handed. */
#ifndef HAIR_H
#define HAIR_H

#include <superhelix_inline.h>

/* The head's mesh at rest, and where hair grows on it. */
typedef struct hair_scalp {
  const float *vertices; /* three a vertex */
  const uint32_t *triangles; /* three a triangle, counter-clockwise seen from outside */
  const double *density; /* one a vertex, 0 to 1 */
  size_t vertex_count, triangle_count;
} hair_scalp;

typedef struct hair_options {
  size_t guides, hairs; /* strands that are simulated, strands that are drawn */
  uint32_t points; /* a drawn strand, root and tip included */
  uint32_t elements; /* a guide */
  uint32_t workers; /* threads */
  double length; /* of the longest guides, m */
  double wave; /* how far waves go to either side at the tip, m */
  double part; /* where the parting is, m to the right of the middle as one looks at the face */
  double wisp_radius; /* guides collide with each other as locks of that radius, m; 0: with the head only */
  double hold; /* how firmly locks keep their style, 0 to 1 */
} hair_options;

typedef struct hair {
  hair_options options;
  shx_solver *solver;
  shx_strand_id *ids;
  shx_body_id head;
  shx_attachment *attachment; /* roots and head */
  shx_render_hair *render;
  shx_render_pose *pose;
  shx_step_report report; /* of the last step */
} hair;

/* Where the drawn strands go: one item a point, strand by strand, so many bytes apart; in one buffer or in two. The bytes between are left alone. */
typedef struct hair_vertices {
  void *positions; /* three floats */
  void *frames; /* four floats: a quaternion x, y, z, w that turns x into the tangent */
  size_t position_stride, frame_stride;
  size_t count;
} hair_vertices;

void hair_options_init(hair_options *options);

/* Combs guides over the scalp, settles what they rest as, and binds the drawn strands to them. On failure the message is in shx_last_error, and
 * *out is as hair_free left it. */
shx_result hair_grow(const hair_scalp *scalp, const hair_options *options, hair *out);

/* The head is to be in this pose in `seconds` of simulated time. At rest its pose is the identity. */
shx_result hair_move(hair *h, const shx_frame *pose, double seconds);

/* The head is there at once, and the hair with it: a cut. */
shx_result hair_teleport(hair *h, const shx_frame *pose);

shx_result hair_step(hair *h, double seconds, uint32_t substeps);

/* Writes the drawn strands as they are now, out of the head. */
shx_result hair_draw(hair *h, const hair_vertices *to);

/* One number from 0 to 1 for each drawn strand; strands of one lock have similar ones. For colours. */
shx_result hair_shades(const hair *h, float *out);

/* For tests: the longest distance of a point from the one before it on its strand, m, and how many points are not finite or have no unit quaternion. */
void hair_inspect(const uint8_t *positions, const uint8_t *frames, size_t stride, size_t count, size_t points, double *longest, size_t *broken);

void hair_free(hair *h);

#endif
