/* A head's recorded motion, for the examples: a line of titles, then time (s), position (m), unit quaternion w, x, y, z. */
#ifndef MOTION_H
#define MOTION_H
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct pose {
  double time, position[3], rotation[4]; /* x, y, z, w */
} pose;

typedef struct motion {
  pose *poses;
  size_t count;
} motion;

static motion read_motion(const char *path) {
  FILE *file = fopen(path, "r");
  char line[512];
  if (file == NULL || fgets(line, sizeof line, file) == NULL) {
    fprintf(stderr, "%s: cannot be read\n", path);
    exit(EXIT_FAILURE);
  }
  motion m = {NULL, 0};
  size_t capacity = 0;
  while (fgets(line, sizeof line, file) != NULL) {
    pose p;
    double *q = p.rotation;
    if (sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &p.time, &p.position[0], &p.position[1], &p.position[2], &q[3], &q[0],
               &q[1], &q[2]) != 8) {
      fprintf(stderr, "%s: line %zu does not hold eight numbers\n", path, m.count + 2);
      exit(EXIT_FAILURE);
    }
    if (m.count == capacity) {
      capacity = capacity == 0 ? 256 : 2 * capacity;
      m.poses = realloc(m.poses, capacity * sizeof *m.poses);
      if (m.poses == NULL)
        exit(EXIT_FAILURE);
    }
    m.poses[m.count++] = p;
  }
  fclose(file);
  if (m.count == 0) {
    fprintf(stderr, "%s: holds no pose\n", path);
    exit(EXIT_FAILURE);
  }
  return m;
}

/* The pose at a time, between the two recorded ones; held at both ends. */
static pose pose_at(const motion *m, double time) {
  size_t i = 0;
  while (i + 1 < m->count && m->poses[i + 1].time <= time)
    i++;
  pose a = m->poses[i];
  if (i + 1 == m->count || time <= a.time)
    return a;
  const pose *b = &m->poses[i + 1];
  const double u = (time - a.time) / (b->time - a.time);
  double cosine = 0.0, norm = 0.0;
  for (int k = 0; k < 4; k++)
    cosine += a.rotation[k] * b->rotation[k];
  for (int k = 0; k < 3; k++)
    a.position[k] += u * (b->position[k] - a.position[k]);
  for (int k = 0; k < 4; k++) {
    a.rotation[k] += u * ((cosine < 0.0 ? -1.0 : 1.0) * b->rotation[k] - a.rotation[k]);
    norm += a.rotation[k] * a.rotation[k];
  }
  for (int k = 0; k < 4; k++)
    a.rotation[k] /= sqrt(norm);
  a.time = time;
  return a;
}

/* ---- quaternions x, y, z, w ---- */

static void multiply(const double a[4], const double b[4], double out[4]) {
  const double q[4] = {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
                       a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
  memcpy(out, q, sizeof q);
}

static void rotate(const double q[4], const double v[3], double out[3]) {
  const double inverse[4] = {-q[0], -q[1], -q[2], q[3]}, pure[4] = {v[0], v[1], v[2], 0.0};
  double turned[4];
  multiply(q, pure, turned);
  multiply(turned, inverse, turned);
  memcpy(out, turned, 3 * sizeof *out);
}

/* How the head has turned since its first pose. */
static void turn_since(const pose *first, const pose *now, double turn[4]) {
  const double back[4] = {-first->rotation[0], -first->rotation[1], -first->rotation[2], first->rotation[3]};
  multiply(now->rotation, back, turn);
}

#endif
