/* For the examples: a triangle mesh of a Wavefront OBJ file (its v and f lines; faces of more corners become fans), and a head made of one. */
#ifndef MESH_H
#define MESH_H
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "check.h"

typedef struct mesh {
  double *vertices; /* three a vertex, m */
  uint32_t *triangles; /* three a triangle */
  size_t vertex_count, triangle_count;
} mesh;

/* Room for one item more: arrays double. */
static void *grown(void *array, size_t count, size_t size) {
  if (count > 0 && (count & (count - 1)) != 0)
    return array;
  array = realloc(array, (count == 0 ? 1 : 2 * count) * size);
  if (array == NULL) {
    fprintf(stderr, "out of memory\n");
    exit(EXIT_FAILURE);
  }
  return array;
}

static mesh read_mesh(const char *path, double scale) {
  mesh m = {NULL, NULL, 0, 0};
  char line[4096];
  size_t number = 0;
  FILE *file = fopen(path, "r");
  if (file == NULL) {
    fprintf(stderr, "%s: cannot be read\n", path);
    exit(EXIT_FAILURE);
  }
  while (fgets(line, sizeof line, file) != NULL) {
    number++;
    if (strncmp(line, "v ", 2) == 0) {
      m.vertices = grown(m.vertices, m.vertex_count, 3 * sizeof *m.vertices);
      double *v = m.vertices + 3 * m.vertex_count++;
      if (sscanf(line + 2, "%lf %lf %lf", &v[0], &v[1], &v[2]) != 3) {
        fprintf(stderr, "%s: line %zu does not hold three numbers\n", path, number);
        exit(EXIT_FAILURE);
      }
      for (int k = 0; k < 3; k++)
        v[k] *= scale;
    } else if (strncmp(line, "f ", 2) == 0) {
      uint32_t first = 0, last = 0;
      int corners = 0;
      for (char *word = strtok(line + 2, " \t\r\n"); word != NULL; word = strtok(NULL, " \t\r\n"), corners++) {
        const long index = strtol(word, NULL, 10); /* of v/vt/vn the first */
        if (index < 1 || (size_t)index > m.vertex_count) {
          fprintf(stderr, "%s: line %zu names no vertex: %s\n", path, number, word);
          exit(EXIT_FAILURE);
        }
        if (corners >= 2) {
          m.triangles = grown(m.triangles, m.triangle_count, 3 * sizeof *m.triangles);
          uint32_t *t = m.triangles + 3 * m.triangle_count++;
          t[0] = first;
          t[1] = last;
          t[2] = (uint32_t)index - 1;
        }
        first = corners == 0 ? (uint32_t)index - 1 : first;
        last = (uint32_t)index - 1;
      }
    }
  }
  fclose(file);
  if (m.triangle_count == 0) {
    fprintf(stderr, "%s: holds no faces\n", path);
    exit(EXIT_FAILURE);
  }
  return m;
}

static void free_mesh(mesh *m) {
  free(m->vertices);
  free(m->triangles);
}

static void *allocate(size_t count, size_t size) {
  void *memory = calloc(count > 0 ? count : 1, size);
  if (memory == NULL) {
    fprintf(stderr, "out of memory\n");
    exit(EXIT_FAILURE);
  }
  return memory;
}

/* The head as a grid of distances, which costs the same however fine its mesh is: cell and band in m. */
static shx_body_id add_head(shx_solver *solver, const mesh *head, double cell, double band) {
  shx_distance_grid_def baked;
  CHECK(shx_distance_grid_def_init(&baked, sizeof baked));
  baked.vertices = (shx_input){head->vertices, 0, head->vertex_count, SHX_FORMAT_F64X3, 0};
  baked.triangles = head->triangles;
  baked.triangle_count = head->triangle_count;
  baked.cell = cell;
  baked.band = band;
  size_t size;
  CHECK(shx_distance_grid_bake(&baked, NULL, 0, &size));
  void *grid = allocate(size, 1);
  CHECK(shx_distance_grid_bake(&baked, grid, size, &size));
  shx_body_def def;
  CHECK(shx_body_def_init(&def, sizeof def));
  def.shape = SHX_SHAPE_GRID;
  def.grid = grid;
  def.grid_size = size;
  shx_body_id id;
  CHECK(shx_solver_add_bodies(solver, &def, sizeof def, 1, &id));
  free(grid);
  return id;
}

#endif
