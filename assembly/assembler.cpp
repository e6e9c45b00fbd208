#include "assembly/assembler.hpp"

#include <algorithm>
#include <cassert>

#include "assembly/bodies.hpp"
#include "assembly/element.hpp"
#include "assembly/joints.hpp"
#include "assembly/seabed.hpp"
#include "assembly/supports.hpp"
#include "assembly/sweep.hpp"

namespace hawser {

namespace {}  // namespace

int Tangent::negative_inner_pivots() const {
  int n = 0;
  for (const Elimination& e : eliminations) n += e.negative_pivots;
  return n;
}

/// Tables in the layout of the kernels, and scratch; nothing here outlives a call as a result.
struct Assembler::Impl {
  struct PanelOf {
    int line, panel;
  };

  const Model& model;
  const SweepTable& sweep = widest_sweep_table();
  int threads;
  std::vector<double> property[property_count];
  std::vector<double> node_property[node_property_count];
  std::vector<PanelOf> panels;
  std::vector<int> first_panel;  // of each line
  std::vector<double> carry;
  TangentFloor floor;  // the one the tables hold

  Impl(const Model& m, int n) : model(m), threads(n) {
    const auto source = property_arrays(m.element);
    for (int k = 0; k < property_count - 1; ++k) {
      property[k] = *source[k];
      // An element at a joint contributes nothing to the sweep: its own path computes it (joints.hpp).
      if (k > 0)
        for (const Joint& j : m.joints) property[k][j.element] = 0.0;
      property[k].resize(m.total_elements() + table_padding, k == 0 ? 1.0 : 0.0);
    }
    for (std::size_t line = 0; line < m.lines.size(); ++line) {
      first_panel.push_back(static_cast<int>(panels.size()));
      const int count = (m.lines[line].elements + panel_elements - 1) / panel_elements;
      for (int p = 0; p < count; ++p) panels.push_back({static_cast<int>(line), p});
    }
    carry.assign(panels.size() * carry_size, 0.0);
    node_property[0] = shared_at_nodes(property[1]);
    node_property[1] = shared_at_nodes(property[3]);
    fill_floor(TangentFloor{});
  }

  /// Sum over the elements at a node of their Lobatto share times a property.
  std::vector<double> shared_at_nodes(const std::vector<double>& p) const {
    std::vector<double> sum(model.total_nodes() + table_padding, 0.0);
    for (const Line& line : model.lines)
      for (int i = 0; i < line.elements; ++i) {
        const int e = line.first_element + i, node = line.first_node + i;
        const double share = HermiteShape::end_weight * model.element.length[e] * p[e];
        sum[node] += share;
        if (!joint_of(model, e)) sum[node + 1] += share;
      }
    return sum;
  }

  void fill_floor(const TangentFloor& f) {
    floor = f;
    std::vector<double>& least = property[property_count - 1];
    least.assign(model.total_elements() + table_padding, no_floor);
    for (int e = 0; e < model.total_elements(); ++e) least[e] = least_tension(model, f, e);
    for (const Joint& j : model.joints) least[j.element] = no_floor;
    const bool floored = f.tension > 0.0 || f.use_minimum;
    std::vector<double>& at_nodes = node_property[2];
    if (floored) {
      // A joint's element takes no part in the nodal sums, so its least tension must not either.
      std::vector<double> taking_part = least;
      for (const Joint& j : model.joints) taking_part[j.element] = 0.0;
      at_nodes = shared_at_nodes(taking_part);
    } else {
      at_nodes.assign(model.total_nodes() + table_padding, no_floor);
    }
  }

  void set_floor(const TangentFloor& f) {
    if (f.tension != floor.tension || f.use_minimum != floor.use_minimum) fill_floor(f);
    floor.gauss_newton = f.gauss_newton;
  }

  SweepLine sweep_line(int index, const State& state, const TangentWeights& w, double* r, double* values) {
    const Line& line = model.lines[index];
    const Chain& chain = model.chain(index);
    SweepLine s{};
    s.elements = line.elements;
    s.q = state.q.data() + chain.first_dof;
    s.v = state.v.data() + chain.first_dof;
    s.a = state.a.data() + chain.first_dof;
    for (int k = 0; k < property_count; ++k) s.property[k] = property[k].data() + line.first_element;
    for (int k = 0; k < node_property_count; ++k) s.node_property[k] = node_property[k].data() + line.first_node;
    s.weights = {w.stiffness, w.damping, w.mass, floor.gauss_newton};
    s.current = current_table(model);
    s.r = r + chain.first_dof;
    s.blocks = values ? values + chain.first_value : nullptr;
    s.carry = carry.data() + static_cast<std::size_t>(first_panel[index]) * carry_size;
    return s;
  }

  void run(const State& state, const TangentWeights& w, double* r, double* values) {
    const int count = static_cast<int>(panels.size());
    const int team = model.total_elements() < serial_below ? 1 : threads;
    if (team <= 1) {
      for (int p = 0; p < count; ++p) run_panel(p, state, w, r, values);
    } else {
#pragma omp parallel for num_threads(team) schedule(static)
      for (int p = 0; p < count; ++p) run_panel(p, state, w, r, values);
    }
    add_carries(r, values);
  }

  void run_panel(int p, const State& state, const TangentWeights& w, double* r, double* values) {
    const int family = sweep_family(static_cast<int>(model.lines[panels[p].line].family), model.wet);
    const SweepLine line = sweep_line(panels[p].line, state, w, r, values);
    (values ? sweep.tangent : sweep.force)[family](line, panels[p].panel);
  }

  void add_carries(double* r, double* values) {
    for (std::size_t p = 0; p + 1 < panels.size(); ++p) {
      if (panels[p + 1].line != panels[p].line) continue;
      const Chain& chain = model.chain(panels[p].line);
      const int b = chain.block, node = panels[p + 1].panel * panel_elements;
      const double* c = carry.data() + p * carry_size;
      for (int i = 0; i < b; ++i) r[chain.dof(node) + i] += c[i];
      if (!values) continue;
      double* D = values + chain.first_value + std::size_t{3} * b * b * node;
      for (int i = 0; i < b * b; ++i) D[i] += c[b + i];
    }
  }
};

Assembler::Assembler(const Model& model, int threads) : model_(model), impl_(std::make_unique<Impl>(model, std::max(1, threads))) {}
Assembler::~Assembler() = default;

int Assembler::threads() const { return impl_->threads; }

Tangent Assembler::make_tangent() const {
  Tangent t;
  t.chain = BlockTridiagonal(model_.chains);
  t.eliminations.resize(model_.joints.size());
  return t;
}

void Assembler::residual(const State& state, std::span<double> r) const {
  assert(r.size() == model_.unknowns);
  impl_->run(state, TangentWeights{}, r.data(), nullptr);
  for (const Joint& joint : model_.joints) {
    Vector12 rx;
    Eigen::Map<Eigen::VectorXd> rc(&r[joint.inner], joint.inner_count());
    joint_residual(model_, state, joint, rx, rc);
    const std::size_t first = model_.dof(joint.line, joint.node - 1);
    for (int i = 0; i < 12; ++i) r[first + i] += rx[i];
  }
  add_spread_loads(model_, state, r);
  add_bodies(model_, state, r);
  add_seabed(model_, state, r);
}

void Assembler::tangent(const State& state, const TangentWeights& weights, const TangentFloor& floor, std::span<double> r, Tangent& tangent) const {
  assert(r.size() == model_.unknowns);
  impl_->set_floor(floor);
  impl_->run(state, weights, r.data(), tangent.chain.values().data());
  for (std::size_t k = 0; k < model_.joints.size(); ++k) {
    const Joint& joint = model_.joints[k];
    const JointElement e = evaluate_joint(model_, state, joint, weights, floor);
    tangent.eliminations[k] = e.elimination;
    const Chain& chain = model_.chain(joint.line);
    const std::size_t first = chain.dof(joint.node - 1);
    for (int i = 0; i < 12; ++i) r[first + i] += e.rx[i];
    for (int i = 0; i < joint.inner_count(); ++i) r[joint.inner + i] = e.rc[i];
    using Block = Eigen::Map<Eigen::Matrix<double, 6, 6>>;
    Block(tangent.chain.D(chain, joint.node - 1)) += e.Kxx.topLeftCorner<6, 6>();
    Block(tangent.chain.U(chain, joint.node - 1)) += e.Kxx.topRightCorner<6, 6>();
    Block(tangent.chain.L(chain, joint.node - 1)) += e.Kxx.bottomLeftCorner<6, 6>();
    Block(tangent.chain.D(chain, joint.node)) += e.Kxx.bottomRightCorner<6, 6>();
  }
  add_spread_loads(model_, state, r);
  add_bodies(model_, state, r, weights, tangent.chain);
  add_seabed(model_, state, r, weights, floor.gauss_newton, tangent.chain);
  for (const Support& support : model_.supports) constrain(model_, support, tangent.chain);
}

void Assembler::reduce(Tangent& tangent, std::span<const double> r, std::span<double> rhs) const {
  assert(rhs.size() == model_.dofs);
  for (std::size_t i = 0; i < model_.dofs; ++i) rhs[i] = -r[i];
  for (std::size_t k = 0; k < model_.joints.size(); ++k) {
    const Joint& joint = model_.joints[k];
    Elimination& e = tangent.eliminations[k];
    e.rc = Eigen::Map<const Eigen::VectorXd>(&r[joint.inner], joint.inner_count());
    Eigen::Map<Vector12>(&rhs[model_.dof(joint.line, joint.node - 1)]) += e.Kxc * (e.Kcc_inverse * e.rc);
  }
  project(rhs);
}

void Assembler::expand(const Tangent& tangent, std::span<const double> x, std::span<double> d) const {
  std::copy(x.begin(), x.end(), d.begin());
  for (std::size_t k = 0; k < model_.joints.size(); ++k) {
    const Joint& joint = model_.joints[k];
    const Elimination& e = tangent.eliminations[k];
    const Eigen::Map<const Vector12> dx(&x[model_.dof(joint.line, joint.node - 1)]);
    Eigen::Map<Eigen::VectorXd>(&d[joint.inner], joint.inner_count()) = -(e.Kcc_inverse * (e.rc + e.Kcx * dx));
  }
}

void Assembler::project(std::span<double> r) const {
  for (const Support& support : model_.supports) project_support(model_, support, r);
}

}  // namespace hawser
