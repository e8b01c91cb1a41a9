// Groom files, and caches of curves over time.
#ifndef SUPERHELIX_CURVES_HPP
#define SUPERHELIX_CURVES_HPP

#include "definitions.hpp"
#include "handle.hpp"

#include <string>
#include <vector>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

// The strands of a groom file: polylines, root first, in the file's units. They never change: any threads may read them at the same time.
class curves {
 public:
  // An empty one, to move another into.
  curves() = default;
  // Reads .hair, .tfx, .obj, .usda, .abc, .data, .ply, .npy or .npz. The path is UTF-8.
  static returns<curves> read(const std::string &path) {
    shx_curves *made = nullptr;
    const shx_result code = shx_curves_read(path.c_str(), &made);
    return detail::finish(code, curves(made));
  }

  // How many strands, and how many points in all.
  returns<std::size_t> strand_count() const {
    std::size_t strands = 0;
    const shx_result code = shx_curves_count(get(), &strands, nullptr);
    return detail::finish(code, strands);
  }
  returns<std::size_t> point_count() const {
    std::size_t points = 0;
    const shx_result code = shx_curves_count(get(), nullptr, &points);
    return detail::finish(code, points);
  }

  // The number of points of each strand.
  returns<std::vector<std::uint32_t>> point_counts() const {
    std::size_t strands = 0;
    shx_result code = shx_curves_count(get(), &strands, nullptr);
    std::vector<std::uint32_t> counts(strands);
    if (code == SHX_OK)
      code = shx_curves_point_counts(get(), counts.data(), counts.size());
    return detail::finish(code, std::move(counts));
  }

  // The points of strand_count strands from first_strand on, one strand after the other, times scale (metres a file unit).
  returns<void> points(std::size_t first_strand, std::size_t strand_count, double scale, const output &out_points) const {
    return detail::finish(shx_curves_points(get(), first_strand, strand_count, scale, &out_points));
  }
  // The points of all strands, times scale.
  returns<std::vector<vec3>> points(double scale = 1.0) const {
    std::size_t strands = 0, total = 0;
    shx_result code = shx_curves_count(get(), &strands, &total);
    std::vector<vec3> all(total);
    if (code == SHX_OK) {
      const output room(all);
      code = shx_curves_points(get(), 0, strands, scale, &room);
    }
    return detail::finish(code, std::move(all));
  }

  // The file's optional data; empty if absent.
  returns<std::vector<float>> attribute(curve_attribute::type what) const {
    std::size_t count = 0;
    shx_result code = shx_curves_attribute(get(), what, nullptr, 0, &count);
    std::vector<float> numbers(count);
    if (code == SHX_OK && count > 0)
      code = shx_curves_attribute(get(), what, numbers.data(), numbers.size(), &count);
    return detail::finish(code, std::move(numbers));
  }

  struct units_of_file {
    double metres;         // a file unit; 0 where the file does not say
    std::uint32_t up_axis;  // up_axis::y, ::z or ::unknown
  };
  returns<units_of_file> units() const {
    units_of_file units{};
    const shx_result code = shx_curves_units(get(), &units.metres, &units.up_axis);
    return detail::finish(code, units);
  }

  shx_curves *get() const noexcept { return handle_.get(); }
  explicit operator bool() const noexcept { return static_cast<bool>(handle_); }

 private:
  friend class curve_cache;
  explicit curves(shx_curves *raw) : handle_(raw) {}
  handle_detail::handle<shx_curves, shx_curves_destroy> handle_;
};

// Writes polylines to an .obj, .hair, .tfx or .usda file: points of all strands, one strand after the other.
inline returns<void> write_curves(const std::string &path, const input &points, span<const std::uint32_t> point_counts) {
  return detail::finish(shx_curves_write_points(path.c_str(), &points, point_counts.data(), point_counts.size()));
}
// The same with all that a groom file can say.
inline returns<void> write_curves(const std::string &path, const curve_data &data) {
  return detail::finish(shx_curve_data_write(path.c_str(), &data));
}

// Curves over time, from a .usda file. They never change: any threads may read them at the same time.
class curve_cache {
 public:
  // An empty one, to move another into.
  curve_cache() = default;
  static returns<curve_cache> read(const std::string &path) {
    shx_curve_cache *made = nullptr;
    const shx_result code = shx_curve_cache_read(path.c_str(), &made);
    return detail::finish(code, curve_cache(made));
  }

  // The times of the frames, s, ascending.
  returns<std::vector<double>> times() const {
    std::size_t count = 0;
    shx_result code = shx_curve_cache_times(get(), nullptr, 0, &count);
    std::vector<double> all(count);
    if (code == SHX_OK)
      code = shx_curve_cache_times(get(), all.data(), all.size(), &count);
    return detail::finish(code, std::move(all));
  }

  // The curves at a time, s.
  returns<curves> sample(double time) const {
    shx_curves *made = nullptr;
    const shx_result code = shx_curve_cache_sample(get(), time, &made);
    return detail::finish(code, curves(made));
  }

  shx_curve_cache *get() const noexcept { return handle_.get(); }
  explicit operator bool() const noexcept { return static_cast<bool>(handle_); }

 private:
  explicit curve_cache(shx_curve_cache *raw) : handle_(raw) {}
  handle_detail::handle<shx_curve_cache, shx_curve_cache_destroy> handle_;
};

// A cache that is being written. The file appears when it is finished; one that is not finished leaves nothing.
class curve_cache_writer {
 public:
  // An empty one, to move another into.
  curve_cache_writer() = default;
  // Begins a .usda file. first has the numbers of points and what does not change over time.
  static returns<curve_cache_writer> create(const std::string &path, const curve_data &first, double frames_per_second) {
    shx_curve_cache_writer *made = nullptr;
    const shx_result code = shx_curve_cache_writer_create(path.c_str(), &first, frames_per_second, &made);
    return detail::finish(code, curve_cache_writer(made));
  }

  // Writes a frame at a time, s, after that of the frame before. velocities: if first had them.
  returns<void> write(double time, const input &points, const input &velocities = {}) {
    return detail::finish(shx_curve_cache_writer_write(get(), time, &points, detail::given(velocities)));
  }

  // Puts the file in its place. The writer is empty then, whether that went well or not.
  returns<void> finish() { return detail::finish(shx_curve_cache_writer_finish(handle_.release())); }

  shx_curve_cache_writer *get() const noexcept { return handle_.get(); }
  explicit operator bool() const noexcept { return static_cast<bool>(handle_); }

 private:
  explicit curve_cache_writer(shx_curve_cache_writer *raw) : handle_(raw) {}
  handle_detail::handle<shx_curve_cache_writer, shx_curve_cache_writer_abandon> handle_;
};

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_CURVES_HPP
