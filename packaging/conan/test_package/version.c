/* Links the library, and says which it is. */
#include <stdio.h>
#include <superhelix.h>

int main(void) {
  shx_solver *solver;
  if (shx_abi_version() != SHX_ABI_VERSION || shx_solver_create(NULL, &solver) != SHX_OK) {
    return 1;
  }
  shx_solver_destroy(solver);
  puts(shx_build_info());
  return 0;
}
