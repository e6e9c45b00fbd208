// What the two forms of the chain solver cost a node, LU and L Delta L^T (solver/linear/README.md), with 3, 6 and 7 unknowns.
//
//   hawser_bench --benchmark_filter=forms
//
// stored:  factorize and solve of a stored matrix
// panels:  a full Newton iteration of statics in still water, made panel by panel, factors spent
// The matrix of `stored` is symmetric with dominant diagonal blocks and the same for both forms; `panels` has the line of fixture.hpp at rest.
#include <algorithm>
#include <cmath>
#include <string>

#include "assembly/symmetry.hpp"
#include "bench/fixture.hpp"

namespace {

using namespace hawser;
using namespace hawser::bench;

BlockTridiagonal dominant_matrix(int block, int nodes) {
  BlockTridiagonal matrix({Chain{block, nodes, 0, 0}});
  double phase = 0.0;
  for (double& v : matrix.values()) v = std::sin(phase += 1.7);
  matrix.symmetrize();
  const Chain& c = matrix.chains().front();
  for (int i = 0; i < nodes; ++i)
    for (int k = 0; k < block; ++k) matrix.D(c, i)[k * (block + 1)] += 3.0 * block;
  return matrix;
}

void stored(benchmark::State& state, int block, Symmetry symmetry) {
  const int nodes = static_cast<int>(state.range(0));
  BlockTridiagonal matrix = dominant_matrix(block, nodes);
  matrix.declare(symmetry);
  const auto solver = make_linear_solver(LinearSolverKind::chain);
  solver->analyze(matrix);
  const std::vector<double> b(matrix.dofs(), 1.0);
  std::vector<double> x = b;
  for (auto _ : state) {
    benchmark::DoNotOptimize(solver->factorize(matrix).smallest_pivot);
    std::copy(b.begin(), b.end(), x.begin());
    solver->solve(x);
    benchmark::ClobberMemory();
  }
  state.counters["s_per_element"] = per_element(nodes);
  state.counters["backward_error"] = backward_error(matrix, x, b);
}

void panels(benchmark::State& state, ModelChoice family, Symmetry symmetry) {
  const int elements = static_cast<int>(state.range(0));
  Scene scene = line_scene(family, elements, true);
  scene.environment.current.clear();
  const Model model = build_model(scene);
  const Assembler assembler(model);
  State at = moving_state(model);
  std::fill(at.v.begin(), at.v.end(), 0.0);
  std::fill(at.a.begin(), at.a.end(), 0.0);
  if (static_symmetry(model, at) != Symmetry::symmetric) return state.SkipWithError("the tangent is not symmetric");
  Tangent tangent = assembler.make_tangent();
  std::vector<double> r(model.unknowns), rhs(model.dofs), d(model.unknowns);
  const auto solver = make_linear_solver(LinearSolverKind::chain);
  solver->analyze(tangent.chain);
  bool fell_back = false;
  for (auto _ : state) {
    TangentPanels made = assembler.tangent_panels(at, TangentWeights{}, TangentFloor{}, r, tangent, rhs);
    made.declare(symmetry);
    fell_back = solver->solve_once(made, rhs).fell_back;
    assembler.expand(tangent, rhs, d);
    benchmark::ClobberMemory();
  }
  assembler.tangent(at, TangentWeights{}, TangentFloor{}, r, tangent);
  std::vector<double> b(model.dofs);
  assembler.reduce(tangent, r, b);
  state.counters["s_per_element"] = per_element(elements);
  state.counters["backward_error"] = backward_error(tangent.chain, rhs, b);
  state.counters["fell_back"] = fell_back;
}

const bool registered = [] {
  for (const auto& [symmetry, word] : {std::pair{Symmetry::unknown, "lu"}, {Symmetry::symmetric, "ldlt"}}) {
    for (const int block : {3, 6, 7}) {
      const std::string name = std::string("forms/stored/") + word + "/" + std::to_string(block);
      benchmark::RegisterBenchmark(name.c_str(), stored, block, symmetry)->Arg(1000)->Arg(100000)->Unit(benchmark::kMicrosecond);
    }
    for (const ModelChoice family : {ModelChoice::cable, ModelChoice::beam}) {
      const std::string name = std::string("forms/panels/") + word + "/" + word_of(family);
      benchmark::RegisterBenchmark(name.c_str(), panels, family, symmetry)->Arg(1000)->Arg(100000)->Unit(benchmark::kMicrosecond);
    }
  }
  return true;
}();

}  // namespace
