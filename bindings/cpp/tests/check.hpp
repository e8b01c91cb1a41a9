// Shared code of the tests. They are compiled with both ways of reporting errors: GET takes the value of a call in either, and ends the program where there is
// none; WHY is the error of a call that should fail.
#ifndef CHECK_HPP
#define CHECK_HPP

#include <superhelix/superhelix.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace check {

inline void failed(const char *file, int line, const char *what) {
  std::fprintf(stderr, "%s:%d: %s\n", file, line, what);
  std::exit(1);
}

// A test, which main runs under its name.
struct test {
  const char *name;
  void (*run)();
};
inline std::vector<test> &tests() {
  static std::vector<test> all;
  return all;
}
struct registered {
  registered(const char *name, void (*run)()) { tests().push_back({name, run}); }
};

inline double distance(const superhelix::vec3 &a, const superhelix::vec3 &b) {
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

}  // namespace check

#define EXPECT(condition) ((condition) ? (void)0 : check::failed(__FILE__, __LINE__, "not so: " #condition))
#define NEAR(a, b, tolerance) EXPECT(std::abs((a) - (b)) <= (tolerance))
#define TEST(name)                                              \
  static void name();                                           \
  static const check::registered registered_##name(#name, name); \
  static void name()

#if SUPERHELIX_USE_RESULTS
#define GET(...) (__VA_ARGS__).value()
#define WHY(...)                                                                                             \
  [&]() -> superhelix::error {                                                                               \
    const auto outcome = (__VA_ARGS__);                                                                      \
    if (outcome.ok())                                                                                        \
      check::failed(__FILE__, __LINE__, "should have failed: " #__VA_ARGS__);                                \
    return outcome.error();                                                                                  \
  }()
#else
#define GET(...) (__VA_ARGS__)
#define WHY(...)                                                                                             \
  [&]() -> superhelix::error {                                                                               \
    try {                                                                                                    \
      (void)(__VA_ARGS__);                                                                                   \
    } catch (const superhelix::error &why) {                                                                 \
      return why;                                                                                            \
    }                                                                                                        \
    check::failed(__FILE__, __LINE__, "should have failed: " #__VA_ARGS__);                                  \
    std::abort();                                                                                            \
  }()
#endif

namespace check {

// Strands of 20 cm and eight elements that hang from roots 1 cm apart.
inline std::vector<superhelix::strand_id> hanging(superhelix::solver &solver, std::size_t count) {
  std::vector<superhelix::strand_def> defs(count);
  for (std::size_t i = 0; i < count; i++) {
    defs[i].with_length(0.2).with_element_count(8).with_air_drag(5e-5).with_user_data(100 + i);
    // Turned about y: n0 points down.
    defs[i].with_root(superhelix::make_frame({0.01 * static_cast<double>(i), 0.0, 0.0}, {0.0, std::sqrt(0.5), 0.0, std::sqrt(0.5)}));
  }
  return GET(solver.add_strands(defs));
}

}  // namespace check

#endif
