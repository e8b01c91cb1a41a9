// Callables of the host behind the C interface's callbacks.
#ifndef SUPERHELIX_HOOKS_HPP
#define SUPERHELIX_HOOKS_HPP

#include "result.hpp"
#include "span.hpp"
#include "types.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>

namespace superhelix {
inline namespace SUPERHELIX_WAY {

// A piece of work that the library gives to the host's parallel loop.
class range_task {
 public:
  range_task(shx_range_fn function, void *task) noexcept : function_(function), task_(task) {}
  // Does items begin to end - 1. worker: any number that no other thread has at the same time.
  void operator()(std::uint32_t begin, std::uint32_t end, std::uint32_t worker) const { function_(task_, begin, end, worker); }

 private:
  shx_range_fn function_;
  void *task_;
};

namespace detail {

// Exceptions cannot pass through C: the trampolines are noexcept, so that one that tries ends the program at once and visibly.
struct parallel_for_hook {
  template <class F>
  explicit parallel_for_hook(F &&callable) : loop(std::forward<F>(callable)) {}

  static void call(void *user, std::uint32_t count, std::uint32_t min_range, shx_range_fn function, void *task) noexcept {
    static_cast<parallel_for_hook *>(user)->loop(count, min_range, range_task(function, task));
  }

  std::function<void(std::uint32_t count, std::uint32_t min_range, range_task task)> loop;
};

struct log_hook {
  template <class F>
  explicit log_hook(F &&callable) : receiver(std::forward<F>(callable)) {}

  static void call(void *user, std::uint32_t level, const char *message) noexcept {
    static_cast<log_hook *>(user)->receiver(level, message);
  }

  std::function<void(std::uint32_t level, const char *message)> receiver;
};

struct wind_hook {
  template <class F>
  explicit wind_hook(F &&callable) : field(std::forward<F>(callable)) {}

  static void call(void *user, double seconds, const double *positions, double *velocities, std::size_t count) noexcept {
    static_assert(sizeof(vec3) == 3 * sizeof(double), "points follow one another");
    static_cast<wind_hook *>(user)->field(seconds, span<const vec3>(reinterpret_cast<const vec3 *>(positions), count),
                                          span<vec3>(reinterpret_cast<vec3 *>(velocities), count));
  }

  std::function<void(double seconds, span<const vec3> positions, span<vec3> velocities)> field;
};

}  // namespace detail

// Makes the library take all of its memory from the host's functions, for the whole process. Before every other call: see shx_set_allocator.
inline returns<void> set_allocator(shx_alloc_fn alloc, shx_free_fn free, void *user = nullptr) {
  return detail::finish(shx_set_allocator(alloc, free, user));
}

}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_HOOKS_HPP
