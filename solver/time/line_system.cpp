#include "solver/time/line_system.hpp"

#include <algorithm>

#include "solver/norms.hpp"

namespace hawser {

LineSystem::LineSystem(const Assembler& assembler)
    : assembler_(assembler), model_(assembler.model()), nodal_load_(largest_nodal_load(assembler.model())) {
  for (const Support& support : model_.supports) {
    if (support.position) {
      const std::size_t first = model_.dof(support.line, support.node);
      prescribed_.insert(prescribed_.end(), {first, first + 1, first + 2});
    }
  }
  for (const Line& line : model_.lines) {
    reference_length_ = std::max(reference_length_, line.length);
  }
}

ScaledResidual LineSystem::scaled_residual(std::span<const double> r) const {
  const WorstNode worst = worst_node(model_, r);
  return {worst.residual, model_.dof(worst.line, worst.node)};
}

IncrementMeasure LineSystem::measure_increment(std::span<const double> d) const {
  const IncrementSize size = increment_size(model_, d);
  double turn = size.slope;
  for (const Line& line : model_.lines) {
    if (line.family != Family::bar) {
      continue;
    }
    const Chain& chain = model_.chain(static_cast<int>(&line - model_.lines.data()));
    for (int i = 0; i < line.elements; ++i) {
      const Eigen::Map<const Vec3> left(&d[chain.dof(i)]), right(&d[chain.dof(i + 1)]);
      turn = std::max(turn, (right - left).norm() / model_.element.length[line.first_element + i]);
    }
  }
  return {size.scaled, turn};
}

double LineSystem::reference_force(std::span<const double> r) const { return std::max(nodal_load_, largest_end_force(model_, r)); }

double LineSystem::roundoff_floor(const State& state) const { return roundoff_force(model_, state); }

}  // namespace hawser
