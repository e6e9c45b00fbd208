#include "assembly/aligned.hpp"

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

namespace hawser {

void ask_for_huge_pages([[maybe_unused]] void* p, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  madvise(p, bytes / huge_page * huge_page, MADV_HUGEPAGE);  // refused: small pages, as without it
#endif
}

}  // namespace hawser
