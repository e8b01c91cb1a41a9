// A tool in a hand: bodies of a solver that a haptic device moves, and the wrench that the hand feels.
#ifndef SUPERHELIX_HAPTIC_HPP
#define SUPERHELIX_HAPTIC_HPP

#include "definitions.hpp"
#include "handle.hpp"
#include "solver.hpp"

#include <array>
#include <cstddef>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

// Force, N, and torque about the handle's origin, N m, world axes.
struct haptic_wrench {
  vec3 force{};
  vec3 torque{};
};

// Bodies that move as one rigid tool. Its two sides may be used at the same time: before_step and after_step by the thread that steps the solver, update by
// that of the device. It moves and is not copied.
class haptic {
 public:
  // An empty one, to move another into.
  haptic() = default;
  static returns<haptic> create(const solver &hair, span<const body_id> bodies, const haptic_def &def = haptic_def()) {
    shx_haptic *made = nullptr;
    const shx_result code = shx_haptic_create(hair.get(), &def, bodies.data(), bodies.size(), &made);
    return detail::finish(code, haptic(made));
  }
#if !SUPERHELIX_USE_RESULTS
  explicit haptic(const solver &hair, span<const body_id> bodies, const haptic_def &def = haptic_def()) : haptic(create(hair, bodies, def)) {}
#endif

  // Before a step, or several substeps, of dt seconds in all: moves the bodies over dt to where the device is now.
  returns<void> before_step(solver &hair, double dt) { return detail::finish(shx_haptic_before_step(get(), hair.get(), dt)); }
  // After the step: hands what touches the tool, and how it yields, over to the device's side.
  returns<void> after_step(solver &hair) { return detail::finish(shx_haptic_after_step(get(), hair.get())); }

  // On the device's thread: its pose and velocity (linear, m/s, angular, rad/s, world axes), dt seconds after the last update, and what the hand is to
  // feel. Waits for nothing and allocates nothing. state, where it is given: how it went.
  returns<haptic_wrench> update(const frame &pose, const vec3 &velocity, const vec3 &angular_velocity, double dt, haptic_state *state = nullptr) {
    const std::array<double, 6> twist = {velocity[0], velocity[1], velocity[2], angular_velocity[0], angular_velocity[1], angular_velocity[2]};
    std::array<double, 6> out{};
    const shx_result code = shx_haptic_update(get(), &pose, twist.data(), dt, out.data(), state);
    return detail::finish(code, haptic_wrench{{out[0], out[1], out[2]}, {out[3], out[4], out[5]}});
  }

  // Gives the hand a ring comb with the teeth of a tool (any but plates), which is at a frame now; its index. From the next step on it goes with the bodies,
  // catches those of ids that its teeth run into, and the hand feels what they pull with. Bodies where the teeth are push the strands off them: give these
  // strands no contact, or let the tool have a body only where it is held.
  returns<std::size_t> add_ring_comb(const solver &hair, const tool_def &tool, const frame &at, span<const strand_id> ids,
                                     const ring_comb_def &def = ring_comb_def()) {
    std::size_t index = 0;
    const shx_result code = shx_haptic_add_ring_comb(get(), hair.get(), &tool, &at, &def, ids.data(), ids.size(), &index);
    return detail::finish(code, index);
  }
  // What the last step did to a ring comb.
  returns<ring_comb_report> get_ring_comb_report(std::size_t index) const {
    ring_comb_report report{};
    const shx_result code = shx_haptic_ring_comb_report(get(), index, &report);
    return detail::finish(code, report);
  }
  // Where a ring comb is.
  returns<frame> ring_comb_frame(std::size_t index) const {
    frame at{};
    const shx_result code = shx_haptic_ring_comb_frame(get(), index, &at);
    return detail::finish(code, at);
  }
  // Lets go of all strands on the teeth of ring combs. Call it before this ends: what holds them belongs to the solver.
  returns<void> release_ring_combs(solver &hair) { return detail::finish(shx_haptic_release_ring_combs(get(), hair.get())); }

  shx_haptic *get() const noexcept { return handle_.get(); }
  explicit operator bool() const noexcept { return static_cast<bool>(handle_); }

 private:
  explicit haptic(shx_haptic *raw) : handle_(raw) {}

  handle_detail::handle<shx_haptic, shx_haptic_destroy> handle_;
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_HAPTIC_HPP
