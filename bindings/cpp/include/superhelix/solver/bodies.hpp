// Bodies that strands meet.
#ifndef SUPERHELIX_SOLVER_BODIES_HPP
#define SUPERHELIX_SOLVER_BODIES_HPP

#include "../definitions.hpp"

#include <vector>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

// Bakes a mesh into a signed distance grid, for bodies of shape::grid. The bytes may be kept in a file.
inline returns<std::vector<std::uint8_t>> bake_distance_grid(const distance_grid_def &def) {
  std::size_t size = 0;
  shx_result code = shx_distance_grid_bake(&def, nullptr, 0, &size);
  std::vector<std::uint8_t> grid(size);
  if (code == SHX_OK)
    code = shx_distance_grid_bake(&def, grid.data(), grid.size(), &size);
  return detail::finish(code, std::move(grid));
}

template <class Solver>
class solver_bodies {
  shx_solver *raw() const noexcept { return static_cast<const Solver *>(this)->get(); }

 public:
  // Adds bodies, all or none; their ids come in the order of the definitions.
  returns<std::vector<body_id>> add_bodies(span<const body_def> defs) {
    std::vector<body_id> ids(defs.size());
    const shx_result code = shx_solver_add_bodies(raw(), defs.data(), sizeof(body_def), defs.size(), ids.data());
    return detail::finish(code, std::move(ids));
  }
  returns<body_id> add_body(const body_def &def) {
    body_id id{};
    const shx_result code = shx_solver_add_bodies(raw(), &def, sizeof(body_def), 1, &id);
    return detail::finish(code, id);
  }

  // Removes bodies, all or none. Their ids are stale from then on.
  returns<void> remove_bodies(span<const body_id> ids) {
    return detail::finish(shx_solver_remove_bodies(raw(), ids.data(), ids.size()));
  }

  // The number that body_def's user_data gave to a body.
  returns<std::uint64_t> get_body_user_data(body_id id) const {
    std::uint64_t number = 0;
    const shx_result code = shx_solver_get_body_user_data(raw(), id, &number);
    return detail::finish(code, number);
  }

  bool has_body(body_id id) const noexcept { return shx_solver_has_body(raw(), id); }

  returns<std::size_t> body_count() const {
    std::size_t count = 0;
    const shx_result code = shx_solver_body_count(raw(), &count);
    return detail::finish(code, count);
  }

  returns<std::vector<body_id>> body_ids() const {
    std::size_t count = 0;
    shx_result code = shx_solver_body_count(raw(), &count);
    std::vector<body_id> ids(count);
    if (code == SHX_OK)
      code = shx_solver_body_ids(raw(), ids.data(), ids.size());
    return detail::finish(code, std::move(ids));
  }

  // Moves bodies smoothly to the given frames, one for each id, over the next over_seconds of simulated time; they push what lies between.
  returns<void> set_body_frames(span<const body_id> ids, const input &frames, double over_seconds) {
    return detail::finish(shx_solver_set_body_frames(raw(), ids.data(), ids.size(), &frames, over_seconds));
  }
  // Puts bodies at the given frames at once, at rest.
  returns<void> teleport_bodies(span<const body_id> ids, const input &frames) {
    return detail::finish(shx_solver_teleport_bodies(raw(), ids.data(), ids.size(), &frames));
  }
  // The frames of bodies as they are now: frames, or quaternions alone.
  returns<void> get_body_frames(span<const body_id> ids, const output &frames) const {
    return detail::finish(shx_solver_get_body_frames(raw(), ids.data(), ids.size(), &frames));
  }

  // Sends the vertices of a mesh to new places over the next over_seconds of simulated time: for skin that deforms, once a frame.
  returns<void> set_body_vertices(body_id id, const input &vertices, double over_seconds) {
    return detail::finish(shx_solver_set_body_vertices(raw(), id, &vertices, over_seconds));
  }

  // How far outside its shape a body's surface lies, m, and what it multiplies the strands' coefficients of friction by.
  returns<void> set_body_surface(body_id id, double thickness, double friction_scale, double viscous_friction_scale) {
    return detail::finish(shx_solver_set_body_surface(raw(), id, thickness, friction_scale, viscous_friction_scale));
  }

  // Which groups a body is in and which it touches, as bits.
  returns<void> set_body_filter(body_id id, std::uint32_t groups, std::uint32_t mask) {
    return detail::finish(shx_solver_set_body_filter(raw(), id, groups, mask));
  }

  // The action of strands on each body in the last substep: force (N) and torque about the body's origin (N m), world axes.
  returns<void> body_wrenches(span<const body_id> ids, const output &forces, const output &torques = {}) const {
    return detail::finish(
        shx_solver_body_wrenches(raw(), ids.data(), ids.size(), detail::wanted(forces), detail::wanted(torques)));
  }
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_SOLVER_BODIES_HPP
