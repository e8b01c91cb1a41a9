/* Error handling of the examples: print the text, stop. A real host would continue without its hair. */
#ifndef CHECK_H
#define CHECK_H
#include <stdio.h>
#include <stdlib.h>
#include "superhelix.h"

#define CHECK(call)                                                            \
  do {                                                                         \
    shx_result check_result = (call);                                          \
    if (check_result != SHX_OK) {                                              \
      char check_text[512];                                                    \
      shx_last_error(check_text, sizeof check_text);                           \
      fprintf(stderr, "%s\n", check_text);                                     \
      exit(EXIT_FAILURE);                                                      \
    }                                                                          \
  } while (0)

#endif
