/* The class SuperhelixHair for Godot 3: a NativeScript on Godot's C interface. project/main.gd shows its use. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <gdnative_api_struct.gen.h>

#include "hair.h"

static const godot_gdnative_core_api_struct *api;
static const godot_gdnative_core_1_1_api_struct *api11;
static const godot_gdnative_ext_nativescript_api_struct *script;

/* The members of Mesh.ArrayType that are used here, and how many there are. */
enum { ARRAY_VERTEX = 0, ARRAY_COLOR = 3, ARRAY_TEX_UV = 4, ARRAY_INDEX = 8, ARRAY_MAX = 9 };

typedef struct node {
  hair hair;
  godot_pool_byte_array vertices; /* what the vertex buffer is to hold: the engine writes here, Godot uploads from here */
  size_t stride, frames; /* bytes a vertex; offset of the quaternion */
} node;

/* ---- values ----------------------------------------------------------------------------------------------------------- */

static godot_variant nothing(void) {
  godot_variant v;
  api->godot_variant_new_nil(&v);
  return v;
}

static godot_variant text(const char *utf8) {
  godot_string s = api->godot_string_chars_to_utf8(utf8);
  godot_variant v;
  api->godot_variant_new_string(&v, &s);
  api->godot_string_destroy(&s);
  return v;
}

/* What a method returns: nothing to say, or why it failed. */
static godot_variant outcome(shx_result result) {
  char message[600] = "";
  if (result != SHX_OK) {
    const int length = snprintf(message, sizeof message, "%s: ", shx_result_name(result));
    if (result != SHX_ERROR_OUT_OF_MEMORY)
      shx_last_error(message + length, sizeof message - (size_t)length);
  }
  return text(message);
}

/* The number under a key of a dictionary, or `otherwise`. */
static double setting(const godot_dictionary *from, const char *key, double otherwise) {
  godot_variant name = text(key), standard, value;
  api->godot_variant_new_real(&standard, otherwise);
  value = api11->godot_dictionary_get_with_default(from, &name, &standard);
  const double number = api->godot_variant_as_real(&value);
  api->godot_variant_destroy(&name);
  api->godot_variant_destroy(&standard);
  api->godot_variant_destroy(&value);
  return number;
}

static shx_frame frame_of(const godot_variant *transform) {
  godot_transform t = api->godot_variant_as_transform(transform);
  godot_transform rigid = api->godot_transform_orthonormalized(&t);
  godot_basis basis = api->godot_transform_get_basis(&rigid);
  const godot_quat q = api11->godot_basis_get_quat(&basis);
  const godot_vector3 p = api->godot_transform_get_origin(&rigid);
  shx_frame frame = {{0}, {api->godot_quat_get_x(&q), api->godot_quat_get_y(&q), api->godot_quat_get_z(&q), api->godot_quat_get_w(&q)}};
  double square = 0.0;
  for (int k = 0; k < 3; k++)
    frame.origin[k] = api->godot_vector3_get_axis(&p, (godot_vector3_axis)k);
  /* Godot computes in floats: their rounding adds up to more than the library accepts as a unit quaternion. */
  for (int k = 0; k < 4; k++)
    square += frame.rotation[k] * frame.rotation[k];
  for (int k = 0; k < 4; k++)
    frame.rotation[k] /= sqrt(square);
  return frame;
}

/* ---- growing ---------------------------------------------------------------------------------------------------------- */

static godot_variant grow_from(node *n, const godot_pool_vector3_array *positions, const godot_pool_int_array *indices,
                               const godot_pool_real_array *painted, const hair_options *options) {
  const size_t vertices = (size_t)api->godot_pool_vector3_array_size(positions), corners = (size_t)api->godot_pool_int_array_size(indices);
  if (vertices == 0 || corners == 0 || corners % 3 != 0)
    return text("grow: vertices and indices must be those of a surface of triangles");
  if ((size_t)api->godot_pool_real_array_size(painted) != vertices)
    return text("grow: density must have a number for each vertex");
  uint32_t *triangles = malloc(corners * sizeof *triangles);
  double *density = malloc(vertices * sizeof *density);
  if (triangles == NULL || density == NULL) {
    free(triangles);
    free(density);
    return outcome(SHX_ERROR_OUT_OF_MEMORY);
  }
  godot_pool_int_array_read_access *in = api->godot_pool_int_array_read(indices);
  godot_pool_real_array_read_access *paint = api->godot_pool_real_array_read(painted);
  godot_pool_vector3_array_read_access *at = api->godot_pool_vector3_array_read(positions);
  const godot_int *index = api->godot_pool_int_array_read_access_ptr(in);
  /* Godot's front faces are clockwise, the library's counter-clockwise. An index that is wrong is wrong for the library too, which says so. */
  for (size_t i = 0; i < corners; i += 3) {
    triangles[i] = (uint32_t)index[i];
    triangles[i + 1] = (uint32_t)index[i + 2];
    triangles[i + 2] = (uint32_t)index[i + 1];
  }
  for (size_t i = 0; i < vertices; i++)
    density[i] = api->godot_pool_real_array_read_access_ptr(paint)[i];
  /* A Vector3 is three floats. */
  const hair_scalp scalp = {(const float *)(const void *)api->godot_pool_vector3_array_read_access_ptr(at), triangles, density, vertices, corners / 3};
  hair_free(&n->hair);
  const shx_result result = hair_grow(&scalp, options, &n->hair);
  api->godot_pool_int_array_read_access_destroy(in);
  api->godot_pool_real_array_read_access_destroy(paint);
  api->godot_pool_vector3_array_read_access_destroy(at);
  free(triangles);
  free(density);
  return outcome(result);
}

/* grow(vertices: PoolVector3Array, indices: PoolIntArray, density: PoolRealArray, options: Dictionary) -> String */
static godot_variant grow(node *n, godot_variant **a) {
  godot_dictionary given = api->godot_variant_as_dictionary(a[3]);
  hair_options o;
  hair_options_init(&o);
  o.guides = (size_t)fmax(setting(&given, "guides", (double)o.guides), 0.0);
  o.hairs = (size_t)fmax(setting(&given, "hairs", (double)o.hairs), 0.0);
  o.points = (uint32_t)fmax(setting(&given, "points", o.points), 0.0);
  o.elements = (uint32_t)fmax(setting(&given, "elements", o.elements), 0.0);
  o.workers = (uint32_t)fmax(setting(&given, "workers", o.workers), 0.0);
  o.length = setting(&given, "length", o.length);
  o.wave = setting(&given, "wave", o.wave);
  o.part = setting(&given, "part", o.part);
  o.wisp_radius = setting(&given, "wisp_radius", o.wisp_radius);
  o.hold = setting(&given, "hold", o.hold);
  api->godot_dictionary_destroy(&given);
  if (!(o.length > 0.0 && isfinite(o.length))) { /* the others are checked by the library */
    char message[100];
    snprintf(message, sizeof message, "grow: length is %g; expected a finite number above zero", o.length);
    return text(message);
  }
  godot_pool_vector3_array positions = api->godot_variant_as_pool_vector3_array(a[0]);
  godot_pool_int_array indices = api->godot_variant_as_pool_int_array(a[1]);
  godot_pool_real_array density = api->godot_variant_as_pool_real_array(a[2]);
  const godot_variant result = grow_from(n, &positions, &indices, &density, &o);
  api->godot_pool_vector3_array_destroy(&positions);
  api->godot_pool_int_array_destroy(&indices);
  api->godot_pool_real_array_destroy(&density);
  return result;
}

static size_t vertex_count(const node *n) { return n->hair.options.hairs * n->hair.options.points; }

/* Texture coordinates: u is the shade of a strand, v the place along it. */
static shx_result fill_uv(const node *n, godot_pool_vector2_array *uv) {
  const size_t points = n->hair.options.points;
  float *shades = malloc(n->hair.options.hairs * sizeof *shades);
  shx_result result = shades != NULL ? hair_shades(&n->hair, shades) : SHX_ERROR_OUT_OF_MEMORY;
  godot_pool_vector2_array_write_access *to = api->godot_pool_vector2_array_write(uv);
  godot_vector2 *item = api->godot_pool_vector2_array_write_access_ptr(to);
  for (size_t i = 0; i < vertex_count(n) && result == SHX_OK; i++)
    api->godot_vector2_new(&item[i], shades[i / points], (float)(i % points) / (float)(points - 1));
  api->godot_pool_vector2_array_write_access_destroy(to);
  free(shades);
  return result;
}

/* A line from each point of a strand to the next. */
static void fill_lines(const node *n, godot_pool_int_array *lines) {
  const size_t points = n->hair.options.points;
  godot_pool_int_array_write_access *to = api->godot_pool_int_array_write(lines);
  godot_int *item = api->godot_pool_int_array_write_access_ptr(to);
  for (size_t i = 0; i < n->hair.options.hairs; i++) {
    for (size_t j = 0; j + 1 < points; j++) {
      *item++ = (godot_int)(i * points + j);
      *item++ = (godot_int)(i * points + j + 1);
    }
  }
  api->godot_pool_int_array_write_access_destroy(to);
}

/* surface() -> Array: for ArrayMesh.add_surface_from_arrays, as lines, without compression. Null if nothing has grown. */
static godot_variant surface(node *n, godot_variant **a) {
  (void)a;
  if (n->hair.render == NULL)
    return nothing();
  godot_pool_vector3_array positions;
  godot_pool_color_array frames;
  godot_pool_vector2_array uv;
  godot_pool_int_array lines;
  api->godot_pool_vector3_array_new(&positions);
  api->godot_pool_color_array_new(&frames);
  api->godot_pool_vector2_array_new(&uv);
  api->godot_pool_int_array_new(&lines);
  api->godot_pool_vector3_array_resize(&positions, (godot_int)vertex_count(n));
  api->godot_pool_color_array_resize(&frames, (godot_int)vertex_count(n));
  api->godot_pool_vector2_array_resize(&uv, (godot_int)vertex_count(n));
  api->godot_pool_int_array_resize(&lines, (godot_int)(2 * n->hair.options.hairs * (n->hair.options.points - 1)));
  fill_lines(n, &lines);
  const shx_result result = fill_uv(n, &uv);

  godot_pool_vector3_array_write_access *to = api->godot_pool_vector3_array_write(&positions);
  memset(api->godot_pool_vector3_array_write_access_ptr(to), 0, vertex_count(n) * sizeof(godot_vector3));
  api->godot_pool_vector3_array_write_access_destroy(to);
  godot_variant v[4], all;
  api->godot_variant_new_pool_vector3_array(&v[0], &positions);
  api->godot_variant_new_pool_color_array(&v[1], &frames);
  api->godot_variant_new_pool_vector2_array(&v[2], &uv);
  api->godot_variant_new_pool_int_array(&v[3], &lines);
  godot_array arrays;
  api->godot_array_new(&arrays);
  api->godot_array_resize(&arrays, ARRAY_MAX);
  const godot_int places[4] = {ARRAY_VERTEX, ARRAY_COLOR, ARRAY_TEX_UV, ARRAY_INDEX};
  for (int i = 0; i < 4; i++) {
    api->godot_array_set(&arrays, places[i], &v[i]);
    api->godot_variant_destroy(&v[i]);
  }
  api->godot_variant_new_array(&all, &arrays);
  api->godot_array_destroy(&arrays);
  api->godot_pool_vector3_array_destroy(&positions);
  api->godot_pool_color_array_destroy(&frames);
  api->godot_pool_vector2_array_destroy(&uv);
  api->godot_pool_int_array_destroy(&lines);
  if (result == SHX_OK)
    return all;
  api->godot_variant_destroy(&all);
  return nothing();
}

/* use_vertices(vertices: PoolByteArray, stride: int, color_offset: int) -> String: the bytes of the surface, positions first, to be written in place. */
static godot_variant use_vertices(node *n, godot_variant **a) {
  const int64_t stride = api->godot_variant_as_int(a[1]), offset = api->godot_variant_as_int(a[2]);
  godot_pool_byte_array given = api->godot_variant_as_pool_byte_array(a[0]);
  const size_t size = (size_t)api->godot_pool_byte_array_size(&given);
  const int fits = n->hair.render != NULL && offset >= 12 && stride >= offset + 16 && size == vertex_count(n) * (size_t)stride;
  if (fits) {
    api->godot_pool_byte_array_destroy(&n->vertices);
    api->godot_pool_byte_array_new_copy(&n->vertices, &given);
    n->stride = (size_t)stride;
    n->frames = (size_t)offset;
  }
  api->godot_pool_byte_array_destroy(&given);
  return text(fits ? "" : "use_vertices: these are not the bytes of the surface of this hair, with colours of four floats");
}

/* ---- every frame ------------------------------------------------------------------------------------------------------ */

/* What every method needs that moves hair. */
static godot_variant bare(void) { return text("grow hair first"); }

/* move(head: Transform, seconds: float) -> String */
static godot_variant move(node *n, godot_variant **a) {
  const shx_frame pose = frame_of(a[0]);
  return n->hair.render == NULL ? bare() : outcome(hair_move(&n->hair, &pose, api->godot_variant_as_real(a[1])));
}

/* teleport(head: Transform) -> String */
static godot_variant teleport(node *n, godot_variant **a) {
  const shx_frame pose = frame_of(a[0]);
  return n->hair.render == NULL ? bare() : outcome(hair_teleport(&n->hair, &pose));
}

/* step(seconds: float, substeps: int) -> String */
static godot_variant step(node *n, godot_variant **a) {
  const int64_t substeps = api->godot_variant_as_int(a[1]);
  if (n->hair.render == NULL)
    return bare();
  return outcome(hair_step(&n->hair, api->godot_variant_as_real(a[0]), substeps > 0 && substeps <= UINT32_MAX ? (uint32_t)substeps : 0));
}

/* draw() -> String: writes the drawn strands into the bytes that vertices() returns. */
static godot_variant draw(node *n, godot_variant **a) {
  (void)a;
  if (n->hair.render == NULL || n->stride == 0)
    return text("draw: grow hair, make a mesh of surface(), and call use_vertices first");
  godot_pool_byte_array_write_access *to = api->godot_pool_byte_array_write(&n->vertices);
  uint8_t *bytes = api->godot_pool_byte_array_write_access_ptr(to);
  const hair_vertices where = {bytes, bytes + n->frames, n->stride, n->stride, vertex_count(n)};
  const shx_result result = hair_draw(&n->hair, &where);
  api->godot_pool_byte_array_write_access_destroy(to);
  return outcome(result);
}

/* vertices() -> PoolByteArray: for VisualServer.mesh_surface_update_region. Do not keep it: a second holder makes draw() copy all of it. */
static godot_variant vertices(node *n, godot_variant **a) {
  (void)a;
  godot_variant v;
  api->godot_variant_new_pool_byte_array(&v, &n->vertices);
  return v;
}

/* ---- looking ---------------------------------------------------------------------------------------------------------- */

static void put(godot_dictionary *into, const char *key, double number) {
  godot_variant name = text(key), value;
  api->godot_variant_new_real(&value, number);
  api->godot_dictionary_set(into, &name, &value);
  api->godot_variant_destroy(&name);
  api->godot_variant_destroy(&value);
}

/* state() -> Dictionary: of the last step, and of what draw() wrote. */
static godot_variant state(node *n, godot_variant **a) {
  (void)a;
  const shx_step_report *r = &n->hair.report;
  double longest = 0.0;
  size_t broken = 0;
  if (n->stride != 0) {
    godot_pool_byte_array_read_access *from = api->godot_pool_byte_array_read(&n->vertices);
    const uint8_t *bytes = api->godot_pool_byte_array_read_access_ptr(from);
    hair_inspect(bytes, bytes + n->frames, n->stride, vertex_count(n), n->hair.options.points, &longest, &broken);
    api->godot_pool_byte_array_read_access_destroy(from);
  }
  godot_dictionary d;
  api->godot_dictionary_new(&d);
  put(&d, "contacts", r->contacts);
  put(&d, "unconverged", r->unconverged);
  put(&d, "quarantined", r->quarantined);
  put(&d, "unfinished", r->unfinished);
  put(&d, "penetration", r->max_penetration);
  put(&d, "kinetic_energy", r->kinetic_energy);
  put(&d, "longest_segment", longest);
  put(&d, "broken_vertices", (double)broken);
  godot_variant v;
  api->godot_variant_new_dictionary(&v, &d);
  api->godot_dictionary_destroy(&d);
  return v;
}

/* ---- the class -------------------------------------------------------------------------------------------------------- */

typedef struct method {
  const char *name;
  int arguments;
  godot_variant (*call)(node *, godot_variant **);
} method;

static method methods[] = {{"grow", 4, grow}, {"surface", 0, surface}, {"use_vertices", 3, use_vertices}, {"move", 2, move}, {"teleport", 1, teleport},
                           {"step", 2, step}, {"draw", 0, draw}, {"vertices", 0, vertices}, {"state", 0, state}};

static GDCALLINGCONV godot_variant call(godot_object *self, void *data, void *user, int count, godot_variant **arguments) {
  const method *m = data;
  char message[100];
  (void)self;
  if (count == m->arguments)
    return m->call(user, arguments);
  snprintf(message, sizeof message, "%s: %d arguments, %d expected", m->name, count, m->arguments);
  return text(message);
}

static GDCALLINGCONV void *create(godot_object *self, void *data) {
  (void)self, (void)data;
  node *n = api->godot_alloc(sizeof *n);
  memset(n, 0, sizeof *n);
  api->godot_pool_byte_array_new(&n->vertices);
  return n;
}

static GDCALLINGCONV void destroy(godot_object *self, void *data, void *user) {
  (void)self, (void)data;
  node *n = user;
  hair_free(&n->hair);
  api->godot_pool_byte_array_destroy(&n->vertices);
  api->godot_free(n);
}

void GDN_EXPORT godot_gdnative_init(godot_gdnative_init_options *options) {
  api = options->api_struct;
  for (const godot_gdnative_api_struct *next = api->next; next != NULL; next = next->next) {
    if (next->version.major == 1 && next->version.minor == 1)
      api11 = (const void *)next;
  }
  for (unsigned int i = 0; i < api->num_extensions; i++) {
    if (api->extensions[i]->type == GDNATIVE_EXT_NATIVESCRIPT)
      script = (const void *)api->extensions[i];
  }
}

void GDN_EXPORT godot_gdnative_terminate(godot_gdnative_terminate_options *options) { (void)options; }

void GDN_EXPORT godot_nativescript_init(void *handle) {
  if (api11 == NULL || script == NULL || shx_abi_version() != SHX_ABI_VERSION) {
    api->godot_print_error("Godot is older than 3.1, or the library superhelix has another binary interface", __func__, __FILE__, __LINE__);
    return;
  }
  const godot_instance_create_func made = {create, NULL, NULL};
  const godot_instance_destroy_func gone = {destroy, NULL, NULL};
  script->godot_nativescript_register_class(handle, "SuperhelixHair", "Reference", made, gone);
  for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
    const godot_instance_method how = {call, &methods[i], NULL};
    const godot_method_attributes local = {GODOT_METHOD_RPC_MODE_DISABLED};
    script->godot_nativescript_register_method(handle, "SuperhelixHair", methods[i].name, local, how);
  }
}
