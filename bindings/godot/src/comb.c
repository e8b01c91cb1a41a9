#include "comb.h"

#include <math.h>

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void normalise(double a[3]) {
  const double length = sqrt(dot(a, a));
  for (int k = 0; k < 3; k++)
    a[k] /= length > 1e-12 ? length : 1.0;
}

/* From 0 at `from` to 1 at `to`, which may be the lesser. */
static double smooth(double from, double to, double x) {
  const double t = fmin(fmax((x - from) / (to - from), 0.0), 1.0);
  return t * t * (3.0 - 2.0 * t);
}

comb comb_for(const float *vertices, const double *density, size_t count) {
  comb c = {{0.0}, {0.0}, 0.0, 0.0};
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (size_t i = 0; i < count; i++) {
    for (int k = 0; k < 3 && density[i] > 0.5; k++) {
      low[k] = fmin(low[k], vertices[3 * i + (size_t)k]);
      high[k] = fmax(high[k], vertices[3 * i + (size_t)k]);
    }
  }
  for (int k = 0; k < 3; k++) {
    c.centre[k] = 0.5 * (low[k] + high[k]);
    c.semi_axes[k] = 0.5 * (high[k] - low[k]);
  }
  return c;
}

/* How far out p is: 1 on the ellipsoid that is `clear` larger. Also gives its normal there. */
static double level(const comb *c, const double p[3], double clear, double normal[3]) {
  double sum = 0.0;
  for (int k = 0; k < 3; k++) {
    const double axis = c->semi_axes[k] + clear, x = (p[k] - c->centre[k]) / axis;
    sum += x * x;
    normal[k] = x / axis;
  }
  normalise(normal);
  return sqrt(sum);
}

void comb_curve(const comb *c, const double root[3], const double normal[3], double length, double chance, double *points, size_t count) {
  const double step = length / (double)(count - 1), side = tanh((root[0] - c->part) / 0.006);
  /* Locks that lie on others are farther out: those from higher up. */
  const double high = (root[1] - c->centre[1]) / c->semi_axes[1], volume = 0.005 + 0.008 * smooth(-0.8, 0.9, high) + 0.004 * chance;
  double p[3] = {root[0], root[1], root[2]}, direction[3], out[3];
  for (int k = 0; k < 3; k++)
    direction[k] = normal[k];
  for (size_t i = 0; i < count; i++) {
    const double s = step * (double)i, phase = 6.2832 * (s / 0.08 + 0.3 * chance), sway = c->wave * smooth(0.1, 0.9, s / length) * sin(phase);
    level(c, p, 0.0, out);
    const double across[3] = {out[2], 0.0, -out[0]};
    for (int k = 0; k < 3; k++)
      points[3 * i + (size_t)k] = p[k] + sway * (0.8 * across[k] + 0.6 * out[k]);
    /* Away from the parting, and back as long as it is in front of the ears; then down, and in towards the neck. */
    const double front = smooth(-0.1, 0.55, (p[2] - c->centre[2]) / c->semi_axes[2]), down = smooth(0.0, 0.11, s) * (1.0 - 0.8 * front);
    const double below = smooth(0.1, -0.7, (p[1] - c->centre[1]) / c->semi_axes[1]);
    double flow[3] = {side * (1.0 - down) * (1.0 - 0.3 * front) - 0.3 * below * out[0], -0.25 - 1.6 * down, -0.15 - 1.3 * front - 0.3 * below * out[2]};
    normalise(flow);
    const double clear = volume * smooth(0.0, 0.04, s), at = level(c, p, clear, out), inward = dot(flow, out);
    for (int k = 0; k < 3; k++) {
      /* Near the skull along it, elsewhere free; it leaves the scalp steeply and bends over. */
      const double wanted = flow[k] - (at < 1.12 && inward < 0.0 ? inward * out[k] : 0.0);
      direction[k] += (0.5 * smooth(0.0, 0.02, s) + 0.15) * (wanted - direction[k]);
    }
    normalise(direction);
    for (int k = 0; k < 3; k++)
      p[k] += step * direction[k];
    const double inside = level(c, p, clear, out);
    if (inside < 1.0) {
      for (int k = 0; k < 3; k++)
        p[k] = c->centre[k] + (p[k] - c->centre[k]) / inside;
    }
  }
}
