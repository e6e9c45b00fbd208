// LoadedSystem: a line with loads that scenes do not have, for tests: a body force per unstretched length f(s, t), linear
// damping per unstretched length -c v, and a dashpot -c v on the last node. No joints, cable or beam, both ends pinned or free.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "solver/time/line_system.hpp"

namespace hawser::test {

class LoadedSystem : public LineSystem {
 public:
  using LineSystem::LineSystem;

  std::function<Vec3(double s, double t)> body_force;  // N/m
  double damping = 0.0;                                // N s/m per m
  double end_dashpot = 0.0;                            // N s/m

  void residual(const State& state, std::span<double> r) const override {
    LineSystem::residual(state, r);
    add_loads(state, r);
  }

  void tangent(const State& state, const TangentWeights& weights, const TangentFloor& floor, std::span<double> r, Tangent& t) const override {
    LineSystem::tangent(state, weights, floor, r, t);
    add_loads(state, r);
    const Chain& chain = model().chain(0);
    for (int e = 0; e < line().elements; ++e) {
      const Eigen::Matrix4d C = weights.damping * damping * mass_pattern(length(e));
      add_block(t.chain.D(chain, e), C.topLeftCorner<2, 2>(), e, e);
      add_block(t.chain.U(chain, e), C.topRightCorner<2, 2>(), e, e + 1);
      add_block(t.chain.L(chain, e), C.bottomLeftCorner<2, 2>(), e + 1, e);
      add_block(t.chain.D(chain, e + 1), C.bottomRightCorner<2, 2>(), e + 1, e + 1);
    }
    const int last = line().nodes - 1;
    add_block(t.chain.D(chain, last), weights.damping * end_dashpot * Eigen::Vector2d(1.0, 0.0).asDiagonal().toDenseMatrix(), last, last);
  }

  FactorReport linearize(const State& state, const TangentWeights& weights, const TangentFloor& floor, BorderedSolver& solver, std::span<double> r,
                         Tangent& t, std::span<double> x) const override {
    return System::linearize(state, weights, floor, solver, r, t, x);
  }

 private:
  const Line& line() const { return model().lines.front(); }
  double length(int e) const { return model().element.length[e]; }

  /// int s_i s_j of the Hermite functions, theory 2.1.
  static Eigen::Matrix4d mass_pattern(double l) {
    Eigen::Matrix4d m;
    m << 156, 22 * l, 54, -13 * l, 22 * l, 4 * l * l, 13 * l, -3 * l * l, 54, 13 * l, 156, -22 * l, -13 * l, -3 * l * l, -22 * l, 4 * l * l;
    return l / 420.0 * m;
  }

  bool held(int node) const {
    for (const Support& support : model().supports) {
      if (support.node == node) {
        return true;
      }
    }
    return false;
  }

  /// Adds the scalar 2x2 pattern to a 6x6 block, but not in rows and columns of a held position.
  void add_block(double* block, const Eigen::Matrix2d& pattern, int row_node, int column_node) const {
    Eigen::Map<Eigen::Matrix<double, 6, 6>> b(block);
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        if (!(i == 0 && held(row_node)) && !(j == 0 && held(column_node))) {
          b.block<3, 3>(3 * i, 3 * j) += pattern(i, j) * Mat3::Identity();
        }
      }
    }
  }

  void add_loads(const State& state, std::span<double> r) const {
    // Eight Gauss points: the body forces of the tests are smooth, and the element's own three points are under test.
    static constexpr double xi[] = {0.019855071751231856, 0.10166676129318664, 0.2372337950418355, 0.40828267875217511,
                                    0.59171732124782495,  0.7627662049581645,  0.8983332387068134, 0.98014492824876809};
    static constexpr double weight[] = {0.050614268145188129, 0.11119051722668724, 0.15685332293894363, 0.18134189168918100,
                                        0.18134189168918100,  0.15685332293894363, 0.11119051722668724, 0.050614268145188129};
    const Chain& chain = model().chain(0);
    for (int e = 0; e < line().elements; ++e) {
      const double l = length(e);
      Eigen::Map<Eigen::Matrix<double, 3, 4>> re(&r[chain.dof(e)]);
      const Eigen::Map<const Eigen::Matrix<double, 3, 4>> v(&state.v[chain.dof(e)]);
      re += damping * v * mass_pattern(l);
      for (int g = 0; g < 8 && body_force; ++g) {
        const double x = xi[g];
        const Eigen::RowVector4d shape(1 - x * x * (3 - 2 * x), l * x * (1 - x) * (1 - x), x * x * (3 - 2 * x), l * x * x * (x - 1));
        re -= weight[g] * l * body_force(line().s[e] + x * l, state.t) * shape;
      }
    }
    const std::size_t end = chain.dof(line().nodes - 1);
    for (int c = 0; c < 3; ++c) {
      r[end + c] += end_dashpot * state.v[end + c];
    }
  }
};

}  // namespace hawser::test
