// Axial motion of a straight line, which is exactly linear: forced vibration with damping, and a wave front.
#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "solver/time/generalized_alpha.hpp"
#include "tests/support/dynamic_scenes.hpp"
#include "tests/support/loaded_system.hpp"
#include "tests/support/reference_case.hpp"

namespace hawser::test {
namespace {

using Complex = std::complex<double>;
constexpr Complex I(0.0, 1.0);
constexpr double pi = std::numbers::pi;

/// Steady vibration of case dynamic_axial_heave_damped: u = Re[U(x) e^{i w t}] downward, U(0) = heave amplitude.
struct Heave {
  double L = 4000.0, EA = 4.0e7, m = 2.5, M = 2000.0, a = 2.5, c = 0.05, cb = 200.0;
  double period;

  double omega() const { return 2.0 * pi / period; }
  Complex wave_number() const { return std::sqrt((m * omega() * omega() - I * omega() * c) / EA); }
  /// U = a cos kx + B sin kx with EA U'(L) = (M w^2 - i w cb) U(L).
  Complex sine_amplitude() const {
    const Complex k = wave_number(), load = M * omega() * omega() - I * omega() * cb, C = std::cos(k * L), S = std::sin(k * L);
    return a * (load * C + EA * k * S) / (EA * k * C - load * S);
  }
  Complex displacement(double x) const { return a * std::cos(wave_number() * x) + sine_amplitude() * std::sin(wave_number() * x); }
  Complex strain(double x) const {
    const Complex k = wave_number();
    return k * (sine_amplitude() * std::cos(k * x) - a * std::sin(k * x));
  }
};

TEST(AxialHeave, ClosedFormIsThatOfTheCase) {
  const ReferenceCase reference("dynamic_axial_heave_damped");
  for (const auto& row : reference.value<Table>("table")) {
    Heave heave;
    heave.period = row[0];
    // cos kL with kL up to 6 rad, near resonance enlarged by up to 36: 1e-16 times 1e3.
    EXPECT_NEAR(std::abs(heave.displacement(heave.L)) / heave.a, row[1], 1e-13 * row[1] * row[1] * 10.0);
    EXPECT_NEAR(std::abs(heave.EA * heave.strain(0.0)), row[3], 1e-12 * row[3] * 10.0);
  }
}

/// Largest error of the bottom displacement over two periods, in units of its amplitude; started in the steady vibration.
double heave_error(double period, int elements, int steps_per_period) {
  Heave heave;
  heave.period = period;
  LineType type;
  type.name = "line";
  type.mass = heave.m;
  type.EA = heave.EA;
  PointSpec clump = free_point(Vec3(0.0, 0.0, -heave.L), heave.M);
  clump.body.wet_weight = 0.0;
  Scene scene = one_line(type, heave.L, elements, clump);
  scene.environment.gravity = 0.0;
  // u = a cos(w t) downward.
  scene.points.front().motion = MotionSpec{};
  scene.points.front().motion->harmonics = {Harmonic{-Vec3::UnitZ(), heave.a, period, 0.5 * pi}};
  const Model model = build_model(scene);
  const Assembler assembler(model);
  LoadedSystem system(assembler);
  system.damping = heave.c;
  system.end_dashpot = heave.cb;
  State state = model.make_state();
  for (int i = 0; i < model.lines.front().nodes; ++i) {
    const double x = model.lines.front().s[i];
    const std::size_t d = model.dof(0, i);
    state.q[d + 2] = -x - heave.displacement(x).real();
    state.q[d + 5] = -1.0 - heave.strain(x).real();
    state.v[d + 2] = -(I * heave.omega() * heave.displacement(x)).real();
    state.v[d + 5] = -(I * heave.omega() * heave.strain(x)).real();
  }
  const auto solver = make_linear_solver(LinearSolverKind::chain);
  GeneralizedAlpha scheme(system, *solver, {.spectral_radius = 0.8, .tolerance = 1e-12});
  EXPECT_EQ(scheme.start(state).status, StepStatus::ok);
  const Complex bottom = heave.displacement(heave.L);
  const double h = period / steps_per_period;
  double error = 0.0;
  for (int i = 1; i <= 2 * steps_per_period; ++i) {
    EXPECT_EQ(scheme.step(state, i * h, h).status, StepStatus::ok);
    const double exact = -heave.L - (bottom * std::exp(I * heave.omega() * state.t)).real();
    error = std::max(error, std::abs(node_position(model, state, elements).z() - exact));
  }
  return error / std::abs(bottom);
}

TEST(AxialHeave, DampedSteadyVibrationIsKeptWithOrderTwo) {
  for (const double period : {3.0, 5.0, 10.0}) {
    const double coarse = heave_error(period, 64, 200), fine = heave_error(period, 64, 400);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.15) << "period " << period << ": " << coarse << ' ' << fine;
    // A period error of (w h)^2/12 = 2.1e-5 at 400 steps, over 4 pi radians; near resonance (5 s) enlarged by the
    // amplification of 13.
    const double phase = std::pow(2.0 * pi / 400.0, 2) / 12.0;
    EXPECT_LT(fine, phase * 4.0 * pi * (period == 5.0 ? 13.0 : 1.0)) << "period " << period;
  }
}

TEST(AxialStep, EndTensionFollowsTheWaveFronts) {
  // A rod pulled at 1 m/s, the pull growing over 0.02 s: rectangular waves of period 4L/c with fronts of that length.
  const ReferenceCase reference("dynamic_axial_step");
  const double L = 100.0, ramp = 0.02;
  LineType type = s3_type();
  type.EI = 0.0;
  Scene scene = one_line(type, L, 100, free_point(Vec3(L, 0.0, 0.0)));
  scene.environment.gravity = 0.0;
  scene.points.front().motion = MotionSpec{};
  scene.points.front().motion->velocity = Vec3(-1.0, 0.0, 0.0);
  scene.points.front().motion->ramp = ramp;
  const Model model = build_model(scene);
  const Assembler assembler(model);
  State state = straight_rest_state(model);
  SimulateOptions options;
  options.step = 2.5e-4;
  options.duration = 0.3;
  options.output_interval = 0.01;
  SimulateReport report;
  const auto samples = run_and_sample(assembler, options, state, report);
  ASSERT_TRUE(report.finished);
  const double high = reference.value("end tension 0<t<2L/c"), low = reference.value("end tension 2L/c<t<4L/c");
  const double turn = reference.value("2L/c");
  int checked = 0;
  for (const Sample& sample : samples) {
    // A front of the mesh is some elements longer than the ramp and rings behind it; judged on the settled plateaus.
    const double settled = std::fmod(sample.t, turn);
    if (settled < 4.0 * ramp) {
      continue;
    }
    const double tension = observe_line(model, sample.state, 0).force_from.x();
    EXPECT_NEAR(tension, sample.t < turn ? high : low, 2e-3 * high) << "t = " << sample.t;
    ++checked;
  }
  EXPECT_GE(checked, 12);
}

}  // namespace
}  // namespace hawser::test
