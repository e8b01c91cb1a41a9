// Smooth motions through recorded poses.
#ifndef SUPERHELIX_MOTION_HPP
#define SUPERHELIX_MOTION_HPP

#include "definitions.hpp"

#include <vector>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

// A motion at some times: frames, and in world axes the velocities of their origins (m/s) and angular velocities (rad/s).
struct motion_samples {
  std::vector<frame> frames;
  std::vector<vec3> velocities, angular_velocities;
};
// Samples the smooth motion through poses at pose_times (s, ascending, as many) at times (s).
inline returns<motion_samples> sample_motion(span<const double> pose_times, span<const frame> poses, span<const double> times) {
  detail::sizes sizes("sample_motion");
  if (sizes.exactly("pose_times", pose_times.size(), poses.size()).wrong())
    return sizes.failure<motion_samples>();
  motion_samples made;
  made.frames.resize(times.size());
  made.velocities.resize(times.size());
  made.angular_velocities.resize(times.size());
  const input at(poses);
  const output frames(made.frames), velocities(made.velocities), angular_velocities(made.angular_velocities);
  const shx_result code = shx_sample_motion(pose_times.data(), &at, times.data(), times.size(), &frames, &velocities, &angular_velocities);
  return detail::finish(code, std::move(made));
}

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_MOTION_HPP
