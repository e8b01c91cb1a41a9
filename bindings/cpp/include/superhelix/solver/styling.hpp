// Styling: tools as bodies, clips, scissors, heat, styles that are fixed.
#ifndef SUPERHELIX_SOLVER_STYLING_HPP
#define SUPERHELIX_SOLVER_STYLING_HPP

#include "../definitions.hpp"

#include <array>
#include <vector>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

template <class Solver>
class solver_styling {
  shx_solver *raw() const noexcept { return static_cast<const Solver *>(this)->get(); }

 public:
  // Adds the bodies of a tool at a frame. opening: distance between the faces of plates, m.
  returns<std::vector<body_id>> add_tool(const tool_def &def, const frame &at, double opening = 0.0) {
    std::size_t count = 0;
    shx_result code = shx_tool_frames(&def, &at, opening, nullptr, 0, &count);
    std::vector<body_id> ids(count);
    if (code == SHX_OK)
      code = shx_solver_add_tool(raw(), &def, &at, opening, ids.data(), ids.size(), &count);
    return detail::finish(code, std::move(ids));
  }

  // Closes a clip: the constraints that hold what is in its box. move_constraints moves it, remove_constraints opens it.
  returns<std::vector<constraint_id>> clip_strands(const clip_def &def, span<const strand_id> ids) {
    std::vector<constraint_id> held(ids.size());
    std::size_t count = 0;
    shx_result code = shx_solver_clip_strands(raw(), &def, ids.data(), ids.size(), held.data(), held.size(), &count);
    // A strand may lie in the box more than once.
    while (code == SHX_ERROR_BUFFER_TOO_SMALL) {
      held.resize(2 * held.size() + 1);
      code = shx_solver_clip_strands(raw(), &def, ids.data(), ids.size(), held.data(), held.size(), &count);
    }
    held.resize(count);
    return detail::finish(code, std::move(held));
  }

  // Moves targets over over_seconds as something rigid that goes from one frame to another.
  returns<void> move_constraints(span<const constraint_id> ids, const frame &from, const frame &to, double over_seconds) {
    return detail::finish(shx_solver_move_constraints(raw(), ids.data(), ids.size(), &from, &to, over_seconds));
  }

  // Cuts the strands that cross a blade, a quad of these corners in order, no shorter than min_length, m: what was cut.
  returns<std::vector<cut>> scissor_strands(span<const strand_id> ids, const std::array<vec3, 4> &corners, double min_length = 1e-3) {
    std::array<double, 12> blade{};
    for (std::size_t i = 0; i < blade.size(); i++)
      blade[i] = corners[i / 3][i % 3];
    std::vector<cut> cuts(ids.size());
    std::size_t count = 0;
    const shx_result code = shx_solver_scissor_strands(raw(), ids.data(), ids.size(), blade.data(), min_length, cuts.data(), &count);
    cuts.resize(count);
    return detail::finish(code, std::move(cuts));
  }

  // Heats strands for some seconds; returns the heated length of each, m.
  returns<std::vector<double>> heat_strands(const heat_def &def, span<const strand_id> ids, double seconds) {
    std::vector<double> heated(ids.size());
    const shx_result code = shx_solver_heat_strands(raw(), &def, ids.data(), ids.size(), seconds, heated.data());
    return detail::finish(code, std::move(heated));
  }

  // Fixes the style of strands; wakes them; which are frozen (1, else 0).
  returns<void> freeze_strands(span<const strand_id> ids) {
    return detail::finish(shx_solver_freeze_strands(raw(), ids.data(), ids.size()));
  }
  returns<void> wake_strands(span<const strand_id> ids) { return detail::finish(shx_solver_wake_strands(raw(), ids.data(), ids.size())); }
  returns<std::vector<std::uint8_t>> frozen_strands(span<const strand_id> ids) const {
    std::vector<std::uint8_t> frozen(ids.size());
    const shx_result code = shx_solver_frozen_strands(raw(), ids.data(), ids.size(), frozen.data());
    return detail::finish(code, std::move(frozen));
  }
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_SOLVER_STYLING_HPP
