#include "solver/linear/csc_map.hpp"

#include <cassert>
#include <climits>

namespace hawser {

CscMap::CscMap(const BlockTridiagonal& pattern, Part part) {
  assert(pattern.values().size() <= static_cast<std::size_t>(INT_MAX));
  const double* first = pattern.values().data();
  column_start.reserve(pattern.dofs() + 1);
  row.reserve(pattern.values().size());
  source.reserve(pattern.values().size());

  // One column of one block, rows up to and with last_row of the block.
  const auto append = [&](const double* block, const Chain& c, int block_row, int column, int last_row) {
    for (int r = 0; r <= last_row; ++r) {
      row.push_back(static_cast<int>(c.dof(block_row)) + r);
      source.push_back(static_cast<int>(block + c.block * column + r - first));
    }
  };

  column_start.push_back(0);
  for (const Chain& c : pattern.chains())
    for (int i = 0; i < c.nodes; ++i)
      for (int column = 0; column < c.block; ++column) {
        if (i > 0) append(pattern.U(c, i - 1), c, i - 1, column, c.block - 1);
        append(pattern.D(c, i), c, i, column, part == Part::upper ? column : c.block - 1);
        if (part == Part::whole && i + 1 < c.nodes) append(pattern.L(c, i), c, i + 1, column, c.block - 1);
        column_start.push_back(static_cast<int>(row.size()));
      }
  value.resize(row.size());
}

void CscMap::copy_values(const BlockTridiagonal& matrix) {
  const double* from = matrix.values().data();
  for (std::size_t k = 0; k < value.size(); ++k) value[k] = from[source[k]];
}

std::size_t CscMap::bytes() const {
  return sizeof(int) * (column_start.capacity() + row.capacity() + source.capacity()) + sizeof(double) * value.capacity();
}

}  // namespace hawser
