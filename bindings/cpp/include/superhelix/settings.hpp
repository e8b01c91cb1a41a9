// The library's version, settings by preset or by error, numbers of elements, kinds of hair, wisps.
#ifndef SUPERHELIX_SETTINGS_HPP
#define SUPERHELIX_SETTINGS_HPP

#include "definitions.hpp"

#include <string>
#include <vector>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

// The version of the library that runs, in the form of SHX_VERSION.
inline std::uint32_t version() noexcept { return shx_version(); }
// The binary interface of the library that runs: check at the start that it equals SHX_ABI_VERSION.
inline std::uint32_t abi_version() noexcept { return shx_abi_version(); }
// One line for bug reports.
inline const char *build_info() noexcept { return shx_build_info(); }

// The settings of a preset for hair of a natural curvature (rad/m) and length (m), and frames of frame_time seconds.
inline returns<settings> settings_from_preset(preset::type which, double natural_curvature, double length, double frame_time) {
  settings chosen;
  const shx_result code = shx_settings_from_preset(which, natural_curvature, length, frame_time, &chosen);
  return detail::finish(code, chosen);
}
// The cheapest settings that were measured to err by no more than target_error, in units of the strand's length.
inline returns<settings> suggest_settings(double target_error, double natural_curvature, double length, double frame_time) {
  settings chosen;
  const shx_result code = shx_settings_suggest(target_error, natural_curvature, length, frame_time, &chosen);
  return detail::finish(code, chosen);
}

// The least number of elements for which a strand meets a tolerance.
inline returns<suggestion> suggest_elements(const strand_def &strand, const suggest_def &demand = {}) {
  suggestion found;
  const shx_result code = shx_suggest_elements(&strand, &demand, &found);
  return detail::finish(code, found);
}

// The measurements of a hair type: "asian", "caucasian1", "caucasian2", "african", "h1", "h2", "ga1", "gc3".
inline returns<hair_type> hair_type_from_name(const std::string &name) {
  hair_type hair;
  const shx_result code = shx_hair_type_from_name(name.c_str(), &hair);
  return detail::finish(code, hair);
}

// Strands of a kind of hair: what each is made of, and natural curvatures, a row for each element, strand after strand.
struct hair_strands {
  std::vector<hair_strand> strands;
  std::vector<curvature> curvatures;
};
inline returns<hair_strands> make_hair_strands(const hair_strands_def &def) {
  std::size_t rows = 0;
  for (std::size_t i = 0; def.element_counts != nullptr && i < def.strand_count; i++)
    rows += def.element_counts[i];
  detail::sizes sizes("make_hair_strands");
  if (sizes.exactly("element_lengths", def.element_length_count(), rows).wrong())
    return sizes.failure<hair_strands>();
  hair_strands made;
  made.strands.resize(def.strand_count);
  made.curvatures.resize(rows);
  const shx_result code = shx_hair_strands(&def, made.strands.data(), sizeof(hair_strand), detail::rows(span<curvature>(made.curvatures)), rows);
  return detail::finish(code, std::move(made));
}

// The rod that moves as a wisp of hairs does: its material, the radius within which the hairs lie (m), and the margin for stiffen_strands.
struct wisp_rod {
  superhelix::material material;
  double radius = 0.0, margin = 0.0;
};
inline returns<wisp_rod> wisp_material(const wisp &bundle, const material &hair) {
  wisp_rod rod;
  const shx_result code = shx_wisp_material(&bundle, &hair, &rod.material, &rod.radius, &rod.margin);
  return detail::finish(code, rod);
}

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_SETTINGS_HPP
