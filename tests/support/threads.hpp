// How many threads a whole solution in a test runs on: 1, or what HAWSER_TEST_THREADS says (the `paths` of tests/README.md).
#pragma once

#include <cstdlib>

namespace hawser::test {

inline int threads() {
  const char* asked = std::getenv("HAWSER_TEST_THREADS");
  return asked ? std::atoi(asked) : 1;
}

}  // namespace hawser::test
