#include "solver/probe.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "assembly/observables.hpp"
#include "solver/static_perturbation.hpp"

namespace hawser {
namespace {

constexpr int waves = 3;
constexpr std::array amplitudes{0.01, 0.03, 0.1, 0.3};  // of the length
constexpr double loop_radius = 0.06;                    // of the length, at most
constexpr double least_radius = 0.002;                  // of it; a line with less slack has no loop
constexpr int probe_iterations = 200;                   // factorizations from one start
constexpr double pi = std::numbers::pi;

/// Numbers in [-1, 1], the same on every machine (std::uniform_real_distribution promises no bits).
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double next() { return 2.0 * static_cast<double>(engine_()) / static_cast<double>(std::mt19937::max()) - 1.0; }
  Vec3 vector() {
    const double x = next(), y = next(), z = next();
    return {x, y, z};
  }

 private:
  std::mt19937 engine_;
};

/// A line as its start is written: unit vectors along its chord, across it in its vertical plane, and across both.
struct Frame {
  Vec3 origin, along, upward, sideways;
  double chord = 0.0;
};

class Starts {
 public:
  Starts(const Model& model, const State& known, unsigned seed) : model_(model), known_(known), random_(seed) {}

  State next() {
    enum Kind { mirrored, from_catenary, looped, from_straight, from_known, kinds };
    const int turn = turn_++, kind = turn % kinds;
    State state = kind == from_catenary                     ? static_start(model_, StaticStart::catenary)
                  : kind == from_straight || kind == looped ? static_start(model_, StaticStart::straight)
                                                            : known_;
    const double amplitude = amplitudes[static_cast<std::size_t>(turn / kinds) % amplitudes.size()];
    const bool in_plane = turn % 2 == 0;
    move_hubs(kind == mirrored, amplitude, state);
    for (int line = 0; line < static_cast<int>(model_.lines.size()); ++line) {
      const Frame frame = frame_of(line, state);
      if (kind == mirrored) mirror(line, frame, state);
      if (kind == looped) lay_loop(line, frame, state);
      disturb(line, frame, amplitude, in_plane, state);
    }
    model_.prescribe(state);
    model_.align_clamps(state);
    model_.reset_joints(state);
    state.v = known_.v;
    state.a = known_.a;
    return state;
  }

 private:
  /// Moves every hub, mirrored: to the other side of the points that its lines lead to; its lines follow, linearly in s.
  void move_hubs(bool mirrored, double amplitude, State& state) {
    if (model_.hubs.empty()) return;
    std::vector<Vec3> moved(model_.points.size(), Vec3::Zero());
    for (const Hub& hub : model_.hubs) {
      Vec3 others = Vec3::Zero();
      double length = 0.0;
      for (const Support& end : hub.ends) {
        const Line& line = model_.lines[end.line];
        others += node(state, end.line, line.nodes - 1 - end.node);
        length = std::max(length, line.length);
      }
      const Vec3 here = node(state, hub.ends[0].line, hub.ends[0].node);
      moved[hub.point] = amplitude * length * random_.vector();
      if (mirrored) moved[hub.point] += 2.0 * (others / static_cast<double>(hub.ends.size()) - here);
    }
    for (int line = 0; line < static_cast<int>(model_.lines.size()); ++line) {
      const Line& l = model_.lines[line];
      const Vec3 from = moved[l.from], along = (moved[l.to] - from) / l.length;
      for_each_node(line, state, [&](double s, Vec3& r, Vec3& slope) {
        r += from + s * along;
        slope += along;
      });
    }
  }

  Vec3 node(const State& state, int line, int i) const { return Eigen::Map<const Vec3>(&state.q[model_.dof(line, i)]); }

  Frame frame_of(int line, const State& state) const {
    Frame frame;
    frame.origin = node(state, line, 0);
    frame.along = node(state, line, model_.lines[line].nodes - 1) - frame.origin;
    frame.chord = frame.along.norm();
    frame.along = frame.chord > 0.0 ? Vec3(frame.along / frame.chord) : Vec3::UnitX();
    frame.sideways = frame.along.cross(Vec3::UnitZ());
    frame.sideways = frame.sideways.norm() > 1e-3 ? frame.sideways.normalized() : frame.along.unitOrthogonal();
    frame.upward = frame.sideways.cross(frame.along);
    return frame;
  }

  /// Calls f(s, r, r') for every node and lets it change them; a bar has no r'.
  template <class Function>
  void for_each_node(int line, State& state, Function f) const {
    const Chain& chain = model_.chain(line);
    for (int i = 0; i < chain.nodes; ++i) {
      Eigen::Map<Vec3> r(&state.q[chain.dof(i)]);
      Vec3 position = r, slope = Vec3::Zero();
      if (chain.block == 6) slope = Eigen::Map<Vec3>(&state.q[chain.dof(i) + 3]);
      f(model_.lines[line].s[i], position, slope);
      r = position;
      if (chain.block == 6) Eigen::Map<Vec3>(&state.q[chain.dof(i) + 3]) = slope;
    }
  }

  void mirror(int line, const Frame& frame, State& state) const {
    const auto turned = [&](const Vec3& v) { return Vec3(2.0 * v.dot(frame.along) * frame.along - v); };
    for_each_node(line, state, [&](double, Vec3& r, Vec3& slope) {
      r = frame.origin + turned(r - frame.origin);
      slope = turned(slope);
    });
  }

  /// Straight to the middle, one turn of a circle across the vertical plane, and on: a loop as large as the slack allows.
  void lay_loop(int line, const Frame& frame, State& state) const {
    const double L = model_.lines[line].length, radius = std::min(loop_radius * L, (L - frame.chord) / (2.0 * pi));
    if (radius < least_radius * L) return;
    const double turn = 2.0 * pi * radius, from = 0.5 * (L - turn), stretch = frame.chord / (L - turn);
    for_each_node(line, state, [&](double s, Vec3& r, Vec3& slope) {
      const double angle = std::clamp((s - from) / radius, 0.0, 2.0 * pi), straight = s - radius * angle;
      const bool inside = angle > 0.0 && angle < 2.0 * pi;
      r = frame.origin + (stretch * straight + radius * std::sin(angle)) * frame.along + radius * (1.0 - std::cos(angle)) * frame.sideways;
      slope = inside ? Vec3(std::cos(angle) * frame.along + std::sin(angle) * frame.sideways) : Vec3(stretch * frame.along);
    });
  }

  void disturb(int line, const Frame& frame, double amplitude, bool in_plane, State& state) {
    const Line& l = model_.lines[line];
    const bool free = l.from_free || l.to_free;
    std::array<Vec3, waves> c;
    for (int k = 0; k < waves; ++k) {
      const Vec3 random = random_.vector();
      c[k] = amplitude * l.length / (k + 1.0) * (random[0] * frame.along + random[1] * frame.upward + (in_plane ? 0.0 : random[2]) * frame.sideways);
    }
    for_each_node(line, state, [&](double s, Vec3& r, Vec3& slope) {
      for (int k = 0; k < waves; ++k) {
        const double wave = (free ? k + 0.5 : k + 1.0) * pi / l.length, from_held = l.from_free ? l.length - s : s;
        r += std::sin(wave * from_held) * c[k];
        slope += (l.from_free ? -wave : wave) * std::cos(wave * from_held) * c[k];
      }
    });
  }

  const Model& model_;
  const State& known_;
  Random random_;
  int turn_ = 0;
};

}  // namespace

double potential_energy(const Model& model, const State& state) {
  const Energies energies = observe_energies(model, state);
  double energy = energies.axial + energies.bending + energies.potential + energies.bed;
  for (const Body& body : model.bodies) energy -= body.force(0.0).dot(Eigen::Map<const Vec3>(&state.q[model.dof(body.line, body.node)]));
  for (const SpreadLoad& spread : model.spread_loads) {
    const Line& line = model.lines[spread.line];
    const int first = spread.element - line.first_element;
    const double s = line.s[first] + 0.5 * (spread.xi0 + spread.xi1) * (line.s[first + 1] - line.s[first]);
    energy -= spread.share * spread.force(0.0).dot(observe_stations(model, state, spread.line, std::array{s})[0].position);
  }
  return energy;
}

ProbeReport probe_equilibria(const Assembler& assembler, const StaticOptions& options, const State& known, const StaticReport& report,
                             const ProbeOptions& probe) {
  const Model& model = assembler.model();
  ProbeReport result;
  result.equilibria.push_back({known, report, potential_energy(model, known), 0.0, 1});
  StaticOptions from_start = options;
  from_start.start = StaticStart::given;
  from_start.max_iterations = std::min(options.max_iterations, probe_iterations);
  from_start.log = nullptr;
  Starts starts(model, known, probe.seed);
  for (int i = 0; i < probe.starts; ++i) {
    State state = starts.next();
    StaticReport found = solve_static(assembler, from_start, state);
    result.factorizations += found.iterations;
    if (!found.converged) {
      ++result.failed;
      continue;
    }
    const auto same = [&](const ProbedEquilibrium& e) { return distance(model, e.state, state) <= probe.same; };
    const auto at = std::find_if(result.equilibria.begin(), result.equilibria.end(), same);
    if (at != result.equilibria.end()) {
      ++at->found;
      continue;
    }
    const double energy = potential_energy(model, state), away = distance(model, known, state);
    result.equilibria.push_back({std::move(state), std::move(found), energy, away, 1});
  }
  return result;
}

}  // namespace hawser
