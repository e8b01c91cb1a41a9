// Constraints that hold points of strands.
#ifndef SUPERHELIX_SOLVER_CONSTRAINTS_HPP
#define SUPERHELIX_SOLVER_CONSTRAINTS_HPP

#include "../definitions.hpp"

#include <vector>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

template <class Solver>
class solver_constraints {
  shx_solver *raw() const noexcept { return static_cast<const Solver *>(this)->get(); }

 public:
  // Adds constraints, all or none; their ids come in the order of the definitions.
  returns<std::vector<constraint_id>> add_constraints(span<const constraint_def> defs) {
    std::vector<constraint_id> ids(defs.size());
    const shx_result code = shx_solver_add_constraints(raw(), defs.data(), sizeof(constraint_def), defs.size(), ids.data());
    return detail::finish(code, std::move(ids));
  }
  returns<constraint_id> add_constraint(const constraint_def &def) {
    constraint_id id{};
    const shx_result code = shx_solver_add_constraints(raw(), &def, sizeof(constraint_def), 1, &id);
    return detail::finish(code, id);
  }

  // Removes constraints, all or none. Their ids are stale from then on.
  returns<void> remove_constraints(span<const constraint_id> ids) {
    return detail::finish(shx_solver_remove_constraints(raw(), ids.data(), ids.size()));
  }

  // The number that constraint_def's user_data gave to a constraint.
  returns<std::uint64_t> get_constraint_user_data(constraint_id id) const {
    std::uint64_t number = 0;
    const shx_result code = shx_solver_get_constraint_user_data(raw(), id, &number);
    return detail::finish(code, number);
  }

  bool has_constraint(constraint_id id) const noexcept { return shx_solver_has_constraint(raw(), id); }

  returns<std::size_t> constraint_count() const {
    std::size_t count = 0;
    const shx_result code = shx_solver_constraint_count(raw(), &count);
    return detail::finish(code, count);
  }

  returns<std::vector<constraint_id>> constraint_ids() const {
    std::size_t count = 0;
    shx_result code = shx_solver_constraint_count(raw(), &count);
    std::vector<constraint_id> ids(count);
    if (code == SHX_OK)
      code = shx_solver_constraint_ids(raw(), ids.data(), ids.size());
    return detail::finish(code, std::move(ids));
  }

  // Moves targets smoothly to the given frames, one for each id, over the next over_seconds of simulated time.
  returns<void> set_constraint_targets(span<const constraint_id> ids, const input &frames, double over_seconds) {
    return detail::finish(shx_solver_set_constraint_targets(raw(), ids.data(), ids.size(), &frames, over_seconds));
  }
  // The targets as they are now: frames, or quaternions alone.
  returns<void> get_constraint_targets(span<const constraint_id> ids, const output &frames) const {
    return detail::finish(shx_solver_get_constraint_targets(raw(), ids.data(), ids.size(), &frames));
  }

  // What each constraint did in the last substep.
  returns<void> constraint_states(span<const constraint_id> ids, span<constraint_state> out_states) const {
    detail::sizes sizes("constraint_states");
    if (sizes.room("out_states", out_states.size(), ids.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(
        shx_solver_constraint_states(raw(), ids.data(), ids.size(), out_states.data(), sizeof(constraint_state)));
  }
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_SOLVER_CONSTRAINTS_HPP
