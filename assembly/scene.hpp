// Scene: what the user wrote, in SI units, with the place in the scene file where it was written.
//
// A plain tree of values. The scene reader (solver/app) fills and checks it; build_model (model.hpp) turns it into
// the immutable Model. z points up, the mean sea surface is z = 0. Names keep the order of the file.
// Spelling and meaning of every key: data/README.md.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hawser {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Line and column (1-based) in the scene file; 0 where a value was not written.
struct Place {
  int line = 0;
  int column = 0;
};

/// Samples of a vector in time: a motion file or a force table.
struct TimeTable {
  enum class Interpolation { linear, cubic };
  std::vector<double> time;  // s, strictly increasing
  std::vector<Vec3> value;
  Interpolation interpolation = Interpolation::linear;
};

/// A force [N] or moment [N m] in time: constant + table (zero outside it) + force * sin^2(pi t/duration) for 0 <= t <= duration.
struct TimeForce {
  struct Pulse {
    Vec3 force = Vec3::Zero();
    double duration = 0.0;  // s
  };
  Vec3 constant = Vec3::Zero();
  std::optional<TimeTable> table;
  std::optional<Pulse> pulse;

  bool any() const { return !constant.isZero(0.0) || table.has_value() || pulse.has_value(); }
};

struct Harmonic {
  Vec3 direction = Vec3::Zero();  // used as given, not normalised
  double amplitude = 0.0;         // m
  double period = 1.0;            // s
  double phase = 0.0;             // rad (degrees in the scene file)
};

/// Prescribed motion of a point: position + velocity * int r + r * sum of harmonics, r = min(1, t/ramp); or a file of positions.
struct MotionSpec {
  Vec3 velocity = Vec3::Zero();  // m/s
  double ramp = 0.0;             // s; 0: no ramp
  std::vector<Harmonic> harmonics;
  std::optional<TimeTable> file;  // absolute positions, cubic
};

/// What a concentrated body adds to its node: a free point, or a clump or float on a line.
struct BodySpec {
  double mass = 0.0;                 // kg
  std::optional<double> wet_weight;  // N, positive down
  std::optional<double> volume;      // m3, used where wet_weight is absent
  double drag_area = 0.0;            // Cd*A, m2
  double added_mass = 0.0;           // kg, isotropic
  TimeForce force;                   // N: thrust of a point, force of a load
};

struct PointSpec {
  std::string name;
  Place place;
  bool free = false;
  Vec3 position = Vec3::Zero();      // m; a starting guess where free
  std::optional<MotionSpec> motion;  // absent: fixed (or free)
  BodySpec body;                     // free points only
};

struct LineType {
  std::string name;
  Place place;
  double diameter = 0.0;                                        // m
  double mass = 0.0;                                            // kg/m in air
  double EA = 0.0;                                              // N
  double EI = 0.0;                                              // N m2
  double drag_normal = 0.0, drag_tangential = 0.0;              // reference areas d*l and pi*d*l
  double added_mass_normal = 0.0, added_mass_tangential = 0.0;  // times the displaced water mass
  double axial_damping = 0.0;                                   // N s
  std::optional<double> wet_weight;                             // N/m; absent: (mass - rho*A)*g
};

struct SectionSpec {
  std::string type;  // name of a line type
  Place place;
  double length = 0.0;  // m, unstretched
  int elements = 0;
};

struct LoadSpec {
  Place place;
  double at = 0.0;    // m, unstretched arc length from the `from` end
  double over = 0.0;  // m; > 0: the force is spread evenly over at +- over/2
  BodySpec body;
  TimeForce moment;  // N m
};

struct EndSpec {
  bool clamped = false;
  Vec3 direction = Vec3::UnitX();  // of the tangent, pointing from `from` to `to`; any length
};

enum class ModelChoice { automatic, bar, cable, beam };

/// A first guess of a static shape: positions at unstretched arc lengths.
struct ShapeTable {
  std::vector<double> s;
  std::vector<Vec3> position;
};

struct LineSpec {
  std::string name;
  Place place;
  std::string from, to;  // names of points
  std::vector<SectionSpec> sections;
  ModelChoice model = ModelChoice::automatic;
  std::vector<LoadSpec> loads;
  EndSpec from_end, to_end;
  std::optional<ShapeTable> start;
};

struct CurrentRow {
  double z = 0.0;        // m
  double speed = 0.0;    // m/s, may be negative
  double heading = 0.0;  // rad from +x towards +y (degrees in the scene file)
};

/// Soundings of the seabed on a grid: x and y increase, z[j nx + i] at (x[i], y[j]).
struct BathymetryGrid {
  std::vector<double> x, y, z;  // m, at least two of x and of y
};

/// Contact with the seabed, on the centreline of a line (theory 5.4).
struct SeabedSpec {
  double stiffness = 3.0e3;                             // N/m per metre of line per metre of penetration
  double smoothing = 0.0;                               // m, width of a quadratic toe
  double damping = 0.0;                                 // N s/m2
  double friction_axial = 0.0, friction_lateral = 0.0;  // Coulomb coefficients
  double slip = 1.0e-4;                                 // m, elastic slip of static friction
  std::optional<BathymetryGrid> bathymetry;             // absent: the plane z = -depth
};

struct Environment {
  double gravity = 9.80665;       // m/s2
  double water_density = 1025.0;  // kg/m3; 0: a dry scene
  std::optional<double> depth;    // m: plane seabed at z = -depth; absent, and no bathymetry: no seabed
  SeabedSpec seabed;
  std::vector<CurrentRow> current;
};

struct SolveSpec {
  double accuracy = 1.0e-3;
  std::optional<double> newton_tolerance;  // relative (theory 6.1); absent: automatic
  std::string linear_solver = "auto";
  int threads = 0;  // 0: all
};

enum class StartChoice { equilibrium, straight, file };

/// A start read from a file: per line, arc lengths with position and velocity.
struct StartTable {
  struct Row {
    std::string line;
    double s;
    Vec3 position, velocity;
  };
  std::vector<Row> rows;
};

struct DynamicsSpec {
  double duration = 0.0;         // s
  double step = 0.0;             // s, the largest step
  double spectral_radius = 0.8;  // at infinite frequency
  double output_interval = 0.1;  // s
  double fields_interval = 5.0;  // s
  StartChoice start = StartChoice::equilibrium;
  std::optional<StartTable> start_table;
};

struct OutputSpec {
  std::vector<std::pair<std::string, std::vector<double>>> stations;  // line name, arc lengths [m]
};

struct Scene {
  std::string title;
  std::string path;  // as given by the user
  std::string text;  // the scene file itself, for the result file
  Environment environment;
  std::vector<LineType> line_types;
  std::vector<PointSpec> points;
  std::vector<LineSpec> lines;
  SolveSpec solve;
  std::optional<DynamicsSpec> dynamics;
  OutputSpec output;
};

}  // namespace hawser
