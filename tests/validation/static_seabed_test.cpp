// Lines on the seabed against independent solutions (data/reference/static_winkler_*, static_seabed_*, static_jlay_*).
//
// Tolerance of every comparison: the largest of
//   - what the reference file asks,
//   - the discretisation error: the line has a kink in its third derivative (with bending: its fifth) where it meets the bed, inside an
//     element, so order 3 is counted on; twice the change between n and 2n elements over 2^3 - 1,
//   - rounding: twice the floor of theory 6.1 for forces (static_catenary_test.cpp).
// The rigid bed is the limit of a stiff one, on which the line rests w/k deep. Its anchor is put there, and the fairlead is lowered by
// half of that: the catenary of the free part, continued, has its lowest point w/2k below the bed. Then 2 f(2k) - f(k) is taken; what is
// left is counted as a tenth of the change.
// Each test also bounds the tolerance itself, so that it cannot grow unnoticed.
#include <gtest/gtest.h>

#include "assembly/seabed.hpp"
#include "tests/support/reference_case.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

constexpr double water = 3000.0;  // m: the bed of every scene here is at z = -water

/// Values on the rigid bed, f(2k) + (f(2k) - f(k)), with what both are worth; `left` of the change counts as error.
Numbers rigid(const std::function<Numbers(double)>& solve, double k, double left = 0.1) {
  const Numbers a = solve(k);
  Numbers b = solve(2.0 * k);
  for (std::size_t i = 0; i < b.value.size(); ++i) {
    const double change = b.value[i] - a.value[i];
    b.error[i] = 2.0 * b.error[i] + a.error[i] + left * std::abs(change);
    b.value[i] += change;
  }
  return b;
}

struct SeabedCase {
  ReferenceCase reference;
  double L, w, noise = 0.0;

  explicit SeabedCase(const std::string& name) : reference(name), L(reference.parameter("L0")), w(reference.parameter("w")) {}

  Scene scene(double stiffness, int n, double slip = 1e-4) const {
    Vec3 from = vector(reference.parameter("anchor")), to = vector(reference.parameter("fairlead"));
    if (reference.parameter("seabed_z") != 0) throw std::runtime_error("the bed of a case is at z = 0");
    if (from.z() == 0.0) {
      from.z() -= w / stiffness;
      to.z() -= 0.5 * w / stiffness;
    }
    from.z() -= water;
    to.z() -= water;
    SceneBuilder builder;
    builder.dry().type(line_type("cable", reference.parameter("EA"), w)).fixed("anchor", from).fixed("fairlead", to);
    builder.line("anchor", "fairlead").section("cable", L, n);
    builder.scene.environment.depth = water;
    SeabedSpec& bed = builder.scene.environment.seabed;
    bed.stiffness = stiffness;
    bed.slip = slip;
    bed.friction_axial = bed.friction_lateral = reference.parameter("CB");
    return builder.scene;
  }

  /// H, V and T at the fairlead, T at the anchor, arc length and x of the touchdown.
  std::vector<double> values(double stiffness, int n, double slip = 1e-4) {
    const StaticSolution solution(scene(stiffness, n, slip));
    noise = std::max(noise, 2.0 * solution.report.roundoff_floor);
    const SeabedContact contact = observe_seabed(*solution.model, solution.state, 0);
    EXPECT_EQ(contact.touchdown.size(), 1u);
    const double s = contact.touchdown.empty() ? 0.0 : contact.touchdown[0];
    return {-solution.line.force_to.x(),     -solution.line.force_to.z(), solution.line.tension_to, solution.line.tension_from, s,
            solution.station(s).position.x()};
  }

  void check(const Numbers& got, std::size_t i, const char* name, double largest_relative, double scale, double rounding) const {
    const double expected = reference.value(name);
    const double tolerance = std::max({reference.tolerance(name, expected), got.error[i], rounding});
    EXPECT_LE(tolerance, largest_relative * scale) << name;
    EXPECT_NEAR(got.value[i], expected, tolerance) << name;
  }
};

// --- an elastic bed ---

class Winkler : public ::testing::TestWithParam<const char*> {};

TEST_P(Winkler, TensionsAndTouchdownMeetTheBoundaryValueProblem) {
  SeabedCase c(GetParam());
  const double k = c.reference.parameter("seabed_stiffness_per_unstretched_length");
  const Numbers got = refined([&](int n) { return c.values(k, n); }, 1750, 3);
  const double T = c.reference.value("T_fairlead"), H = c.reference.value("H");
  c.check(got, 0, "H", 1e-8, T, c.noise);
  c.check(got, 1, "V_fairlead", 1e-8, T, c.noise);
  c.check(got, 2, "T_fairlead", 1e-8, T, c.noise);
  c.check(got, 3, "T_anchor", 1e-8, T, c.noise);
  // A force error f moves the touchdown by about f L/H along the line.
  c.check(got, 4, "unstretched length below mudline z<0 (s of crossing)", 2e-7, c.L, c.noise * c.L / H);
  c.check(got, 5, "x of crossing z=0", 2e-7, c.L, c.noise * c.L / H);
}

INSTANTIATE_TEST_SUITE_P(Static, Winkler, ::testing::Values("static_winkler_U40_k100", "static_winkler_U40_k1e3"));

// --- the rigid bed ---

struct RigidTest {
  const char* name;
  int n;           // coarse mesh
  double k;        // N/m2, the softer of the two beds
  double largest;  // bound on the tolerance of forces, relative to the tension at the fairlead
};

class RigidBed : public ::testing::TestWithParam<RigidTest> {};

// The touchdown of the rigid bed is a tangency: at finite k the line leaves the bed sqrt(H/k) further on, so only the tensions have a
// limit in 1/k. The length on the bed follows from them, V = w (L - LB).
TEST_P(RigidBed, TensionsMeetTheClosedForm) {
  SeabedCase c(GetParam().name);
  const auto on_bed = [&](double k) { return refined([&](int n) { return c.values(k, n); }, GetParam().n, 3); };
  const Numbers got = rigid(on_bed, GetParam().k);
  const double T = c.reference.value("T_fairlead"), largest = GetParam().largest;
  c.check(got, 0, "H_fairlead", largest, T, c.noise);
  c.check(got, 1, "V_fairlead", largest, T, c.noise);
  c.check(got, 2, "T_fairlead", largest, T, c.noise);
  c.check(got, 3, "T_anchor", largest, T, c.noise);
  EXPECT_NEAR(c.L - got.value[1] / c.w, c.reference.value("length_on_seabed_unstretched_LB"), largest * T / c.w);
}

INSTANTIATE_TEST_SUITE_P(Static, RigidBed,
                         ::testing::Values(RigidTest{"static_seabed_U40_2000m_CB0", 3500, 5e3, 2e-7},
                                           RigidTest{"static_seabed_oc3_CB0", 1800, 5e5, 2e-6}),
                         [](const auto& test) { return std::string(test.param.name).substr(14); });

struct FrictionTest {
  const char* name;
  int n;
  double k;
};

class Friction : public ::testing::TestWithParam<FrictionTest> {};

// Stiff bed and mesh leave 1e-6 of the tension at the fairlead there and 1e-5 at the anchor. The elastic slip leaves 5/16 mu w d EA/T at the
// anchor: the last d EA/T of the line moves by less than d, so that 5/16 of its friction, the mean of 1 - f over the slip, is not mobilised. Asked of
// the issue: 1e-3 at 1e-3 m, which the anchor tension meets as a share of itself.
// (Below 1e-4 m that length is shorter than an element and the four points of its integral no longer see it.)
TEST_P(Friction, TensionsConvergeLinearlyInTheSlip) {
  SeabedCase c(GetParam().name);
  const double T = c.reference.value("T_fairlead"), anchor = c.reference.value("T_anchor");
  const double predicted = 5.0 / 16.0 * c.w * c.reference.parameter("EA").get<double>() / anchor;  // N per metre of slip
  std::vector<double> error;
  for (double slip : {1e-2, 1e-3, 1e-4}) {
    const std::vector<double> got = c.values(GetParam().k, GetParam().n, slip);
    EXPECT_NEAR(got[2], T, (1e-6 + 3e-4 * slip) * T);
    error.push_back(got[3] - anchor);
    EXPECT_NEAR(error.back(), predicted * slip, 0.1 * predicted * slip + 1e-5 * T);
  }
  EXPECT_LE(std::abs(error[1]), 1e-3 * anchor);
  // Differences, so that what mesh and bed leave drops out. The quotient tends to 10 as the slip vanishes; at 1e-2 m the length that does
  // not slip is up to a tenth of the length on the bed.
  EXPECT_NEAR((error[0] - error[1]) / (error[1] - error[2]), 10.0, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Static, Friction,
                         ::testing::Values(FrictionTest{"static_seabed_U40_2000m_CB1", 1750, 1e5}, FrictionTest{"static_seabed_oc3_CB1", 1800, 1e7}),
                         [](const auto& test) { return std::string(test.param.name).substr(14); });

// T_anchor = 0: all tension is rubbed off 20.8 m from the touchdown. Mesh and bed leave what 1 m elements leave elsewhere here: 1e-6 of the
// tension at the fairlead; on the part that does not slip, the element at the anchor keeps a tenth of the weight it carries.
TEST(FrictionOfASlackLine, LeavesNoTensionAtTheAnchor) {
  SeabedCase c("static_seabed_slack_CB1_zeroanchor");
  const std::vector<double> got = c.values(1e7, 1800, 1e-4);
  const double T = c.reference.value("T_fairlead");
  EXPECT_NEAR(got[0], c.reference.value("H_fairlead"), 2e-6 * T);
  EXPECT_NEAR(got[1], c.reference.value("V_fairlead"), 2e-6 * T);
  EXPECT_NEAR(got[2], T, 2e-6 * T);
  EXPECT_NEAR(got[3], 0.0, 0.1 * c.w * c.L / 1800);
}

// --- with bending stiffness ---

struct JlayTest {
  const char* name;
  double k;        // N/m2, the softer of the two beds
  double largest;  // bound on the tolerance, relative
};

struct Jlay : ::testing::TestWithParam<JlayTest> {
  Jlay() : c(GetParam().name) {}

  double parameter(const char* name) const { return c.parameter(name); }

  Scene scene(double EA, double k, int n) const {
    const double depth = parameter("depth"), fine = 10.0 * layer;
    SceneBuilder builder;
    builder.dry().type(line_type("pipe", EA, parameter("w"), parameter("EI")));
    builder.fixed("bed", {0.0, 0.0, -depth}).fixed("top", {laid + c.value("top x - touchdown x"), 0.0, 0.0}).line("bed", "top");
    builder.section("pipe", laid - fine, n).section("pipe", 2.0 * fine, 2 * n).section("pipe", suspended - fine, 4 * n);
    builder.scene.environment.depth = depth;
    builder.scene.environment.seabed.stiffness = k;
    return builder.scene;
  }

  /// H, V and T at the top, largest curvature; then x, z and curvature of the stations from the touchdown.
  std::vector<double> values(double EA, double k, int n) {
    const StaticSolution solution(scene(EA, k, n));
    noise = std::max(noise, 2.0 * solution.report.roundoff_floor);
    std::vector<double> bend;
    for (int i = 0; i <= 1000; ++i) bend.push_back(laid + 0.01 * i * layer);
    double most = 0.0;
    for (const Station& station : solution.stations(bend)) most = std::max(most, station.curvature);
    std::vector<double> result{-solution.line.force_to.x(), -solution.line.force_to.z(), solution.line.tension_to, most};
    for (int i = 0; i <= 10; ++i) {
      const Station station = solution.station(laid + 0.1 * i * suspended);
      result.insert(result.end(), {station.position.x() - laid, station.position.z() + parameter("depth"), station.curvature});
    }
    return result;
  }

  ReferenceCase c;
  double layer = std::sqrt(parameter("EI") / parameter("H")), suspended = c.value("suspended length"), laid = 40.0 * layer;
  double noise = 0.0;
};

// Inextensible: the limit in EA of static_solution.hpp. A beam follows the stiffness of the bed a little faster than 1/k: all of the change
// counts as error. Curvatures are those inside elements, of order 2; none of them is asked for better than the largest one is known.
// The curvature at the top, where it vanishes, is left out: that of the last element is not.
TEST_P(Jlay, ShapeAndForcesMeetTheHeavyElastica) {
  const double T = c.value("top tension magnitude"), H = parameter("H"), w = parameter("w"), bound = GetParam().largest;
  const auto elastic = [&](double EA) {
    return rigid([&](double k) { return refined([&](int n) { return values(EA, k, n); }, 20, 2); }, GetParam().k, 1.0);
  };
  const Numbers got = inextensible(elastic, 3e4 * T);
  const auto check = [&](const char* what, std::size_t i, double expected, double least, double largest) {
    const double tolerance = std::max(least, got.error[i]);
    EXPECT_LE(tolerance, largest) << what << " " << i;
    EXPECT_NEAR(got.value[i], expected, tolerance) << what << " " << i;
  };
  check("H", 0, H, noise, bound * T);
  check("V", 1, c.value("V0 internal vertical force just above touchdown (= - contact point force)") + w * suspended, noise, bound * T);
  check("T", 2, T, noise, bound * T);
  const double most = c.value("max curvature");  // met to 1e-4; order 2 promises no more than the bound here
  check("curvature", 3, most, 0.0, 3e-3 * most);
  const auto x = c.value<std::vector<double>>("stations x"), z = c.value<std::vector<double>>("stations z");
  const auto curvature = c.value<std::vector<double>>("stations kappa");
  const double shift = noise * suspended / H;  // m, what a force error of the rounding moves
  for (std::size_t i = 0; i < x.size(); ++i) {
    check("x", 4 + 3 * i, x[i], shift, 10.0 * bound * suspended);
    check("z", 5 + 3 * i, z[i], shift, 10.0 * bound * suspended);
    if (i > 0 && i < 10) check("curvature", 6 + 3 * i, curvature[i], got.error[3], 3e-3 * most);
  }
}

INSTANTIATE_TEST_SUITE_P(Static, Jlay,
                         ::testing::Values(JlayTest{"static_jlay_pipe_momentfree_top", 1e9, 2e-6},
                                           JlayTest{"static_jlay_U40_momentfree_top", 1e7, 2e-6}));

}  // namespace
}  // namespace hawser::test
