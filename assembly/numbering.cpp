#include "assembly/numbering.hpp"

#include "assembly/block_tridiagonal.hpp"

namespace hawser {

void number_unknowns(Model& model) {
  const BlockTridiagonal layout(model.chains);
  model.chains.assign(layout.chains().begin(), layout.chains().end());
  model.dofs = model.unknowns = layout.dofs();
  for (Joint& joint : model.joints) {
    joint.inner = model.unknowns;
    model.unknowns += static_cast<std::size_t>(joint.inner_count());
  }
}

}  // namespace hawser
