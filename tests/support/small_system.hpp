// Small systems with known solutions for tests of the time scheme, and a dense linear solver for them.
//
// A Problem has `unknowns` (a multiple of 3), a residual template on the scalar, and optionally a prescribed first unknown.
// The tangent comes from automatic differentiation of the residual.
#pragma once

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <memory>
#include <unsupported/Eigen/AutoDiff>
#include <vector>

#include "solver/linear/linear_solver.hpp"
#include "solver/time/system.hpp"

namespace hawser::test {

/// Solves block-tridiagonal systems as dense ones. Where `symmetric_only` it refuses unsymmetric matrices as CHOLMOD does.
class DenseSolver : public LinearSolver {
 public:
  explicit DenseSolver(bool symmetric_only = false) : symmetric_only_(symmetric_only) {}

  std::string_view name() const override { return "dense"; }
  bool takes_unsymmetric() const override { return !symmetric_only_; }
  void analyze(const BlockTridiagonal&) override {}
  FactorReport factorize(const BlockTridiagonal& matrix) override {
    FactorReport report;
    if (symmetric_only_ && matrix.asymmetry() > 1e-14) {
      report.status = FactorStatus::not_applicable;
      return report;
    }
    const auto n = static_cast<Eigen::Index>(matrix.dofs());
    Eigen::MatrixXd dense(n, n);
    std::vector<double> unit(matrix.dofs(), 0.0);
    for (Eigen::Index j = 0; j < n; ++j) {
      unit[j] = 1.0;
      matrix.multiply(unit, std::span<double>(dense.col(j).data(), matrix.dofs()));
      unit[j] = 0.0;
    }
    factors_.compute(dense);
    return report;
  }
  void solve(std::span<double> b) override {
    Eigen::Map<Eigen::VectorXd> x(b.data(), static_cast<Eigen::Index>(b.size()));
    x = factors_.solve(Eigen::VectorXd(x));
  }
  std::size_t bytes() const override { return 0; }

 private:
  bool symmetric_only_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

template <class Problem>
class SmallSystem : public System {
 public:
  static constexpr int n = Problem::unknowns;
  static_assert(n % 3 == 0);
  using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, n, 1>>;

  explicit SmallSystem(Problem problem = {}) : problem_(problem) {
    if (Problem::first_is_prescribed) {
      prescribed_.push_back(0);
    }
  }

  std::size_t unknowns() const override { return n; }
  std::size_t dofs() const override { return n; }
  Tangent make_tangent() const override {
    Tangent t;
    t.chain = BlockTridiagonal({Chain{3, n / 3, 0, 0}});
    return t;
  }

  void residual(const State& s, std::span<double> r) const override { problem_.residual(s.q.data(), s.v.data(), s.a.data(), s.t, r.data()); }

  void tangent(const State& s, const TangentWeights& w, const TangentFloor&, std::span<double> r, Tangent& t) const override {
    std::array<Dual, n> q, v, a, value;
    for (int i = 0; i < n; ++i) {
      q[i] = Dual(s.q[i], w.stiffness * Eigen::Matrix<double, n, 1>::Unit(i));
      v[i] = Dual(s.v[i], w.damping * Eigen::Matrix<double, n, 1>::Unit(i));
      a[i] = Dual(s.a[i], w.mass * Eigen::Matrix<double, n, 1>::Unit(i));
      value[i] = Dual(0.0, Eigen::Matrix<double, n, 1>::Zero());
    }
    problem_.residual(q.data(), v.data(), a.data(), s.t, value.data());
    t.chain.set_zero();
    const Chain& chain = t.chain.chains().front();
    for (int i = 0; i < n; ++i) {
      r[i] = value[i].value();
      for (int j = 0; j < n; ++j) {
        const int row = i / 3, column = j / 3;
        double* block = nullptr;
        if (column == row) {
          block = t.chain.D(chain, row);
        } else if (column == row + 1) {
          block = t.chain.U(chain, row);
        } else if (column + 1 == row) {
          block = t.chain.L(chain, column);
        }
        const bool held = Problem::first_is_prescribed && (i == 0 || j == 0);
        if (block != nullptr) {
          block[i % 3 + 3 * (j % 3)] = held ? (i == j ? 1.0 : 0.0) : value[i].derivatives()[j];
        }
      }
    }
  }

  void reduce(Tangent&, std::span<const double> r, std::span<double> rhs) const override {
    for (int i = 0; i < n; ++i) {
      rhs[i] = -r[i];
    }
    project(rhs);
  }
  void expand(const Tangent&, std::span<const double> x, std::span<double> d) const override { std::copy(x.begin(), x.end(), d.begin()); }
  void project(std::span<double> r) const override {
    if (Problem::first_is_prescribed) {
      r[0] = 0.0;
    }
  }

  std::span<const std::size_t> prescribed() const override { return prescribed_; }
  void prescribe(State& s) const override {
    if constexpr (Problem::first_is_prescribed) {
      const std::array<double, 3> motion = problem_.motion(s.t);
      s.q[0] = motion[0];
      s.v[0] = motion[1];
      s.a[0] = motion[2];
    }
  }

  ScaledResidual scaled_residual(std::span<const double> r) const override {
    ScaledResidual largest;
    for (int i = 0; i < n; ++i) {
      if (!(std::abs(r[i]) <= largest.force)) {
        largest = {std::abs(r[i]), static_cast<std::size_t>(i)};
      }
      if (std::isnan(r[i])) {
        break;
      }
    }
    return largest;
  }
  IncrementMeasure measure_increment(std::span<const double> d) const override {
    double largest = 0.0;
    for (const double x : d) {
      largest = std::max(largest, std::abs(x));
    }
    return {largest, 0.0};
  }
  double reference_length() const override { return Problem::length; }
  double reference_force(std::span<const double>) const override { return Problem::force; }
  double roundoff_floor(const State&) const override { return 4e-16 * Problem::force; }

  State make_state() const {
    State s;
    s.q.assign(n, 0.0);
    s.v.assign(n, 0.0);
    s.a.assign(n, 0.0);
    return s;
  }

  /// qdd at (q, v, t): the mass matrix is dR/da.
  Eigen::Matrix<double, n, 1> acceleration(State s) const {
    std::fill(s.a.begin(), s.a.end(), 0.0);
    prescribe(s);
    Tangent t = make_tangent();
    std::vector<double> r(n), rhs(n);
    tangent(s, {0.0, 0.0, 1.0}, {}, r, t);
    reduce(t, r, rhs);
    DenseSolver solver;
    solver.factorize(t.chain);
    solver.solve(rhs);
    Eigen::Matrix<double, n, 1> a;
    for (int i = 0; i < n; ++i) {
      a[i] = s.a[i] + rhs[i];
    }
    return a;
  }

 private:
  Problem problem_;
  std::vector<std::size_t> prescribed_;
};

/// Classical Runge-Kutta of order 4 with `steps` steps to `duration`: a reference that shares nothing with the scheme under test.
template <class Problem>
State runge_kutta(const SmallSystem<Problem>& system, State s, double duration, int steps) {
  constexpr int n = Problem::unknowns;
  using Vector = Eigen::Matrix<double, n, 1>;
  const double h = duration / steps;
  const double t0 = s.t;
  const auto at = [&](const Vector& q, const Vector& v, double t) {
    State x = s;
    x.t = t;
    Eigen::Map<Vector>(x.q.data()) = q;
    Eigen::Map<Vector>(x.v.data()) = v;
    return system.acceleration(x);
  };
  Vector q = Eigen::Map<Vector>(s.q.data()), v = Eigen::Map<Vector>(s.v.data());
  for (int i = 0; i < steps; ++i) {
    const double t = t0 + h * i;
    const Vector k1 = at(q, v, t);
    const Vector v2 = v + 0.5 * h * k1, k2 = at(q + 0.5 * h * v, v2, t + 0.5 * h);
    const Vector v3 = v + 0.5 * h * k2, k3 = at(q + 0.5 * h * v2, v3, t + 0.5 * h);
    const Vector v4 = v + h * k3, k4 = at(q + h * v3, v4, t + h);
    q += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
    v += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  s.t = t0 + duration;
  Eigen::Map<Vector>(s.q.data()) = q;
  Eigen::Map<Vector>(s.v.data()) = v;
  Eigen::Map<Vector>(s.a.data()) = at(q, v, s.t);
  return s;
}

}  // namespace hawser::test
