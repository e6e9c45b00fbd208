// Static solutions for tests, and what their discretisation is worth.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "assembly/assembler.hpp"
#include "assembly/observables.hpp"
#include "solver/statics.hpp"
#include "tests/support/threads.hpp"

namespace hawser::test {

/// The static solution of a scene; `given`: from the shape tables of its lines.
struct StaticSolution {
  explicit StaticSolution(const Scene& scene, StaticStart start = StaticStart::catenary, double tolerance = 0.0)
      : model(std::make_unique<Model>(build_model(scene))) {
    const Assembler assembler(*model, threads());
    StaticOptions options;
    options.start = start;
    if (start == StaticStart::given) state = static_start(*model, StaticStart::catenary, scene);
    options.tolerance = tolerance;
    report = solve_static(assembler, options, state);
    EXPECT_TRUE(report.converged) << report.failure.what << "; " << report.failure.cause << "\n" << fmt::format("{}", fmt::join(report.stages, "\n"));
    EXPECT_TRUE(report.stable);
    line = observe_line(*model, state, 0);
  }

  std::vector<Station> stations(const std::vector<double>& s) const { return observe_stations(*model, state, 0, s); }
  Station station(double s) const { return stations({s})[0]; }
  Vec3 slope(int node) const { return Eigen::Map<const Vec3>(&state.q[model->dof(0, node) + 3]); }
  int last_node() const { return model->lines[0].nodes - 1; }

  std::unique_ptr<Model> model;
  State state;
  StaticReport report;
  LineResult line;
};

/// Of a point of the scene, by its name.
inline PointResult point_of(const StaticSolution& s, const std::string& name) {
  for (std::size_t i = 0; i < s.model->points.size(); ++i)
    if (s.model->points[i].name == name) return observe_points(*s.model, s.state)[i];
  ADD_FAILURE() << "no point " << name;
  return {};
}
inline Vec3 position(const StaticSolution& s, const std::string& point) { return point_of(s, point).position; }
inline Vec3 force(const StaticSolution& s, const std::string& point) { return point_of(s, point).force; }

/// Values of a quantity and a bound on their numerical error.
struct Numbers {
  std::vector<double> value, error;
};

/// Values on 2n elements. Order `order` predicts their error as the change from n divided by 2^order - 1; twice that is asked.
inline Numbers refined(const std::function<std::vector<double>(int)>& solve, int n, int order = 4) {
  const std::vector<double> coarse = solve(n);
  Numbers result{solve(2 * n), {}};
  for (std::size_t i = 0; i < coarse.size(); ++i) result.error.push_back(2.0 * std::abs(result.value[i] - coarse[i]) / (std::pow(2.0, order) - 1.0));
  return result;
}

/// The inextensible limit: linear extrapolation in 1/EA from EA and 2 EA. The first-order part c = f(2EA) - f(EA) drops out;
/// what is left is of the order c times the relative change of the first value (a tension), asked ten times over.
inline Numbers inextensible(const std::function<Numbers(double)>& solve, double EA) {
  const Numbers a = solve(EA);
  Numbers b = solve(2.0 * EA);
  const double relative = std::abs(b.value[0] - a.value[0]) / std::abs(b.value[0]);
  for (std::size_t i = 0; i < b.value.size(); ++i) {
    const double change = b.value[i] - a.value[i];
    b.error[i] = 2.0 * b.error[i] + a.error[i] + 10.0 * std::abs(change) * relative;
    b.value[i] += change;
  }
  return b;
}

}  // namespace hawser::test
