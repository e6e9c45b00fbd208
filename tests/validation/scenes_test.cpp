// Every scene of data/scenes, as it stands: equilibrium, then its motion to the end, against its reference where there is one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "assembly/observables.hpp"
#include "solver/app/scene_reader.hpp"
#include "solver/simulate.hpp"
#include "tests/support/threads.hpp"

namespace hawser {
namespace {

/// What a run gave at one output instant.
struct Instant {
  double time, tension_from, tension_to;
  Vec3 to;  // position of the point at the `to` end
};

struct Outcome {
  StaticReport equilibrium;
  LineResult at_rest;
  SimulateReport motion;
  std::vector<Instant> history;

  const Instant& at(double time) const {
    return *std::min_element(history.begin(), history.end(),
                             [time](const Instant& a, const Instant& b) { return std::abs(a.time - time) < std::abs(b.time - time); });
  }
};

Outcome run_scene(const std::string& name, const std::vector<std::string>& overrides = {}) {
  const Scene scene = read_scene(std::string(HAWSER_SOURCE_DIR) + "/data/scenes/" + name + ".toml", overrides);
  const Model model = build_model(scene);
  const Assembler assembler(model, test::threads());
  Outcome outcome;
  State state = model.make_state();
  outcome.equilibrium = solve_static(assembler, StaticOptions{}, state);
  outcome.at_rest = observe_line(model, state, 0);
  if (scene.dynamics->start == StartChoice::straight) state = straight_rest_state(model);
  outcome.motion = simulate(assembler, simulate_options(scene), state, [&](const State& s, const SimulateCounters&) {
    const LineResult line = observe_line(model, s, 0);
    const std::size_t end = model.dof(0, model.lines[0].nodes - 1);
    outcome.history.push_back({s.t, line.tension_from, line.tension_to, {s.q[end], s.q[end + 1], s.q[end + 2]}});
    return true;
  });
  return outcome;
}

void expect_stays(const Outcome& outcome) {
  // Nothing moves: what is left is the residual that Newton stops at, 1e-8 of the reference force, with a margin of ten.
  for (const Instant& i : outcome.history) {
    EXPECT_NEAR(i.tension_from, outcome.at_rest.tension_from, 1e-7 * outcome.at_rest.tension_from);
    EXPECT_NEAR(i.tension_to, outcome.at_rest.tension_to, 1e-7 * outcome.at_rest.tension_to);
  }
}

struct Expected {
  const char* scene;
  std::function<void(const Outcome&)> check;
};

class SceneFile : public ::testing::TestWithParam<Expected> {};

TEST_P(SceneFile, RunsToItsEndAndMeetsItsReference) {
  const Outcome outcome = run_scene(GetParam().scene);
  EXPECT_TRUE(outcome.equilibrium.converged);
  EXPECT_TRUE(outcome.equilibrium.stable);
  EXPECT_TRUE(outcome.motion.finished);
  for (const Instant& i : outcome.history) EXPECT_TRUE(std::isfinite(i.tension_from + i.tension_to));
  GetParam().check(outcome);
}

// Values and their digits: data/reference, the case named in each scene. Tolerances beyond them: the discretisation error of the
// scene's own mesh and step as measured in bench/README.md and solver/time/README.md.
const Expected expected[] = {
    {"catenary-5000",
     [](const Outcome& o) {
       EXPECT_NEAR(o.at_rest.tension_from, 16147.116066455797, 1e-9 * 16147.0);
       EXPECT_NEAR(o.at_rest.tension_to, 51772.29105342868, 1e-9 * 51772.0);
       expect_stays(o);
     }},
    {"current-shear",
     [](const Outcome& o) {
       EXPECT_NEAR(o.at_rest.tension_from, 22002.286532501254, 1e-9 * 22002.0);
       EXPECT_NEAR(o.at_rest.tension_to, 57369.48138575837, 1e-9 * 57369.0);
       expect_stays(o);
     }},
    {"steady-tow",
     [](const Outcome& o) {
       EXPECT_NEAR(o.at_rest.tension_from, 11004.667548625666, 1e-7 * 11005.0);  // 200 elements: 2e-8
       expect_stays(o);
       EXPECT_NEAR(o.at(20.0).to[0] - o.at(0.0).to[0], 3.0 * 20.0, 1e-6);  // towed at 3 m/s
     }},
    {"umbilical-heave",
     [](const Outcome& o) {
       EXPECT_NEAR(o.at_rest.tension_from, 60705.02336509358, 1e-8 * 60705.0);
       EXPECT_NEAR(o.at(120.0).tension_from, o.at(110.0).tension_from, 1e-3 * 60705.0);  // periodic by then
     }},
    {"swinging-bob",
     [](const Outcome& o) {
       EXPECT_NEAR(o.at(10.0).to[0], 37.997988066308, 1e-5);
       EXPECT_NEAR(o.at(10.0).to[2], -92.62025422752, 1e-5);
     }},
    {"falling-line",
     [](const Outcome& o) {
       EXPECT_NEAR(o.at(2.0).to[0], 93.543201641114, 1e-5);  // 2e-6 m of the mesh, and the 3e-6 m of the reference
       EXPECT_NEAR(o.at(2.0).to[2], -19.61314122443, 1e-5);
     }},
    {"mooring-chain",
     [](const Outcome& o) {
       // The rigid bed of the reference; the bed of the scene yields by 9.5 mm under the chain and adds 6e-5.
       EXPECT_NEAR(o.at_rest.tension_to, 911088.357, 1e-4 * 911088.0);
       EXPECT_NEAR(o.at_rest.tension_from, 736938.324, 1e-4 * 736938.0);
       EXPECT_NEAR(o.at(0.0).tension_to, o.at_rest.tension_to, 1e-5 * o.at_rest.tension_to);    // the ramp starts with 0.06 m/s2
       EXPECT_NEAR(o.at(60.0).tension_to, o.at(40.0).tension_to, 1e-2 * o.at_rest.tension_to);  // periodic after the ramp
       EXPECT_GT(o.at(40.0).tension_to - o.at(50.0).tension_to, 1e5);                           // N: lifted and laid down again
     }},
    {"three-leg-mooring",
     [](const Outcome& o) {
       // V = 152003.075 N is a third of the net buoyancy whatever the bed. On a rigid one a = V/w = 139.777738 m are suspended and
       //   420 m = (450 m - a) (1 + H/EA) + H/w asinh(V/H) + H a/EA     gives H = 96586.7278 N,
       // and the buoy floats (sqrt(H^2 + V^2) - H)/w + V^2/(2 w EA) = 76.812689 m above the bed. The bed of the scene yields by 14 mm: to H it
       // adds as in mooring-chain 1e-4 (11 N), to the height about as much as it yields.
       EXPECT_NEAR(o.at_rest.tension_from, 96586.7278, 3e-4 * 96587.0);
       EXPECT_NEAR(o.at_rest.tension_to, 180094.2276, 1e-5 * 180094.0);
       EXPECT_NEAR(o.at_rest.force_to.z(), -152003.075, 1e-8 * 152003.0);
       EXPECT_NEAR(o.at(0.0).to[2], -120.0 + 76.812689, 0.014);
       EXPECT_LT(o.at(0.0).to.head<2>().norm(), 1e-8);
       double farthest = 0.0;
       for (const Instant& i : o.history) {
         EXPECT_LT(std::abs(i.to[1]), 1e-6);  // pushed along the plane of symmetry
         farthest = std::max(farthest, i.to[0]);
       }
       EXPECT_GT(farthest, 15.0);
       EXPECT_LT(std::abs(o.at(90.0).to[0]), 0.02 * farthest);  // the water takes the motion away
     }},
    {"vehicle-on-tether",
     [](const Outcome& o) {
       EXPECT_NEAR(o.at(0.0).tension_from, o.at_rest.tension_from, 1e-7 * o.at_rest.tension_from);  // the run starts in its equilibrium
       const auto away = [&](const Instant& i) { return std::abs(i.tension_to - o.at_rest.tension_to); };
       const Instant& most =
           *std::max_element(o.history.begin(), o.history.end(), [&](const Instant& x, const Instant& y) { return away(x) < away(y); });
       EXPECT_GT(away(most), 10.0);                    // N: the thrust changes what the tether carries
       EXPECT_LT(away(o.at(60.0)), 0.5 * away(most));  // and the water takes the motion away
     }},
    {"lazy-wave-960",
     [](const Outcome& o) {
       // The plane elastica of its three sections, H and V at the lower end from the two distances:
       //   EI theta'' = (1 + T/EA) (H sin theta - V cos theta), V' = w, T = H cos theta + V sin theta, theta' = 0 at both ends,
       // by central differences of 0.1 to 0.0125 m with Richardson extrapolation: 12 digits. The mesh leaves 2.3e-10.
       EXPECT_NEAR(o.at_rest.tension_from, 8097.963494597, 1e-9 * 8098.0);
       EXPECT_NEAR(o.at_rest.tension_to, 11599.244816909, 1e-9 * 11599.0);
       // Periodic by then but for the axial fronts of the first 12 s: 5.7 N are left of them.
       EXPECT_NEAR(o.at(60.0).tension_to, o.at(48.0).tension_to, 1e-3 * 11599.0);
       // Newton stops where full Newton to the end would: 1e-4 of the top tension is asked, 6e-9 was measured.
       const Outcome exact = run_scene("lazy-wave-960", {"solve.newton_tolerance=1e-11"});
       for (const Instant& i : o.history) EXPECT_NEAR(i.tension_to, exact.at(i.time).tension_to, 1e-4 * o.at_rest.tension_to);
     }},
};

INSTANTIATE_TEST_SUITE_P(Scenes, SceneFile, ::testing::ValuesIn(expected), [](const auto& scene) {
  std::string name = scene.param.scene;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(SceneFiles, EachOneIsRunHere) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(HAWSER_SOURCE_DIR) + "/data/scenes"))
    if (entry.path().extension() == ".toml") {
      ++files;
      EXPECT_TRUE(std::any_of(std::begin(expected), std::end(expected), [&](const Expected& e) { return entry.path().stem() == e.scene; }))
          << entry.path();
    }
  EXPECT_EQ(files, std::size(expected));
}

}  // namespace
}  // namespace hawser
