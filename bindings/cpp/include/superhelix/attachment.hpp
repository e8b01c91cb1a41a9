// Rigid attachments: roots, bodies and targets of constraints that follow one pose.
#ifndef SUPERHELIX_ATTACHMENT_HPP
#define SUPERHELIX_ATTACHMENT_HPP

#include "solver.hpp"

namespace superhelix {
inline namespace SUPERHELIX_WAY {

// What follows one pose, for example all that belongs to a head. It moves and is not copied.
class attachment {
 public:
  // An empty one, to move another into.
  attachment() = default;
  // Attaches what there is now to something that is at pose now.
  static returns<attachment> create(const solver &hair, const frame &pose, span<const strand_id> strands, span<const body_id> bodies = {},
                                    span<const constraint_id> constraints = {}) {
    shx_attachment *made = nullptr;
    const shx_result code = shx_attachment_create(hair.get(), &pose, strands.data(), strands.size(), bodies.data(), bodies.size(),
                                                  constraints.data(), constraints.size(), &made);
    return detail::finish(code, attachment(made));
  }

  // Moves all smoothly to where it is when its carrier is at pose, over the next over_seconds of simulated time.
  returns<void> move(solver &hair, const frame &pose, double over_seconds) const {
    return detail::finish(shx_attachment_move(get(), hair.get(), &pose, over_seconds));
  }
  // Puts all there at once.
  returns<void> teleport(solver &hair, const frame &pose) const { return detail::finish(shx_attachment_teleport(get(), hair.get(), &pose)); }

  shx_attachment *get() const noexcept { return handle_.get(); }
  explicit operator bool() const noexcept { return static_cast<bool>(handle_); }

 private:
  explicit attachment(shx_attachment *raw) : handle_(raw) {}

  handle_detail::handle<shx_attachment, shx_attachment_destroy> handle_;
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_ATTACHMENT_HPP
