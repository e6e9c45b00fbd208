// Counts the calls of the global operator new of the test program.
#pragma once

namespace hawser::test {

long allocations_so_far();

}  // namespace hawser::test
