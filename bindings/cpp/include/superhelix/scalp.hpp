// Follicles on a scalp.
#ifndef SUPERHELIX_SCALP_HPP
#define SUPERHELIX_SCALP_HPP

#include "definitions.hpp"
#include "handle.hpp"

#include <vector>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

// A triangle mesh at rest, on which follicles stand. It never changes: any threads may use it at the same time.
class scalp {
 public:
  // An empty one, to move another into.
  scalp() = default;
  static returns<scalp> create(const scalp_def &def) {
    shx_scalp *made = nullptr;
    const shx_result code = shx_scalp_create(&def, &made);
    return detail::finish(code, scalp(made, def.vertices.count));
  }
#if !SUPERHELIX_USE_RESULTS
  explicit scalp(const scalp_def &def) : scalp(create(def)) {}
#endif

  // Follicles scattered over the scalp. least_distance, where it is given: the least distance of two of them along the scalp, m.
  returns<std::vector<follicle>> scatter(const scatter_def &def, double *least_distance = nullptr) const {
    detail::sizes sizes("scatter");
    if (def.density != nullptr && def.density_width == 0 && sizes.exactly("density", def.density_size(), vertex_count_).wrong())
      return sizes.failure<std::vector<follicle>>();
    // Where def asks for more than the library makes, the library says so.
    const std::size_t most = 10000000;
    // Asked for by number there are no more than that; by spacing the number has to be found first.
    std::size_t count = def.count <= most ? def.count : 0;
    shx_result code = SHX_OK;
    if (count == 0)
      code = shx_scalp_scatter(get(), &def, nullptr, 0, &count, nullptr);
    std::vector<follicle> follicles;
    if (code == SHX_OK) {
      follicles.resize(count);
      code = shx_scalp_scatter(get(), &def, follicles.data(), follicles.size(), &count, least_distance);
      follicles.resize(code == SHX_OK ? count : 0);
    }
    return detail::finish(code, std::move(follicles));
  }

  // The follicles at texture coordinates, each first offset at random by up to jitter in u and in v.
  returns<std::vector<follicle>> follicles_at_uvs(span<const std::array<double, 2>> uvs, double jitter = 0.0, std::uint64_t seed = 0) const {
    std::vector<follicle> follicles(uvs.size());
    const double *numbers = uvs.empty() ? nullptr : uvs.data()->data();
    const shx_result code = shx_scalp_follicles_at_uvs(get(), numbers, uvs.size(), jitter, seed, follicles.data());
    return detail::finish(code, std::move(follicles));
  }

  // The frames of follicles on the current scalp. vertices: as many as at rest, m; none: at rest.
  returns<void> root_frames(span<const follicle> follicles, const output &frames, const input &vertices = {}) const {
    return detail::finish(shx_scalp_root_frames(get(), detail::given(vertices), follicles.data(), follicles.size(), &frames));
  }

  shx_scalp *get() const noexcept { return handle_.get(); }
  explicit operator bool() const noexcept { return static_cast<bool>(handle_); }

 private:
  scalp(shx_scalp *raw, std::size_t vertex_count) : vertex_count_(vertex_count), handle_(raw) {}

  std::size_t vertex_count_ = 0;
  handle_detail::handle<shx_scalp, shx_scalp_destroy> handle_;
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_SCALP_HPP
