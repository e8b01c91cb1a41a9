/* How the hair is combed: the curve of a guide from its root on. */
#ifndef COMB_H
#define COMB_H

#include <stddef.h>

/* The skull as an ellipsoid, and the style. */
typedef struct comb {
  double centre[3], semi_axes[3]; /* m */
  double part; /* x of the parting, m */
  double wave; /* how far waves go to either side at the tip, m */
} comb;

/* The ellipsoid around the vertices (three floats each) whose density is above a half. */
comb comb_for(const float *vertices, const double *density, size_t count);

/* Draws a curve of `count` points (three doubles each) and the given length from `root`, where the scalp has this normal. `chance`, 0 to 1, varies it. */
void comb_curve(const comb *c, const double root[3], const double normal[3], double length, double chance, double *points, size_t count);

#endif
