/* Old versions of wine (8.0 for one) lack bcryptprimitives.dll, from which Rust's standard library takes its random numbers. This one stands in for it beside the tests. */
#include <stddef.h>

__declspec(dllimport) unsigned char __stdcall SystemFunction036(void *buffer, unsigned long length); /* RtlGenRandom */

__declspec(dllexport) int __stdcall ProcessPrng(unsigned char *buffer, size_t length) {
  return SystemFunction036(buffer, (unsigned long)length) != 0;
}
