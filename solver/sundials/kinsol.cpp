#include "solver/sundials/kinsol.hpp"

#include <fmt/format.h>
#include <kinsol/kinsol.h>
#include <kinsol/kinsol_ls.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "solver/static_failure.hpp"
#include "solver/static_system.hpp"

namespace hawser {
namespace {

constexpr double automatic_tolerance = 1e-10;  // as statics
constexpr double largest_step = 0.1;           // of the longest line, mean of the nodes
constexpr double least_scaled_step = 1e-14;
constexpr int most_iterations = 60;  // of one round
constexpr int most_rounds = 3;       // of one stage

/// What KINSOL's callbacks work on: the equations at the state, its tangent and its factors.
struct Problem {
  Problem(const Assembler& a, LinearSolver& l, State& s)
      : assembler(a), linear(l), state(s), tangent(a.make_tangent()), r(a.model().unknowns), rhs(a.model().dofs) {
    linear.analyze(tangent);
    const std::vector<double>& least = a.model().element.minimum_tension;
    least_kept = *std::max_element(least.begin(), least.end());
  }

  void residual(std::span<const double> q, std::span<double> out) {
    state.q.assign(q.begin(), q.end());
    assembler.residual(state, out);
    assembler.project(out);
  }

  /// The tangent at q; a least tension is kept where the tension only vanishes, as in Newton.
  bool factorize(std::span<const double> q) {
    state.q.assign(q.begin(), q.end());
    const bool compressed = least_strain_tension(assembler.model(), state).value < -10.0 * least_kept;
    assembler.tangent(state, TangentWeights{}, {0.0, !compressed, false}, r, tangent);
    ++factorizations;
    report = linear.factorize(tangent);
    return report.status == FactorStatus::ok;
  }

  /// T x = b.
  void solve(std::span<const double> b, std::span<double> x) {
    std::transform(b.begin(), b.end(), r.begin(), [](double value) { return -value; });
    assembler.reduce(tangent, r, rhs);
    linear.solve(rhs);
    assembler.expand(tangent, rhs, x);
  }

  const Assembler& assembler;
  BorderedSolver linear;
  State& state;
  Tangent tangent;
  std::vector<double> r, rhs;
  double least_kept = 0.0;
  int factorizations = 0;
  FactorReport report;
  std::string message;  // KINSOL's last one
};

std::span<double> values(N_Vector v) { return {N_VGetArrayPointer(v), static_cast<std::size_t>(N_VGetLength(v))}; }

int residual_callback(N_Vector q, N_Vector r, void* problem) {
  static_cast<Problem*>(problem)->residual(values(q), values(r));
  return std::all_of(values(r).begin(), values(r).end(), [](double x) { return std::isfinite(x); }) ? 0 : 1;  // 1: take a shorter step
}

int tangent_callback(N_Vector q, N_Vector, SUNMatrix, void* problem, N_Vector, N_Vector) {
  return static_cast<Problem*>(problem)->factorize(values(q)) ? 0 : -1;
}

void message_callback(int, const char*, const char*, char* message, void* problem) { static_cast<Problem*>(problem)->message = message; }

/// A SUNMatrix that only stands for Problem::tangent, and a SUNLinearSolver that solves with its factors.
SUNMatrix make_matrix(SUNContext context) {
  SUNMatrix matrix = SUNMatNewEmpty(context);
  matrix->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix->ops->zero = [](SUNMatrix) { return 0; };
  matrix->ops->destroy = [](SUNMatrix m) { SUNMatFreeEmpty(m); };
  return matrix;
}

SUNLinearSolver make_solver(SUNContext context, Problem& problem) {
  SUNLinearSolver solver = SUNLinSolNewEmpty(context);
  solver->content = &problem;
  solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
  solver->ops->initialize = [](SUNLinearSolver) { return 0; };
  solver->ops->setup = [](SUNLinearSolver, SUNMatrix) { return 0; };  // factorized with the tangent
  solver->ops->solve = [](SUNLinearSolver s, SUNMatrix, N_Vector x, N_Vector b, realtype) {
    static_cast<Problem*>(s->content)->solve(values(b), values(x));
    return 0;
  };
  solver->ops->free = [](SUNLinearSolver s) {
    SUNLinSolFreeEmpty(s);
    return 0;
  };
  return solver;
}

/// KINSOL and all it owns, for one model.
class Kinsol {
 public:
  Kinsol(Problem& problem, const Model& model) : problem_(problem), model_(model) {
    SUNContext_Create(nullptr, &context_);
    const auto n = static_cast<sunindextype>(model.unknowns);
    q_ = N_VNew_Serial(n, context_);
    of_unknowns_ = N_VNew_Serial(n, context_);
    of_residuals_ = N_VNew_Serial(n, context_);
    matrix_ = make_matrix(context_);
    solver_ = make_solver(context_, problem);
    memory_ = KINCreate(context_);
    KINSetErrHandlerFn(memory_, message_callback, &problem);
    KINInit(memory_, residual_callback, q_);
    KINSetUserData(memory_, &problem);
    KINSetLinearSolver(memory_, solver_, matrix_);
    KINSetJacFn(memory_, tangent_callback);
    KINSetMaxSetupCalls(memory_, 1);  // a new tangent at every step
    KINSetScaledStepTol(memory_, least_scaled_step);
    KINSetMaxNewtonStep(memory_, largest_step * std::sqrt(static_cast<double>(model.total_nodes())));
    scale();
  }
  ~Kinsol() {
    KINFree(&memory_);
    SUNLinSolFree(solver_);
    SUNMatDestroy(matrix_);
    for (N_Vector v : {q_, of_unknowns_, of_residuals_}) N_VDestroy(v);
    SUNContext_Free(&context_);
  }
  Kinsol(const Kinsol&) = delete;
  Kinsol& operator=(const Kinsol&) = delete;

  /// Iterates from the state to a residual [N]; KINSOL's own verdict. The state is left at the last point.
  int solve(int strategy, double tolerance, int iterations) {
    KINSetFuncNormTol(memory_, tolerance);
    KINSetNumMaxIters(memory_, iterations);
    std::copy(problem_.state.q.begin(), problem_.state.q.end(), values(q_).begin());
    const int flag = KINSol(memory_, q_, strategy, of_unknowns_, of_residuals_);
    problem_.state.q.assign(values(q_).begin(), values(q_).end());
    return flag;
  }

 private:
  void scale() {
    double longest = 0.0;
    for (const Line& line : model_.lines) longest = std::max(longest, line.length);
    const std::span<double> u = values(of_unknowns_), f = values(of_residuals_);
    for (int index = 0; index < static_cast<int>(model_.lines.size()); ++index) {
      const Chain& chain = model_.chain(index);
      for (int node = 0; node < chain.nodes; ++node)
        for (int k = 0; k < chain.block; ++k) {
          const double l = k < 3 ? 1.0 : model_.node_length[model_.lines[index].first_node + node];
          u[chain.dof(node) + static_cast<std::size_t>(k)] = l / longest;
          f[chain.dof(node) + static_cast<std::size_t>(k)] = 1.0 / l;
        }
    }
    for (const Joint& joint : model_.joints) {
      const double l = model_.node_length[model_.lines[joint.line].first_node + joint.node];
      for (int k = 0; k < joint.inner_count(); ++k) {
        u[joint.inner + static_cast<std::size_t>(k)] = l / longest;
        f[joint.inner + static_cast<std::size_t>(k)] = 1.0 / l;
      }
    }
  }

  Problem& problem_;
  const Model& model_;
  SUNContext context_ = nullptr;
  N_Vector q_ = nullptr, of_unknowns_ = nullptr, of_residuals_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
  void* memory_ = nullptr;
};

std::string name_of_flag(int flag) {
  char* name = KINGetReturnFlagName(flag);
  std::string text = name ? name : "";
  std::free(name);
  return text;
}

/// Residual and its references at the state, and whether that is an equilibrium, by the criteria of solver/README.md.
bool judge(Problem& problem, const StaticOptions& options, StaticReport& report) {
  const Model& model = problem.assembler.model();
  std::vector<double> r(model.unknowns);
  problem.assembler.residual(problem.state, r);
  report.reference_force = reference_force(model, r);
  problem.assembler.project(r);
  report.residual_force = residual_norm(model, r);
  report.roundoff_floor = roundoff_force(model, problem.state);
  report.residual = report.reference_force > 0.0 ? report.residual_force / report.reference_force : report.residual_force;
  const double tolerance = (options.tolerance > 0.0 ? options.tolerance : automatic_tolerance) * report.reference_force;
  return report.residual_force <= std::max(tolerance, rounding_margin * report.roundoff_floor);
}

/// What KINSOL's norm, the largest component, has to reach: at least the norm of a node over sqrt(3).
double wanted_residual(const StaticOptions& options, const StaticReport& report) {
  const double tolerance = options.tolerance > 0.0 ? options.tolerance : automatic_tolerance;
  return std::max(tolerance * report.reference_force, 2.0 * report.roundoff_floor) / std::sqrt(3.0);
}

Failure explain(const Problem& problem, const StaticReport& report, int flag) {
  const Model& model = problem.assembler.model();
  Failure failure;
  if (report.negative_pivots > 0) {
    const LeastTension least = least_strain_tension(model, problem.state);
    failure.what = fmt::format("KINSOL found an unstable equilibrium: {} negative pivots, strain tension {:.4g} N (compression)",
                               report.negative_pivots, least.value);
    failure.line = model.lines[static_cast<std::size_t>(least.line)].name;
    failure.s = least.s;
    failure.cause = "its line search follows the start and knows nothing of stability";
    failure.remedy = "use --method newton, which leaves unstable states, or another start";
    return failure;
  }
  std::vector<double> r(model.unknowns);
  problem.assembler.residual(problem.state, r);
  problem.assembler.project(r);
  const WorstNode worst = worst_node(model, r);
  failure.what = fmt::format("KINSOL stopped with {}: residual {:.3g} N is {:.1e} of {:.4g} N after {} factorizations", name_of_flag(flag),
                             report.residual_force, report.residual, report.reference_force, report.iterations);
  failure.line = model.lines[static_cast<std::size_t>(worst.line)].name;
  failure.s = model.lines[static_cast<std::size_t>(worst.line)].s[static_cast<std::size_t>(worst.node)];
  const bool factorized = problem.report.status == FactorStatus::ok;
  failure.cause = !factorized ? fmt::format("the tangent could not be factorized by {}: {}", report.linear_solver, problem.report.message)
                  : problem.message.empty() ? "the line search found no way on"
                                            : problem.message;
  failure.remedy = "use --method newton, which starts in stages, or --start catenary";
  return failure;
}

}  // namespace

StaticReport solve_static_kinsol(const Assembler& assembler, const StaticOptions& options, State& state) {
  const Model& model = assembler.model();
  StaticReport report;
  if (const auto refusal = refuse(model)) {
    report.failure = *refusal;
    if (options.start != StaticStart::given) state = static_start(model, StaticStart::straight);
    return report;
  }
  const auto linear = make_linear_solver(options.linear_solver, options.threads);
  report.linear_solver = linear->name();
  Problem problem(assembler, *linear, state);
  Kinsol kinsol(problem, model);
  const auto attempt = [&](const std::string& name, State start, int strategy) {
    state = std::move(start);
    const int before = problem.factorizations;
    int flag = 0;
    report.converged = report.stable = false;
    report.negative_pivots = 0;
    judge(problem, options, report);
    // The tolerance follows the reference force, which is known well only near the end.
    for (int round = 0; round < most_rounds && !report.converged; ++round) {
      const int left = std::min(most_iterations, options.max_iterations - problem.factorizations);
      if (left <= 0) break;
      flag = kinsol.solve(strategy, wanted_residual(options, report), left);
      report.converged = judge(problem, options, report);
      if (flag < 0) break;
    }
    report.iterations = problem.factorizations;
    const auto knot = report.converged ? certify(model, state, report) : std::nullopt;
    const char* outcome = report.stable ? "converged" : report.converged ? "converged, unstable or knotted" : "not converged";
    report.stages.push_back(fmt::format("KINSOL {}: {} ({}) after {} factorizations, residual {:.1e} of {:.4g} N", name, outcome, name_of_flag(flag),
                                        problem.factorizations - before, report.residual, report.reference_force));
    if (options.log) options.log(report.stages.back());
    report.converged = report.stable;
    report.failure = report.converged ? Failure{} : knot ? knotted(model, *knot) : explain(problem, report, flag);
    return report.converged;
  };
  const auto solved_from = [&](const char* name, const State& start) {
    if (attempt(fmt::format("from the {}", name), start, KIN_LINESEARCH)) return true;
    const bool unstable = report.negative_pivots > 0;  // whole steps would only find it again
    return !unstable && attempt(fmt::format("from the {}, without line search", name), start, KIN_NONE);
  };
  const State start = options.start == StaticStart::given ? state : static_start(model, options.start);
  if (!solved_from("start", start) && options.start != StaticStart::catenary) solved_from("catenary", static_start(model, StaticStart::catenary));
  return report;
}

}  // namespace hawser
