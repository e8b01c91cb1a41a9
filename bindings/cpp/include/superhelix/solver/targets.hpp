// Targets: curves, of a rig for example, to which strands are drawn with a weight along their length.
#ifndef SUPERHELIX_SOLVER_TARGETS_HPP
#define SUPERHELIX_SOLVER_TARGETS_HPP

#include "../definitions.hpp"

namespace superhelix {
inline namespace SUPERHELIX_WAY {

template <class Solver>
class solver_targets {
  shx_solver *raw() const noexcept { return static_cast<const Solver *>(this)->get(); }

 public:
  // Draws strands to curves, one for each id, as they are after the next over_seconds of simulated time. Call it once per frame, before the step.
  returns<void> set_targets(span<const strand_id> ids, const target_def &def, double over_seconds) {
    return detail::finish(shx_solver_set_targets(raw(), ids.data(), ids.size(), &def, over_seconds));
  }

  // Lets strands go: nothing draws them any more.
  returns<void> clear_targets(span<const strand_id> ids) {
    return detail::finish(shx_solver_clear_targets(raw(), ids.data(), ids.size()));
  }

  // How far each strand is from its target, m, weighted; -1 for one without.
  returns<void> target_distances(span<const strand_id> ids, span<double> out_distances) const {
    detail::sizes sizes("target_distances");
    if (sizes.room("out_distances", out_distances.size(), ids.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(shx_solver_target_distances(raw(), ids.data(), ids.size(), out_distances.data()));
  }
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_SOLVER_TARGETS_HPP
