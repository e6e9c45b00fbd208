// CscMap: the compressed-column pattern of a BlockTridiagonal and where each of its values comes from.
//
//   value k of the sparse matrix = matrix.values()[source[k]],   rows ascending in every column
//
// The pattern is that of full blocks; the zero padding (U and L of a chain's last node) is left out. Made once, in analyze.
#pragma once

#include <span>
#include <vector>

#include "assembly/block_tridiagonal.hpp"

namespace hawser {

struct CscMap {
  enum class Part { whole, upper };  // upper: the upper triangle with the diagonal, for symmetric solvers

  std::vector<int> column_start;  // unknowns + 1
  std::vector<int> row;
  std::vector<int> source;
  std::vector<double> value;

  CscMap() = default;
  CscMap(const BlockTridiagonal& pattern, Part part);

  int unknowns() const { return static_cast<int>(column_start.size()) - 1; }
  void copy_values(const BlockTridiagonal& matrix);
  std::size_t bytes() const;
};

}  // namespace hawser
