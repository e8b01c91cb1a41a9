// Render hair: many strands that follow a few guides.
#ifndef SUPERHELIX_RENDER_HAIR_HPP
#define SUPERHELIX_RENDER_HAIR_HPP

#include "definitions.hpp"
#include "handle.hpp"

#include <vector>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

class render_hair;

// Where the guides of render hair are at one moment. Keep one for each moment that is needed at the same time.
class render_pose {
 public:
  // An empty one, to move another into; render_hair::create_pose makes them.
  render_pose() = default;

  // Where the guides are, in the number and order of the hair.
  returns<void> set_guides(const render_guides &guides) { return detail::finish(shx_render_pose_set_guides(get(), &guides)); }

  // Evaluates all render strands: item i * points_per_strand + j of each output is point j of strand i. frames: quaternions in four floats, or unit
  // tangents in three.
  returns<void> evaluate(const output &points, const output &frames = {}, const output &velocities = {}) const {
    return detail::finish(
        shx_render_pose_evaluate(get(), nullptr, detail::wanted(points), detail::wanted(frames), detail::wanted(velocities)));
  }
  // Those that view asks for.
  returns<void> evaluate(const render_view &view, const output &points, const output &frames = {}, const output &velocities = {}) const {
    return detail::finish(
        shx_render_pose_evaluate(get(), &view, detail::wanted(points), detail::wanted(frames), detail::wanted(velocities)));
  }

  shx_render_pose *get() const noexcept { return handle_.get(); }
  explicit operator bool() const noexcept { return static_cast<bool>(handle_); }

 private:
  friend class render_hair;
  render_pose(shx_render_pose *raw, std::shared_ptr<void> loop) : loop_(std::move(loop)), handle_(raw) {}

  std::shared_ptr<void> loop_;
  handle_detail::handle<shx_render_pose, shx_render_pose_destroy> handle_;
};

// Which guides each render strand follows, and how. It never changes: any threads may use it at the same time.
class render_hair {
 public:
  // An empty one, to move another into.
  render_hair() = default;
  // Takes over what the C functions made. loop: render_settings::loop() of its settings.
  explicit render_hair(shx_render_hair *raw, std::shared_ptr<void> loop = {}) : loop_(std::move(loop)), handle_(raw) {}

  // From guides in their rest pose and the render strands' roots at the same moment. With a solver: solver::create_render_hair.
  static returns<render_hair> create(const render_settings &settings, const render_guides &guides, const input &roots) {
    shx_render_hair *made = nullptr;
    const shx_result code = shx_render_hair_create(&settings, &guides, &roots, &made);
    return detail::finish(code, render_hair(made, settings.loop()));
  }
  // From the bytes of save. Of settings only worker_count and parallel_for count.
  static returns<render_hair> load(span<const std::uint8_t> image, const render_settings &settings = {}) {
    shx_render_hair *made = nullptr;
    const shx_result code = shx_render_hair_load(image.data(), image.size(), &settings, &made);
    return detail::finish(code, render_hair(made, settings.loop()));
  }
  returns<std::vector<std::uint8_t>> save() const {
    std::size_t size = 0;
    shx_result code = shx_render_hair_save(get(), nullptr, 0, &size);
    std::vector<std::uint8_t> image(size);
    if (code == SHX_OK)
      code = shx_render_hair_save(get(), image.data(), image.size(), &size);
    return detail::finish(code, std::move(image));
  }
  // The same hair without some of its guides, by their numbers.
  returns<render_hair> without_guides(span<const std::uint32_t> guides) const {
    shx_render_hair *made = nullptr;
    const shx_result code = shx_render_hair_without_guides(get(), guides.data(), guides.size(), &made);
    return detail::finish(code, render_hair(made, loop_));
  }
  // The same hair with shapes of its strands' own: curves at rest, m, strand by strand. point_counts: of each curve; none: the hair's points per strand.
  returns<render_hair> with_own_shapes(const input &points, std::size_t strand_count, span<const std::uint32_t> point_counts = {}) const {
    detail::sizes sizes("with_own_shapes");
    if (!point_counts.empty() && sizes.exactly("point_counts", point_counts.size(), strand_count).wrong())
      return sizes.failure<render_hair>();
    shx_render_hair *made = nullptr;
    const shx_result code = shx_render_hair_with_own_shapes(get(), &points, point_counts.data(), strand_count, &made);
    return detail::finish(code, render_hair(made, loop_));
  }

  // For strands from first on: the guide that each follows first, and its wisp about that guide. One of the two may be empty.
  returns<void> wisps(std::size_t first, span<std::uint32_t> out_guides, span<std::uint32_t> out_wisps) const {
    detail::sizes sizes("wisps");
    if (!out_guides.empty() && !out_wisps.empty() && sizes.exactly("out_wisps", out_wisps.size(), out_guides.size()).wrong())
      return sizes.failure<void>();
    const std::size_t count = out_guides.empty() ? out_wisps.size() : out_guides.size();
    return detail::finish(shx_render_hair_wisps(get(), first, count, out_guides.data(), out_wisps.data()));
  }

  // A pose of this hair. It must be set before it is evaluated.
  returns<render_pose> create_pose() const {
    shx_render_pose *made = nullptr;
    const shx_result code = shx_render_pose_create(get(), &made);
    return detail::finish(code, render_pose(made, loop_));
  }

  shx_render_hair *get() const noexcept { return handle_.get(); }
  explicit operator bool() const noexcept { return static_cast<bool>(handle_); }

 private:
  std::shared_ptr<void> loop_;
  handle_detail::handle<shx_render_hair, shx_render_hair_destroy> handle_;
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_RENDER_HAIR_HPP
