#include "solver/linear/dense_border.hpp"

#include <cassert>

#include <fmt/format.h>

#include "solver/linear/dense_spectrum.hpp"

namespace hawser {

void DenseBorder::analyze(const BlockTridiagonal& pattern, int border) {
  chains_.analyze(pattern);
  const auto n = static_cast<Eigen::Index>(pattern.dofs());
  responses_.resize(n, border);
  rows_.resize(border, n);
  complement_.resize(border, border);
  factors_ = Eigen::FullPivLU<Eigen::MatrixXd>(border, border);
  factors_.setThreshold(0.0);
  border_.resize(border);
}

FactorReport DenseBorder::factorize(const BlockTridiagonal& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& C, const Eigen::MatrixXd& D) {
  assert(B.rows() == responses_.rows() && B.cols() == responses_.cols() && C.rows() == B.cols() && C.cols() == B.rows() && D.rows() == B.cols());
  FactorReport report = chains_.factorize(A);
  if (report.status != FactorStatus::ok) return report;
  responses_ = B;
  rows_ = C;
  for (Eigen::Index k = 0; k < responses_.cols(); ++k) chains_.solve({responses_.col(k).data(), A.dofs()});
  complement_ = D;
  complement_.noalias() -= rows_ * responses_;
  factors_.compute(complement_);
  const bool symmetric = A.symmetry() == Symmetry::symmetric && C == B.transpose() && D == D.transpose();
  report.negative_pivots =
      symmetric && report.negative_pivots >= 0 ? report.negative_pivots + negative_eigenvalues(0.5 * (complement_ + complement_.transpose())) : -1;
  if (factors_.isInvertible() && complement_.allFinite()) return report;
  Eigen::Index loose = 0;
  if (complement_.allFinite()) factors_.kernel().col(0).cwiseAbs().maxCoeff(&loose);
  report.status = FactorStatus::singular;
  report.failed_unknown = A.dofs() + static_cast<std::size_t>(loose);
  report.message = fmt::format("nothing holds unknown {} of the border", loose);
  return report;
}

void DenseBorder::solve(std::span<double> f, std::span<double> g) {
  assert(static_cast<Eigen::Index>(f.size()) == responses_.rows() && static_cast<Eigen::Index>(g.size()) == responses_.cols());
  Eigen::Map<Eigen::VectorXd> x(f.data(), responses_.rows()), y(g.data(), responses_.cols());
  chains_.solve(f);
  border_ = y;
  border_.noalias() -= rows_ * x;
  y = factors_.solve(border_);
  x.noalias() -= responses_ * y;
}

}  // namespace hawser
