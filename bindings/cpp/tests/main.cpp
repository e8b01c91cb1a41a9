// Runs all tests: tests FOLDER, where they write files. In one unit, so that the headers are compiled once.
#include "views.cpp"
#include "strands.cpp"
#include "contact.cpp"
#include "fitting.cpp"
#include "files.cpp"
#include "hooks.cpp"

namespace check {
std::string &folder() {
  static std::string path;
  return path;
}
}  // namespace check

int main(int argc, char **argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: tests FOLDER\n");
    return 2;
  }
  check::folder() = argv[1];
  for (const check::test &test : check::tests())
    test.run();
  std::printf("%zu tests passed, C++ %ld, errors by %s\n", check::tests().size(), __cplusplus, SUPERHELIX_USE_RESULTS ? "result" : "exception");
  return 0;
}
