// Strands of a solver: added, removed, asked how they are.
#ifndef SUPERHELIX_SOLVER_STRANDS_HPP
#define SUPERHELIX_SOLVER_STRANDS_HPP

#include "../definitions.hpp"

#include <vector>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

template <class Solver>
class solver_strands {
  shx_solver *raw() const noexcept { return static_cast<const Solver *>(this)->get(); }

 public:
  // Adds strands, all or none, and writes an id for each.
  returns<void> add_strands(span<const strand_def> defs, span<strand_id> out_ids) {
    detail::sizes sizes("add_strands");
    if (sizes.exactly("out_ids", out_ids.size(), defs.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(shx_solver_add_strands(raw(), defs.data(), sizeof(strand_def), defs.size(), out_ids.data()));
  }
  // Adds strands, all or none; their ids come in the order of the definitions.
  returns<std::vector<strand_id>> add_strands(span<const strand_def> defs) {
    std::vector<strand_id> ids(defs.size());
    const shx_result code = shx_solver_add_strands(raw(), defs.data(), sizeof(strand_def), defs.size(), ids.data());
    return detail::finish(code, std::move(ids));
  }
  returns<strand_id> add_strand(const strand_def &def) {
    strand_id id{};
    const shx_result code = shx_solver_add_strands(raw(), &def, sizeof(strand_def), 1, &id);
    return detail::finish(code, id);
  }

  // Removes strands, all or none. Their ids are stale from then on.
  returns<void> remove_strands(span<const strand_id> ids) {
    return detail::finish(shx_solver_remove_strands(raw(), ids.data(), ids.size()));
  }

  bool has_strand(strand_id id) const noexcept { return shx_solver_has_strand(raw(), id); }

  returns<std::size_t> strand_count() const {
    std::size_t count = 0;
    const shx_result code = shx_solver_strand_count(raw(), &count);
    return detail::finish(code, count);
  }

  // The ids of all strands, in the order they were added, into out_ids; strand_count() says how many.
  returns<void> strand_ids(span<strand_id> out_ids) const {
    return detail::finish(shx_solver_strand_ids(raw(), out_ids.data(), out_ids.size()));
  }
  returns<std::vector<strand_id>> strand_ids() const {
    std::size_t count = 0;
    shx_result code = shx_solver_strand_count(raw(), &count);
    std::vector<strand_id> ids(count);
    if (code == SHX_OK)
      code = shx_solver_strand_ids(raw(), ids.data(), ids.size());
    return detail::finish(code, std::move(ids));
  }

  returns<std::size_t> get_element_count(strand_id id) const {
    std::size_t count = 0;
    const shx_result code = shx_solver_get_element_count(raw(), id, &count);
    return detail::finish(code, count);
  }

  // The lengths of a strand's elements from root to tip, m.
  returns<void> get_element_lengths(strand_id id, span<double> out_lengths) const {
    return detail::finish(shx_solver_get_element_lengths(raw(), id, out_lengths.data(), out_lengths.size()));
  }
  returns<std::vector<double>> get_element_lengths(strand_id id) const {
    std::size_t count = 0;
    shx_result code = shx_solver_get_element_count(raw(), id, &count);
    std::vector<double> lengths(count);
    if (code == SHX_OK)
      code = shx_solver_get_element_lengths(raw(), id, lengths.data(), lengths.size());
    return detail::finish(code, std::move(lengths));
  }

  // The length of each strand, m.
  returns<void> strand_lengths(span<const strand_id> ids, span<double> out_lengths) const {
    detail::sizes sizes("strand_lengths");
    if (sizes.room("out_lengths", out_lengths.size(), ids.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(shx_solver_strand_lengths(raw(), ids.data(), ids.size(), out_lengths.data()));
  }

  // The number that strand_def's user_data gave to a strand.
  returns<std::uint64_t> get_user_data(strand_id id) const {
    std::uint64_t number = 0;
    const shx_result code = shx_solver_get_user_data(raw(), id, &number);
    return detail::finish(code, number);
  }

  // The status of each strand after the last step: SHX_STRAND_CONVERGED, _UNCONVERGED or _QUARANTINED.
  returns<void> strand_status(span<const strand_id> ids, span<shx_strand_status> out_status) const {
    detail::sizes sizes("strand_status");
    if (sizes.room("out_status", out_status.size(), ids.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(shx_solver_strand_status(raw(), ids.data(), ids.size(), out_status.data()));
  }
  returns<shx_strand_status> strand_status(strand_id id) const {
    shx_strand_status status = SHX_STRAND_CONVERGED;
    const shx_result code = shx_solver_strand_status(raw(), &id, 1, &status);
    return detail::finish(code, status);
  }

  // Newton's iterations of each strand in the last substep.
  returns<void> strand_iterations(span<const strand_id> ids, span<std::uint32_t> out_iterations) const {
    detail::sizes sizes("strand_iterations");
    if (sizes.room("out_iterations", out_iterations.size(), ids.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(shx_solver_strand_iterations(raw(), ids.data(), ids.size(), out_iterations.data()));
  }

  // How many quadrature points integrate the elements of each strand, and the relative error of the most turned element.
  returns<void> strand_quadrature(span<const strand_id> ids, span<std::uint32_t> out_points, span<double> out_errors) const {
    detail::sizes sizes("strand_quadrature");
    if (sizes.room("out_points", out_points.size(), ids.size()).room("out_errors", out_errors.size(), ids.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(shx_solver_strand_quadrature(raw(), ids.data(), ids.size(), out_points.data(), out_errors.data()));
  }

  // The largest angle by which an element of each strand turns, rad. Above pi/2 a strand moves too stiffly: give it more elements.
  returns<void> strand_turning_angles(span<const strand_id> ids, span<double> out_angles) const {
    detail::sizes sizes("strand_turning_angles");
    if (sizes.room("out_angles", out_angles.size(), ids.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(shx_solver_strand_turning_angles(raw(), ids.data(), ids.size(), out_angles.data()));
  }

  // Energies of each strand, J. An output that is not wanted is empty.
  returns<void> strand_energies(span<const strand_id> ids, span<double> out_kinetic, span<double> out_elastic = {},
                                span<double> out_gravity = {}) const {
    detail::sizes sizes("strand_energies");
    sizes.optional("out_kinetic", out_kinetic.size(), ids.size()).optional("out_elastic", out_elastic.size(), ids.size());
    if (sizes.optional("out_gravity", out_gravity.size(), ids.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(shx_solver_strand_energies(raw(), ids.data(), ids.size(), out_kinetic.data(), out_elastic.data(), out_gravity.data()));
  }

  // Puts strands back to their natural curvatures, at rest relative to their roots, and clears a quarantine.
  returns<void> reset_strands(span<const strand_id> ids) {
    return detail::finish(shx_solver_reset_strands(raw(), ids.data(), ids.size()));
  }

  // Changes sections and materials of living strands: one for all, or one for each.
  returns<void> set_materials(span<const strand_id> ids, span<const material> materials) {
    return detail::finish(
        shx_solver_set_materials(raw(), ids.data(), ids.size(), materials.data(), sizeof(material), materials.size()));
  }
  returns<material> get_material(strand_id id) const {
    material now;
    const shx_result code = shx_solver_get_material(raw(), id, &now);
    return detail::finish(code, now);
  }

  // Puts strands on another number of elements as they are. out_distances: how far each curve has moved at most, m.
  returns<void> set_element_count(span<const strand_id> ids, std::uint32_t element_count, span<double> out_distances = {}) {
    detail::sizes sizes("set_element_count");
    if (sizes.optional("out_distances", out_distances.size(), ids.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(shx_solver_set_element_count(raw(), ids.data(), ids.size(), element_count, out_distances.data()));
  }
  // Puts a strand on elements of given lengths, m, and returns how far its curve has moved at most, m.
  returns<double> set_element_lengths(strand_id id, span<const double> lengths) {
    double distance = 0.0;
    const shx_result code = shx_solver_set_element_lengths(raw(), id, lengths.data(), lengths.size(), &distance);
    return detail::finish(code, distance);
  }
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_SOLVER_STRANDS_HPP
