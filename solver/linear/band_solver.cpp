#include "solver/linear/band_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <lapacke.h>

#include "solver/linear/backends.hpp"
#include "solver/linear/factor_reports.hpp"

namespace hawser {

void BandSolver::analyze(const BlockTridiagonal& pattern) {
  bands_.clear();
  for (const Chain& c : pattern.chains()) {
    Band band{c, 2 * c.block - 1, 3 * (2 * c.block - 1) + 1, {}, {}};
    band.values.resize(band.column_length * c.dofs());
    band.exchanged_row.resize(c.dofs());
    bands_.push_back(std::move(band));
  }
}

// Entry (i, j) lies at values[2 half_width + i - j + column_length j].
void BandSolver::copy_values(const BlockTridiagonal& matrix, Band& band) {
  const Chain& c = band.chain;
  const int n = c.block;
  std::fill(band.values.begin(), band.values.end(), 0.0);
  const auto place = [&](const double* block, int block_row, int block_column) {
    for (int j = 0; j < n; ++j) {
      const std::size_t column = static_cast<std::size_t>(n) * block_column + j;
      double* to = &band.values[band.column_length * column + 2 * band.half_width + n * (block_row - block_column) - j];
      std::copy_n(block + n * j, n, to);
    }
  };
  for (int i = 0; i < c.nodes; ++i) {
    place(matrix.D(c, i), i, i);
    if (i + 1 == c.nodes) continue;
    place(matrix.U(c, i), i, i + 1);
    place(matrix.L(c, i), i + 1, i);
  }
}

void BandSolver::note_pivots(const Band& band, FactorReport& report) {
  for (std::size_t j = 0; j < band.chain.dofs(); ++j) {
    const double pivot = std::abs(band.values[band.column_length * j + 2 * band.half_width]);
    if (!usable_pivot(pivot)) {
      report = singular_report(band.chain.first_dof + j);
      return;
    }
    report.smallest_pivot = std::min(report.smallest_pivot, pivot);
    report.largest_pivot = std::max(report.largest_pivot, pivot);
  }
}

FactorReport BandSolver::factorize(const BlockTridiagonal& matrix) {
  assert(matrix.chains().size() == bands_.size());
  if (const auto unknown = first_not_finite(matrix)) return not_finite_report(*unknown);
  FactorReport report;
  report.smallest_pivot = std::numeric_limits<double>::infinity();
  for (Band& band : bands_) {
    copy_values(matrix, band);
    const int unknowns = static_cast<int>(band.chain.dofs());
    LAPACKE_dgbtrf_work(LAPACK_COL_MAJOR, unknowns, unknowns, band.half_width, band.half_width, band.values.data(), band.column_length,
                        band.exchanged_row.data());
    note_pivots(band, report);
    if (report.status != FactorStatus::ok) break;
  }
  return report;
}

void BandSolver::solve(std::span<double> b) {
  for (const Band& band : bands_) {
    const int unknowns = static_cast<int>(band.chain.dofs());
    LAPACKE_dgbtrs_work(LAPACK_COL_MAJOR, 'N', unknowns, band.half_width, band.half_width, 1, band.values.data(), band.column_length,
                        band.exchanged_row.data(), b.data() + band.chain.first_dof, std::max(1, unknowns));
  }
}

std::size_t BandSolver::bytes() const {
  std::size_t sum = 0;
  for (const Band& band : bands_) sum += sizeof(double) * band.values.size() + sizeof(int) * band.exchanged_row.size();
  return sum;
}

std::unique_ptr<LinearSolver> make_band_solver() { return std::make_unique<BandSolver>(); }

}  // namespace hawser
