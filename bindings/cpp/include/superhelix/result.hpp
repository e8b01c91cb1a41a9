// How calls fail: by exception, the default, or by a result that holds a value or an error.
//
// Define SUPERHELIX_USE_RESULTS to 1 before the first include (or compile with -fno-exceptions, which implies it) and every function returns
// superhelix::result<T> where it would return T. The two ways live in inline namespaces of their own, so that files compiled one way link with files
// compiled the other.
#ifndef SUPERHELIX_RESULT_HPP
#define SUPERHELIX_RESULT_HPP

#include <superhelix.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#ifndef SUPERHELIX_USE_RESULTS
#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
#define SUPERHELIX_USE_RESULTS 0
#else
#define SUPERHELIX_USE_RESULTS 1
#endif
#endif

#if SUPERHELIX_USE_RESULTS
#define SUPERHELIX_WAY by_result
#else
#define SUPERHELIX_WAY by_exception
#endif

namespace superhelix {

// Why a call failed: its code, SHX_ERROR_, and a text that names the function, the argument and the value.
class error : public std::runtime_error {
 public:
  error(shx_result code, const std::string &text) : std::runtime_error(text), code_(code) {}

  shx_result code() const noexcept { return code_; }
  // "SHX_ERROR_BUSY".
  const char *name() const noexcept { return shx_result_name(code_); }

 private:
  shx_result code_;
};

// The name of a result code, "SHX_ERROR_BUSY".
inline const char *result_name(shx_result code) noexcept { return shx_result_name(code); }

// The text of the last error on this thread; empty when there was none.
inline std::string last_error_text() {
  std::string text(shx_last_error(nullptr, 0), '\0');
  if (!text.empty())
    shx_last_error(&text[0], text.size() + 1);
  return text;
}

// A value, or the error for which there is none.
template <class T>
class [[nodiscard]] result {
 public:
  result(T value) : value_(std::move(value)) {}
  result(superhelix::error why) : error_(std::move(why)) {}

  bool ok() const noexcept { return !error_.has_value(); }
  explicit operator bool() const noexcept { return ok(); }

  // Only when it is ok: otherwise the program ends with the error's text.
  T &value() & { return *(require(), &*value_); }
  const T &value() const & { return *(require(), &*value_); }
  T value() && { return std::move(*(require(), &*value_)); }
  T &operator*() & { return value(); }
  const T &operator*() const & { return value(); }
  T operator*() && { return std::move(*this).value(); }
  T *operator->() { return &value(); }
  const T *operator->() const { return &value(); }
  T value_or(T other) && { return ok() ? std::move(*value_) : std::move(other); }

  // Only when it is not ok.
  const superhelix::error &error() const { return *error_; }

 private:
  void require() const {
    if (!ok()) {
      std::fprintf(stderr, "superhelix: %s\n", error_->what());
      std::abort();
    }
  }

  std::optional<T> value_;
  std::optional<superhelix::error> error_;
};

template <>
class [[nodiscard]] result<void> {
 public:
  result() = default;
  result(superhelix::error why) : error_(std::move(why)) {}

  bool ok() const noexcept { return !error_.has_value(); }
  explicit operator bool() const noexcept { return ok(); }
  // Ends the program with the error's text when it is not ok.
  void value() const {
    if (!ok()) {
      std::fprintf(stderr, "superhelix: %s\n", error_->what());
      std::abort();
    }
  }
  const superhelix::error &error() const { return *error_; }

 private:
  std::optional<superhelix::error> error_;
};

inline namespace SUPERHELIX_WAY {

#if SUPERHELIX_USE_RESULTS
// The return type of a function of T: T, or with SUPERHELIX_USE_RESULTS result<T>.
template <class T>
using returns = result<T>;
#else
// The return type of a function of T: T, or with SUPERHELIX_USE_RESULTS result<T>.
template <class T>
using returns = T;
#endif

namespace detail {

template <class T>
[[nodiscard]] inline returns<T> fail(shx_result code, const std::string &text) {
#if SUPERHELIX_USE_RESULTS
  return result<T>(error(code, text));
#else
  throw error(code, text);
#endif
}

// The result of a call of the C library, without a value.
inline returns<void> finish(shx_result code) {
  if (code != SHX_OK)
    return fail<void>(code, last_error_text());
  return returns<void>();
}

// The value of a call of the C library, unless it failed.
template <class T>
inline returns<std::decay_t<T>> finish(shx_result code, T &&value) {
  if (code != SHX_OK)
    return fail<std::decay_t<T>>(code, last_error_text());
  return std::forward<T>(value);
}

// Looks at the sizes of spans before the C library trusts them.
class sizes {
 public:
  explicit sizes(const char *function) : function_(function) {}

  // size items must be exactly needed.
  sizes &exactly(const char *argument, std::size_t size, std::size_t needed) {
    if (size != needed)
      say(SHX_ERROR_INVALID_ARGUMENT, argument, size, needed, " are needed");
    return *this;
  }
  // An output of at least needed items, or of none where it is not wanted.
  sizes &optional(const char *argument, std::size_t size, std::size_t needed) {
    return size == 0 ? *this : room(argument, size, needed);
  }
  // An output of at least needed items.
  sizes &room(const char *argument, std::size_t size, std::size_t needed) {
    if (size < needed)
      say(SHX_ERROR_BUFFER_TOO_SMALL, argument, size, needed, " are needed");
    return *this;
  }
  // size numbers must be whole rows of width.
  sizes &rows(const char *argument, std::size_t size, std::size_t width) {
    if (size % width != 0)
      say(SHX_ERROR_INVALID_ARGUMENT, argument, size, width, " make a row");
    return *this;
  }

  bool wrong() const { return code_ != SHX_OK; }
  template <class T>
  returns<T> failure() const {
    return fail<T>(code_, text_);
  }

 private:
  void say(shx_result code, const char *argument, std::size_t size, std::size_t needed, const char *end) {
    if (code_ != SHX_OK)
      return;
    code_ = code;
    text_ = std::string(function_) + ": " + argument + " holds " + std::to_string(size) + " items; " + std::to_string(needed) + end;
  }

  const char *function_;
  shx_result code_ = SHX_OK;
  std::string text_;
};

}  // namespace detail
}  // namespace SUPERHELIX_WAY
}  // namespace superhelix

#endif  // SUPERHELIX_RESULT_HPP
