#include "assembly/seabed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "assembly/bracketed_root.hpp"
#include "assembly/seabed_bodies.hpp"

namespace hawser {
namespace {

constexpr int points = 4;                  // of Gauss, in a piece of an element
constexpr int samples = 8;                 // of the penetration over an element, on a grid
constexpr double root_resolution = 1e-15;  // of the element
constexpr double inside = 1e-9;            // of a piece: off its ends, where the bed may have a kink

/// Shape functions and their derivatives by arc length at xi; those of the slopes are zero for a bar.
struct Shapes {
  Eigen::Vector4d s, ds;

  Shapes(bool bar, double l, double x) {
    if (bar) {
      s << 1.0 - x, 0.0, x, 0.0;
      ds << -1.0 / l, 0.0, 1.0 / l, 0.0;
    } else {
      s << 1.0 - x * x * (3.0 - 2.0 * x), l * x * (1.0 - x) * (1.0 - x), x * x * (3.0 - 2.0 * x), l * x * x * (x - 1.0);
      ds << -6.0 * x * (1.0 - x) / l, (1.0 - x) * (1.0 - 3.0 * x), 6.0 * x * (1.0 - x) / l, x * (3.0 * x - 2.0);
    }
  }
};

using Columns = Eigen::Matrix<double, 3, 4>;  // r0, r0', r1, r1'

Columns columns(const Nodal<double>& n) {
  Columns c;
  for (int i = 0; i < 3; ++i) c.row(i) << n.r0[i], n.s0[i], n.r1[i], n.s1[i];
  return c;
}

Columns columns(const double* x, int block) {
  Columns c = Columns::Zero();
  for (int i = 0; i < 3; ++i) {
    c(i, 0) = x[i], c(i, 2) = x[block + i];
    if (block == 6) c(i, 1) = x[3 + i], c(i, 3) = x[9 + i];
  }
  return c;
}

constexpr int most_kinks = 24;  // lines of the grid that an element crosses
constexpr int smooth_pieces = samples + most_kinks;
struct Cut {
  double xi;
  bool kink;  // of the bed
};
using Cuts = std::array<Cut, 2 * smooth_pieces + 1>;
constexpr int most_pieces = 6 * smooth_pieces + 1;  // cut at two levels of the penetration and at kinks

/// Parts of an element, xi from a to b.
struct Piece {
  double a, b;
};
struct Pieces {
  std::array<Piece, most_pieces> piece;
  int count = 0;
  const Piece* begin() const { return piece.data(); }
  const Piece* end() const { return piece.data() + count; }
};

/// One element as the bed sees it.
class ContactElement {
 public:
  ContactElement(const Model& model, int line, int element, const Columns& q)
      : bed_(*model.seabed), bar_(model.lines[line].family == Family::bar), l_(model.element.length[element]), q_(q) {
    const int node = model.lines[line].first_node + element - model.lines[line].first_element;
    laid_ = bed_.law.rubs() && bed_.laid[line] != Laid::nowhere;
    if (laid_) lay_ << bed_.lay[node], bed_.lay_slope[node], bed_.lay[node + 1], bed_.lay_slope[node + 1];
  }

  /// Some part of the element may touch: its control polygon reaches the bed.
  bool near() const {
    Columns control = q_;
    control.col(1) = q_.col(0) + (l_ / 3.0) * q_.col(1);
    control.col(3) = q_.col(2) - (l_ / 3.0) * q_.col(3);
    const Vec3 low = control.rowwise().minCoeff(), high = control.rowwise().maxCoeff();
    return low.z() < bed_.surface.highest_within(low.x(), high.x(), low.y(), high.y());
  }

  /// On a level bed: all of it below, at least by `depth`.
  bool immersed(double depth) const {
    const auto z = q_.row(2);
    const double highest = std::max({z[0], z[0] + l_ / 3.0 * z[1], z[2] - l_ / 3.0 * z[3], z[2]});
    return bed_.surface.level() && highest < bed_.surface.highest() - depth;
  }

  /// Pieces with g > 0, cut where g = 0 and, if `toe`, where g = delta.
  Pieces wet(bool toe) const;
  /// Ends of pieces on which the penetration is monotone: the extrema of the cubic on a level bed; on a grid the lines that cross, where the
  /// bed has a kink, and the extrema between them that samples of the derivative tell. (A piece that only began at a sample would begin at once,
  /// with a jump of the force.)
  int monotone_cuts(Cuts& cut) const;
  /// Samples and places over lines of the grid, in order.
  int smooth_cuts(std::array<Cut, smooth_pieces + 1>& cut) const;

  Shapes shapes(double xi) const { return Shapes(bar_, l_, xi); }
  Vec3 position(const Shapes& n) const { return q_ * n.s; }
  Vec3 slope(const Shapes& n) const { return q_ * n.ds; }
  SurfacePoint<double> bed(const Vec3& r) const { return bed_.surface.at(r.x(), r.y()); }
  double level_gap(const Shapes& n) const { return bed_.surface.highest() - q_.row(2).dot(n.s); }
  double gap(double xi) const {
    const Shapes n = shapes(xi);
    if (bed_.surface.level()) return level_gap(n);
    const Vec3 r = position(n);
    return bed_.surface.height(r.x(), r.y()) - r.z();
  }
  /// Derivative of the penetration by arc length.
  double deepening(double xi) const {
    const Shapes n = shapes(xi);
    const Vec3 r = position(n), t = slope(n);
    const SurfacePoint<double> at = bed(r);
    return at.gradient[0] * t.x() + at.gradient[1] * t.y() - t.z();
  }
  bool laid() const { return laid_; }
  Vec3 lay(const Shapes& n) const { return lay_ * n.s; }
  bool upward_only() const { return bed_.surface.level() && !laid_ && bed_.law.damping == 0.0; }
  const Seabed& seabed() const { return bed_; }
  double length() const { return l_; }

 private:
  const Seabed& bed_;
  bool bar_, laid_ = false;
  double l_;
  Columns q_, lay_;
};

int ContactElement::smooth_cuts(std::array<Cut, smooth_pieces + 1>& cut) const {
  int count = 0, kinks = 0;
  cut[count++] = {0.0, false};
  Vec3 left = q_.col(0);
  for (int i = 1; i <= samples; ++i) {
    const double a = static_cast<double>(i - 1) / samples, b = static_cast<double>(i) / samples;
    const Vec3 right = position(shapes(b));
    const int first = count;
    for (int axis = 0; axis < 2; ++axis) {
      auto line = bed_.surface.grid_line(axis, left[axis], right[axis]);
      for (; line && kinks < most_kinks; ++kinks) {
        const auto beyond = [&](double x) { return position(shapes(x))[axis] - *line; };
        cut[count++] = {bracketed_root(beyond, a, b, left[axis] - *line, right[axis] - *line, root_resolution), true};
        line = bed_.surface.grid_line(axis, std::nextafter(*line, right[axis]), right[axis]);
      }
    }
    std::sort(cut.begin() + first, cut.begin() + count, [](const Cut& p, const Cut& q) { return p.xi < q.xi; });
    cut[count++] = {b, false};
    left = right;
  }
  return count;
}

int ContactElement::monotone_cuts(Cuts& cut) const {
  int count = 0;
  cut[count++] = {0.0, false};
  if (!bed_.surface.level()) {
    std::array<Cut, smooth_pieces + 1> smooth;
    const int pieces = smooth_cuts(smooth) - 1;
    for (int i = 0; i < pieces; ++i) {
      const double width = smooth[i + 1].xi - smooth[i].xi, a = smooth[i].xi + inside * width, b = smooth[i + 1].xi - inside * width;
      const double left = deepening(a), right = deepening(b);
      if ((left > 0.0) != (right > 0.0) && b > a)
        cut[count++] = {bracketed_root([&](double x) { return deepening(x); }, a, b, left, right, root_resolution), false};
      cut[count++] = smooth[i + 1];
    }
    return count;
  }
  if (!bar_) {
    // z'(xi) = a xi^2 + b xi + c
    const double rise = q_(2, 2) - q_(2, 0), s0 = l_ * q_(2, 1), s1 = l_ * q_(2, 3);
    const double a = 3.0 * (s0 + s1 - 2.0 * rise), b = 2.0 * (3.0 * rise - 2.0 * s0 - s1), c = s0;
    const double discriminant = b * b - 4.0 * a * c;
    if (discriminant > 0.0) {
      const double h = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
      double roots[2] = {a != 0.0 ? h / a : -1.0, h != 0.0 ? c / h : -1.0};
      if (roots[0] > roots[1]) std::swap(roots[0], roots[1]);
      for (double x : roots)
        if (x > 0.0 && x < 1.0) cut[count++] = {x, false};
    }
  }
  cut[count++] = {1.0, false};
  return count;
}

Pieces ContactElement::wet(bool toe) const {
  Pieces wet;
  if (immersed(toe ? bed_.law.smoothing : 0.0)) {
    wet.piece[wet.count++] = {0.0, 1.0};
    return wet;
  }
  const double levels[2] = {0.0, bed_.law.smoothing};
  const int level_count = toe && bed_.law.smoothing > 0.0 ? 2 : 1;
  Cuts turn;
  std::array<double, most_pieces + 1> cut;
  const int count = monotone_cuts(turn);
  int cuts = 0;
  cut[cuts++] = 0.0;
  double left = gap(0.0);
  for (int i = 1; i < count; ++i) {
    const double right = gap(turn[i].xi);
    const int first = cuts;
    for (int k = 0; k < level_count; ++k) {
      const double level = levels[k];
      if ((left > level) == (right > level)) continue;
      const auto above = [&](double x) { return gap(x) - level; };
      cut[cuts++] = bracketed_root(above, turn[i - 1].xi, turn[i].xi, left - level, right - level, root_resolution);
    }
    std::sort(cut.begin() + first, cut.begin() + cuts);
    if (turn[i].kink) cut[cuts++] = turn[i].xi;
    left = right;
  }
  cut[cuts++] = 1.0;
  for (int i = 0; i + 1 < cuts; ++i)
    if (cut[i + 1] > cut[i] && gap(0.5 * (cut[i] + cut[i + 1])) > 0.0) wet.piece[wet.count++] = {cut[i], cut[i + 1]};
  return wet;
}

V3<double> to_v3(const Vec3& x) { return {{x[0], x[1], x[2]}}; }

/// The four force vectors and 4 x 4 blocks that a point of weight w (length included) adds: R = -s f.
void add_point(const ContactElement& e, const Shapes& n, const ContactForce& c, double w, const TangentWeights& weights, Vector12& f, Matrix12* K) {
  for (int i = 0; i < 4; ++i) f.segment<3>(3 * i) -= w * n.s[i] * c.force;
  if (!K) return;
  const Mat3 by_place = w * (weights.stiffness * c.d_r + weights.damping * c.d_v), by_slope = w * weights.stiffness * c.d_a;
  for (int j = 0; j < 4; ++j) {
    Mat3 column = n.s[j] * by_place;
    if (e.laid()) column += n.ds[j] * by_slope;
    for (int i = 0; i < 4; ++i) K->block<3, 3>(3 * i, 3 * j) -= n.s[i] * column;
  }
}

/// The same where the bed pushes upward and nothing else.
void add_upward_point(const SeabedLaw& law, const Shapes& n, double g, double w, const TangentWeights& weights, Vector12& f, Matrix12* K) {
  const double N = w * contact_pressure(law, g);
  for (int i = 0; i < 4; ++i) f[3 * i + 2] -= n.s[i] * N;
  if (!K) return;
  const double dN = w * weights.stiffness * contact_stiffness(law, g);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) (*K)(3 * i + 2, 3 * j + 2) += n.s[i] * n.s[j] * dN;
}

ContactForce force_at(const ContactElement& e, const Shapes& n, const Vec3& v, bool secant, bool with_tangent) {
  const Vec3 r = e.position(n), a = e.slope(n);
  const SurfacePoint<double> bed = e.bed(r);
  const Vec3 lay = e.laid() ? e.lay(n) : Vec3::Zero();
  const Vec3* laid = e.laid() ? &lay : nullptr;
  if (with_tangent) return contact_tangent(e.seabed().law, bed, r, a, v, laid, secant ? FrictionTangent::secant : e.seabed().friction_tangent);
  const V3<double> force = contact_force(e.seabed().law, bed, to_v3(r), to_v3(a), to_v3(v), laid);
  ContactForce out;
  out.force = Vec3(force[0], force[1], force[2]);
  return out;
}

bool add_contact_of(const ContactElement& e, const Columns& v, const TangentWeights& weights, bool secant, Vector12& f, Matrix12* K) {
  const Pieces wet = e.wet(true);
  for (const Piece& piece : wet)
    for (int q = 0; q < points; ++q) {
      const double width = piece.b - piece.a, xi = piece.a + width * four_gauss_xi[q], w = four_gauss_weight[q] * width * e.length();
      const Shapes n = e.shapes(xi);
      if (e.upward_only())
        add_upward_point(e.seabed().law, n, e.level_gap(n), w, weights, f, K);
      else
        add_point(e, n, force_at(e, n, v * n.s, secant, K != nullptr), w, weights, f, K);
    }
  return wet.count > 0;
}

/// No part of the element is below this height: the least of its control points.
double lowest(const double* q, int block, double l) {
  const double z0 = q[2], z1 = q[block + 2], inner = block == 6 ? l / 3.0 : 0.0;
  return std::min({z0, z1, z0 + inner * q[block - 1], z1 - inner * q[2 * block - 1]});
}

void add_force(const Chain& chain, int node, const Vector12& f, std::span<double> r) {
  for (int end = 0; end < 2; ++end)
    for (int i = 0; i < chain.block; ++i) r[chain.dof(node + end) + i] += f[6 * end + i];
}

/// The integral over a piece of what the law says of the penetration there.
double integral(const ContactElement& e, const Piece& piece, double (*of)(const SeabedLaw& law, double gap)) {
  const double width = piece.b - piece.a;
  double sum = 0.0;
  for (int q = 0; q < points; ++q) sum += four_gauss_weight[q] * width * e.length() * of(e.seabed().law, e.gap(piece.a + width * four_gauss_xi[q]));
  return sum;
}

/// Force on the bed and the deepest place of a piece.
void add_depth(const ContactElement& e, const Piece& piece, double s0, SeabedContact& out) {
  out.force += integral(e, piece, [](const SeabedLaw& law, double gap) { return contact_pressure(law, gap); });
  Cuts turn;
  const int count = e.monotone_cuts(turn);
  for (int i = 0; i < count; ++i) {
    const double x = std::clamp(turn[i].xi, piece.a, piece.b), g = e.gap(x);
    if (g > out.largest_penetration) out.largest_penetration = g, out.largest_penetration_s = s0 + x * e.length();
  }
}

/// Calls visit(element, first unknown of its left node, force, tangent or null) for every element in contact that has no joint.
template <class Visit>
void for_each_contact(const Model& model, const State& state, const TangentWeights& weights, bool secant, bool with_tangent, Visit visit) {
  if (!model.seabed) return;
  // Beyond its soundings a grid may rise above the highest of them.
  const double top = model.seabed->surface.level() ? model.seabed->surface.highest() : std::numeric_limits<double>::infinity();
  Vector12 f;
  Matrix12 K;
  for (int line = 0; line < static_cast<int>(model.lines.size()); ++line) {
    const Line& l = model.lines[line];
    const Chain& chain = model.chain(line);
    for (int i = 0; i < l.elements; ++i) {
      const double* q = &state.q[chain.dof(i)];
      if (lowest(q, chain.block, model.element.length[l.first_element + i]) >= top) continue;
      const ContactElement e(model, line, l.first_element + i, columns(q, chain.block));
      if (!e.near() || joint_of(model, l.first_element + i)) continue;
      f.setZero();
      if (with_tangent) K.setZero();
      if (add_contact_of(e, columns(&state.v[chain.dof(i)], chain.block), weights, secant, f, with_tangent ? &K : nullptr)) visit(chain, i, f, K);
    }
  }
}

}  // namespace

void add_seabed(const Model& model, const State& state, std::span<double> r) {
  for_each_contact(model, state, TangentWeights{}, false, false,
                   [&](const Chain& chain, int node, const Vector12& f, const Matrix12&) { add_force(chain, node, f, r); });
}

void add_seabed(const Model& model, const State& state, std::span<double> r, const TangentWeights& weights, bool secant, AddedBlocks added) {
  for_each_contact(model, state, weights, secant, true, [&](const Chain& chain, int node, const Vector12& f, const Matrix12& K) {
    add_force(chain, node, f, r);
    double* blocks[2][2] = {{added.D(chain, node), added.U(chain, node)}, {added.L(chain, node), added.D(chain, node + 1)}};
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>> block(blocks[i][j], chain.block, chain.block);
        block += K.block(6 * i, 6 * j, chain.block, chain.block);
      }
  });
}

bool add_contact(const Model& model, int line, int element, const ElementState<double>& x, const TangentWeights& weights, bool secant, Vector12& f,
                 Matrix12* K) {
  if (!model.seabed) return false;
  const ContactElement e(model, line, element, columns(x.q));
  return e.near() && add_contact_of(e, columns(x.v), weights, secant, f, K);
}

Vec3 seabed_force(const Model& model, const State& state, int line, int element, double xi) {
  if (!model.seabed) return Vec3::Zero();
  const ElementState<double> x = element_state(model, state, line, element);
  const ContactElement e(model, line, element, columns(x.q));
  const Shapes n = e.shapes(xi);
  return force_at(e, n, columns(x.v) * n.s, false, false).force;
}

double seabed_energy(const Model& model, const State& state, int line, int element) {
  if (!model.seabed) return 0.0;
  const ContactElement e(model, line, element, columns(element_state(model, state, line, element).q));
  if (!e.near()) return 0.0;
  double energy = 0.0;
  for (const Piece& piece : e.wet(true)) energy += integral(e, piece, contact_energy);
  return energy;
}

SeabedContact observe_seabed(const Model& model, const State& state, int line) {
  SeabedContact out;
  if (!model.seabed) return out;
  const Line& l = model.lines[line];
  double on_bed_to = -1.0;  // m, where the last piece in contact ended
  // Rounding must not make a touchdown of an anchor that lies on the bed, or of a node.
  const auto at_node = [&](double s, int i) {
    const double near = 1e-9 * l.length;
    return s < l.s[i] + near ? l.s[i] : s > l.s[i + 1] - near ? l.s[i + 1] : s;
  };
  for (int i = 0; i < l.elements; ++i) {
    const ContactElement e(model, line, l.first_element + i, columns(element_state(model, state, line, l.first_element + i).q));
    if (!e.near()) continue;
    for (const Piece& piece : e.wet(false)) {
      const double a = at_node(l.s[i] + piece.a * e.length(), i), b = at_node(l.s[i] + piece.b * e.length(), i);
      if (a > on_bed_to) {
        if (on_bed_to > 0.0) out.touchdown.push_back(on_bed_to);
        if (a > 0.0) out.touchdown.push_back(a);
      }
      on_bed_to = b;
      out.length += b - a;
      add_depth(e, piece, l.s[i], out);
    }
  }
  if (on_bed_to > 0.0 && on_bed_to < l.length) out.touchdown.push_back(on_bed_to);
  out.force += lift_of_bodies(model, state, line);
  return out;
}

}  // namespace hawser
