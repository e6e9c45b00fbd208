#include "solver/static_start_hubs.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/static_start_loads.hpp"
#include "solver/static_start_shape.hpp"

namespace hawser {
namespace {

constexpr int max_iterations = 60;                  // with one elasticity
constexpr double EA_first = 10.0, EA_ratio = 10.0;  // of the loads; from one elasticity to the next
constexpr double rough_balance = 1e-2;              // of the largest load at a hub: with softened lines
constexpr double wanted_balance = 1e-9;             // in still water
constexpr double balance_in_flow = 1e-3;            // the drag of a first guess is not known better
constexpr double least_step = 1e-12;                // of the length
constexpr double least_tension = 1e-6;              // of the load: tension that keeps a slack line's compliance finite
constexpr double difference = 1e-6;                 // of the length, to measure the stiffness of a line on the bed
constexpr double floor_share = 1e-12;               // of the largest stiffness, added to all
constexpr double upturn = 0.1;                      // slope of the energy along a step, of the one at its start, that ends it
constexpr double least_share = 1e-6;                // of a step

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// What a line exerts on the points at its `from` and `to` end [N], and K = -dF/dr of both [N/m].
struct Pull {
  Vector6 force;
  Matrix6 stiffness = Matrix6::Zero();
};

Vec3 tension(double EA, const Vec3& slope) { return EA * (slope.norm() - 1.0) * slope.normalized(); }

Vector6 end_forces(const Model& model, const Line& line, const LineShape& shape) {
  const auto EA = model.element.EA.begin() + line.first_element;
  Vector6 force;
  force << tension(EA[0], shape.right.front()), -tension(EA[line.elements - 1], shape.left.back());
  return force;
}

/// Stiffness of a hanging line from the compliance of its shape.
Matrix6 hanging_stiffness(const Model& model, const Line& line, const LineShape& shape, double least) {
  Mat3 C = Mat3::Zero();
  for (int i = 0; i < line.elements; ++i) {
    const int e = line.first_element + i;
    for (const Vec3& slope : {shape.right[i], shape.left[i + 1]}) {
      const Vec3 t = slope.normalized();
      const double T = std::max(tension(model.element.EA[e], slope).norm(), least);
      C += 0.5 * model.element.length[e] * ((Mat3::Identity() - t * t.transpose()) / T + Mat3::Identity() / model.element.EA[e]);
    }
  }
  const Mat3 K = C.ldlt().solve(Mat3::Identity());
  Matrix6 both;
  both << K, -K, -K, K;
  return both;
}

bool rests_on_bed(const Model& model, const LineShape& shape) {
  if (!model.seabed) return false;
  return std::any_of(shape.r.begin() + 1, shape.r.end() - 1, [&](const Vec3& r) { return r.z() <= model.seabed->surface.height(r.x(), r.y()); });
}

class Balance {
 public:
  explicit Balance(const Model& model) : model_(model), EA_(model.element.EA) {
    for (const ModelPoint& point : model.points) position_.push_back(point.motion(0.0).r);
    std::vector<double> at_hub(model.hubs.size());
    for (int index = 0; index < static_cast<int>(model.lines.size()); ++index) {
      const Line& line = model.lines[index];
      const double load = load_scale(model, index);
      all_loads_ += load;
      length_ = std::max(length_, line.length);
      for (const int hub : {line.from_hub, line.to_hub})
        if (hub >= 0) at_hub[hub] += load;
    }
    hub_load_ = *std::max_element(at_hub.begin(), at_hub.end());
  }

  /// Soft lines first, then stiffer and stiffer ones: a step that swings a hub on a stiff line would be short.
  std::vector<Vec3> run() {
    const double stiffest = *std::max_element(EA_.begin(), EA_.end());
    for (double EA = EA_first * all_loads_; EA < stiffest && EA > 0.0; EA *= EA_ratio) {
      for (std::size_t e = 0; e < EA_.size(); ++e) model_.element.EA[e] = std::min(EA_[e], EA);
      balance(rough_balance);
    }
    model_.element.EA = EA_;
    const bool flow = model_.wet && model_.current.fastest() + model_.tow.norm() > 0.0;
    balance(flow ? balance_in_flow : wanted_balance);
    return position_;
  }

 private:
  void balance(double tolerance) {
    Eigen::VectorXd force = evaluate(true);
    for (int k = 0; k < max_iterations && force.cwiseAbs().maxCoeff() > tolerance * hub_load_; ++k) {
      Eigen::VectorXd step = factors_.solve(force);
      if (factors_.info() != Eigen::Success || !step.allFinite()) return;
      step *= std::min(1.0, length_ / step.cwiseAbs().maxCoeff());
      const double taken = along(step, force);
      if (taken * step.cwiseAbs().maxCoeff() <= least_step * length_) return;
    }
  }

  /// Goes along the step while the energy falls, whose slope is -force . step; returns the share taken and updates the force.
  double along(const Eigen::VectorXd& step, Eigen::VectorXd& force) {
    const std::vector<Vec3> start = position_;
    const double first = force.dot(step);
    double share = 1.0;
    for (;;) {
      for (std::size_t hub = 0; hub < model_.hubs.size(); ++hub)
        position_[model_.hubs[hub].point] = start[model_.hubs[hub].point] + share * step.segment<3>(3 * static_cast<Eigen::Index>(hub));
      force = evaluate(false);
      const double slope = force.dot(step);
      if (slope >= -upturn * first || share < least_share) break;
      share *= std::clamp(first / (first - slope), 0.1, 0.5);
    }
    force = evaluate(true);
    return share;
  }

  /// Force on every hub; with the factors of its stiffness.
  Eigen::VectorXd evaluate(bool with_stiffness) {
    Eigen::VectorXd force(3 * static_cast<Eigen::Index>(model_.hubs.size()));
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t hub = 0; hub < model_.hubs.size(); ++hub) force.segment<3>(3 * static_cast<Eigen::Index>(hub)) = load_of(model_.hubs[hub]);
    for (int index = 0; index < static_cast<int>(model_.lines.size()); ++index) {
      const Line& line = model_.lines[index];
      const int hubs[2] = {line.from_hub, line.to_hub};
      if (hubs[0] < 0 && hubs[1] < 0) continue;
      const Pull pull = pull_of(index, with_stiffness);
      for (int i = 0; i < 2; ++i) {
        if (hubs[i] < 0) continue;
        force.segment<3>(3 * hubs[i]) += pull.force.segment<3>(3 * i);
        for (int j = 0; j < 2; ++j)
          for (int k = 0; k < 9 && hubs[j] >= 0; ++k)
            entries.emplace_back(3 * hubs[i] + k % 3, 3 * hubs[j] + k / 3, pull.stiffness(3 * i + k % 3, 3 * j + k / 3));
      }
    }
    if (with_stiffness) factorize(force.size(), entries);
    return force;
  }

  void factorize(Eigen::Index size, std::vector<Eigen::Triplet<double>>& entries) {
    double largest = std::numeric_limits<double>::min();
    for (const auto& entry : entries) largest = std::max(largest, std::abs(entry.value()));
    for (int i = 0; i < size; ++i) entries.emplace_back(i, i, floor_share * largest);
    Eigen::SparseMatrix<double> K(size, size);
    K.setFromTriplets(entries.begin(), entries.end());
    factors_.compute(K);
  }

  Vec3 load_of(const Hub& hub) const {
    const Support& first = hub.ends.front();
    for (const Body& body : model_.bodies)
      if (body.line == first.line && body.node == first.node) return body_force(model_, body, position_[hub.point].z());
    return Vec3::Zero();
  }

  Pull pull_of(int index, bool with_stiffness) const {
    const Line& line = model_.lines[index];
    const Vec3 ends[2] = {position_[line.from], position_[line.to]};
    const LineShape shape = guessed_shape(model_, index, ends[0], ends[1]);
    Pull pull{end_forces(model_, line, shape)};
    if (!with_stiffness || line.from_free || line.to_free) return pull;  // a line with a free end follows its other end
    if (!rests_on_bed(model_, shape)) {
      pull.stiffness = hanging_stiffness(model_, line, shape, least_tension * all_loads_);
      return pull;
    }
    const double h = difference * line.length;
    for (int k = 0; k < 6; ++k) {
      Vec3 moved[2] = {ends[0], ends[1]};
      moved[k / 3][k % 3] += h;
      pull.stiffness.col(k) = (pull.force - end_forces(model_, line, guessed_shape(model_, index, moved[0], moved[1]))) / h;
    }
    pull.stiffness = (0.5 * (pull.stiffness + pull.stiffness.transpose())).eval();
    return pull;
  }

  Model model_;             // with the elasticity of the moment
  std::vector<double> EA_;  // N, as it is
  std::vector<Vec3> position_;
  double all_loads_ = 0.0, hub_load_ = 0.0;  // N; the largest of the lines at a hub
  double length_ = 0.0;                      // m, the longest line
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
};

}  // namespace

std::vector<Vec3> balanced_positions(const Model& model) { return Balance(model).run(); }

}  // namespace hawser
