// Links with results.cpp, which is compiled the other way: neither takes the other's functions.
#include <superhelix/superhelix.hpp>

int count_by_result();

int count_by_exception() {
  try {
    superhelix::solver hair;
    hair.step(-1.0);
  } catch (const superhelix::error &why) {
    return why.code();
  }
  return 0;
}

int main() {
  return count_by_exception() == SHX_ERROR_INVALID_ARGUMENT && count_by_result() == SHX_ERROR_INVALID_ARGUMENT ? 0 : 1;
}
