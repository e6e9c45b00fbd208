#include "assembly/assembler.hpp"

#include <algorithm>
#include <cassert>

#include "assembly/bodies.hpp"
#include "assembly/element.hpp"
#include "assembly/joints.hpp"
#include "assembly/seabed.hpp"
#include "assembly/seabed_bodies.hpp"
#include "assembly/supports.hpp"
#include "assembly/sweep.hpp"

namespace hawser {

namespace {

constexpr int fetched_ahead_from = 2000;  // elements: half of a megabyte of state and tables, measured

/// What the inner unknowns of a joint leave in the right-hand side of its element.
void condense_inner(const Model& model, const Joint& joint, std::span<const double> r, Elimination& e, std::span<double> rhs) {
  e.rc = Eigen::Map<const Eigen::VectorXd>(&r[joint.inner], joint.inner_count());
  Eigen::Map<Vector12>(&rhs[model.dof(joint.line, joint.node - 1)]) += e.Kxc * (e.Kcc_inverse * e.rc);
}

}  // namespace

int Tangent::negative_inner_pivots() const {
  int n = 0;
  for (const Elimination& e : eliminations) n += e.negative_pivots;
  return n;
}

void Tangent::symmetrize() {
  chain.symmetrize();
  border.symmetrize();
}

/// Tables in the layout of the kernels, and scratch; nothing here outlives a call as a result.
struct Assembler::Impl {
  struct PanelOf {
    int line, panel;
    int table;  // the panel of the line whose properties it reads: those of a uniform line stay in the cache
  };

  const Model& model;
  const SweepTable& sweep = widest_sweep_table();
  int threads;
  std::vector<double> property[property_count];
  std::vector<double> node_property[node_property_count];
  std::vector<PanelOf> panels;
  std::vector<int> first_panel;  // of each line
  std::vector<double> carry;
  std::vector<double> beside;        // residual of the loads beside the sweep, for the panels being made
  std::vector<double> condensation;  // what inner unknowns leave in their right-hand side
  std::vector<char> touched;         // AddedBlocks
  TangentFloor floor;                // the one the tables hold

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
      const int count = panel_count(m.lines[line].nodes);
      for (int p = 0; p < count; ++p) panels.push_back({static_cast<int>(line), p, p});
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
    share_tables();
  }

  /// A panel whose properties are those of the panel before it reads them there.
  void share_tables() {
    for (std::size_t p = 1; p < panels.size(); ++p) {
      const PanelOf& before = panels[p - 1];
      PanelOf& now = panels[p];
      now.table = before.line == now.line && same_properties(model.lines[now.line], before.table, now.panel) ? before.table : now.panel;
    }
  }

  /// Of panels a and b of a line, as far as b goes.
  bool same_properties(const Line& line, int a, int b) const {
    const int i = first_node_of_panel(a), k = first_node_of_panel(b), elements = std::min(panel_elements, line.elements - k);
    const auto same = [&](int start, int count) {
      return [=](const std::vector<double>& table) {
        const auto at = table.begin() + start;
        return std::equal(at + i, at + i + count, at + k);
      };
    };
    return std::all_of(std::begin(property), std::end(property), same(line.first_element, elements)) &&
           std::all_of(std::begin(node_property), std::end(node_property), same(line.first_node, elements + 1));
  }

  void set_floor(const TangentFloor& f) {
    if (f.tension != floor.tension || f.use_minimum != floor.use_minimum) fill_floor(f);
    floor.gauss_newton = f.gauss_newton;
  }

  SweepLine sweep_line(const PanelOf& panel, const State& state, const TangentWeights& w, double* r, double* values) {
    const Line& line = model.lines[panel.line];
    const Chain& chain = model.chain(panel.line);
    const int table = first_node_of_panel(panel.table);
    SweepLine s{};
    s.elements = line.elements;
    s.q = state.q.data() + chain.first_dof;
    s.v = state.v.data() + chain.first_dof;
    s.a = state.a.data() + chain.first_dof;
    for (int k = 0; k < property_count; ++k) s.property[k] = property[k].data() + line.first_element + table;
    for (int k = 0; k < node_property_count; ++k) s.node_property[k] = node_property[k].data() + line.first_node + table;
    s.weights = {w.stiffness, w.damping, w.mass, floor.gauss_newton};
    s.current = current_table(model);
    s.r = r + chain.first_dof;
    s.blocks = values;
    s.carry = carry.data() + static_cast<std::size_t>(first_panel[panel.line]) * carry_size;
    return s;
  }

  void run(const State& state, const TangentWeights& w, double* r, double* values) {
    const int count = static_cast<int>(panels.size());
    const int team = model.total_elements() < serial_below ? 1 : threads;
    if (team <= 1) {
      for (int p = 0; p < count; ++p) run_panel(p, 1, state, w, r, values_of(p, values));
    } else {
#pragma omp parallel for num_threads(team) schedule(static)
      for (int p = 0; p < count; ++p) run_panel(p, 1, state, w, r, values_of(p, values));
    }
    for (int p = 0; p + 1 < count; ++p)
      if (panels[p + 1].line == panels[p].line) add_carry(p, r, values_of(p + 1, values));
  }

  /// D of a panel's first node in the values of a whole matrix.
  double* values_of(int p, double* values) {
    if (!values) return nullptr;
    const Chain& c = model.chain(panels[p].line);
    return values + c.first_value + std::size_t{3} * c.block * c.block * first_node_of_panel(panels[p].panel);
  }

  /// direction: to the panel that is made next, 1 or -1.
  void run_panel(int p, int direction, const State& state, const TangentWeights& w, double* r, double* values) {
    const int family = sweep_family(static_cast<int>(model.lines[panels[p].line].family), model.wet);
    SweepLine line = sweep_line(panels[p], state, w, r, values);
    const int next = panels[p].panel + direction;
    if (line.elements >= fetched_ahead_from && next >= 0 && first_node_of_panel(next) < line.elements) {
      line.next = direction * panel_elements;
      line.next_table = panel_elements * (panels[p + direction].table - panels[p].table);
    }
    (values ? sweep.tangent : sweep.force)[family](line, panels[p].panel);
  }

  /// What a panel left for the first node of the next one.
  void add_carry(int p, double* r, double* D_next, double* rhs = nullptr) {
    const Chain& chain = model.chain(panels[p].line);
    const int b = chain.block;
    const std::size_t dof = chain.dof(first_node_of_panel(panels[p].panel + 1));
    const double* c = carry.data() + static_cast<std::size_t>(p) * carry_size;
    for (int i = 0; i < b; ++i) r[dof + i] += c[i];
    if (D_next)
      for (int i = 0; i < b * b; ++i) D_next[i] += c[b + i];
    if (rhs)
      for (int i = 0; i < b; ++i) rhs[dof + i] -= c[i];
  }

  /// Joints, bodies, spread loads and contact.
  void add_beside(const State& state, const TangentWeights& weights, const TangentFloor& f, std::span<double> r, AddedBlocks blocks,
                  std::vector<Elimination>& eliminations) const {
    for (std::size_t k = 0; k < model.joints.size(); ++k) eliminations[k] = add_joint(model, state, model.joints[k], weights, f, r, blocks);
    add_spread_loads(model, state, r);
    add_bodies(model, state, r, weights, blocks);
    add_seabed(model, state, r, weights, f.gauss_newton, blocks);
    add_seabed_to_bodies(model, state, r, weights, f.gauss_newton, blocks);
  }

  bool has_beside() const { return !(model.joints.empty() && model.bodies.empty() && model.spread_loads.empty()) || model.seabed; }
};

Assembler::Assembler(const Model& model, int threads) : model_(model), impl_(std::make_unique<Impl>(model, std::max(1, threads))) {}
Assembler::~Assembler() = default;

int Assembler::threads() const { return impl_->threads; }

Tangent Assembler::make_tangent() const {
  Tangent t;
  t.chain = BlockTridiagonal(model_.chains);
  t.eliminations.resize(model_.joints.size());
  t.border = make_border(model_);
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
  add_seabed_to_bodies(model_, state, r);
}

void Assembler::tangent(const State& state, const TangentWeights& weights, const TangentFloor& floor, std::span<double> r, Tangent& tangent) const {
  assert(r.size() == model_.unknowns);
  impl_->set_floor(floor);
  tangent.chain.declare(Symmetry::unknown);
  impl_->run(state, weights, r.data(), tangent.chain.values().data());
  impl_->add_beside(state, weights, floor, r, AddedBlocks(tangent.chain), tangent.eliminations);
  for (const Support& support : model_.supports) constrain(model_, support, tangent.chain);
  take_border(model_, tangent.chain, tangent.border);
}

TangentPanels Assembler::tangent_panels(const State& state, const TangentWeights& weights, const TangentFloor& floor, std::span<double> r,
                                        Tangent& tangent, std::span<double> rhs) const {
  assert(r.size() == model_.unknowns && rhs.size() == model_.dofs);
  return {*this, state, weights, floor, r, tangent, rhs};
}

void Assembler::reduce(Tangent& tangent, std::span<const double> r, std::span<double> rhs) const {
  assert(rhs.size() == model_.dofs);
  impl_->sweep.copy_negated(r.data(), rhs.data(), model_.dofs);
  for (std::size_t k = 0; k < model_.joints.size(); ++k) condense_inner(model_, model_.joints[k], r, tangent.eliminations[k], rhs);
  project(rhs);
}

void Assembler::expand(const Tangent& tangent, std::span<const double> x, std::span<double> d) const {
  if (x.data() != d.data()) std::copy(x.begin(), x.end(), d.begin());
  for (std::size_t k = 0; k < model_.joints.size(); ++k) {
    const Joint& joint = model_.joints[k];
    const Elimination& e = tangent.eliminations[k];
    const Eigen::Map<const Vector12> dx(&x[model_.dof(joint.line, joint.node - 1)]);
    Eigen::Map<Eigen::VectorXd>(&d[joint.inner], joint.inner_count()) = -(e.Kcc_inverse * (e.rc + e.Kcx * dx));
  }
}

void Assembler::project(std::span<double> r) const {
  for (const Support& support : model_.supports) project_support(model_, support, r);
  project_hubs(model_, r);
}

TangentPanels::TangentPanels(const Assembler& assembler, const State& state, const TangentWeights& weights, const TangentFloor& floor,
                             std::span<double> r, Tangent& tangent, std::span<double> rhs)
    : assembler_(assembler), state_(state), weights_(weights), floor_(floor), r_(r), rhs_(rhs), tangent_(tangent) {
  Assembler::Impl& impl = *assembler.impl_;
  const Model& model = assembler.model_;
  impl.set_floor(floor);
  if (!impl.has_beside()) return;
  impl.beside.assign(model.unknowns, 0.0);
  impl.condensation.assign(model.dofs, 0.0);
  impl.touched.assign(model.dofs / 3, 0);
  impl.add_beside(state, weights, floor, impl.beside, AddedBlocks(tangent.chain, impl.touched), tangent.eliminations);
  for (std::size_t k = 0; k < model.joints.size(); ++k)
    condense_inner(model, model.joints[k], impl.beside, tangent.eliminations[k], impl.condensation);
  std::copy(impl.beside.begin() + static_cast<std::ptrdiff_t>(model.dofs), impl.beside.end(), r.begin() + static_cast<std::ptrdiff_t>(model.dofs));
}

void TangentPanels::make(int chain_index, int panel, double* values) {
  Assembler::Impl& impl = *assembler_.impl_;
  const Model& model = assembler_.model_;
  const Chain& chain = model.chain(chain_index);
  const int towards_middle = 2 * panel < panel_count(chain.nodes) ? 1 : -1;  // as the chain solver asks for them
  impl.run_panel(impl.first_panel[chain_index] + panel, towards_middle, state_, weights_, r_.data(), values);
  const bool beside = impl.has_beside();
  if (beside) add_beside(chain, panel, values);
  const std::size_t first = chain.dof(first_node_of_panel(panel)), end = first + chain.block * nodes_of_panel(panel, chain.nodes);
  impl.sweep.copy_negated(&r_[first], &rhs_[first], end - first);
  if (beside && !model.joints.empty())
    for (std::size_t i = first; i < end; ++i) rhs_[i] += impl.condensation[i];
  for (const Support& support : model.supports) {
    const int node = support.node - first_node_of_panel(panel);
    if (support.line != chain_index || node < 0 || node >= nodes_of_panel(panel, chain.nodes)) continue;
    const int b2 = chain.block * chain.block, coupling = std::max(node - 1, 0);
    constrain(model, support, values + 3 * b2 * node, values + (3 * coupling + 1) * b2, values + (3 * coupling + 2) * b2);
    project_support(model, support, rhs_);
  }
}

void TangentPanels::add_beside(const Chain& chain, int panel, double* values) {
  const Assembler::Impl& impl = *assembler_.impl_;
  const int b2 = chain.block * chain.block, first = first_node_of_panel(panel);
  for (int i = 0; i < nodes_of_panel(panel, chain.nodes); ++i) {
    const int node = first + i;
    if (!impl.touched[AddedBlocks::place(chain, node)]) continue;
    const double* added = tangent_.chain.D(chain, node);
    const int blocks = node + 1 < chain.nodes ? 3 : 1;
    for (int k = 0; k < blocks * b2; ++k) values[3 * b2 * i + k] += added[k];
  }
  const std::size_t from = chain.dof(first), to = from + chain.block * nodes_of_panel(panel, chain.nodes);
  for (std::size_t i = from; i < to; ++i) r_[i] += impl.beside[i];
}

void TangentPanels::add_carry(int chain_index, int panel, double* D_next) {
  Assembler::Impl& impl = *assembler_.impl_;
  const int p = impl.first_panel[chain_index] + panel;
  impl.add_carry(p, r_.data(), D_next, rhs_.data());
}

const BlockTridiagonal& TangentPanels::whole() {
  assembler_.tangent(state_, weights_, floor_, r_, tangent_);
  tangent_.chain.declare(symmetry_);
  assembler_.reduce(tangent_, r_, rhs_);
  return tangent_.chain;
}

}  // namespace hawser
