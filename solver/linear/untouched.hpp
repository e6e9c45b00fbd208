// UntouchedVector: an AlignedVector whose new numbers are not set. Systems lay a page of memory beside the processor that touches it first: who makes
// the vector lets the threads that will work on its parts do so.
#pragma once

#include "assembly/aligned.hpp"

namespace hawser {

template <class T>
struct UntouchedAllocator : CacheLineAllocator<T> {
  template <class U>
  struct rebind {                         // NOLINT(readability-identifier-naming): the library wants this spelling
    using other = UntouchedAllocator<U>;  // NOLINT(readability-identifier-naming)
  };
  template <class U>
  void construct(U* p) {
    ::new (static_cast<void*>(p)) U;
  }
};

template <class T>
using UntouchedVector = std::vector<T, UntouchedAllocator<T>>;

}  // namespace hawser
