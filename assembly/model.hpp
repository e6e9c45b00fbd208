// Model: a scene meshed, numbered and checked. Immutable once built; everything that assembles reads it.
//
// Lines are chains of nodes; nodes and elements are numbered through all lines. Node i of a line has the unknowns
//   bar: r (3);   cable, beam: r, r' = dr/ds (6),   s = unstretched arc length from the `from` end.
// Properties are per unstretched length and per element, as arrays over all elements.
// Free points at which several line ends meet are hubs: every end keeps its place in State::q, and the r of all of them is one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assembly/block_tridiagonal.hpp"
#include "assembly/environment/seabed_surface.hpp"
#include "assembly/environment/time_function.hpp"
#include "assembly/scene.hpp"
#include "assembly/seabed_law.hpp"
#include "assembly/state.hpp"

namespace hawser {

enum class Family { bar, cable, beam };
const char* name_of(Family);

/// How the slope jumps at the right end of an element (architecture rule 8).
enum class Jump {
  free,   // EI = 0 on a side: the left element's end slope is an unknown vector of its own (3 inner unknowns)
  scaled  // EI > 0 on both sides: it is mu r' of the node (1 inner unknown)
};

struct Joint {
  Jump jump;
  int line, element, node;  // the element left of the node (numbered through all lines), and the node
  std::size_t inner;        // first inner unknown in State::q
  int inner_count() const { return jump == Jump::free ? 3 : 1; }
};

/// Concentrated mass, weight, drag and force at a node.
struct Body {
  int line, node;
  double mass = 0.0, added_mass = 0.0;  // kg
  double wet_weight = 0.0;              // N, down
  double drag = 0.0;                    // 1/2 rho Cd A [kg/m]
  TimeFunction force;                   // N
  TimeFunction moment;                  // N m, on the tangent of the node (beam)
  double bed_length = 0.0;              // m, of line that the seabed takes it for; 0: it does not touch (seabed_bodies.hpp)
  std::optional<Vec3> lay;              // m, where it was laid on a seabed with friction
};

/// A force spread evenly over part of one element: xi in [xi0, xi1], share = its part of the whole force.
struct SpreadLoad {
  int line, element;
  double xi0, xi1, share;
  TimeFunction force;  // N, the whole force
};

/// An end of a line at a fixed or moved point, and what is held there.
struct Support {
  int line, node, point;
  bool position = true;            // r is prescribed
  bool clamped = false;            // the direction of r' is prescribed, its length is not
  Vec3 direction = Vec3::UnitX();  // unit vector, clamped ends
};

/// A free point at which two or more line ends meet: the r of these ends is one unknown vector (hubs.hpp).
struct Hub {
  int point;
  std::vector<Support> ends;  // the body of the point is at the first one
};

struct ModelPoint {
  std::string name;
  bool free = false;
  Vec3 position = Vec3::Zero();  // as in the scene
  Motion motion;                 // prescribed position in time (a constant for a fixed point)
};

struct Line {
  std::string name;
  Family family;
  int first_node, nodes;
  int first_element, elements;
  int from, to;                    // points
  double length;                   // m, unstretched
  bool from_free, to_free;         // ends at a free point where no other line ends
  int from_hub = -1, to_hub = -1;  // hubs; -1: none
  std::vector<double> s;           // arc length of each node
};

/// Properties per element, structure of arrays. Weight is positive down.
struct ElementArrays {
  std::vector<double> length;                          // m
  std::vector<double> EA, EI, axial_damping;           // N, N m2, N s
  std::vector<double> mass, weight;                    // kg/m, N/m
  std::vector<double> drag_normal, drag_tangential;    // 1/2 rho Cdn d and 1/2 rho Cdt pi d [kg/m2]
  std::vector<double> added_normal, added_tangential;  // kg/m
  std::vector<double> minimum_tension;                 // N: 1e-6 (|w| + |drag|) l, theory 7.2
  std::vector<double> diameter;                        // m
};

/// Steady current, components linear in z between rows (ascending z), constant beyond.
struct Current {
  std::vector<double> z, ux, uy;

  Vec3 at(double depth_z) const;
  double fastest() const;  // m/s, largest horizontal speed over the rows
};

/// The seabed, and where the nodes of every line with an end on it were laid: unstrained on the bed from that end, in plan towards the
/// other end. Static friction counts from there.
enum class Laid : char { nowhere, from_start, from_end };
struct Seabed {
  SeabedSurface surface;
  SeabedLaw law;
  std::vector<Vec3> lay, lay_slope;                           // m and -, of every node
  std::vector<Laid> laid;                                     // of every line: the end from which it was laid
  FrictionTangent friction_tangent = FrictionTangent::exact;  // of the unfloored tangent
};

struct Model {
  std::vector<Line> lines;
  std::vector<Chain> chains;  // one per line, same order
  std::vector<ModelPoint> points;
  ElementArrays element;
  std::vector<Joint> joints;
  std::vector<Body> bodies;
  std::vector<SpreadLoad> spread_loads;
  std::vector<Support> supports;
  std::vector<Hub> hubs;
  std::vector<double> node_length;  // m: the shorter adjacent element, for norms (theory 6.1)
  Current current;
  std::optional<Seabed> seabed;
  double gravity = 9.80665, water_density = 1025.0;
  bool wet = false;         // some element has drag or added mass
  Vec3 tow = Vec3::Zero();  // common velocity of a steady tow

  std::size_t dofs = 0;      // chain unknowns
  std::size_t unknowns = 0;  // with the inner ones

  int total_nodes() const { return static_cast<int>(node_length.size()); }
  int total_elements() const { return static_cast<int>(element.length.size()); }
  const Chain& chain(int line) const { return chains[line]; }
  bool rubs() const { return seabed && seabed->law.rubs(); }  // the seabed has friction

  /// First unknown of node `node` (0-based within its line).
  std::size_t dof(int line, int node) const { return chains[line].dof(node); }

  /// A state of the right size, all zero.
  State make_state() const;

  /// Writes the prescribed positions, velocities and accelerations of the supports at state.t, and gives all ends at a hub those of its
  /// first end (slopes are untouched).
  void prescribe(State& state) const;

  /// Puts r' of clamped nodes along their direction, keeping its length.
  void align_clamps(State& state) const;

  /// Sets the slopes of jumps from their nodes: free jumps copy r', scaled ones take mu = 1.
  void reset_joints(State& state) const;
};

/// Meshes and numbers a checked scene. Throws std::invalid_argument on a scene that the reader would have refused.
Model build_model(const Scene& scene);

/// The same scene on a mesh of half the elements, for error estimates; sections keep at least one element.
Scene coarsened(const Scene& scene);

}  // namespace hawser
