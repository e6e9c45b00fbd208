// Numbers of a model's unknowns: the chains one behind the other, then the inner unknowns of the joints.
#pragma once

#include "assembly/model.hpp"

namespace hawser {

/// From the nodes and blocks of model.chains and from model.joints: the rest of the chains, Joint::inner, dofs and unknowns.
void number_unknowns(Model& model);

}  // namespace hawser
