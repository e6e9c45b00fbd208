#include "assembly/seabed.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "assembly/assembler.hpp"
#include "assembly/bracketed_root.hpp"
#include "tests/support/dual.hpp"
#include "tests/support/scene_builder.hpp"

namespace hawser {
namespace {

using test::Dual;
using test::SceneBuilder;

/// Soundings of a smooth bumpy bed around z = -10 m, 6 x 5, unevenly spaced, `scale` times 1.5 to 8 m apart.
BathymetryGrid bumpy(double scale = 1.0) {
  BathymetryGrid grid{{-3.0, 1.0, 4.0, 9.0, 12.0, 20.0}, {-4.0, -1.0, 0.5, 3.0, 6.0}, {}};
  for (double& x : grid.x) x *= scale;
  for (double& y : grid.y) y *= scale;
  for (double y : grid.y)
    for (double x : grid.x) grid.z.push_back(-10.0 + 0.4 * std::sin(0.5 / scale * x) + 0.3 * std::cos(0.7 / scale * y) + 0.05 / scale * x);
  return grid;
}

SeabedLaw law(double smoothing, double damping, double axial, double lateral, double slip = 0.02) {
  return {2.0e3, smoothing, damping, axial, lateral, slip};
}

// --- the surface ---

TEST(SeabedSurface, TwoByTwoSoundingsAreASlopingPlaneEverywhere) {
  const SeabedSurface plane(BathymetryGrid{{0.0, 10.0}, {0.0, 5.0}, {-100.0, -99.0, -100.5, -99.5}});
  for (double x : {-40.0, 0.0, 3.0, 10.0, 60.0})
    for (double y : {-9.0, 2.0, 33.0}) {
      const auto bed = plane.at(x, y);
      EXPECT_NEAR(bed.height, -100.0 + 0.1 * x - 0.1 * y, 1e-12);
      EXPECT_NEAR(bed.slope[0], 0.1, 1e-14);
      EXPECT_NEAR(bed.slope[1], -0.1, 1e-14);
      EXPECT_NEAR(bed.gradient[0], 0.1, 1e-14);
      EXPECT_NEAR(bed.gradient[1], -0.1, 1e-14);
    }
}

TEST(SeabedSurface, MeetsItsSoundingsAndIsBilinearBetweenThem) {
  const BathymetryGrid grid = bumpy();
  const SeabedSurface surface(grid);
  for (std::size_t j = 0; j < grid.y.size(); ++j)
    for (std::size_t i = 0; i < grid.x.size(); ++i) EXPECT_NEAR(surface.height(grid.x[i], grid.y[j]), grid.z[j * 6 + i], 1e-14);
  EXPECT_NEAR(surface.height(2.5, -0.25), 0.25 * (grid.z[7] + grid.z[8] + grid.z[13] + grid.z[14]), 1e-14);
}

TEST(SeabedSurface, DerivativesAreThoseOfHeightAndSlopes) {
  using AD = Dual<2>;
  const SeabedSurface surface(bumpy());
  for (double x : {-7.0, -1.0, 2.0, 6.5, 11.0, 31.0})
    for (double y : {-8.0, -2.0, 0.1, 5.0, 7.0}) {
      const SurfacePoint<AD> bed = surface.at(AD::variable(x, 0), AD::variable(y, 1));
      for (int k = 0; k < 2; ++k) {
        EXPECT_NEAR(bed.gradient[k], bed.height.d[k], 1e-14);
        for (int i = 0; i < 2; ++i) EXPECT_NEAR(bed.curvature[i][k], bed.slope[i].d[k], 1e-14);
      }
    }
}

TEST(SeabedSurface, NothingInARectangleIsHigherThanItsHighest) {
  const SeabedSurface surface(bumpy());
  for (double x0 : {-9.0, -2.0, 3.0, 15.0})
    for (double y0 : {-6.0, 0.0, 4.0}) {
      double highest = -1e300;
      for (int i = 0; i <= 40; ++i)
        for (int j = 0; j <= 40; ++j) highest = std::max(highest, surface.height(x0 + 0.2 * i, y0 + 0.1 * j));
      const double bound = surface.highest_within(x0, x0 + 8.0, y0, y0 + 4.0);
      EXPECT_GE(bound, highest - 1e-13);
      EXPECT_LE(bound, highest + 0.1);  // met at a corner of a cell; the samples are 0.2 m and 0.1 m apart on slopes below 0.4
    }
}

// --- the law ---

TEST(SeabedLaw, PushesByStiffnessTimesPenetrationUpwardOnALevelBed) {
  const SeabedSurface level(-10.0);
  const V3<double> zero{{0, 0, 0}}, x{{1, 0, 0}};
  const auto at = [&](const SeabedLaw& l, double z) { return contact_force(l, level.at(3.0, 4.0), V3<double>{{3, 4, z}}, x, zero, nullptr); };
  EXPECT_EQ(at(law(0, 0, 0, 0), -9.99)[2], 0.0);
  EXPECT_NEAR(at(law(0, 0, 0, 0), -10.25)[2], 500.0, 1e-10);
  EXPECT_EQ(at(law(0, 0, 0, 0), -10.25)[0], 0.0);
  EXPECT_NEAR(at(law(0.2, 0, 0, 0), -10.1)[2], 2.0e3 * 0.1 * 0.1 / 0.4, 1e-10);
  EXPECT_NEAR(at(law(0.2, 0, 0, 0), -10.3)[2], 2.0e3 * (0.3 - 0.1), 1e-10);
}

TEST(SeabedLaw, NeverPullsHoweverFastTheLineRises) {
  const SeabedSurface level(-10.0);
  const auto rising = [&](double speed) {
    return contact_force(law(0, 50.0, 0, 0), level.at(0.0, 0.0), V3<double>{{0, 0, -10.1}}, V3<double>{{1, 0, 0}}, V3<double>{{0, 0, speed}},
                         nullptr)[2];
  };
  EXPECT_NEAR(rising(-1.0), 250.0, 1e-10);
  EXPECT_NEAR(rising(1.0), 150.0, 1e-10);
  EXPECT_EQ(rising(100.0), 0.0);
}

TEST(SeabedLaw, FrictionBeyondTheSlipIsCoulombsAxiallyAndLaterally) {
  const SeabedSurface level(-10.0);
  const Vec3 lay(0.0, 0.0, -10.0);
  const V3<double> zero{{0, 0, 0}}, along{{1, 0, 0}};
  const SeabedLaw l = law(0, 0, 0.3, 0.7);
  const double N = 200.0;  // 0.1 m deep
  const auto axial = contact_force(l, level.at(5.0, 0.0), V3<double>{{5.0, 0.0, -10.1}}, along, zero, &lay);
  const auto lateral = contact_force(l, level.at(0.0, -5.0), V3<double>{{0.0, -5.0, -10.1}}, along, zero, &lay);
  // The tangent is shortened by upright_slope^2/2.
  EXPECT_NEAR(axial[0], -0.3 * N, upright_slope * upright_slope * 0.4 * N);
  EXPECT_NEAR(lateral[1], 0.7 * N, 1e-14 * N);
  EXPECT_EQ(lateral[0], 0.0);
}

TEST(SeabedLaw, FrictionIsFullAtTheSlipWithTwoContinuousDerivatives) {
  const SeabedLaw l = law(0, 0, 0.4, 0.4);
  const auto share = [&](double x) { return x * l.slip / sliding_length(l, x * x * l.slip * l.slip); };
  EXPECT_NEAR(share(1e-9), 15.0 / 8.0 * 1e-9, 1e-24);
  EXPECT_DOUBLE_EQ(friction_stiffness(l), 0.4 * 15.0 / 8.0 / l.slip);
  for (const double x : {1.0, 1.001, 50.0}) EXPECT_NEAR(share(x), 1.0, 1e-15);
  // The third derivative is 15 there: 1 - f = 5/2 (1 - x)^3 to the next order.
  for (const double h : {1e-2, 1e-3}) EXPECT_NEAR((1.0 - share(1.0 - h)) / (2.5 * h * h * h), 1.0, h);
  double missing = 0.0;
  constexpr int n = 1000;
  for (int i = 0; i < n; ++i) missing += (1.0 - share((i + 0.5) / n)) / n;
  EXPECT_NEAR(missing, 5.0 / 16.0, 1e-6);
}

TEST(SeabedLaw, ALineThatSinksNormallyToASlopeDoesNotRub) {
  const SeabedSurface plane(BathymetryGrid{{0.0, 10.0}, {0.0, 5.0}, {-100.0, -97.0, -99.0, -96.0}});
  const Vec3 lay(5.0, 2.0, plane.height(5.0, 2.0)), normal(-0.3, -0.2, 1.0), sunk = lay - 0.1 * normal;
  const auto at = plane.at(sunk.x(), sunk.y());
  const auto force =
      contact_force(law(0, 0, 0.5, 0.5), at, V3<double>{{sunk.x(), sunk.y(), sunk.z()}}, V3<double>{{1, 0, 0}}, V3<double>{{0, 0, 0}}, &lay);
  EXPECT_NEAR(force[0], -0.3 * force[2], 1e-9);
  EXPECT_NEAR(force[1], -0.2 * force[2], 1e-9);
}

// Analytic derivatives against automatic differentiation of the force itself; both are sums of a few dozen products: 1e-12.
TEST(SeabedLaw, TangentIsTheDerivativeOfTheForce) {
  using AD = Dual<9>;
  const SeabedSurface level(-10.0), bumps(bumpy());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const SeabedLaw laws[] = {law(0, 0, 0, 0),     law(0.3, 0, 0, 0),     law(0, 40.0, 0, 0),      law(0.3, 40.0, 0, 0),
                            law(0, 0, 0.5, 0.5), law(0.3, 0, 0.4, 0.9), law(0.3, 40.0, 0.9, 0.4)};
  for (const SeabedSurface& surface : {level, bumps})
    for (const SeabedLaw& l : laws)
      for (int k = 0; k < 20; ++k) {
        const double x[9] = {
            8.0 + 9.0 * u(random), 4.0 * u(random), 0.0, 1.0 + 0.2 * u(random), 0.3 * u(random), 0.3 * u(random), u(random), u(random), u(random)};
        const double z = surface.height(x[0], x[1]) - 0.05 - 0.4 * std::abs(u(random));
        V3<AD> part[3];
        for (int i = 0; i < 9; ++i) part[i / 3][i % 3] = AD::variable(i == 2 ? z : x[i], i);
        const Vec3 lay(x[0] + 0.03 * u(random), x[1] + 0.03 * u(random), z + 0.1 * u(random));
        const Vec3* laid = l.rubs() ? &lay : nullptr;
        const V3<AD> wanted = contact_force(l, surface.at(part[0][0], part[0][1]), part[0], part[1], part[2], laid);
        const ContactForce got =
            contact_tangent(l, surface.at(x[0], x[1]), {x[0], x[1], z}, {x[3], x[4], x[5]}, {x[6], x[7], x[8]}, laid, FrictionTangent::exact);
        const double scale = l.stiffness + l.damping + (l.rubs() ? friction_stiffness(l) * got.force.z() : 0.0);
        for (int i = 0; i < 3; ++i) {
          EXPECT_NEAR(got.force[i], wanted[i].v, 1e-12 * scale);
          for (int j = 0; j < 3; ++j) {
            EXPECT_NEAR(got.d_r(i, j), wanted[i].d[j], 1e-12 * scale) << i << j;
            EXPECT_NEAR(got.d_a(i, j), wanted[i].d[3 + j], 1e-12 * scale) << i << j;
            EXPECT_NEAR(got.d_v(i, j), wanted[i].d[6 + j], 1e-12 * scale) << i << j;
          }
        }
      }
}

// --- elements ---

struct Setup {
  const char* name;
  ModelChoice model;
  bool grid;
  SeabedLaw law;
};

struct SeabedUnder : ::testing::TestWithParam<Setup> {
  /// A line of four elements from the bed at x = 0 up to x = 16 m, and a state that waves through the bed.
  SeabedUnder() {
    SceneBuilder builder;
    builder.dry().type(test::line_type("t", 1.0e5, 12.0, GetParam().model == ModelChoice::beam ? 20.0 : 0.0));
    builder.fixed("a", {0, 0, -10.0}).fixed("b", {16, 0, -9.5}).line("a", "b", GetParam().model).section("t", 16.0, 4);
    SeabedSpec& bed = builder.scene.environment.seabed;
    builder.scene.environment.depth = 10.0;
    if (GetParam().grid) bed.bathymetry = bumpy(10.0);  // cells longer than elements, as in a chart
    const SeabedLaw& l = GetParam().law;
    bed = {l.stiffness, l.smoothing, l.damping, l.friction_axial, l.friction_lateral, l.slip, bed.bathymetry};
    model = build_model(builder.scene);
    state = model.make_state();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    const bool slopes = GetParam().model != ModelChoice::bar;
    for (int i = 0; i <= 4; ++i) {
      const std::size_t d = model.dof(0, i);
      for (int c = 0; c < 3; ++c) {
        state.q[d + c] = Vec3(4.0 * i, 0.0, i % 2 ? -10.6 : -9.7)[c] + 0.1 * u(random);
        if (slopes) state.q[d + 3 + c] = Vec3::UnitX()[c] + 0.2 * u(random);
      }
    }
    for (double& v : state.v) v = 0.3 * u(random);
  }

  std::vector<double> residual(const State& at) const {
    std::vector<double> r(model.unknowns, 0.0);
    add_seabed(model, at, r);
    return r;
  }

  Model model;
  State state;
};

INSTANTIATE_TEST_SUITE_P(Beds, SeabedUnder,
                         ::testing::Values(Setup{"bar_level", ModelChoice::bar, false, law(0, 0, 0, 0)},
                                           Setup{"cable_level", ModelChoice::cable, false, law(0, 0, 0, 0)},
                                           Setup{"cable_level_toe", ModelChoice::cable, false, law(0.1, 0, 0, 0)},
                                           Setup{"cable_level_toe_damping", ModelChoice::cable, false, law(0.1, 40.0, 0, 0)},
                                           Setup{"cable_level_friction", ModelChoice::cable, false, law(0, 0, 0.4, 0.9, 0.5)},
                                           Setup{"bar_grid", ModelChoice::bar, true, law(0, 0, 0, 0)},
                                           Setup{"beam_grid_friction", ModelChoice::beam, true, law(0, 0, 0.8, 0.8, 0.5)}),
                         [](const auto& setup) { return setup.param.name; });

// Roots of the penetration move with the state, and the rule of the integral with them. Central differences, h = 1e-6 m: rounding of
// the force is 1e-16/h = 1e-10 of it. On a plane bed without toe and friction the rule is exact and nothing else is left: 1e-8 of the
// largest entry. Else moving the ends of the four-point rule changes the sum by its own error, which the tangent leaves out: 1e-3.
TEST_P(SeabedUnder, TangentIsTheDerivativeOfTheResidualWhereTheRootsMove) {
  const bool exact = !GetParam().grid && GetParam().law.smoothing == 0.0 && !GetParam().law.rubs();
  for (const TangentWeights& w : {TangentWeights{1.0, 0.0, 0.0}, TangentWeights{0.7, 25.0, 300.0}}) {
    BlockTridiagonal matrix(model.chains);
    matrix.set_zero();
    std::vector<double> r(model.unknowns, 0.0), unit(model.dofs, 0.0), column(model.dofs);
    add_seabed(model, state, r, w, false, AddedBlocks(matrix));
    const auto alone = residual(state);
    for (std::size_t i = 0; i < r.size(); ++i) EXPECT_NEAR(r[i], alone[i], 1e-12 * 2.0e3) << "the force is the same with and without a tangent";
    double largest = 0.0;
    for (double value : matrix.values()) largest = std::max(largest, std::abs(value));
    ASSERT_GT(largest, 0.0);
    const double h = 1e-6;
    for (std::size_t j = 0; j < model.dofs; ++j) {
      unit[j] = 1.0;
      matrix.multiply(unit, column);
      unit[j] = 0.0;
      const auto moved = [&](double step) {
        State s = state;
        s.q[j] += step * w.stiffness;
        s.v[j] += step * w.damping;
        return residual(s);
      };
      const auto plus = moved(h), minus = moved(-h);
      for (std::size_t i = 0; i < model.dofs; ++i)
        EXPECT_NEAR(column[i], (plus[i] - minus[i]) / (2.0 * h), (exact ? 1e-8 : 1e-3) * largest) << "row " << i << ", column " << j;
    }
  }
}

TEST_P(SeabedUnder, ElementsWithAndWithoutAJointTakeTheSameContact) {
  std::vector<double> sum(model.unknowns, 0.0);
  const int b = model.chain(0).block;
  for (int e = 0; e < 4; ++e) {
    Vector12 f = Vector12::Zero();
    add_contact(model, 0, e, element_state(model, state, 0, e), TangentWeights{}, false, f, nullptr);
    for (int end = 0; end < 2; ++end)
      for (int i = 0; i < b; ++i) sum[model.dof(0, e + end) + i] += f[6 * end + i];
  }
  const auto r = residual(state);
  for (std::size_t i = 0; i < sum.size(); ++i) EXPECT_NEAR(r[i], sum[i], 1e-12 * 2.0e3);
}

// Where friction slides, the symmetric part of D (I - u u^T/m^2) has a negative eigenvalue if D is not a number; so has that of a normal force that
// is not along the gradient of the penetration. Neither says that a line would leave its place.
TEST(SeabedLaw, WhatStabilityTakesOfTheBedIsSymmetricAndNeverPullsALineFromItsPlace) {
  const SeabedSurface surface(bumpy());
  const Vec3 r(2.3, 0.2, surface.height(2.3, 0.2) - 0.03), along(0.8, 0.5, 0.1), still = Vec3::Zero();
  for (const Vec3& u : {Vec3(0.001, 0.002, 0.0), Vec3(0.3, 0.2, 0.0), Vec3(-0.1, 0.9, 0.1)}) {
    const Vec3 lay = r - u;
    SurfacePoint<double> bed = surface.at(r.x(), r.y());
    for (auto& row : bed.curvature) row[0] = row[1] = 0.0;  // a ridge does let a line go
    const Mat3 stiffness = -contact_tangent(law(0, 0, 1.1, 0.15), bed, r, along, still, &lay, FrictionTangent::frozen).d_r;
    const double size = stiffness.norm();
    EXPECT_LT((stiffness - stiffness.transpose()).norm(), 1e-14 * size);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Mat3>(stiffness).eigenvalues()[0], -1e-13 * size);
  }
}

TEST(SeabedLaw, WhatStabilityTakesOfFrictionIsItsDerivativeWhereTheLineSlidesAlongOrAcrossOrSticks) {
  const SeabedSurface level(-10.0);
  const Vec3 r(5.0, 0.0, -10.1), along = Vec3::UnitX(), still = Vec3::Zero();
  for (const Vec3& u : {Vec3(0.4, 0.0, 0.0), Vec3(0.0, -0.4, 0.0), Vec3(1e-9, 1e-9, 0.0)}) {
    const Vec3 lay = r - u;
    const auto of = [&](FrictionTangent kind) -> Mat3 {
      return contact_tangent(law(0, 0, 1.1, 0.15), level.at(r.x(), r.y()), r, along, still, &lay, kind).d_r;
    };
    const Eigen::Matrix2d exact = of(FrictionTangent::exact).topLeftCorner<2, 2>(), frozen = of(FrictionTangent::frozen).topLeftCorner<2, 2>();
    EXPECT_LT((exact - frozen).norm(), 1e-6 * exact.norm()) << u.transpose();  // the direction counts to 1e-3 squared: upright_slope
  }
}

/// A level line of two elements of 4 m at a depth below the bed at each of its three nodes, straight between them.
Model straight_model(SeabedLaw l = law(0, 0, 0, 0)) {
  SceneBuilder builder;
  builder.dry().type(test::line_type("t", 1e5, 12.0)).fixed("a", {0, 0, -10}).fixed("b", {8, 0, -10}).line("a", "b").section("t", 8.0, 2);
  builder.scene.environment.depth = 10.0;
  builder.scene.environment.seabed.stiffness = l.stiffness;
  return build_model(builder.scene);
}
State straight_state(const Model& model, double z0, double z1, double z2) {
  State s = model.make_state();
  const double z[3] = {z0, z1, z2};
  for (int i = 0; i < 3; ++i) {
    const std::size_t d = model.dof(0, i);
    s.q[d] = 4.0 * i;
    s.q[d + 2] = z[i];
    s.q[d + 3] = 1.0;
    s.q[d + 5] = (z2 - z0) / 8.0;
  }
  return s;
}

TEST(Seabed, ForceOfALineThatCrossesTheBedIsTheAreaBelowIt) {
  const Model model = straight_model();
  const State state = straight_state(model, -10.5, -10.1, -9.7);  // straight: below the bed from s = 0 to 5 m
  std::vector<double> r(model.unknowns, 0.0);
  add_seabed(model, state, r);
  const double lift = r[2] + r[8] + r[14];
  EXPECT_NEAR(-lift, 2.0e3 * 0.5 * 0.5 * 5.0, 1e-10);
  const SeabedContact contact = observe_seabed(model, state, 0);
  ASSERT_EQ(contact.touchdown.size(), 1u);
  EXPECT_NEAR(contact.touchdown[0], 5.0, 1e-13);
  EXPECT_NEAR(contact.length, 5.0, 1e-13);
  EXPECT_NEAR(contact.force, -lift, 1e-10);
  EXPECT_NEAR(contact.largest_penetration, 0.5, 1e-14);
  EXPECT_EQ(contact.largest_penetration_s, 0.0);
}

TEST(Seabed, ForceIsContinuousWhereAnElementBeginsToLift) {
  const Model model = straight_model();
  const auto lifted = [&](double z2) {
    std::vector<double> r(model.unknowns, 0.0);
    add_seabed(model, straight_state(model, -10.4, -10.2, z2), r);
    return r;
  };
  const auto below = lifted(-10.0 - 1e-9), above = lifted(-10.0 + 1e-9);
  for (std::size_t i = 0; i < below.size(); ++i) EXPECT_NEAR(below[i], above[i], 2e-9 * 2.0e3 * 8.0);  // stiffness times 2e-9 m over 8 m
}

// Newton cannot end at a jump. The largest step of the force along a path is halved in length until a continuous force would leave nothing of it.
TEST(Seabed, ForceIsContinuousWhereALineMovesOverTheLinesOfAGrid) {
  SceneBuilder builder;
  builder.type(test::line_type("rope", 1e8, 10.0)).fixed("a", {0, 0, -10}).fixed("b", {8, 0, -10}).line("a", "b", ModelChoice::cable);
  builder.section("rope", 8.0, 1);
  builder.scene.environment.seabed.bathymetry = bumpy();
  builder.scene.environment.seabed.stiffness = 2.0e3;
  const Model model = build_model(builder.scene);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int path = 0; path < 100; ++path) {
    State ends[2] = {model.make_state(), model.make_state()};
    for (State& end : ends)
      for (int node = 0; node < 2; ++node) {
        Eigen::Map<Vec3>(&end.q[model.dof(0, node)]) = Vec3(8.0 * node + u(random), u(random), -9.8 + 0.3 * u(random));
        Eigen::Map<Vec3>(&end.q[model.dof(0, node) + 3]) = Vec3(1.0, 0.2 * u(random), 0.2 * u(random));
      }
    State state = model.make_state();
    const auto force = [&](double x) -> Eigen::VectorXd {
      for (std::size_t i = 0; i < state.q.size(); ++i) state.q[i] = ends[0].q[i] + x * (ends[1].q[i] - ends[0].q[i]);
      std::vector<double> r(model.unknowns, 0.0);
      add_seabed(model, state, r);
      return Eigen::Map<Eigen::VectorXd>(r.data(), static_cast<Eigen::Index>(r.size()));
    };
    double a = 0.0, b = 1.0;
    for (int cuts = 0; b - a > 1e-12; ++cuts) {
      const int parts = cuts == 0 ? 200 : 2;
      double largest = -1.0, from = a;
      for (int k = 0; k < parts; ++k) {
        const double x = a + k * (b - a) / parts, step = (force(x + (b - a) / parts) - force(x)).norm();
        if (step > largest) largest = step, from = x;
      }
      b = from + (b - a) / parts;
      a = from;
    }
    // Stiffness times 3 m over 8 m and 1e-12 of the path, and the roots of the penetration to 1e-15 of 8 m.
    EXPECT_LT((force(b) - force(a)).norm(), 1e-6) << "path " << path;
  }
}

TEST(Seabed, ADipBetweenTwoNodesAboveTheBedIsFound) {
  const Model model = straight_model();
  State state = straight_state(model, -9.98, -9.98, -9.98);
  state.q[model.dof(0, 0) + 5] = -0.1;
  state.q[model.dof(0, 1) + 5] = 0.1;  // dips by l/4 * 0.1 = 0.1 m in the first element
  const SeabedContact contact = observe_seabed(model, state, 0);
  ASSERT_EQ(contact.touchdown.size(), 2u);
  EXPECT_NEAR(contact.touchdown[0] + contact.touchdown[1], 4.0, 1e-12);
  EXPECT_NEAR(contact.largest_penetration, 0.08, 1e-14);
}

// Over a cell whose diagonal rises as 4 u (1 - u) between its ends, a level element dips into the bed by d over sqrt(d) of its length. The least
// of these is far narrower than an eighth of the element.
TEST(Seabed, ABumpWithinAnElementIsFoundHoweverNarrow) {
  const double l = 8.0, side = l / std::sqrt(2.0);
  for (const double d : {1e-8, 1e-5, 1e-3}) {
    // z = -10 + 4 u (1 - v), with u = v + offset along the line: highest at v = (1 - offset)/2, between two samples.
    SceneBuilder builder;
    const double offset = 0.09, top = std::pow(1.0 + offset, 2), z = -10.0 + top - d;
    builder.type(test::line_type("rope", 1e8, 10.0)).fixed("a", {offset * side, 0, z}).fixed("b", {(1.0 + offset) * side, side, z});
    Scene scene = builder.line("a", "b", ModelChoice::bar).section("rope", l, 1).scene;
    scene.environment.seabed.bathymetry = BathymetryGrid{{0.0, side}, {0.0, side}, {-10.0, -6.0, -10.0, -10.0}};
    const Model model = build_model(scene);
    State state = model.make_state();
    model.prescribe(state);
    // (u)(1 - v) = (v + offset)(1 - v) is a parabola of curvature 8 in v: as deep as d within sqrt(d)/2 to both sides.
    EXPECT_NEAR(observe_seabed(model, state, 0).length, l * std::sqrt(d), 1e-5 * l * std::sqrt(d) + 1e-14 * l / std::sqrt(d)) << d;
  }
}

TEST(Seabed, LayStateRunsFromTheGroundedEndInPlanTowardsTheOther) {
  SceneBuilder builder;
  builder.dry().type(test::line_type("t", 1e5, 12.0)).fixed("ship", {3, 4, 0}).fixed("anchor", {63, 84, -50.0}).line("ship", "anchor");
  builder.section("t", 130.0, 13);
  builder.scene.environment.depth = 50.0;
  builder.scene.environment.seabed.friction_axial = 0.5;
  const Model model = build_model(builder.scene);
  ASSERT_EQ(model.seabed->laid[0], Laid::from_end);
  EXPECT_NEAR((model.seabed->lay[13] - Vec3(63, 84, -50)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((model.seabed->lay[3] - Vec3(3, 4, -50)).norm(), 0.0, 1e-12);  // 100 m from the anchor
  builder.scene.points[1].position.z() = -49.0;
  EXPECT_EQ(build_model(builder.scene).seabed->laid[0], Laid::nowhere) << "an end that hangs above the bed";
}

TEST(Seabed, LayStateFollowsTheLengthOfASlope) {
  SceneBuilder builder;
  builder.dry().type(test::line_type("t", 1e5, 12.0)).fixed("a", {0, 0, 0}).fixed("b", {50, 0, 20.0}).line("a", "b").section("t", 60.0, 6);
  builder.scene.environment.seabed.bathymetry = BathymetryGrid{{0.0, 4.0}, {0.0, 1.0}, {0.0, -3.0, 0.0, -3.0}};  // 3 : 4 : 5
  builder.scene.environment.seabed.friction_lateral = 0.5;
  const Model model = build_model(builder.scene);
  EXPECT_NEAR((model.seabed->lay[6] - Vec3(48.0, 0.0, -36.0)).norm(), 0.0, 1e-11);
}

TEST(Seabed, ALineLongerThanItsWayIsLaidInAnArcThatEndsBelowItsOtherEnd) {
  SceneBuilder builder;
  builder.dry().type(test::line_type("t", 1e5, 12.0)).fixed("a", {0, 0, -50}).fixed("b", {60, 0, -20.0}).line("a", "b").section("t", 120.0, 240);
  builder.scene.environment.depth = 50.0;
  const Model model = build_model(builder.scene);
  const std::vector<Vec3>& lay = model.seabed->lay;
  EXPECT_NEAR((lay[180] - Vec3(60, 0, -50)).norm(), 0.0, 1e-9);                        // 90 m on the bed, 30 m up
  for (int i = 0; i < 180; ++i) EXPECT_NEAR((lay[i + 1] - lay[i]).norm(), 0.5, 1e-5);  // chord of an arc of radius 35 m: 4e-6 shorter
  EXPECT_GT(lay[90].y(), 20.0);
}

// A stiff line of which friction holds strains of 1e-6 is compressed by many times the weight of an element.
TEST(Seabed, ALineIsLaidWithoutStrainInTheElementsThatTheMeshHas) {
  for (const bool bar : {false, true}) {
    SceneBuilder builder;
    builder.dry().type(test::line_type("t", 1e9, 12.0)).fixed("a", {0, 0, -50}).fixed("b", {60, 10, -20.0}).line("a", "b").section("t", 120.0, 40);
    builder.scene.lines[0].model = bar ? ModelChoice::bar : ModelChoice::cable;
    // Bent in plan, over a twisted slope with ridges and valleys every 20 m.
    builder.scene.environment.seabed.bathymetry =
        BathymetryGrid{{0, 20, 40, 60}, {0, 15, 30, 60}, {-50, -52, -51, -47, -49, -51, -49, -48, -50, -53, -51, -49, -48, -50, -49, -47}};
    builder.scene.environment.seabed.friction_axial = 0.5;
    const Model model = build_model(builder.scene);
    const std::vector<Vec3>&r = model.seabed->lay, &t = model.seabed->lay_slope;
    const int laid = 28;  // of the elements; the last 33 m hang from the other end
    for (int i = 0; i < laid; ++i) {
      const Vec3 chord = (r[i + 1] - r[i]) / 3.0;
      const Vec3 middle = bar ? chord : Vec3(1.5 * chord - 0.25 * (t[i] + t[i + 1]));                    // r' of the cubic in the middle
      EXPECT_NEAR(middle.norm(), 1.0, 1e-13) << "element " << i << (bar ? " of a bar" : " of a cable");  // rounding of places of 100 m
      EXPECT_NEAR(t[i].norm(), 1.0, 1e-14);
      EXPECT_NEAR(model.seabed->surface.height(r[i].x(), r[i].y()), r[i].z(), 1e-13);
    }
  }
}

TEST(BracketedRoot, FindsRootsOfFlatAndSteepFunctions) {
  const auto find = [](auto f, double a, double b) { return bracketed_root(f, a, b, f(a), f(b), 1e-15); };
  EXPECT_NEAR(find([](double x) { return x * x - 2.0; }, 0.0, 2.0), std::sqrt(2.0), 3e-15);
  EXPECT_NEAR(find([](double x) { return std::exp(20.0 * x) - 1.0; }, -1.0, 1.0), 0.0, 1e-14);
  EXPECT_NEAR(find([](double x) { return std::pow(x, 9) - 1e-9; }, -1.0, 1.0), 0.1, 1e-12);
  EXPECT_NEAR(find([](double x) { return std::tanh(1e4 * (x - 0.3)); }, 0.0, 1.0), 0.3, 1e-14);
}

}  // namespace
}  // namespace hawser
