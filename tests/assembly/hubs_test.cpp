// The border of a network: its columns and rows are the derivative of the projected residual, whatever the lines carry.
#include "assembly/hubs.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <functional>

#include "assembly/assembler.hpp"
#include "tests/support/network_scenes.hpp"

namespace hawser::test {
namespace {

using Matrix = Eigen::MatrixXd;

/// E of hubs.hpp extended by the identity: the unknowns that may move (hubs last) into all of them. Inner unknowns of joints follow the chains.
Matrix moving(const Model& model) {
  std::vector<char> own(model.unknowns, 1);
  for (const Support& support : model.supports) std::fill_n(&own[model.dof(support.line, support.node)], 3, 0);
  for (const Hub& hub : model.hubs)
    for (const Support& end : hub.ends) std::fill_n(&own[model.dof(end.line, end.node)], 3, 0);
  const int free = static_cast<int>(std::count(own.begin(), own.end(), 1)), hubs = static_cast<int>(model.hubs.size());
  Matrix P = Matrix::Zero(static_cast<int>(model.unknowns), free + 3 * hubs);
  int column = 0;
  for (std::size_t i = 0; i < own.size(); ++i)
    if (own[i]) P(static_cast<int>(i), column++) = 1.0;
  for (const Hub& hub : model.hubs) {
    for (const Support& end : hub.ends) P.block<3, 3>(static_cast<int>(model.dof(end.line, end.node)), column).setIdentity();
    column += 3;
  }
  return P;
}

State bent_state(const Model& model) {
  State state = model.make_state();
  state.t = 0.3;
  for (std::size_t line = 0; line < model.lines.size(); ++line) {
    const Line& l = model.lines[line];
    const Vec3 from = model.points[l.from].position, chord = model.points[l.to].position - from;
    const double bow = 0.1 * l.length;
    for (int i = 0; i < l.nodes; ++i) {
      const double x = l.s[i] / l.length;
      const std::size_t d = model.dof(static_cast<int>(line), i);
      Eigen::Map<Vec3> r(&state.q[d]), v(&state.v[d]), a(&state.a[d]);
      const Vec3 across(0.3, 1.0, -1.0), along(2.0, -1.0, 0.4);  // the second keeps the slope of the ring off zero
      r = from + x * chord + bow * x * (1.0 - x) * (across + (1.0 - 2.0 * x) * along);
      v = Vec3(0.2, -0.1, 0.3) + 0.1 * r.cwiseProduct(Vec3(0.01, 0.02, -0.01));
      a = Vec3(0.1, 0.2, -0.1);
      if (model.chain(static_cast<int>(line)).block == 6)
        Eigen::Map<Vec3>(&state.q[d + 3]) = (chord + bow * ((1.0 - 2.0 * x) * across + (1.0 - 6.0 * x + 6.0 * x * x) * along)) / l.length;
    }
  }
  model.reset_joints(state);
  model.prescribe(state);
  return state;
}

/// The whole tangent of the moving unknowns by central differences of P^T R, extrapolated to order four.
Matrix measured(const Assembler& assembler, const State& state, const Matrix& P, const TangentWeights& w) {
  const double h = 1e-4;
  Matrix K(P.cols(), P.cols());
  std::vector<double> r(assembler.model().unknowns);
  const auto residual = [&](const Eigen::VectorXd& d) {
    State moved = state;
    for (std::size_t i = 0; i < r.size(); ++i) {
      moved.q[i] += w.stiffness * d[static_cast<int>(i)];
      moved.v[i] += w.damping * d[static_cast<int>(i)];
      moved.a[i] += w.mass * d[static_cast<int>(i)];
    }
    assembler.residual(moved, r);
    return Eigen::VectorXd(P.transpose() * Eigen::Map<Eigen::VectorXd>(r.data(), P.rows()));
  };
  const auto difference = [&](const Eigen::VectorXd& d) { return Eigen::VectorXd(0.5 * (residual(d) - residual(-d))); };
  for (int j = 0; j < P.cols(); ++j) K.col(j) = (8.0 * difference(h * P.col(j)) - difference(2.0 * h * P.col(j))) / (6.0 * h);
  return K;
}

/// Eliminates the inner unknowns, which stand between the chains and the hubs.
Matrix condensed(const Matrix& K, int inner, int hubs) {
  const int n = static_cast<int>(K.rows()), first = n - inner - hubs, kept = n - inner;
  Eigen::VectorXi order(kept);
  for (int i = 0; i < kept; ++i) order[i] = i < first ? i : i + inner;
  const Matrix Kxx = K(order, order), Kxc = K(order, Eigen::seqN(first, inner)), Kcx = K(Eigen::seqN(first, inner), order);
  if (inner == 0) return Kxx;
  return Kxx - Kxc * K.block(first, first, inner, inner).partialPivLu().solve(Kcx);
}

/// The same from chains and border.
Matrix assembled(const Model& model, const Tangent& tangent) {
  const int n = static_cast<int>(model.dofs), hubs = static_cast<int>(model.hubs.size());
  Matrix A(n, n), P = moving(model);
  std::vector<double> unit(model.dofs), column(model.dofs);
  for (int j = 0; j < n; ++j) {
    std::fill(unit.begin(), unit.end(), 0.0);
    unit[static_cast<std::size_t>(j)] = 1.0;
    tangent.chain.multiply(unit, column);
    A.col(j) = Eigen::Map<Eigen::VectorXd>(column.data(), n);
  }
  for (const BorderEnd& end : tangent.border.ends) A.block<3, 3>(static_cast<int>(end.r), static_cast<int>(end.r)).setZero();
  for (const BorderEnd& end : tangent.border.ends) {
    const int r = static_cast<int>(end.r), window = static_cast<int>(end.window), size = static_cast<int>(end.column.rows());
    A.block(window, r, size, 3) = end.column;
    A.block(r, window, 3, size) = end.row;
  }
  const int inner = static_cast<int>(model.unknowns - model.dofs), free = static_cast<int>(P.cols()) - inner - 3 * hubs;
  Matrix Q(n, free + 3 * hubs);
  Q << P.topLeftCorner(n, free), P.topRightCorner(n, 3 * hubs);
  return Q.transpose() * A * Q;
}

class BorderOf : public ::testing::TestWithParam<ModelChoice> {};

TEST_P(BorderOf, ANetworkIsTheDerivativeOfItsProjectedResidual) {
  for (const int elements : {1, 3}) {
    const Model model = build_model(network_with_ring(elements, GetParam()));
    const Assembler assembler(model);
    const State state = bent_state(model);
    const Matrix P = moving(model);
    std::vector<double> r(model.unknowns);
    for (const TangentWeights& w : {TangentWeights{1.0, 0.0, 0.0}, TangentWeights{1.0, 10.0, 200.0}}) {
      Tangent tangent = assembler.make_tangent();
      assembler.tangent(state, w, TangentFloor{}, r, tangent);
      const int inner = static_cast<int>(model.unknowns - model.dofs);
      const Matrix expected = condensed(measured(assembler, state, P, w), inner, 3 * static_cast<int>(model.hubs.size()));
      const Matrix got = assembled(model, tangent);
      ASSERT_EQ(got.rows(), expected.rows());
      // h = 1e-4: h^4 = 1e-16 and rounding eps/h = 2e-12, a thousand times over for strains of 10 % and more.
      EXPECT_LT((got - expected).norm(), 2e-9 * expected.norm()) << elements;
    }
  }
}

TEST_P(BorderOf, ANetworkWhoseHubsLieOnTheBedIsTheDerivativeOfItsProjectedResidual) {
  Scene scene = network_with_ring(3, GetParam());
  scene.environment.depth = 4.98;  // a hub of 196 N is 20 mm in the bed, lines bow far below it
  const Model model = build_model(scene);
  ASSERT_GT(model.bodies[0].bed_length, 10.0);
  const Assembler assembler(model);
  const State state = bent_state(model);
  std::vector<double> r(model.unknowns);
  const TangentWeights w{1.0, 10.0, 200.0};
  Tangent tangent = assembler.make_tangent();
  assembler.tangent(state, w, TangentFloor{}, r, tangent);
  const int inner = static_cast<int>(model.unknowns - model.dofs);
  const Matrix expected = condensed(measured(assembler, state, moving(model), w), inner, 3 * static_cast<int>(model.hubs.size()));
  EXPECT_LT((assembled(model, tangent) - expected).norm(), 2e-9 * expected.norm());  // as above
}

INSTANTIATE_TEST_SUITE_P(Families, BorderOf, ::testing::Values(ModelChoice::bar, ModelChoice::cable, ModelChoice::beam));

TEST(Hub, BalanceStandsAtItsFirstEnd) {
  const Model model = build_model(network_with_ring(3, ModelChoice::cable));
  const Assembler assembler(model);
  std::vector<double> r(model.unknowns);
  assembler.residual(bent_state(model), r);
  std::vector<double> projected = r;
  assembler.project(projected);
  ASSERT_EQ(model.hubs.size(), 2u);
  for (const Hub& hub : model.hubs) {
    Vec3 sum = Vec3::Zero();
    for (const Support& end : hub.ends) {
      const std::size_t d = model.dof(end.line, end.node);
      sum += Eigen::Map<const Vec3>(&r[d]);
      const bool first = &end == &hub.ends.front();
      EXPECT_EQ(Eigen::Map<const Vec3>(&projected[d]).norm() > 0.0, first);
    }
    EXPECT_EQ(sum, Vec3(Eigen::Map<const Vec3>(&projected[model.dof(hub.ends.front().line, hub.ends.front().node)])));
  }
  std::vector<double> again = projected;
  assembler.project(again);
  EXPECT_EQ(again, projected);
}

TEST(Hub, HasItsBodyOnceAndTakesEveryLineEndAtAFreePoint) {
  const Model model = build_model(network_with_ring(3, ModelChoice::cable));
  EXPECT_EQ(model.hubs[0].ends.size(), 5u);  // two legs, the two ends of the ring, one end of the link
  EXPECT_EQ(model.hubs[1].ends.size(), 2u);  // the other end of the link, a leg
  EXPECT_EQ(model.bodies.size(), 3u);        // of the two points and the load on a line
}

}  // namespace
}  // namespace hawser::test
