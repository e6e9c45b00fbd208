// AlignedVector: a std::vector that starts on a cache line, so that packs of 32 and 64 bytes need not straddle two. A large one starts on a huge
// page (2 MB) and asks the system for such pages: sweeps over it then seldom wait for the address of a page.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace hawser {

inline constexpr std::size_t huge_page = std::size_t{1} << 21, large_from = 2 * huge_page;  // bytes

/// A wish, on which no result depends; nothing where the system does not know it. p: on a huge page.
void ask_for_huge_pages(void* p, std::size_t bytes);

template <class T>
struct CacheLineAllocator {
  using value_type = T;  // NOLINT(readability-identifier-naming): the library wants this spelling
  static constexpr std::align_val_t alignment(std::size_t bytes) { return std::align_val_t{bytes < large_from ? 64 : huge_page}; }

  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}

  T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    void* p = ::operator new(bytes, alignment(bytes));
    if (bytes >= large_from) ask_for_huge_pages(p, bytes);
    return static_cast<T*>(p);
  }
  void deallocate(T* p, std::size_t n) { ::operator delete(p, alignment(n * sizeof(T))); }

  template <class U>
  bool operator==(const CacheLineAllocator<U>&) const {
    return true;
  }
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

}  // namespace hawser
