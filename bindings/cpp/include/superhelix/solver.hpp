// The solver: strands, bodies, constraints, and the step. Its functions are those of the C interface without shx_solver_, in parts by subject.
#ifndef SUPERHELIX_SOLVER_HPP
#define SUPERHELIX_SOLVER_HPP

#include "definitions.hpp"
#include "handle.hpp"
#include "solver/bodies.hpp"
#include "solver/constraints.hpp"
#include "solver/contact.hpp"
#include "solver/posing.hpp"
#include "solver/rendering.hpp"
#include "solver/roots.hpp"
#include "solver/sampling.hpp"
#include "solver/shapes.hpp"
#include "solver/strands.hpp"
#include "solver/styling.hpp"
#include "solver/targets.hpp"

namespace superhelix {
inline namespace SUPERHELIX_WAY {

// Strands, bodies and everything that a step needs. It moves and is not copied. Const functions may run at the same time on any threads; one that is not
// const must be alone. One that was moved from only takes another.
class solver : public solver_strands<solver>,
               public solver_roots<solver>,
               public solver_targets<solver>,
               public solver_shapes<solver>,
               public solver_posing<solver>,
               public solver_sampling<solver>,
               public solver_bodies<solver>,
               public solver_contact<solver>,
               public solver_constraints<solver>,
               public solver_rendering<solver>,
               public solver_styling<solver> {
 public:
  // An empty one, to move another into.
  explicit solver(std::nullptr_t) noexcept {}
#if !SUPERHELIX_USE_RESULTS
  explicit solver(const solver_def &def = solver_def()) : solver(create(def)) {}
#endif
  static returns<solver> create(const solver_def &def = solver_def()) {
    shx_solver *made = nullptr;
    const shx_result code = shx_solver_create(&def, &made);
    return detail::finish(code, solver(made, def));
  }

  // For C functions; still owned.
  shx_solver *get() const noexcept { return handle_.get(); }
  explicit operator bool() const noexcept { return static_cast<bool>(handle_); }

  // Moves time on by dt seconds in substeps equal parts.
  returns<void> step(double dt, std::uint32_t substeps = 1) { return detail::finish(shx_solver_step(get(), dt, substeps, nullptr)); }
  // The same, and what it did into report.
  returns<void> step(double dt, std::uint32_t substeps, step_report &report) {
    return detail::finish(shx_solver_step(get(), dt, substeps, &report));
  }
  // The same within limits: of work, of seconds, or until another thread cancels it.
  returns<step_report> step_with_limits(double dt, std::uint32_t substeps, const step_limits &limits) {
    step_report report;
    const shx_result code = shx_solver_step_with_limits(get(), dt, substeps, &limits, &report);
    return detail::finish(code, report);
  }

  // Gravity, m/s^2, from the next step on.
  returns<void> set_gravity(const vec3 &gravity) { return detail::finish(shx_solver_set_gravity(get(), gravity.data())); }
  // Uniform wind, m/s, from the next step on. Only strands with an air_drag feel it.
  returns<void> set_wind(const vec3 &wind) { return detail::finish(shx_solver_set_wind(get(), wind.data())); }

  // Adds a field to the uniform wind: field(seconds, positions, velocities) writes the air's velocities (m/s) at the positions (m), seconds after the
  // call of step began. It is called by the thread that steps, before each substep, and must not throw: the program would end. It is kept as long as the
  // solver has it. It is in no snapshot.
  template <class F>
  returns<void> set_wind_field(F &&field) {
    auto hook = std::make_shared<detail::wind_hook>(std::forward<F>(field));
    const shx_result code = shx_solver_set_wind_field(get(), &detail::wind_hook::call, hook.get());
    if (code == SHX_OK)
      wind_ = std::move(hook);
    return detail::finish(code);
  }
  // The uniform wind alone from now on.
  returns<void> clear_wind_field() {
    const shx_result code = shx_solver_set_wind_field(get(), nullptr, nullptr);
    if (code == SHX_OK)
      wind_.reset();
    return detail::finish(code);
  }

  // Draws what the solver knows as of the last step: lines(vertices) and points(vertices) get batches of at most 1024 debug_vertex, of lines in pairs.
  // They must not throw: the program would end.
  template <class Lines, class Points>
  returns<void> debug_draw(debug_draw_def def, Lines &&lines, Points &&points) const {
    struct canvas {
      std::remove_reference_t<Lines> &lines;
      std::remove_reference_t<Points> &points;
      static void draw_lines(void *user, const shx_debug_vertex *vertices, std::size_t count) noexcept {
        static_cast<canvas *>(user)->lines(span<const debug_vertex>(vertices, count));
      }
      static void draw_points(void *user, const shx_debug_vertex *vertices, std::size_t count) noexcept {
        static_cast<canvas *>(user)->points(span<const debug_vertex>(vertices, count));
      }
    } host{lines, points};
    def.lines = &canvas::draw_lines;
    def.points = &canvas::draw_points;
    def.user = &host;
    return detail::finish(shx_solver_debug_draw(get(), &def));
  }

  // The options of the solver, to be changed and set again. The number of threads is fixed.
  returns<solver_options> get_options() const {
    solver_options options;
    const shx_result code = shx_solver_get_options(get(), &options);
    return detail::finish(code, options);
  }
  // Changes the options from the next step on.
  returns<void> set_options(const solver_options &options) { return detail::finish(shx_solver_set_options(get(), &options)); }

  // An image of everything that a step depends on.
  returns<std::vector<std::uint8_t>> snapshot() const {
    std::size_t size = 0;
    shx_result code = shx_solver_snapshot(get(), nullptr, 0, &size);
    std::vector<std::uint8_t> image(size);
    if (code == SHX_OK)
      code = shx_solver_snapshot(get(), image.data(), image.size(), &size);
    return detail::finish(code, std::move(image));
  }
  // The same into out_image, and its size.
  returns<std::size_t> snapshot(span<std::uint8_t> out_image) const {
    std::size_t size = 0;
    const shx_result code = shx_solver_snapshot(get(), out_image.data(), out_image.size(), &size);
    return detail::finish(code, size);
  }
  // The same as def says: without shapes that never change, say.
  returns<std::vector<std::uint8_t>> snapshot(const snapshot_def &def) const {
    std::size_t size = 0;
    shx_result code = shx_solver_snapshot_with(get(), &def, nullptr, 0, &size);
    std::vector<std::uint8_t> image(size);
    if (code == SHX_OK)
      code = shx_solver_snapshot_with(get(), &def, image.data(), image.size(), &size);
    return detail::finish(code, std::move(image));
  }
  // The shapes that snapshots without shapes refer to. They serve all of these until a body is added.
  returns<std::vector<std::uint8_t>> snapshot_shapes() const {
    std::size_t size = 0;
    shx_result code = shx_solver_snapshot_shapes(get(), nullptr, 0, &size);
    std::vector<std::uint8_t> image(size);
    if (code == SHX_OK)
      code = shx_solver_snapshot_shapes(get(), image.data(), image.size(), &size);
    return detail::finish(code, std::move(image));
  }
  // Puts the solver into the state of an image, with its options or the solver's own, and shapes that the image refers to.
  returns<void> restore(span<const std::uint8_t> image, const restore_def &def) {
    return detail::finish(shx_solver_restore_with(get(), image.data(), image.size(), &def));
  }
  // Puts the solver into the state of an image, options included. Stepping on gives the same bits as it did then.
  returns<void> restore(span<const std::uint8_t> image) { return detail::finish(shx_solver_restore(get(), image.data(), image.size())); }

  // Equal states give equal hashes.
  returns<std::uint64_t> state_hash() const {
    std::uint64_t hash = 0;
    const shx_result code = shx_solver_state_hash(get(), &hash);
    return detail::finish(code, hash);
  }

  // A number of the host's own, at any time, also in callbacks.
  returns<std::uint64_t> get_own_user_data() const {
    std::uint64_t number = 0;
    const shx_result code = shx_solver_get_own_user_data(get(), &number);
    return detail::finish(code, number);
  }
  returns<void> set_own_user_data(std::uint64_t number) { return detail::finish(shx_solver_set_own_user_data(get(), number)); }

  // Bytes of memory that the solver holds.
  returns<std::uint64_t> memory_usage() const {
    std::uint64_t bytes = 0;
    const shx_result code = shx_solver_memory_usage(get(), &bytes);
    return detail::finish(code, bytes);
  }

 private:
  solver(shx_solver *raw, const solver_def &def) : loop_(def.loop()), receiver_(def.receiver()), handle_(raw) {}

  // Declared before the handle, so that the callbacks outlive it.
  std::shared_ptr<void> loop_, receiver_, wind_;
  handle_detail::handle<shx_solver, shx_solver_destroy> handle_;
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_SOLVER_HPP
