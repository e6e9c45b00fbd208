// Every term's tangent against automatic differentiation of its own residual, for each family, at random states.
//
// Tolerance: both sides carry rounding of about 1e-16 times the largest intermediate, which cancels by up to EA/|f| ~ 1e4
// in the bending of a stiff stretched element; 1e-11 of the largest entry of the matrix leaves a margin of ten.
#include <gtest/gtest.h>

#include <random>

#include "assembly/kernel.hpp"
#include "tests/support/dual.hpp"

namespace hawser {
namespace {

using test::Dual;
using AD = Dual<36>;  // 12 positions, 12 velocities, 12 accelerations

constexpr double z_rows[] = {-60.0, -5.0, 20.0}, ux_rows[] = {0.1, 0.9, -0.4}, uy_rows[] = {0.4, -0.3, 0.2};
const CurrentTable current{3, z_rows, ux_rows, uy_rows};

struct Case {
  double x[3][12];  // q, v, a in the order r0, s0, r1, s1
  double properties[11];
};

Case random_case(std::mt19937& random, double length, double bend) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Case c;
  const double stretch = 1.0 + 0.2 * u(random) + 0.05;
  double direction[3] = {u(random), u(random), u(random)};
  const double norm = std::sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]);
  for (int i = 0; i < 3; ++i) {
    direction[i] *= stretch / norm;
    c.x[0][i] = 10.0 * u(random);
    c.x[0][6 + i] = c.x[0][i] + length * direction[i] + bend * length * u(random);
    c.x[0][3 + i] = direction[i] + bend * u(random);
    c.x[0][9 + i] = direction[i] + bend * u(random);
  }
  for (int k = 1; k < 3; ++k)
    for (double& value : c.x[k]) value = u(random);
  const double p[11] = {length, 3.0e4, 150.0, 700.0, 2.5, 12.0, 25.0, 1.3, 1.4, 0.3, -1.0e300};
  std::copy(p, p + 11, c.properties);
  return c;
}

template <class S>
ElementState<S> state_of(const Case& c, S (*make)(double, int)) {
  ElementState<S> x;
  Nodal<S>* n[3] = {&x.q, &x.v, &x.a};
  for (int k = 0; k < 3; ++k) {
    V3<S>* v[4] = {&n[k]->r0, &n[k]->s0, &n[k]->r1, &n[k]->s1};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 3; ++j) (*v[i])[j] = make(c.x[k][3 * i + j], 12 * k + 3 * i + j);
  }
  return x;
}

template <class S>
Properties<S> properties_of(const Case& c) {
  const double* p = c.properties;
  return {p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8], p[9], p[10]};
}

template <class Family>
class ElementDerivative : public ::testing::Test {};
using Families = ::testing::Types<BarDry, BarWet, CableDry, CableWet, BeamDry, BeamWet>;
TYPED_TEST_SUITE(ElementDerivative, Families);

template <class Family>
void expect_tangent_is_derivative(const Case& c) {
  using Shape = typename Family::Shape;
  constexpr int n = 2 * Shape::node_vectors, stride = 6 / Shape::node_vectors;
  ElementResult<Shape, AD> ad;
  whole_element<Family, Want::force>(state_of<AD>(c, [](double v, int i) { return AD::variable(v, i); }), properties_of<AD>(c),
                                     Weights{1, 0, 0, false}, current, ad);
  for (int k = 0; k < 3; ++k) {
    ElementResult<Shape, double> plain;
    const Weights unit{k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0, false};
    whole_element<Family, Want::tangent>(state_of<double>(c, [](double v, int) { return v; }), properties_of<double>(c), unit, current, plain);
    double largest = 0.0, error = 0.0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int e = 0; e < 9; ++e) {
          const double exact = ad.f[i][e % 3].d[12 * k + stride * j + e / 3];
          largest = std::max(largest, std::abs(exact));
          error = std::max(error, std::abs(exact - plain.K[i][j].m[e]));
        }
    EXPECT_LE(error, 1.0e-11 * std::max(largest, 1.0)) << "weight " << k;
    for (int i = 0; i < n; ++i)
      for (int e = 0; e < 3; ++e) EXPECT_NEAR(plain.f[i][e], ad.f[i][e].v, 1.0e-12 * (1.0 + 3.0e4 * 10.0));
  }
}

TYPED_TEST(ElementDerivative, TangentIsDerivativeOfResidualAtRandomStates) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 50; ++trial) expect_tangent_is_derivative<TypeParam>(random_case(random, 0.5 + 0.1 * trial, 0.1));
}

TYPED_TEST(ElementDerivative, TangentIsDerivativeOfResidualWhereTheLineIsStraight) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 20; ++trial) expect_tangent_is_derivative<TypeParam>(random_case(random, 2.0, 0.0));
}

TYPED_TEST(ElementDerivative, TangentIsDerivativeOfResidualWhereTheLineIsSlack) {
  std::mt19937 random(9);
  for (int trial = 0; trial < 20; ++trial) {
    Case c = random_case(random, 2.0, 0.05);
    for (int i = 0; i < 3; ++i) {
      c.x[0][3 + i] *= 0.8;
      c.x[0][9 + i] *= 0.8;
      c.x[0][6 + i] = c.x[0][i] + 0.8 * (c.x[0][6 + i] - c.x[0][i]);
    }
    expect_tangent_is_derivative<TypeParam>(c);
  }
}

TEST(Bending, ResidualIsGradientOfTheEnergyWithTheMaterialCurvature) {
  std::mt19937 random(10);
  for (int trial = 0; trial < 20; ++trial) {
    const Case c = random_case(random, 1.5, 0.2);
    const auto x = state_of<AD>(c, [](double v, int i) { return AD::variable(v, i); });
    const double l = c.properties[0], EI = c.properties[2];
    V3<AD> y[4];
    to_modes<HermiteShape>(x.q, AD(1.0 / l), y);
    AD energy(0.0);
    for (int q = 0; q < 3; ++q) {
      V3<AD> a = zero_vector<AD>(), b = zero_vector<AD>();
      for (int j = 1; j < 4; ++j) {
        add_scaled(a, AD(HermiteShape::coefficient(Channel::a, j, gauss_eta[q])), y[j]);
        add_scaled(b, AD(HermiteShape::coefficient(Channel::b, j, gauss_eta[q]) / l), y[j]);
      }
      const AD cross2 = dot(a, a) * dot(b, b) - dot(a, b) * dot(a, b);  // |a x b|^2
      energy = energy + AD(0.5 * EI * l * gauss_weight[q]) * cross2 / (dot(a, a) * dot(a, a));
    }
    Case bending_only = c;
    for (int k : {1, 3, 4, 5, 6, 7, 8, 9}) bending_only.properties[k] = 0.0;
    ElementResult<HermiteShape, double> f;
    whole_element<BeamDry, Want::force>(state_of<double>(c, [](double v, int) { return v; }), properties_of<double>(bending_only),
                                        Weights{1, 0, 0, false}, current, f);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(f.f[i][j], energy.d[3 * i + j], 1.0e-11 * (1.0 + std::abs(energy.v)) * 100.0);
  }
}

TEST(Bending, GaussNewtonPartIsSemidefiniteAndExactWhereStraight) {
  std::mt19937 random(11);
  for (double bend : {0.0, 0.2}) {
    Case c = random_case(random, 1.5, bend);
    for (int k : {1, 3, 4, 5, 6, 7, 8, 9}) c.properties[k] = 0.0;
    const auto x = state_of<double>(c, [](double v, int) { return v; });
    ElementResult<HermiteShape, double> exact, part;
    whole_element<BeamDry, Want::tangent>(x, properties_of<double>(c), Weights{1, 0, 0, false}, current, exact);
    whole_element<BeamDry, Want::tangent>(x, properties_of<double>(c), Weights{1, 0, 0, true}, current, part);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (int trial = 0; trial < 100; ++trial) {
      double d[12], work = 0.0, difference = 0.0, scale = 0.0;
      for (double& value : d) value = u(random);
      for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 12; ++j) {
          const double kp = part.K[i / 3][j / 3](i % 3, j % 3), ke = exact.K[i / 3][j / 3](i % 3, j % 3);
          work += d[i] * kp * d[j];
          difference = std::max(difference, std::abs(kp - ke));
          scale = std::max(scale, std::abs(ke));
        }
      EXPECT_GE(work, -1.0e-12 * scale);
      if (bend == 0.0) {
        EXPECT_LE(difference, 1.0e-12 * scale);
      }
    }
  }
}

TEST(ConstantMatrices, MassAndWeightAreThoseOfTheTheory) {
  // theory 2.1, which corrects the paper's (28): factors l in the slope entries.
  const double l = 2.5, m = 3.0;
  const double M[4][4] = {
      {156, 22 * l, 54, -13 * l}, {22 * l, 4 * l * l, 13 * l, -3 * l * l}, {54, 13 * l, 156, -22 * l}, {-13 * l, -3 * l * l, -22 * l, 4 * l * l}};
  const double Q[4] = {l / 2, l * l / 12, l / 2, -l * l / 12};
  Case c{};
  c.x[0][3] = c.x[0][9] = 1.0;
  c.x[0][6] = l;
  c.properties[0] = l;
  c.properties[4] = m;
  c.properties[5] = 7.0;
  c.properties[10] = -1.0e300;
  ElementResult<HermiteShape, double> out;
  whole_element<CableDry, Want::tangent>(state_of<double>(c, [](double v, int) { return v; }), properties_of<double>(c), Weights{0, 0, 1, false},
                                         current, out);
  double translation = 0.0;
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(out.f[i][2], 7.0 * Q[i], 1.0e-14 * 7.0 * l * l);
    for (int j = 0; j < 4; ++j) {
      EXPECT_NEAR(out.K[i][j](0, 0), m * l / 420.0 * M[i][j], 1.0e-13);
      EXPECT_EQ(out.K[i][j](0, 1), 0.0);
      if (i % 2 == 0 && j % 2 == 0) translation += out.K[i][j](1, 1);
    }
  }
  EXPECT_NEAR(translation, m * l, 1.0e-13);
}

TEST(Axial, StraightUniformStretchGivesTheTensionAtBothEnds) {
  const double l = 2.0, EA = 3.0e4, stretch = 1.01;
  Case c{};
  c.x[0][3] = c.x[0][9] = stretch;
  c.x[0][6] = stretch * l;
  c.properties[0] = l;
  c.properties[1] = EA;
  c.properties[10] = -1.0e300;
  ElementResult<HermiteShape, double> out;
  whole_element<CableDry, Want::force>(state_of<double>(c, [](double v, int) { return v; }), properties_of<double>(c), Weights{1, 0, 0, false},
                                       current, out);
  EXPECT_NEAR(out.f[0][0], -EA * 0.01, 1.0e-9);
  EXPECT_NEAR(out.f[2][0], EA * 0.01, 1.0e-9);
  for (int i : {1, 3}) EXPECT_NEAR(out.f[i][0], 0.0, 1.0e-9);  // a uniform stretch does no work on the slopes alone
}

}  // namespace
}  // namespace hawser
