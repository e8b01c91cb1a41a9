// Strands fitted to curves, splines, friction fitted to recordings.
#ifndef SUPERHELIX_FIT_HPP
#define SUPERHELIX_FIT_HPP

#include "definitions.hpp"

#include <vector>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

namespace detail {

// Elements to make room for. Where more are asked for than a strand can have, the library says so.
inline std::uint32_t room_for(std::uint32_t element_count) noexcept {
  const std::uint32_t most = 100000;
  return element_count < most ? element_count : most;
}

}  // namespace detail

// A strand fitted to a polyline.
struct fitted_polyline {
  polyline_fit fit;
  std::vector<double> element_lengths;
  std::vector<curvature> curvatures;
};

// Fits a strand of element_count elements to a polyline in metres, root first.
inline returns<fitted_polyline> fit_polyline(const input &polyline, std::uint32_t element_count) {
  fitted_polyline fitted;
  fitted.element_lengths.resize(detail::room_for(element_count));
  fitted.curvatures.resize(detail::room_for(element_count));
  const shx_result code = shx_fit_polyline(&polyline, element_count, &fitted.fit, fitted.element_lengths.data(),
                                           detail::rows(span<curvature>(fitted.curvatures)), fitted.curvatures.size());
  return detail::finish(code, std::move(fitted));
}

// Natural curvatures for which a strand of this definition hangs still under gravity in the shape of curvatures.
inline returns<std::vector<curvature>> sag_free_curvatures(const strand_def &def, span<const curvature> curvatures, const vec3 &gravity) {
  std::vector<curvature> natural(curvatures.size());
  const shx_result code = shx_sag_free_curvatures(&def, detail::rows(curvatures), curvatures.size(), gravity.data(),
                                                  detail::rows(span<curvature>(natural)));
  return detail::finish(code, std::move(natural));
}

// Strands fitted to many curves. Those whose result is not SHX_OK could not be fitted.
class fitted_strands {
 public:
  fitted_strands(std::size_t count, std::uint32_t most) : strands_(count), most_(most), lengths_(count * most), curvatures_(count * most) {}

  std::size_t size() const noexcept { return strands_.size(); }
  const fitted_strand &operator[](std::size_t index) const noexcept { return strands_[index]; }
  bool ok(std::size_t index) const noexcept { return strands_[index].result == SHX_OK; }
  span<const double> element_lengths(std::size_t index) const noexcept {
    return span<const double>(lengths_).subspan(index * most_, strands_[index].element_count);
  }
  span<const curvature> curvatures(std::size_t index) const noexcept {
    return span<const curvature>(curvatures_).subspan(index * most_, strands_[index].element_count);
  }

  // Puts a fitted strand into a definition, which then points to it: this must live until the definition has been used.
  returns<void> apply(std::size_t index, strand_def &def) const {
    return detail::finish(shx_strand_def_set_fit(&def, &strands_[index], lengths_.data() + index * most_, curvatures_[index * most_].data()));
  }

 private:
  friend returns<fitted_strands> fit_strands(const fit_input &, const fit_options &);
  std::vector<fitted_strand> strands_;
  std::size_t most_;
  std::vector<double> lengths_;
  std::vector<curvature> curvatures_;
};

// Fits a strand to each of many curves. One that cannot be fitted leaves the others alone.
inline returns<fitted_strands> fit_strands(const fit_input &curves, const fit_options &options = {}) {
  fitted_strands fitted(curves.curve_count, detail::room_for(options.element_count));
  const shx_result code = shx_fit_strands(&options, &curves, fitted.strands_.data(), sizeof(fitted_strand), fitted.lengths_.data(),
                                          detail::rows(span<curvature>(fitted.curvatures_)), fitted.lengths_.size());
  return detail::finish(code, std::move(fitted));
}

// Points of a cubic curve, and the arclength of each.
struct spline_points {
  std::vector<vec3> points;
  std::vector<double> arclengths;
};
inline returns<spline_points> sample_spline(const spline_def &def) {
  std::size_t count = 0;
  spline_points made;
  shx_result code = shx_spline_points(&def, nullptr, nullptr, &count);
  if (code == SHX_OK) {
    made.points.resize(count);
    made.arclengths.resize(count);
    const output room(made.points);
    code = shx_spline_points(&def, &room, made.arclengths.data(), &count);
  }
  return detail::finish(code, std::move(made));
}

// Fits friction coefficients of a strand to a recorded curve: values at times, s. out_curve, where it is not empty: the best curve, of as many values.
inline returns<friction_fit_report> fit_friction(const strand_def &strand, const friction_fit_def &def, span<const double> times,
                                                 span<const double> values, const solver_def &solver = {}, span<double> out_curve = {}) {
  detail::sizes sizes("fit_friction");
  sizes.exactly("values", values.size(), times.size());
  if (sizes.optional("out_curve", out_curve.size(), times.size()).wrong())
    return sizes.failure<friction_fit_report>();
  friction_fit_report report;
  const shx_result code =
      shx_fit_friction(&solver, &strand, &def, times.data(), values.data(), times.size(), &report, out_curve.data());
  return detail::finish(code, report);
}

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_FIT_HPP
