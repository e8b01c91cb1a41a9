// Shapes of strands: curvatures, static rest, natural and rest shapes.
#ifndef SUPERHELIX_SOLVER_SHAPES_HPP
#define SUPERHELIX_SOLVER_SHAPES_HPP

#include "../definitions.hpp"

#include <vector>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

template <class Solver>
class solver_shapes {
  shx_solver *raw() const noexcept { return static_cast<const Solver *>(this)->get(); }

 public:
  // Sets the natural curvatures of a strand, a row for each element.
  returns<void> set_natural_curvatures(strand_id id, span<const curvature> curvatures) {
    return detail::finish(shx_solver_set_natural_curvatures(raw(), id, detail::rows(curvatures), curvatures.size()));
  }
  returns<void> get_natural_curvatures(strand_id id, span<curvature> out_curvatures) const {
    return detail::finish(shx_solver_get_natural_curvatures(raw(), id, detail::rows(out_curvatures), out_curvatures.size()));
  }

  // Sets the present curvatures of a strand, and their rates, rad/(m s); no rates: 0.
  returns<void> set_curvatures(strand_id id, span<const curvature> curvatures, span<const curvature> rates = {}) {
    detail::sizes sizes("set_curvatures");
    if (!rates.empty() && sizes.exactly("rates", rates.size(), curvatures.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(shx_solver_set_curvatures(raw(), id, detail::rows(curvatures), detail::rows(rates), curvatures.size()));
  }
  // The present curvatures of a strand and their rates. One that is not wanted is empty.
  returns<void> get_curvatures(strand_id id, span<curvature> out_curvatures, span<curvature> out_rates = {}) const {
    detail::sizes sizes("get_curvatures");
    if (!out_rates.empty() && !out_curvatures.empty() && sizes.exactly("out_rates", out_rates.size(), out_curvatures.size()).wrong())
      return sizes.failure<void>();
    const std::size_t count = out_curvatures.empty() ? out_rates.size() : out_curvatures.size();
    return detail::finish(shx_solver_get_curvatures(raw(), id, detail::rows(out_curvatures), detail::rows(out_rates), count));
  }

  // The present curvatures of strands, a row for each element, strand after strand.
  returns<void> get_shapes(span<const strand_id> ids, span<curvature> out_curvatures) const {
    return detail::finish(shx_solver_get_shapes(raw(), ids.data(), ids.size(), detail::rows(out_curvatures), out_curvatures.size()));
  }
  // Puts strands into shapes that get_shapes gave, at rest relative to their roots.
  returns<void> set_shapes(span<const strand_id> ids, span<const curvature> curvatures) {
    return detail::finish(shx_solver_set_shapes(raw(), ids.data(), ids.size(), detail::rows(curvatures), curvatures.size()));
  }

  // Puts strands at rest in their static equilibrium under gravity. Outputs, each for one strand, are empty where they are not wanted.
  returns<settle_report> settle(span<const strand_id> ids, const settle_def &def = {}, span<shx_strand_status> out_status = {},
                                span<double> out_eigenvalues = {}, span<double> out_residuals = {}) {
    detail::sizes sizes("settle");
    sizes.optional("out_status", out_status.size(), ids.size()).optional("out_eigenvalues", out_eigenvalues.size(), ids.size());
    if (sizes.optional("out_residuals", out_residuals.size(), ids.size()).wrong())
      return sizes.failure<settle_report>();
    settle_report report;
    const shx_result code = shx_solver_settle(raw(), ids.data(), ids.size(), &def, &report, out_status.data(), out_eigenvalues.data(),
                                              out_residuals.data());
    return detail::finish(code, report);
  }

  // Makes the present shapes of strands their natural ones.
  returns<void> adopt_natural_shapes(span<const strand_id> ids) {
    return detail::finish(shx_solver_adopt_natural_shapes(raw(), ids.data(), ids.size()));
  }
  // Makes the present shapes of strands those in which they rest under gravity.
  returns<void> adopt_rest_shapes(span<const strand_id> ids) {
    return detail::finish(shx_solver_adopt_rest_shapes(raw(), ids.data(), ids.size()));
  }

  // How firmly strands would rest in their present shapes: smallest eigenvalues, and the factors on Young's modulus and on the radii that bring them
  // to margin. Outputs are empty where they are not wanted.
  returns<void> shape_stability(span<const strand_id> ids, double margin, span<double> out_eigenvalues, span<double> out_youngs_scales = {},
                                span<double> out_radius_scales = {}) const {
    detail::sizes sizes("shape_stability");
    sizes.optional("out_eigenvalues", out_eigenvalues.size(), ids.size());
    sizes.optional("out_youngs_scales", out_youngs_scales.size(), ids.size());
    if (sizes.optional("out_radius_scales", out_radius_scales.size(), ids.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(shx_solver_shape_stability(raw(), ids.data(), ids.size(), margin, out_eigenvalues.data(),
                                                     out_youngs_scales.data(), out_radius_scales.data()));
  }
  // Makes strands that would not rest stably as much stiffer as that takes, and adopts all their shapes as rest shapes. out_scales: the factors.
  returns<void> stiffen_strands(span<const strand_id> ids, stiffen_by::type by, double margin, span<double> out_scales = {}) {
    detail::sizes sizes("stiffen_strands");
    if (sizes.optional("out_scales", out_scales.size(), ids.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(shx_solver_stiffen_strands(raw(), ids.data(), ids.size(), by, margin, out_scales.data()));
  }
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_SOLVER_SHAPES_HPP
