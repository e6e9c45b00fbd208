// Elimination of one chain while its panels are made (assembly/matrix_panels.hpp): the fronts of chain_kernel.hpp, each a panel at a time.
//
// The left front makes panels 0, 1, ... and eliminates all nodes of a panel but the last, whose neighbour is not there yet. The right front
// makes the last panel first and stays two nodes behind, because the first node of a panel is complete only when the panel before it is made.
// The panel of the middle node is made last; there both fronts end. The right-hand side is reduced panel by panel as well.
// The numbers are those of an elimination after the assembly.
#pragma once

#include "assembly/aligned.hpp"
#include "assembly/matrix_panels.hpp"
#include "solver/linear/chain_kernel.hpp"

namespace hawser {

class ChainPanels {
 public:
  /// index: of the chain in the panels. b: of the chain.
  void start(const ChainKernel& kernel, MatrixPanels& panels, int index, const Chain& chain, Factors form, double* factors, double* b);

  /// The panels on one side of the middle one, or on both. The sides do not depend on each other.
  void eliminate(Front side, PivotWatch& watch);

  /// The middle panel and node, after both sides: b is then reduced, and `backward` makes it the solution.
  void eliminate_middle(PivotWatch& watch);

 private:
  struct Side {
    AlignedVector<double> values;
    FrontRun run;
    int panel = 0;  // the next one
  };

  /// D, U, L of a panel's node i; with the node before the panel, i = -1, and the two after it.
  double* slot(Side& side, int i) const { return side.values.data() + static_cast<std::ptrdiff_t>(i + 1) * node_size_; }
  void copy_nodes(const double* from, double* to, int count) const;
  void make(Side& side, int panel);
  void make_next_left();
  void make_next_right();
  /// The front's run goes on until so many of its nodes are done; `panel` lies in `at`.
  void reach(Front front, int until, Side& at, int panel);

  const ChainKernel* kernel_ = nullptr;
  MatrixPanels* panels_ = nullptr;
  Factors form_ = Factors::lu;
  double *factors_ = nullptr, *b_ = nullptr;
  int index_ = 0, block_ = 0, node_size_ = 0, nodes_ = 0, middle_panel_ = 0, last_panel_ = 0;
  Side left_, right_;
};

}  // namespace hawser
