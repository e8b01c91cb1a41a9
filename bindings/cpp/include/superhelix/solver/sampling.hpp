// Points, frames and velocities along strands, written into the host's memory.
#ifndef SUPERHELIX_SOLVER_SAMPLING_HPP
#define SUPERHELIX_SOLVER_SAMPLING_HPP

#include "../definitions.hpp"

#include <vector>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

template <class Solver>
class solver_sampling {
  shx_solver *raw() const noexcept { return static_cast<const Solver *>(this)->get(); }

 public:
  // Samples strands uniformly: item i * points_per_strand + j of each output is point j of strand ids[i]. One call a frame for everything. frames: whole
  // ones, quaternions in four numbers, or unit tangents in three.
  returns<void> sample_strands(span<const strand_id> ids, const sample_def &def, const output &points, const output &frames = {},
                               const output &velocities = {}) const {
    return detail::finish(shx_solver_sample_strands(raw(), ids.data(), ids.size(), &def, detail::wanted(points),
                                                    detail::wanted(frames), detail::wanted(velocities)));
  }

  // Samples one strand at arclengths from the root, m. origin is subtracted from positions.
  returns<void> sample_at(strand_id id, span<const double> arclengths, const output &points, const output &frames = {},
                          const output &velocities = {}, const vec3 &origin = {}) const {
    return detail::finish(shx_solver_sample_at(raw(), id, arclengths.data(), arclengths.size(), origin.data(), detail::wanted(points),
                                               detail::wanted(frames), detail::wanted(velocities)));
  }
  // The same with the origin and the axes of def.
  returns<void> sample_at(strand_id id, span<const double> arclengths, const sample_def &def, const output &points,
                          const output &frames = {}, const output &velocities = {}) const {
    return detail::finish(shx_solver_sample_at_with(raw(), id, arclengths.data(), arclengths.size(), &def, detail::wanted(points),
                                                    detail::wanted(frames), detail::wanted(velocities)));
  }
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_SOLVER_SAMPLING_HPP
