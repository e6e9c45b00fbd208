// Banded LU with partial pivoting (LAPACK dgbtrf, dgbtrs), one band a chain: half bandwidth 2 block - 1.
#pragma once

#include <vector>

#include "solver/linear/linear_solver.hpp"

namespace hawser {

class BandSolver final : public LinearSolver {
 public:
  std::string_view name() const override { return "band"; }
  bool takes_unsymmetric() const override { return true; }
  void analyze(const BlockTridiagonal& pattern) override;
  FactorReport factorize(const BlockTridiagonal& matrix) override;
  void solve(std::span<double> b) override;
  std::size_t bytes() const override;

 private:
  struct Band {
    Chain chain;
    int half_width = 0;     // sub- and superdiagonals
    int column_length = 0;  // 3 half_width + 1: room for the fill of row exchanges
    std::vector<double> values;
    std::vector<int> exchanged_row;
  };

  static void copy_values(const BlockTridiagonal& matrix, Band& band);
  static void note_pivots(const Band& band, FactorReport& report);

  std::vector<Band> bands_;
};

}  // namespace hawser
