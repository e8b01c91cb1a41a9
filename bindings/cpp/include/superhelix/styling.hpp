// Styling tools and hair handle: where the bodies of tools are, combs whose teeth hold strands, what a hand feels of hair.
#ifndef SUPERHELIX_STYLING_HPP
#define SUPERHELIX_STYLING_HPP

#include "definitions.hpp"
#include "handle.hpp"
#include "solver.hpp"

#include <string>
#include <vector>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

// Where the bodies of a tool are when it is at a frame, in the order of solver::add_tool. opening: distance between the faces of plates, m.
inline returns<std::vector<frame>> tool_frames(const tool_def &def, const frame &at, double opening = 0.0) {
  std::size_t count = 0;
  shx_result code = shx_tool_frames(&def, &at, opening, nullptr, 0, &count);
  std::vector<frame> frames(count);
  if (code == SHX_OK)
    code = shx_tool_frames(&def, &at, opening, frames.data(), frames.size(), &count);
  return detail::finish(code, std::move(frames));
}
// Half the edges of the box in which plates or a barrel heat hair, m, along the axes of the tool.
inline returns<vec3> tool_hot_box(const tool_def &def, double opening = 0.0) {
  vec3 half_edges{};
  const shx_result code = shx_tool_hot_box(&def, opening, half_edges.data());
  return detail::finish(code, half_edges);
}

// What a hand feels of a measured type of hair, by the names of hair_type_from_name.
inline returns<hair_handle> hair_handle_from_name(const std::string &name) {
  hair_handle handle;
  const shx_result code = shx_hair_handle_from_name(name.c_str(), &handle);
  return detail::finish(code, handle);
}
// The same with two sliders moved, each from -1 to 1.
inline returns<hair_handle> adjust_hair_handle(const hair_handle &handle, double curliness, double combing_ease) {
  hair_handle moved;
  const shx_result code = shx_hair_handle_adjust(&handle, curliness, combing_ease, &moved);
  return detail::finish(code, moved);
}
// The type of hair that has this handle.
inline returns<hair_type> hair_handle_to_type(const hair_handle &handle) {
  hair_type hair;
  const shx_result code = shx_hair_handle_to_type(&handle, &hair);
  return detail::finish(code, hair);
}

// Force over stroke, step by step, and its summary.
struct combing_curve {
  std::vector<double> stroke, force, pressure;
  combing_result result{};
};
// Combs hair of this handle.
inline returns<combing_curve> run_combing_test(const hair_handle &handle, const combing_test &test = combing_test()) {
  combing_curve curve;
  // As many steps as its numbers say, and room for rounding.
  const double steps = test.stroke / test.speed * test.rate;
  const std::size_t room = steps > 0.0 && steps < 1e8 ? static_cast<std::size_t>(steps) + 4 : 4;
  curve.stroke.resize(room);
  curve.force.resize(room);
  curve.pressure.resize(room);
  const shx_result code =
      shx_combing_test_run(&test, &handle, curve.stroke.data(), curve.force.data(), curve.pressure.data(), room, &curve.result);
  const std::size_t count = static_cast<std::size_t>(curve.result.step_count);
  curve.stroke.resize(count);
  curve.force.resize(count);
  curve.pressure.resize(count);
  return detail::finish(code, std::move(curve));
}

// A comb whose teeth hold the strands that they run into until these are combed. It moves and is not copied.
class ring_comb {
 public:
  // An empty one, to move another into.
  ring_comb() = default;
  static returns<ring_comb> create(const tool_def &tool, const frame &at, const ring_comb_def &def = ring_comb_def()) {
    shx_ring_comb *made = nullptr;
    const shx_result code = shx_ring_comb_create(&tool, &at, &def, &made);
    return detail::finish(code, ring_comb(made));
  }
#if !SUPERHELIX_USE_RESULTS
  explicit ring_comb(const tool_def &tool, const frame &at, const ring_comb_def &def = ring_comb_def()) : ring_comb(create(tool, at, def)) {}
#endif

  // Before a step of dt seconds: the comb goes to a frame meanwhile, and catches those of ids that its teeth run into.
  returns<void> before_step(solver &hair, span<const strand_id> ids, const frame &to, double dt) {
    return detail::finish(shx_ring_comb_before_step(get(), hair.get(), ids.data(), ids.size(), &to, dt));
  }
  // After the step: lets go of what is combed or drawn at too hard.
  returns<ring_comb_report> after_step(solver &hair) {
    ring_comb_report report{};
    const shx_result code = shx_ring_comb_after_step(get(), hair.get(), &report);
    return detail::finish(code, report);
  }
  // Lets go of all strands.
  returns<void> release(solver &hair) { return detail::finish(shx_ring_comb_release(get(), hair.get())); }

  shx_ring_comb *get() const noexcept { return handle_.get(); }
  explicit operator bool() const noexcept { return static_cast<bool>(handle_); }

 private:
  explicit ring_comb(shx_ring_comb *raw) : handle_(raw) {}

  handle_detail::handle<shx_ring_comb, shx_ring_comb_destroy> handle_;
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_STYLING_HPP
