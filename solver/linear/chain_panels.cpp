#include "solver/linear/chain_panels.hpp"

#include <algorithm>

namespace hawser {

namespace {

constexpr int slots = 1 + panel_elements + 2;

}  // namespace

void ChainPanels::start(const ChainKernel& kernel, MatrixPanels& panels, int index, const Chain& chain, double* factors, double* b) {
  kernel_ = &kernel;
  panels_ = &panels;
  factors_ = factors;
  b_ = b;
  index_ = index;
  block_ = chain.block;
  node_size_ = 3 * block_ * block_;
  nodes_ = chain.nodes;
  last_panel_ = panel_count(nodes_) - 1;
  middle_panel_ = std::min(nodes_ / 2 / panel_elements, last_panel_);
  for (Side* side : {&left_, &right_}) {
    side->values.resize(static_cast<std::size_t>(slots) * node_size_);
    side->done = 0;
  }
}

void ChainPanels::eliminate(Front side, PivotWatch& watch) { side == Front::left ? eliminate_left(watch) : eliminate_right(watch); }

void ChainPanels::eliminate_left(PivotWatch& watch) {
  for (int panel = 0; panel < middle_panel_; ++panel) {
    make(left_, panel);
    advance(Front::left, first_node_of_panel(panel + 1) - 1, left_, panel, watch);
    copy_nodes(slot(left_, panel_elements - 1), slot(left_, -1), 1);
  }
}

void ChainPanels::eliminate_right(PivotWatch& watch) {
  for (int panel = last_panel_; panel > middle_panel_; --panel) {
    copy_nodes(slot(right_, 0), slot(right_, panel_elements), 2);
    panels_->make(index_, panel, slot(right_, 0));
    if (panel < last_panel_) panels_->add_carry(index_, panel, slot(right_, panel_elements));
    advance(Front::right, nodes_ - 2 - first_node_of_panel(panel), right_, panel, watch);
  }
}

void ChainPanels::eliminate_middle(PivotWatch& watch) {
  const int panel = middle_panel_, middle = nodes_ / 2;
  make(left_, panel);
  if (panel < last_panel_) {
    copy_nodes(slot(right_, 0), slot(left_, panel_elements), 2);
    panels_->add_carry(index_, panel, slot(left_, panel_elements));
  }
  advance(Front::left, middle, left_, panel, watch);
  advance(Front::right, nodes_ - 1 - middle, left_, panel, watch);
  kernel_->factorize_middle(block_, nodes_, slot(left_, middle - first_node_of_panel(panel)), factors_, watch);
  kernel_->solve_middle(block_, nodes_, factors_, b_);
}

void ChainPanels::copy_nodes(const double* from, double* to, int count) const {
  std::copy_n(from, static_cast<std::ptrdiff_t>(count) * node_size_, to);
}

void ChainPanels::make(Side& side, int panel) {
  panels_->make(index_, panel, slot(side, 0));
  if (panel > 0) panels_->add_carry(index_, panel - 1, slot(side, 0));
}

void ChainPanels::advance(Front front, int until, Side& at, int panel, PivotWatch& watch) {
  Side& side = front == Front::left ? left_ : right_;
  const FrontRun run{front, side.done, until - side.done};
  const int first_met = front == Front::left ? run.first : nodes_ - 2 - run.first;
  kernel_->factorize_run(block_, nodes_, run, slot(at, first_met - first_node_of_panel(panel)), factors_, side.given, watch);
  kernel_->forward_run(block_, nodes_, run, factors_, b_);
  side.done = until;
}

}  // namespace hawser
