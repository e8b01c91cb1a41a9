// Owners of what the C library makes: they move, are not copied, and free what they own when they end.
#ifndef SUPERHELIX_HANDLE_HPP
#define SUPERHELIX_HANDLE_HPP

#include <utility>

namespace superhelix {
namespace handle_detail {

// Owns a C handle that Destroy frees. An empty one owns nothing: it was moved from.
template <class C, void (*Destroy)(C *)>
class handle {
 public:
  handle() noexcept = default;
  explicit handle(C *raw) noexcept : raw_(raw) {}
  handle(handle &&other) noexcept : raw_(std::exchange(other.raw_, nullptr)) {}
  handle &operator=(handle &&other) noexcept {
    if (this != &other)
      reset(std::exchange(other.raw_, nullptr));
    return *this;
  }
  handle(const handle &) = delete;
  handle &operator=(const handle &) = delete;
  ~handle() { reset(); }

  explicit operator bool() const noexcept { return raw_ != nullptr; }
  // For the C functions; still owned.
  C *get() const noexcept { return raw_; }
  // Gives up ownership.
  C *release() noexcept { return std::exchange(raw_, nullptr); }
  void reset(C *raw = nullptr) noexcept {
    C *old = std::exchange(raw_, raw);
    if (old != nullptr)
      Destroy(old);
  }

 private:
  C *raw_ = nullptr;
};

}  // namespace handle_detail
}  // namespace superhelix

#endif  // SUPERHELIX_HANDLE_HPP
