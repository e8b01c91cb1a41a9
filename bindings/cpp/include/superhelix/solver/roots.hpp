// Roots of strands: where the host moves them, and what strands do to them.
#ifndef SUPERHELIX_SOLVER_ROOTS_HPP
#define SUPERHELIX_SOLVER_ROOTS_HPP

#include "../definitions.hpp"

#include <vector>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

template <class Solver>
class solver_roots {
  shx_solver *raw() const noexcept { return static_cast<const Solver *>(this)->get(); }

 public:
  // Moves roots smoothly to the given frames, one for each id, over the next over_seconds of simulated time.
  returns<void> set_root_frames(span<const strand_id> ids, const input &frames, double over_seconds) {
    return detail::finish(shx_solver_set_root_frames(raw(), ids.data(), ids.size(), &frames, over_seconds));
  }

  // Puts roots at the given frames at once, without a kick: for cuts and new takes.
  returns<void> teleport_roots(span<const strand_id> ids, const input &frames) {
    return detail::finish(shx_solver_teleport_roots(raw(), ids.data(), ids.size(), &frames));
  }

  // The root frames as they are now: frames, or quaternions alone.
  returns<void> get_root_frames(span<const strand_id> ids, const output &frames) const {
    return detail::finish(shx_solver_get_root_frames(raw(), ids.data(), ids.size(), &frames));
  }

  // What each strand does to its follicle as of the last step: force (N) and torque about the root's origin (N m), world axes.
  returns<void> root_wrenches(span<const strand_id> ids, const output &forces, const output &torques = {}) const {
    return detail::finish(
        shx_solver_root_wrenches(raw(), ids.data(), ids.size(), detail::wanted(forces), detail::wanted(torques)));
  }
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_SOLVER_ROOTS_HPP
