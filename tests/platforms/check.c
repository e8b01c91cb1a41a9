/* The golden hashes of the tests, on this platform. */
#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include "superhelix.h"

extern uint32_t lanes_count(void), contact_count(void);
extern uint64_t lanes_golden(uint32_t course), lanes_found(uint32_t course, uint32_t scalar);
extern uint64_t contact_golden(uint32_t course), contact_found(uint32_t course);

static int wrong = 0, right = 0;

static void compare(const char *what, uint32_t course, uint64_t found, uint64_t golden) {
  if (found == golden) {
    right++;
  } else {
    wrong++;
    printf("%s %u: %016" PRIx64 " and not %016" PRIx64 "\n", what, (unsigned)course, found, golden);
  }
}

int main(void) {
  for (uint32_t course = 0; course < lanes_count(); course++) {
    compare("lanes", course, lanes_found(course, 0), lanes_golden(course));
    compare("scalar", course, lanes_found(course, 1), lanes_golden(course));
  }
  for (uint32_t course = 0; course < contact_count(); course++)
    compare("contact", course, contact_found(course), contact_golden(course));
  printf("%s: %d hashes right, %d wrong\n", shx_build_info(), right, wrong);
  return wrong != 0 || right == 0;
}
