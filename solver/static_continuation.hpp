// A model that is easier to solve than the real one, and the way from it to the real one.
//
//   max(EI, EI_a)  a line that bends neither folds at a point nor lies on the bed without a shape;  EI_a from 1e-3 W L^2 down to 0
//   min(EA, EA_a)    a line that stretches does not lock while it finds its shape;                EA_a from 100 W up to EA
//
// W is the whole load of the line with the largest one, L the longest length. One after the other they are given back, each by a ratio a
// step, which shrinks where a step fails. A cable is a beam while it has EI_a; bars have none.
#pragma once

#include <string>

#include "assembly/model.hpp"

namespace hawser {

class StaticContinuation {
 public:
  /// At its easiest. `load`: W [N].
  StaticContinuation(const Model& real, double load);

  const Model& model() const { return at_end() ? real_ : relaxed_; }
  bool at_end() const { return here_.EI == 0.0 && here_.EA >= stiffest_; }
  int steps() const { return steps_; }
  std::string place() const;  // how far it is from the real model

  /// The next model on the way.
  void advance();

  /// Back to the model before the last step, to try a shorter one; false where steps have become too short.
  bool retreat();

 private:
  struct Place {
    double EI, EA;
  };
  void apply();

  const Model& real_;
  Model relaxed_;
  Place here_, before_;
  double stiffest_, least_EI_;  // where EA_a ends; from where EI_a goes to 0 at once
  double ratio_;
  int steps_ = 0, failures_ = 0;
};

}  // namespace hawser
