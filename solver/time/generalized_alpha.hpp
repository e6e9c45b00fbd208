// GeneralizedAlpha: one step of the generalized-alpha method for M(q) a + f(q, v, t) = 0.
//
// Arnold-Bruels form: the residual vanishes exactly at t_{n+1} (no averaging of forces, so M may depend on q). With the
// acceleration qdd = State::a and an auxiliary acceleration a,
//   (1 - alpha_m) a_{n+1} + alpha_m a_n = (1 - alpha_f) qdd_{n+1} + alpha_f qdd_n
//   q_{n+1} = q_n + h v_n + h^2 [(1/2 - beta) a_n + beta a_{n+1}],    v_{n+1} = v_n + h [(1 - gamma) a_n + gamma a_{n+1}]
//   alpha_m = (2 rho - 1)/(rho + 1),  alpha_f = rho/(rho + 1),  gamma = 1/2 + alpha_f - alpha_m,  beta = (1 + alpha_f - alpha_m)^2/4
// with rho in [0, 1] the spectral radius at infinite frequency. The alphas weight the old value (Chung and Hulbert 1993,
// J. Appl. Mech. 60:371; Arnold and Bruels 2007, Multibody Syst. Dyn. 18:185). Order 2.
//
// a_n belongs to the time t_n + (alpha_m - alpha_f) h, so every change of step moves it: a_n <- qdd_n + h_new/h_old (a_n - qdd_n).
// Newton: [beta' M + gamma' C + K] d = -R;  q += d, v += gamma' d, qdd += beta' d,
//   beta' = (1 - alpha_m)/((1 - alpha_f) beta h^2),  gamma' = gamma/(beta h).
// A prescribed unknown takes its given position; its velocity and acceleration follow from the scheme.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "solver/bordered_solver.hpp"
#include "solver/time/system.hpp"

namespace hawser {

struct AlphaCoefficients {
  double alpha_m, alpha_f, gamma, beta;

  /// spectral_radius in [0, 1].
  explicit AlphaCoefficients(double spectral_radius);

  /// The local error of the displacement over h^2 |a_{n+1} - a_n|: (1 + 3 (alpha_m - alpha_f)^2)/12.
  double error_constant() const;
};

struct StepOptions {
  double spectral_radius = 0.8;
  double tolerance = 0.0;            // relative residual and increment (theory 6.1); 0: automatic
  int max_iterations = 12;           // of Newton with the full tangent
  int max_modified_iterations = 50;  // where the linear solver takes the symmetric part only
};

enum class StepStatus {
  ok,
  not_converged,  // too many iterations, or a solution too far away to be the right one
  not_finite,     // a residual or an increment is not a number
  singular        // no linear solve possible
};

struct StepReport {
  StepStatus status = StepStatus::ok;
  int iterations = 0;      // of Newton: one solve each
  int factorizations = 0;  // fewer where factors served twice; a refused matrix counts as well
  int residuals = 0;       // evaluations, those with a tangent included
  double residual = 0.0;   // the last one over the reference force
  std::size_t worst = 0;   // unknown of the largest residual entry
  bool modified_newton = false;
  bool easy = false;  // converged in half of the allowed iterations
};

class GeneralizedAlpha {
 public:
  /// The system and the solver must outlive the scheme. Analyzes the solver and takes all memory.
  GeneralizedAlpha(const System& system, LinearSolver& solver, const StepOptions& options);

  /// Accelerations from M qdd = -f with positions and velocities given; prescribed unknowns take their true motion.
  StepReport start(State& state);

  /// One step from state.t to `t`; h = t - state.t but for rounding. The state changes only where the report says ok.
  StepReport step(State& state, double t, double h, const TangentFloor& floor = {});

  /// Estimated local error of the position in the last accepted step, scaled norm [m] (theory 6).
  double local_error();

 private:
  struct Measure {
    double force, reference;  // N
  };
  class RoundingForce;

  static constexpr int iterations_expected = 2;

  /// What the solver's factors were made for, and how they have served in later steps.
  struct Factors {
    bool valid = false;
    TangentWeights weights;
    TangentFloor floor;
    int pause = 0;                               // steps for which old factors are not tried
    int failures = 0;                            // attempts with old factors in a row that had to be given up
    int fresh_iterations = iterations_expected;  // of the last step that began with new factors
  };

  void predict(const State& state, double t, double h);
  void find_auxiliary(const State& state, std::vector<double>& out);
  void follow_prescribed(const TangentWeights& weights);
  StepStatus iterate(const State& state, const TangentWeights& weights, const TangentFloor& floor, StepReport& report);
  double wanted_force(const Measure& now, RoundingForce& rounding) const;
  bool settled(double force, double previous, double wanted_force, double increment, RoundingForce& rounding) const;
  bool old_factors_serve(const TangentWeights& weights, const TangentFloor& floor);
  void give_up_old_factors();
  void evaluate(StepReport& report);
  StepStatus linearize(const TangentWeights& weights, const TangentFloor& floor, StepReport& report);
  void solve();
  std::span<double> condensed() { return {increment_.data(), system_.dofs()}; }  // solved in the place of the increment
  void move(double factor, const TangentWeights& weights);
  Measure measure(StepReport& report);
  int allowed_iterations(const StepReport& report) const;
  bool turned_too_far(const State& state);
  void accept(State& state, double h);

  const System& system_;
  BorderedSolver solver_;
  StepOptions options_;
  AlphaCoefficients alpha_;
  double tolerance_;
  double last_step_ = 0.0;  // s; 0 before the first
  Factors factors_;
  Tangent tangent_;
  State trial_;
  std::vector<double> auxiliary_, rebased_;  // a_{n+1} after a step; a_n as the step in progress sees it
  std::vector<double> change_;               // of qdd in the last accepted step
  std::vector<double> residual_, increment_;
  std::vector<std::array<double, 3>> predicted_;  // position, velocity, acceleration of the prescribed unknowns
};

}  // namespace hawser
