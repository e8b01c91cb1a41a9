// Contact of strands with bodies and with each other.
#ifndef SUPERHELIX_SOLVER_CONTACT_HPP
#define SUPERHELIX_SOLVER_CONTACT_HPP

#include "../definitions.hpp"

#include <optional>
#include <vector>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

// How much a strand may overlap at material points along it: arclengths (m), what is left of the wisp's radius (0 to 1), how deep in a body (m).
struct permitted_overlap {
  std::vector<double> arclengths, wisp_fractions, body_depths;
};

// How many events of contacts were drained, and how many were lost for want of room.
struct drained_events {
  std::size_t count;
  std::uint64_t lost;
};

template <class Solver>
class solver_contact {
  shx_solver *raw() const noexcept { return static_cast<const Solver *>(this)->get(); }

 public:
  returns<void> set_contact_options(const contact_options &options) {
    return detail::finish(shx_solver_set_contact_options(raw(), &options));
  }
  returns<contact_options> get_contact_options() const {
    contact_options options;
    const shx_result code = shx_solver_get_contact_options(raw(), &options);
    return detail::finish(code, options);
  }

  // The contact parameters of strands: one for all, or one for each.
  returns<void> set_strand_contact(span<const strand_id> ids, span<const strand_contact> contacts) {
    detail::sizes sizes("set_strand_contact");
    if (contacts.size() != 1 && sizes.exactly("contacts", contacts.size(), ids.size()).wrong())
      return sizes.failure<void>();
    const std::size_t stride = contacts.size() == 1 ? 0 : sizeof(strand_contact);
    return detail::finish(shx_solver_set_strand_contact(raw(), ids.data(), ids.size(), contacts.data(), stride));
  }
  // Strands contact nothing from now on, which is how they begin.
  returns<void> clear_strand_contact(span<const strand_id> ids) {
    return detail::finish(shx_solver_set_strand_contact(raw(), ids.data(), ids.size(), nullptr, 0));
  }
  // The contact parameters of a strand; none without contact.
  returns<std::optional<strand_contact>> get_strand_contact(strand_id id) const {
    strand_contact contact;
    std::uint32_t touches = 0;
    const shx_result code = shx_solver_get_strand_contact(raw(), id, &contact, &touches);
    return detail::finish(code, touches != 0 ? std::optional<strand_contact>(contact) : std::optional<strand_contact>());
  }

  // How many contacts carried a force at the end of the last substep.
  returns<std::size_t> contact_count() const {
    std::size_t count = 0;
    const shx_result code = shx_solver_contact_count(raw(), &count);
    return detail::finish(code, count);
  }
  // Those contacts into out_contacts, and how many they are.
  returns<std::size_t> contacts(span<contact> out_contacts) const {
    std::size_t count = 0;
    const shx_result code = shx_solver_contacts(raw(), out_contacts.data(), sizeof(contact), out_contacts.size(), &count);
    return detail::finish(code, count);
  }
  returns<std::vector<contact>> contacts() const {
    std::size_t count = 0;
    shx_result code = shx_solver_contact_count(raw(), &count);
    std::vector<contact> all(count);
    if (code == SHX_OK && count > 0)
      code = shx_solver_contacts(raw(), all.data(), sizeof(contact), all.size(), &count);
    return detail::finish(code, std::move(all));
  }

  // Keeps up to capacity events of contacts that begin and end in steps; 0: none.
  returns<void> keep_contact_events(std::size_t capacity) { return detail::finish(shx_solver_keep_contact_events(raw(), capacity)); }
  // Moves the oldest events into out_events. How many they are, and how many found no room since the last call.
  returns<drained_events> drain_contact_events(span<contact_event> out_events) {
    drained_events drained{};
    const shx_result code = shx_solver_drain_contact_events(raw(), out_events.data(), sizeof(contact_event), out_events.size(),
                                                            &drained.count, &drained.lost);
    return detail::finish(code, drained);
  }

  // How deep strands are in others and in bodies as they are now. Outputs, each for one strand, are empty where they are not wanted.
  returns<void> overlaps(span<const strand_id> ids, span<double> out_hair_depths, span<strand_id> out_strands = {},
                         span<double> out_body_depths = {}, span<body_id> out_bodies = {}) {
    detail::sizes sizes("overlaps");
    sizes.optional("out_hair_depths", out_hair_depths.size(), ids.size()).optional("out_strands", out_strands.size(), ids.size());
    sizes.optional("out_body_depths", out_body_depths.size(), ids.size()).optional("out_bodies", out_bodies.size(), ids.size());
    if (sizes.wrong())
      return sizes.failure<void>();
    return detail::finish(shx_solver_overlaps(raw(), ids.data(), ids.size(), out_hair_depths.data(), out_strands.data(),
                                              out_body_depths.data(), out_bodies.data()));
  }

  // Permits strands what they overlap now, so that the groom rests as it is drawn.
  returns<void> permit_overlaps(span<const strand_id> ids) {
    return detail::finish(shx_solver_permit_overlaps(raw(), ids.data(), ids.size()));
  }
  returns<void> set_permitted_overlap(strand_id id, const permitted_overlap &overlap) {
    detail::sizes sizes("set_permitted_overlap");
    sizes.exactly("wisp_fractions", overlap.wisp_fractions.size(), overlap.arclengths.size());
    if (sizes.exactly("body_depths", overlap.body_depths.size(), overlap.arclengths.size()).wrong())
      return sizes.failure<void>();
    return detail::finish(shx_solver_set_permitted_overlap(raw(), id, overlap.arclengths.data(), overlap.wisp_fractions.data(),
                                                           overlap.body_depths.data(), overlap.arclengths.size()));
  }
  returns<permitted_overlap> get_permitted_overlap(strand_id id) const {
    std::size_t count = 0;
    permitted_overlap overlap;
    shx_result code = shx_solver_get_permitted_overlap(raw(), id, nullptr, nullptr, nullptr, 0, &count);
    if (code == SHX_OK && count > 0) {
      overlap.arclengths.resize(count);
      overlap.wisp_fractions.resize(count);
      overlap.body_depths.resize(count);
      code = shx_solver_get_permitted_overlap(raw(), id, overlap.arclengths.data(), overlap.wisp_fractions.data(),
                                              overlap.body_depths.data(), count, &count);
    }
    return detail::finish(code, std::move(overlap));
  }

  // Brings curves that are drawn inside a body out of it: points, world, m, are changed in place. Outputs, each for one curve, are empty where they are
  // not wanted.
  returns<void> push_out_curves(const push_out_def &def, span<vec3> points, span<double> out_depths = {}, span<double> out_displacements = {},
                                span<std::uint32_t> out_stuck = {}) {
    std::size_t total = 0;
    for (std::size_t i = 0; def.point_counts != nullptr && i < def.curve_count; i++)
      total += def.point_counts[i];
    detail::sizes sizes("push_out_curves");
    sizes.exactly("points", points.size(), total).optional("out_depths", out_depths.size(), def.curve_count);
    sizes.optional("out_displacements", out_displacements.size(), def.curve_count);
    if (sizes.optional("out_stuck", out_stuck.size(), def.curve_count).wrong())
      return sizes.failure<void>();
    return detail::finish(shx_solver_push_out_curves(raw(), &def, points.empty() ? nullptr : points.data()->data(), out_depths.data(),
                                                     out_displacements.data(), out_stuck.data()));
  }
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_SOLVER_CONTACT_HPP
