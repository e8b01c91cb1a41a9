// Small values that every part of the interface uses: ids, vectors, frames, and views of the host's own arrays.
#ifndef SUPERHELIX_TYPES_HPP
#define SUPERHELIX_TYPES_HPP

#include "result.hpp"
#include "span.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>

// Ids are the C structures themselves: types of their own, which compare and hash. The default one, bits 0, names nothing.
#define SUPERHELIX_ID(type)                                                                         \
  constexpr bool operator==(type a, type b) noexcept { return a.bits == b.bits; }                   \
  constexpr bool operator!=(type a, type b) noexcept { return a.bits != b.bits; }                   \
  constexpr bool operator<(type a, type b) noexcept { return a.bits < b.bits; }                     \
  template <>                                                                                       \
  struct std::hash<type> {                                                                          \
    std::size_t operator()(type id) const noexcept { return std::hash<std::uint64_t>()(id.bits); }  \
  };
SUPERHELIX_ID(shx_strand_id)
SUPERHELIX_ID(shx_body_id)
SUPERHELIX_ID(shx_constraint_id)
#undef SUPERHELIX_ID

namespace superhelix {

using strand_id = shx_strand_id;
using body_id = shx_body_id;
using constraint_id = shx_constraint_id;

using vec3 = std::array<double, 3>;
// x, y, z, w.
using quaternion = std::array<double, 4>;
// Of an element: twist, curvature about n1, curvature about n2, rad/m.
using curvature = std::array<double, 3>;
// Three indices of vertices.
using triangle = std::array<std::uint32_t, 3>;
// A right-handed pose in the world: origin (m) and rotation (unit quaternion x, y, z, w).
using frame = shx_frame;

static_assert(sizeof(curvature) == 3 * sizeof(double) && sizeof(triangle) == 3 * sizeof(std::uint32_t), "rows lie one after the other");

// A frame from its parts.
inline frame make_frame(const vec3 &origin, const quaternion &rotation = {0.0, 0.0, 0.0, 1.0}) noexcept {
  return {{origin[0], origin[1], origin[2]}, {rotation[0], rotation[1], rotation[2], rotation[3]}};
}

// Which SHX_FORMAT_ an item type has. Specialise it for your own vectors:
//   template <> struct superhelix::format_of<glm::vec3> : std::integral_constant<std::uint32_t, SHX_FORMAT_F32X3> {};
template <class T>
struct format_of {};
template <>
struct format_of<std::array<float, 3>> : std::integral_constant<std::uint32_t, SHX_FORMAT_F32X3> {};
template <>
struct format_of<std::array<float, 4>> : std::integral_constant<std::uint32_t, SHX_FORMAT_F32X4> {};
template <>
struct format_of<std::array<double, 3>> : std::integral_constant<std::uint32_t, SHX_FORMAT_F64X3> {};
template <>
struct format_of<std::array<double, 4>> : std::integral_constant<std::uint32_t, SHX_FORMAT_F64X4> {};
template <>
struct format_of<float[3]> : std::integral_constant<std::uint32_t, SHX_FORMAT_F32X3> {};
template <>
struct format_of<float[4]> : std::integral_constant<std::uint32_t, SHX_FORMAT_F32X4> {};
template <>
struct format_of<double[3]> : std::integral_constant<std::uint32_t, SHX_FORMAT_F64X3> {};
template <>
struct format_of<double[4]> : std::integral_constant<std::uint32_t, SHX_FORMAT_F64X4> {};
template <>
struct format_of<shx_frame> : std::integral_constant<std::uint32_t, SHX_FORMAT_FRAME> {};

namespace view_detail {

template <class C>
using item_of = std::remove_cv_t<std::remove_pointer_t<decltype(std::data(std::declval<C &>()))>>;

template <class T, class = void>
struct has_format : std::false_type {};
template <class T>
struct has_format<T, std::void_t<decltype(format_of<T>::value)>> : std::true_type {};

template <class C, class = void>
struct is_container : std::false_type {};
template <class C>
struct is_container<C, std::void_t<item_of<C>>> : has_format<item_of<C>> {};

}  // namespace view_detail

// Items that a call reads from the host's memory: points, frames, directions. It converts from containers of what has a format_of; nothing is copied.
struct input : shx_input {
  // No items: for what may be left out.
  constexpr input() noexcept : shx_input{nullptr, 0, 0, 0, 0} {}

  template <class C, std::enable_if_t<view_detail::is_container<const C>::value && !view_detail::has_format<C>::value, int> = 0>
  input(const C &items) noexcept
      : shx_input{std::data(items), sizeof(view_detail::item_of<const C>), std::size(items), format_of<view_detail::item_of<const C>>::value, 0} {}

  // One item, which must live until the call ends.
  template <class T, std::enable_if_t<view_detail::has_format<T>::value, int> = 0>
  input(const T &item) noexcept : shx_input{&item, sizeof(T), 1, format_of<T>::value, 0} {}

  // count items that begin stride bytes after each other.
  template <class T>
  static input strided(const T *first, std::size_t count, std::size_t stride) noexcept {
    return input(shx_input{first, stride, count, format_of<T>::value, 0});
  }

  // A member of each of the host's structures: input::of(vertices, &vertex::position).
  template <class C, class S, class M>
  static input of(const C &structures, M S::*member) noexcept {
    const S *first = std::data(structures);
    return input(shx_input{first == nullptr ? nullptr : &(first->*member), sizeof(S), std::size(structures), format_of<M>::value, 0});
  }

  // Numbers x, y, z, x, y, z, ...
  static input xyz(span<const float> numbers) noexcept { return packed(numbers, 3, SHX_FORMAT_F32X3); }
  static input xyz(span<const double> numbers) noexcept { return packed(numbers, 3, SHX_FORMAT_F64X3); }
  // Numbers x, y, z, w, x, y, z, w, ...
  static input xyzw(span<const float> numbers) noexcept { return packed(numbers, 4, SHX_FORMAT_F32X4); }
  static input xyzw(span<const double> numbers) noexcept { return packed(numbers, 4, SHX_FORMAT_F64X4); }

  explicit input(const shx_input &raw) noexcept : shx_input(raw) {}

 private:
  template <class T>
  static input packed(span<const T> numbers, std::size_t width, std::uint32_t format) noexcept {
    return input(shx_input{numbers.data(), width * sizeof(T), numbers.size() / width, format, 0});
  }
};

// Items that a definition keeps: they must live until the definition has been used. It takes named containers, and views made by input's functions.
struct kept_input : shx_input {
  template <class C, std::enable_if_t<(std::is_lvalue_reference_v<C> || std::is_same_v<std::remove_cv_t<C>, input> ||
                                       span_detail::is_view<std::remove_cv_t<C>>::value) &&
                                          std::is_convertible_v<C, input>,
                                      int> = 0>
  kept_input(C &&items) noexcept : shx_input(static_cast<const input &>(input(items))) {}
};

// Room in the host's memory that a call writes items into. It converts from containers of what has a format_of; nothing is copied.
struct output : shx_output {
  // Not wanted.
  constexpr output() noexcept : shx_output{nullptr, 0, 0, 0, 0} {}
  constexpr output(std::nullptr_t) noexcept : output() {}

  template <class C, std::enable_if_t<view_detail::is_container<C>::value && !view_detail::has_format<C>::value, int> = 0>
  output(C &items) noexcept
      : shx_output{std::data(items), sizeof(view_detail::item_of<C>), std::size(items), format_of<view_detail::item_of<C>>::value, 0} {}

  template <class T>
  output(span<T> items) noexcept : shx_output{items.data(), sizeof(T), items.size(), format_of<T>::value, 0} {}

  // One item.
  template <class T, std::enable_if_t<view_detail::has_format<T>::value, int> = 0>
  output(T &item) noexcept : shx_output{&item, sizeof(T), 1, format_of<T>::value, 0} {}

  // Room for count items that begin stride bytes after each other.
  template <class T>
  static output strided(T *first, std::size_t count, std::size_t stride) noexcept {
    return output(shx_output{first, stride, count, format_of<T>::value, 0});
  }

  // A member of each of the host's structures: output::of(vertices, &vertex::position). What else they hold is left alone.
  template <class C, class S, class M>
  static output of(C &structures, M S::*member) noexcept {
    S *first = std::data(structures);
    return output(shx_output{first == nullptr ? nullptr : &(first->*member), sizeof(S), std::size(structures), format_of<M>::value, 0});
  }

  // Numbers x, y, z, x, y, z, ...
  static output xyz(span<float> numbers) noexcept { return packed(numbers, 3, SHX_FORMAT_F32X3); }
  static output xyz(span<double> numbers) noexcept { return packed(numbers, 3, SHX_FORMAT_F64X3); }
  // Numbers x, y, z, w, x, y, z, w, ...
  static output xyzw(span<float> numbers) noexcept { return packed(numbers, 4, SHX_FORMAT_F32X4); }
  static output xyzw(span<double> numbers) noexcept { return packed(numbers, 4, SHX_FORMAT_F64X4); }

  explicit output(const shx_output &raw) noexcept : shx_output(raw) {}

 private:
  template <class T>
  static output packed(span<T> numbers, std::size_t width, std::uint32_t format) noexcept {
    return output(shx_output{numbers.data(), width * sizeof(T), numbers.size() / width, format, 0});
  }
};

inline namespace SUPERHELIX_WAY {
namespace detail {

// The type of an optional output.
inline const shx_output *wanted(const output &room) noexcept { return room.data == nullptr ? nullptr : &room; }

// The type of an optional input.
inline const shx_input *given(const input &items) noexcept { return items.count == 0 ? nullptr : &items; }

inline double *rows(span<curvature> values) noexcept { return values.empty() ? nullptr : values.data()->data(); }
inline const double *rows(span<const curvature> values) noexcept { return values.empty() ? nullptr : values.data()->data(); }
inline const std::uint32_t *rows(span<const triangle> values) noexcept { return values.empty() ? nullptr : values.data()->data(); }

template <class T, std::size_t N>
void copy(const std::array<T, N> &from, T (&to)[N]) noexcept {
  for (std::size_t i = 0; i < N; i++)
    to[i] = from[i];
}

// Mistakes in definitions are found where they are made. With SUPERHELIX_USE_RESULTS they end the program, since a setter has no result to give.
inline void wrong_definition(shx_result code, const std::string &text) {
#if SUPERHELIX_USE_RESULTS
  std::fprintf(stderr, "superhelix: %s\n", text.c_str());
  (void)code;
  std::abort();
#else
  throw error(code, text);
#endif
}

// A structure that its _init function could not fill: the library is older than the header.
inline void prepared(shx_result code) {
  if (code != SHX_OK)
    wrong_definition(code, last_error_text());
}

// Arrays of one definition that share a count must have the same number of items.
inline void agree(const char *argument, std::size_t size, std::size_t count, bool fixed) {
  if (fixed && size != count)
    wrong_definition(SHX_ERROR_INVALID_ARGUMENT,
                     std::string(argument) + " is of " + std::to_string(size) + " items; what was set before is of " + std::to_string(count));
}

}  // namespace detail
}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_TYPES_HPP
