// What a factorization and a solution cost a node, for every backend, 10^2 to 10^5 nodes of six unknowns.
//
//   hawser_bench --benchmark_filter=linear
//
// The systems are shaped like a tangent of a cable in water: element stiffness EA/l along a direction that turns along the line, T/l across it,
// bending EI/l^3, all through Hermite shape functions, so that diagonals do not dominate, plus drag and added mass on the nodes. Backends
// that take unsymmetric matrices get an unsymmetric part of one hundredth (drag depends on direction). Counters beside every time:
// s_per_node, bytes_per_node and backward_error = max_i |A x - b|_i / (|A| |x| + |b|)_i.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include <benchmark/benchmark.h>

#include "solver/linear/linear_solver.hpp"

namespace {

using namespace hawser;

// Unknowns of an element: r0, r0', r1, r1'. Weights of the four at one point, and a direction with two stiffnesses along and across it.
void add_point(BlockTridiagonal& matrix, const Chain& c, int element, const std::array<double, 4>& shape, const std::array<double, 3>& along,
               double stiffness_along, double stiffness_across) {
  for (int p = 0; p < 4; ++p)
    for (int q = 0; q < 4; ++q) {
      double* block = p < 2 ? (q < 2 ? matrix.D(c, element) : matrix.U(c, element)) : (q < 2 ? matrix.L(c, element) : matrix.D(c, element + 1));
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const double projector = along[i] * along[j];
          const double k = stiffness_along * projector + stiffness_across * ((i == j) - projector);
          block[3 * (p % 2) + i + 6 * (3 * (q % 2) + j)] += shape[p] * shape[q] * k;
        }
    }
}

void add_element(BlockTridiagonal& matrix, const Chain& c, int element, double angle, double tension) {
  constexpr double l = 20.0, axial = 4e7, bending = 1e3, root = 0.7745966692414834;
  const std::array<double, 3> along = {std::cos(angle), 0.3 * std::sin(angle), std::sqrt(0.91) * std::sin(angle)};
  constexpr std::array<std::array<double, 2>, 3> gauss = {{{-root, 5.0 / 9}, {0.0, 8.0 / 9}, {root, 5.0 / 9}}};
  for (const auto& [x, weight] : gauss) {
    const double s = 0.5 * (1.0 + x), w = 0.5 * l * weight;
    const std::array<double, 4> slope = {(6 * s * s - 6 * s) / l, 1 - 4 * s + 3 * s * s, (6 * s - 6 * s * s) / l, 3 * s * s - 2 * s};
    const std::array<double, 4> curvature = {(12 * s - 6) / (l * l), (6 * s - 4) / l, (6 - 12 * s) / (l * l), (6 * s - 2) / l};
    add_point(matrix, c, element, slope, along, w * axial, w * tension);
    add_point(matrix, c, element, curvature, along, w * bending, w * bending);
  }
}

BlockTridiagonal cable_matrix(int nodes, bool unsymmetric) {
  BlockTridiagonal matrix(std::vector<Chain>{{.block = 6, .nodes = nodes}});
  const Chain& c = matrix.chains()[0];
  for (int e = 0; e + 1 < nodes; ++e) add_element(matrix, c, e, 0.2 + 1.2 * e / nodes, 2e4 + 8e4 * e / nodes);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < nodes; ++i) {
    double* d = matrix.D(c, i);
    for (int k = 0; k < 6; ++k) d[7 * k] += k < 3 ? 500.0 : 2e3;  // added mass and drag over a time step
    if (!unsymmetric) continue;
    for (int k = 0; k < 36; ++k) d[k] += (k % 6 < 3) == (k / 6 < 3) ? (k % 6 < 3 ? 5.0 : 20.0) * uniform(random) : 0.0;
  }
  for (const int end : {0, nodes - 1})
    for (int k = 0; k < 3; ++k) matrix.D(c, end)[7 * k] += 1e9;
  return matrix;
}

// Row by row (Oettli and Prager): no large row hides a small one.
double backward_error(const BlockTridiagonal& matrix, std::span<const double> x, std::span<const double> b) {
  BlockTridiagonal magnitudes = matrix;
  std::vector<double> size_x(x.begin(), x.end()), product(b.size()), size(b.size());
  for (double& v : magnitudes.values()) v = std::abs(v);
  for (double& v : size_x) v = std::abs(v);
  matrix.multiply(x, product);
  magnitudes.multiply(size_x, size);
  double error = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) error = std::max(error, std::abs(product[i] - b[i]) / (size[i] + std::abs(b[i])));
  return error;
}

enum class Task { factorize, solve, both };

void linear(benchmark::State& state, LinearSolverKind kind, Task task) {
  const int nodes = static_cast<int>(state.range(0));
  const auto solver = make_linear_solver(kind);
  const BlockTridiagonal matrix = cable_matrix(nodes, solver->takes_unsymmetric());
  std::vector<double> b(matrix.dofs()), x;
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = std::sin(0.1 * static_cast<double>(i));
  x = b;
  solver->analyze(matrix);
  const FactorReport report = solver->factorize(matrix);
  if (report.status != FactorStatus::ok) return state.SkipWithError(report.message.c_str());
  for (auto _ : state) {
    if (task != Task::solve) benchmark::DoNotOptimize(solver->factorize(matrix).smallest_pivot);
    if (task == Task::factorize) continue;
    std::copy(b.begin(), b.end(), x.begin());
    solver->solve(x);
    benchmark::ClobberMemory();
  }
  std::copy(b.begin(), b.end(), x.begin());
  solver->solve(x);
  using benchmark::Counter;
  state.counters["s_per_node"] = Counter(nodes, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["bytes_per_node"] = static_cast<double>(solver->bytes()) / nodes;
  state.counters["backward_error"] = backward_error(matrix, x, b);
  state.counters["fell_back"] = report.fell_back;
}

const bool registered = [] {
  constexpr std::array<std::pair<Task, const char*>, 3> tasks = {{{Task::factorize, "factorize"}, {Task::solve, "solve"}, {Task::both, "both"}}};
  for (const auto& [task, word] : tasks)
    for (const LinearSolverKind kind : all_linear_solvers()) {
      const std::string name = std::string("linear/") + word + "/" + std::string(name_of(kind));
      benchmark::RegisterBenchmark(name.c_str(), linear, kind, task)->RangeMultiplier(10)->Range(100, 100000)->Unit(benchmark::kMicrosecond);
    }
  return true;
}();

}  // namespace
