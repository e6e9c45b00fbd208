// sweep: the assembly loop over one panel of consecutive elements of a line, W elements at a time.
//
// A panel writes the blocks D, U, L and the residual of the nodes it owns (its elements' left nodes; the last panel also the
// end node) directly. What its last element adds to the next panel's first node goes to a carry that is added afterwards, in
// order: the result is the same bits for any number of threads. Blocks: assembly/block_tridiagonal.hpp.
// Compiled once per instruction set (sweep_*.cpp); this interface holds no inline code and no library types.
#pragma once

#include <cstddef>

#include "assembly/kernel.hpp"
#include "assembly/observed.hpp"
#include "assembly/panel.hpp"

namespace hawser {

inline constexpr int table_padding = 16;       // doubles that may be read beyond the end of every table
inline constexpr int carry_size = 6 + 36;      // residual and block of one node
inline constexpr int node_property_count = 3;  // axial terms at nodes: sum of share*EA, share*damping, share*least tension

struct SweepLine {
  int elements;
  const double *q, *v, *a;                           // the line's unknowns
  const double* property[property_count];            // per element of the panel
  const double* node_property[node_property_count];  // per node of the panel
  Weights weights;
  CurrentTable current;
  double* r;       // the line's residual
  double* blocks;  // D, U, L of the panel's nodes; null: residual alone
  double* carry;   // carry_size doubles a panel
  int next;        // elements from the panel to the one that is made after it, whose data are fetched meanwhile; 0: none
  int next_table;  // the same from its properties to those of the other; 0: none, or shared
};

using SweepFunction = void (*)(const SweepLine&, int panel);

/// Rows of Observed (observed.hpp) of one panel's elements; lanes beyond the last element hold nothing of use.
inline constexpr int observed_stride = panel_elements + table_padding;
using ObserveFunction = void (*)(const SweepLine& panel, double* rows);

/// Families in this order: bar, cable, beam, each dry and wet.
inline constexpr int sweep_families = 6;
constexpr int sweep_family(int family, bool wet) { return 2 * family + (wet ? 1 : 0); }

struct SweepTable {
  const char* instruction_set;
  int width;
  SweepFunction force[sweep_families];
  SweepFunction tangent[sweep_families];
  ObserveFunction observe[sweep_families];
  void (*copy_negated)(const double* from, double* to, std::size_t count);
};

/// The widest instruction set of this processor; HAWSER_SIMD=base|avx2 forces a narrower one.
const SweepTable& widest_sweep_table();

namespace base {
extern const SweepTable sweep_table;
}
namespace avx2 {
extern const SweepTable sweep_table;
}
namespace avx512 {
extern const SweepTable sweep_table;
}

}  // namespace hawser
