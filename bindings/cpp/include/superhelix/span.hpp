// A view of items that lie one after the other in memory: a pointer and a count, as std::span of C++20, for C++17.
#ifndef SUPERHELIX_SPAN_HPP
#define SUPERHELIX_SPAN_HPP

#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <type_traits>
#include <utility>
#if __cplusplus >= 202002L
#include <version>
#ifdef __cpp_lib_span
#include <span>
#endif
#endif

namespace superhelix {

namespace span_detail {

// Whether C has data() and size() like std::vector, std::array, std::span and std::string, of items that T can view.
template <class C, class T, class = void>
struct is_contiguous_of : std::false_type {};

template <class C, class T>
struct is_contiguous_of<C, T, std::void_t<decltype(std::data(std::declval<C &>())), decltype(std::size(std::declval<C &>()))>>
    : std::is_convertible<std::remove_pointer_t<decltype(std::data(std::declval<C &>()))> (*)[], T (*)[]> {};

}  // namespace span_detail

// Items of type T that somebody else owns. It converts from std::vector, std::array, std::span, arrays, and where T is const from one item or a
// braced list too, which then live until the end of the call that they are written in.
template <class T>
class span {
 public:
  using element_type = T;
  using value_type = std::remove_cv_t<T>;
  using iterator = T *;

  constexpr span() noexcept = default;
  constexpr span(std::nullptr_t) noexcept {}
  constexpr span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}

  template <std::size_t N>
  constexpr span(T (&array)[N]) noexcept : data_(array), size_(N) {}

  template <class C, std::enable_if_t<!std::is_array_v<std::remove_reference_t<C>> && span_detail::is_contiguous_of<C, T>::value &&
                                          (std::is_lvalue_reference_v<C> || std::is_const_v<T>),
                                      int> = 0>
  constexpr span(C &&container) noexcept : data_(std::data(container)), size_(std::size(container)) {}

  template <class U = T, std::enable_if_t<std::is_const_v<U>, int> = 0>
  constexpr span(const value_type &item) noexcept : data_(&item), size_(1) {}

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Winit-list-lifetime"
#endif
  template <class U = T, std::enable_if_t<std::is_const_v<U>, int> = 0>
  constexpr span(std::initializer_list<value_type> items) noexcept : data_(items.begin()), size_(items.size()) {}
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

  constexpr T *data() const noexcept { return data_; }
  constexpr std::size_t size() const noexcept { return size_; }
  constexpr bool empty() const noexcept { return size_ == 0; }
  constexpr T &operator[](std::size_t index) const noexcept { return data_[index]; }
  constexpr T *begin() const noexcept { return data_; }
  constexpr T *end() const noexcept { return data_ + size_; }

  // count items from the one at offset on; both must lie within.
  constexpr span subspan(std::size_t offset, std::size_t count) const noexcept { return span(data_ + offset, count); }
  constexpr span first(std::size_t count) const noexcept { return span(data_, count); }

 private:
  T *data_ = nullptr;
  std::size_t size_ = 0;
};

namespace span_detail {

// Views, whose items live on when they end.
template <class C>
struct is_view : std::false_type {};
template <class T>
struct is_view<span<T>> : std::true_type {};
#ifdef __cpp_lib_span
template <class T, std::size_t N>
struct is_view<std::span<T, N>> : std::true_type {};
#endif

}  // namespace span_detail

// A span that a definition keeps: its items must live until the definition has been used. It takes named containers and views, and no temporaries.
template <class T>
class kept : public span<T> {
 public:
  constexpr kept() noexcept = default;
  constexpr kept(std::nullptr_t) noexcept {}
  template <class C, std::enable_if_t<std::is_convertible_v<C, span<T>> &&
                                          (std::is_lvalue_reference_v<C> || span_detail::is_view<std::remove_cv_t<C>>::value),
                                      int> = 0>
  constexpr kept(C &&items) noexcept : span<T>(items) {}
};

}  // namespace superhelix

#endif  // SUPERHELIX_SPAN_HPP
