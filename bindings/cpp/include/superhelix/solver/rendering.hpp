// Render hair that follows a solver's strands.
#ifndef SUPERHELIX_SOLVER_RENDERING_HPP
#define SUPERHELIX_SOLVER_RENDERING_HPP

#include "../definitions.hpp"
#include "../render_hair.hpp"

namespace superhelix {
inline namespace SUPERHELIX_WAY {

template <class Solver>
class solver_rendering {
  shx_solver *raw() const noexcept { return static_cast<const Solver *>(this)->get(); }

 public:
  // Makes render hair whose guides are strands as they are now: call it while they rest. roots: points or frames, one strand for each.
  returns<render_hair> create_render_hair(span<const strand_id> ids, const render_settings &settings, const input &roots) const {
    shx_render_hair *made = nullptr;
    const shx_result code = shx_solver_create_render_hair(raw(), ids.data(), ids.size(), &settings, &roots, &made);
    return detail::finish(code, render_hair(made, settings.loop()));
  }

  // Sets where the guides are from strands as they are now; velocities: whether render strands' velocities will be wanted.
  returns<void> set_render_pose(span<const strand_id> ids, bool velocities, render_pose &pose) const {
    return detail::finish(shx_solver_set_render_pose(raw(), ids.data(), ids.size(), velocities ? 1 : 0, pose.get()));
  }

  // render_pose::evaluate, with strands kept out of the solver's bodies.
  returns<void> evaluate_render_pose(const render_pose &pose, const output &points, const output &frames = {},
                                     const output &velocities = {}) const {
    return detail::finish(shx_solver_evaluate_render_pose(raw(), pose.get(), nullptr, detail::wanted(points), detail::wanted(frames),
                                                          detail::wanted(velocities)));
  }
  returns<void> evaluate_render_pose(const render_pose &pose, const render_view &view, const output &points, const output &frames = {},
                                     const output &velocities = {}) const {
    return detail::finish(shx_solver_evaluate_render_pose(raw(), pose.get(), &view, detail::wanted(points), detail::wanted(frames),
                                                          detail::wanted(velocities)));
  }
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_SOLVER_RENDERING_HPP
