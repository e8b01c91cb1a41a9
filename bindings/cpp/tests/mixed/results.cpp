#define SUPERHELIX_USE_RESULTS 1
#include <superhelix/superhelix.hpp>

int count_by_result() {
  auto hair = superhelix::solver::create();
  if (!hair)
    return 0;
  const superhelix::result<void> outcome = hair->step(-1.0);
  return outcome ? 0 : outcome.error().code();
}
