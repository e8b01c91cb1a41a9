// Callables of the host behind the C interface's callbacks.
#ifndef SUPERHELIX_HOOKS_HPP
#define SUPERHELIX_HOOKS_HPP

#include "result.hpp"

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

}  // namespace detail
}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_HOOKS_HPP
