// Strands posed by hand: dragged, brushed, changed, cut, grown, mirrored.
#ifndef SUPERHELIX_SOLVER_POSING_HPP
#define SUPERHELIX_SOLVER_POSING_HPP

#include "../definitions.hpp"

#include <optional>
#include <vector>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

template <class Solver>
class solver_posing {
  shx_solver *raw() const noexcept { return static_cast<const Solver *>(this)->get(); }

 public:
  // Drags the point at arclengths[i] of strand ids[i] to targets[i]. out_distances: how far each point is from its target afterwards, m.
  returns<void> drag_strands(span<const strand_id> ids, span<const double> arclengths, const input &targets, const pose_options &options = {},
                             span<double> out_distances = {}) {
    detail::sizes sizes("drag_strands");
    sizes.exactly("arclengths", arclengths.size(), ids.size());
    if (sizes.optional("out_distances", out_distances.size(), ids.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(
        shx_solver_drag_strands(raw(), ids.data(), ids.size(), arclengths.data(), &targets, &options, out_distances.data()));
  }

  // Moves a brush over strands. out_touched: 1 for each strand with a point in the brush; out_distances: how far those are from where they were to go.
  returns<void> brush_strands(span<const strand_id> ids, const brush &stroke, const pose_options &options = {},
                              span<std::uint8_t> out_touched = {}, span<double> out_distances = {}) {
    detail::sizes sizes("brush_strands");
    sizes.optional("out_touched", out_touched.size(), ids.size());
    if (sizes.optional("out_distances", out_distances.size(), ids.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(
        shx_solver_brush_strands(raw(), ids.data(), ids.size(), &stroke, &options, out_touched.data(), out_distances.data()));
  }

  // Twists, bends and lengthens an element of each strand: changes[i] is for ids[i].
  returns<void> change_elements(span<const strand_id> ids, span<const element_change> changes) {
    detail::sizes sizes("change_elements");
    if (sizes.exactly("changes", changes.size(), ids.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(shx_solver_change_elements(raw(), ids.data(), ids.size(), changes.data(), sizeof(element_change)));
  }

  // Cuts strand ids[i] at arclengths[i], m from the root.
  returns<void> cut_strands(span<const strand_id> ids, span<const double> arclengths) {
    detail::sizes sizes("cut_strands");
    if (sizes.exactly("arclengths", arclengths.size(), ids.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(shx_solver_cut_strands(raw(), ids.data(), ids.size(), arclengths.data()));
  }

  // Lets strands grow at their tips by length, m: on element_count new elements (0: the last one becomes longer) of the given curvature (none: the
  // helix goes on).
  returns<void> grow_strands(span<const strand_id> ids, double length, std::uint32_t element_count = 0,
                             const std::optional<curvature> &curvatures = {}) {
    const double *row = curvatures ? curvatures->data() : nullptr;
    return detail::finish(shx_solver_grow_strands(raw(), ids.data(), ids.size(), length, element_count, row));
  }

  // Adds the images of strands in the mirror through point across normal; their ids come in the order of ids.
  returns<std::vector<strand_id>> mirror_strands(span<const strand_id> ids, const vec3 &point, const vec3 &normal) {
    std::vector<strand_id> images(ids.size());
    const shx_result code = shx_solver_mirror_strands(raw(), ids.data(), ids.size(), point.data(), normal.data(), images.data());
    return detail::finish(code, std::move(images));
  }
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_SOLVER_POSING_HPP
