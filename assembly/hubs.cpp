#include "assembly/hubs.hpp"

#include <algorithm>

#include "assembly/supports.hpp"

namespace hawser {

void Border::symmetrize() {
  for (BorderEnd& end : ends) {
    end.column = (0.5 * (end.column + end.row.transpose())).eval();
    end.row = end.column.transpose();
  }
}

Border make_border(const Model& model) {
  Border border;
  border.hubs = static_cast<int>(model.hubs.size());
  for (int hub = 0; hub < border.hubs; ++hub)
    for (const Support& end : model.hubs[hub].ends) {
      BorderEnd& e = border.ends.emplace_back();
      const int b = model.chain(end.line).block;
      e.hub = hub;
      e.line = end.line;
      e.r = model.dof(end.line, end.node);
      e.window = model.dof(end.line, std::max(0, end.node - 1));
      e.column.setZero(2 * b, 3);
      e.row.setZero(3, 2 * b);
    }
  return border;
}

void take_border(const Model& model, BlockTridiagonal& matrix, Border& border) {
  auto taken = border.ends.begin();
  for (const Hub& hub : model.hubs)
    for (const Support& end : hub.ends) {
      const Chain& c = model.chain(end.line);
      const int b = c.block, first = std::max(0, end.node - 1), own = end.node - first;
      using Block = Eigen::Map<const Eigen::MatrixXd>;
      const Block D(matrix.D(c, end.node), b, b), U(matrix.U(c, first), b, b), L(matrix.L(c, first), b, b);
      taken->column.middleRows(own * b, b) = D.leftCols(3);
      taken->column.middleRows((1 - own) * b, b) = (own == 0 ? L : U).leftCols(3);
      taken->row.middleCols(own * b, b) = D.topRows(3);
      taken->row.middleCols((1 - own) * b, b) = (own == 0 ? U : L).topRows(3);
      ++taken;
    }
  for (const Hub& hub : model.hubs)
    for (const Support& end : hub.ends) constrain(model, end, matrix);
}

void project_hubs(const Model& model, std::span<double> r) {
  for (const Hub& hub : model.hubs) {
    Vec3 sum = Vec3::Zero();
    for (const Support& end : hub.ends) {
      Eigen::Map<Vec3> force(&r[model.dof(end.line, end.node)]);
      sum += force;
      force.setZero();
    }
    Eigen::Map<Vec3> first(&r[model.dof(hub.ends.front().line, hub.ends.front().node)]);
    first = sum;
  }
}

}  // namespace hawser
