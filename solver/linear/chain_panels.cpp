#include "solver/linear/chain_panels.hpp"

#include <algorithm>

namespace hawser {

namespace {

constexpr int slots = 1 + panel_elements + 2;

}  // namespace

void ChainPanels::start(const ChainKernel& kernel, MatrixPanels& panels, int index, const Chain& chain, Factors form, double* factors, double* b) {
  kernel_ = &kernel;
  form_ = form;
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
    side->run = {};
  }
  left_.panel = 0;
  right_.panel = last_panel_;
}

void ChainPanels::eliminate(Front side, PivotWatch& watch) {
  for (;;) {
    const bool left = side != Front::right && left_.panel < middle_panel_, right = side != Front::left && right_.panel > middle_panel_;
    if (!left && !right) return;
    FrontRun none, also_none;
    if (left) make_next_left();
    if (right) make_next_right();
    kernel_->eliminate_runs(block_, nodes_, form_, left ? left_.run : none, right ? right_.run : also_none, factors_, b_, watch);
    if (left) copy_nodes(slot(left_, panel_elements - 1), slot(left_, -1), 1);
  }
}

void ChainPanels::make_next_left() {
  const int panel = left_.panel++;
  make(left_, panel);
  reach(Front::left, first_node_of_panel(panel + 1) - 1, left_, panel);
}

void ChainPanels::make_next_right() {
  const int panel = right_.panel--;
  copy_nodes(slot(right_, 0), slot(right_, panel_elements), 2);
  panels_->make(index_, panel, slot(right_, 0));
  if (panel < last_panel_) panels_->add_carry(index_, panel, slot(right_, panel_elements));
  reach(Front::right, nodes_ - 2 - first_node_of_panel(panel), right_, panel);
}

void ChainPanels::eliminate_middle(PivotWatch& watch) {
  const int panel = middle_panel_, middle = nodes_ / 2;
  make(left_, panel);
  if (panel < last_panel_) {
    copy_nodes(slot(right_, 0), slot(left_, panel_elements), 2);
    panels_->add_carry(index_, panel, slot(left_, panel_elements));
  }
  reach(Front::left, middle, left_, panel);
  reach(Front::right, nodes_ - 1 - middle, left_, panel);
  kernel_->eliminate_runs(block_, nodes_, form_, left_.run, right_.run, factors_, b_, watch);
  kernel_->factorize_middle(block_, nodes_, form_, slot(left_, middle - first_node_of_panel(panel)), factors_, watch);
  kernel_->solve_middle(block_, nodes_, form_, factors_, b_);
}

void ChainPanels::copy_nodes(const double* from, double* to, int count) const {
  std::copy_n(from, static_cast<std::ptrdiff_t>(count) * node_size_, to);
}

void ChainPanels::make(Side& side, int panel) {
  panels_->make(index_, panel, slot(side, 0));
  if (panel > 0) panels_->add_carry(index_, panel - 1, slot(side, 0));
}

void ChainPanels::reach(Front front, int until, Side& at, int panel) {
  FrontRun& run = front == Front::left ? left_.run : right_.run;
  const int node = front == Front::left ? run.first : nodes_ - 1 - run.first;
  run.count = until - run.first;
  run.values = slot(at, node - first_node_of_panel(panel));
}

}  // namespace hawser
