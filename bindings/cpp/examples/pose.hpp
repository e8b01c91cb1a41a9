// A rigid pose and its arithmetic: stands for the transform class that an engine has.
#ifndef POSE_HPP
#define POSE_HPP

#include <superhelix/types.hpp>

struct Pose {
  superhelix::vec3 position{};
  superhelix::quaternion rotation{0.0, 0.0, 0.0, 1.0};  // x, y, z, w

  superhelix::vec3 rotate(const superhelix::vec3 &v) const {
    const auto &q = rotation;
    const superhelix::vec3 t{2.0 * (q[1] * v[2] - q[2] * v[1]), 2.0 * (q[2] * v[0] - q[0] * v[2]), 2.0 * (q[0] * v[1] - q[1] * v[0])};
    return {v[0] + q[3] * t[0] + q[1] * t[2] - q[2] * t[1], v[1] + q[3] * t[1] + q[2] * t[0] - q[0] * t[2],
            v[2] + q[3] * t[2] + q[0] * t[1] - q[1] * t[0]};
  }

  // Where this pose takes what sits at a frame of its own space.
  superhelix::frame operator*(const superhelix::frame &local) const {
    const superhelix::vec3 origin = rotate({local.origin[0], local.origin[1], local.origin[2]});
    const auto &a = rotation;
    const double *b = local.rotation;
    return superhelix::make_frame({origin[0] + position[0], origin[1] + position[1], origin[2] + position[2]},
                                  {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
                                   a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]});
  }
};

#endif  // POSE_HPP
