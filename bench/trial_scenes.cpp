// Random scenes of one line for the public trial of statics, drawn over what a user may sensibly ask (README.md, "The trial of statics").
// The kind goes round with the number of the scene. Every scene has an equilibrium; strains from its loads stay below a third.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bench/trial_draw.hpp"

namespace hawser::bench {
namespace {

class TrialScenes : private TrialDraw {
 public:
  using TrialDraw::TrialDraw;

  Trial draw(std::uint64_t number) {
    constexpr std::array<void (TrialScenes::*)(), trial_kinds> kind{
        &TrialScenes::slack_span,  &TrialScenes::taut_span, &TrialScenes::vertical,   &TrialScenes::ends_at_one_point, &TrialScenes::buoyant,
        &TrialScenes::loaded_span, &TrialScenes::pipe,      &TrialScenes::current,    &TrialScenes::loaded_current,    &TrialScenes::hanging,
        &TrialScenes::bare_end,    &TrialScenes::body_end,  &TrialScenes::tow,        &TrialScenes::mooring,           &TrialScenes::slack_mooring,
        &TrialScenes::laid,        &TrialScenes::laid_pipe, &TrialScenes::bathymetry, &TrialScenes::lazy_wave,         &TrialScenes::let_down};
    (this->*kind[number % trial_kinds])();
    return std::move(trial_);
  }

 private:
  void slack_span() {
    begin("slack span");
    trial_.known = Known::catenary;
    bar_or_cable();
    span(direction(1.5), slack_chord());
  }

  void taut_span() {
    begin("taut span");
    trial_.known = Known::catenary;
    bar_or_cable();
    span(direction(1.5), length_ * (1.0 + std::pow(10.0, uniform(-6.0, 0.0))));
  }

  void vertical() {
    begin("vertical line");
    bar_or_cable();
    const double chord = length_ * uniform(0.3, 1.2);
    if (chance(0.5)) bends(1e-9, 1e-3);
    trial_.degenerate = chord < length_ && type().EI == 0.0;
    if (type().EI == 0.0) trial_.known = Known::catenary;
    span(Vec3::UnitZ(), chord);
  }

  void ends_at_one_point() {
    begin("ends at one point");
    if (chance(0.5)) bends(1e-9, 1e-3);
    trial_.degenerate = type().EI == 0.0;
    if (type().EI == 0.0) trial_.known = Known::catenary;
    span(Vec3::UnitX(), 0.0);
  }

  void buoyant() {
    begin("net-buoyant span");
    type().wet_weight = -weight_;
    if (chance(0.3)) sections(-2.0);
    if (chance(0.3)) loads(2);
    may_bend();
    span(direction(1.4), chance(0.7) ? slack_chord() : length_ * uniform(1.0, 1.2));
  }

  /// Slack four times in five.
  void any_span() { span(direction(1.4), chance(0.8) ? slack_chord() : length_ * uniform(1.0, 1.2)); }

  void loaded(const char* kind, int most) {
    begin(kind);
    if (chance(0.7)) sections(-1.0);
    loads(most);
    may_bend();
    any_span();
  }

  void loaded_span() { loaded("sections, clumps and floats", 5); }

  void pipe() {
    begin("clamped pipe");
    bends(1e-6, 10.0);
    if (chance(0.3)) loads(2);
    const Vec3 along = direction(1.4);
    span(along, length_ * uniform(0.8, 1.0));
    const Vec3 chord = trial_.scene.points[1].position - trial_.scene.points[0].position;
    if (chance(0.8)) clamp(line().from_end, chord.normalized() + 0.5 * direction(1.5));
    if (chance(0.8)) clamp(line().to_end, chord.normalized() + 0.5 * direction(1.5));
  }

  void current() {
    begin("span in a current");
    may_bend();
    any_span();
    flow(0.0, -3000.0, true);
  }

  void loaded_current() {
    loaded("loaded span in a current", 4);
    flow(0.0, -3000.0, true);
  }

  /// One end held at the surface, the other one free; its position is a guess and no good one.
  void free_end(double height = 0.0) {
    point("from", {0.0, 0.0, height});
    point("to", Vec3(0.0, 0.0, height) + length_ * direction(1.5), true);
    if (!chance(0.5)) return;
    std::swap(line().from, line().to);
    std::reverse(line().sections.begin(), line().sections.end());
  }
  PointSpec& free_point() { return trial_.scene.points[1]; }

  void hanging() {
    begin("hanging free");
    trial_.known = Known::hanging;
    if (chance(0.2)) type().wet_weight = -weight_;
    if (chance(0.5)) may_bend();
    free_end();
    if (chance(0.5)) free_point().body.wet_weight = *type().wet_weight * length_ * log_uniform(1e-3, 1.0);
  }

  void bare_end() {
    begin("bare end in a current");
    may_bend();
    free_end();
    flow(0.0, -length_, true);
  }

  void body_end() {
    begin("body at a free end, current");
    if (chance(0.3)) sections(-0.5);
    if (chance(0.3)) loads(3);
    may_bend();
    free_end();
    BodySpec& body = free_point().body;
    body.wet_weight = weight_ * length_ * log_uniform(1e-3, 3.0);
    body.mass = *body.wet_weight / 5.0;
    body.drag_area = log_uniform(0.01, 3.0);
    if (chance(0.2)) body.force.constant = 0.3 * *body.wet_weight * direction(1.0);
    flow(0.0, -length_, true);
  }

  void tow() {
    begin("tow");
    if (chance(0.3)) type().wet_weight = 0.0;
    if (chance(0.3)) sections(0.5);
    may_bend();
    free_end();
    for (LineType& t : trial_.scene.line_types) {
      t.drag_normal = uniform(0.8, 1.6);
      t.drag_tangential = uniform(0.005, 0.05);
    }
    trial_.scene.points[0].motion = MotionSpec{};
    trial_.scene.points[0].motion->velocity = uniform(0.2, 4.0) * plan();
    BodySpec& body = free_point().body;
    if (chance(0.7)) body.wet_weight = weight_ * length_ * log_uniform(1e-3, 1.0), body.drag_area = log_uniform(0.01, 3.0);
    const double most = 0.5 * 1025.0 * 1.6 * 2.0 * type().diameter * 16.0;
    stretches((weight_ + most) * length_);
  }

  /// From the bed at -depth_ up to an end; the chord leaves room for `slack` of the line beyond the taut one.
  void from_the_bed(double least, double most, bool rubs) {
    const double depth = length_ * uniform(0.05, 0.6);
    const double across = std::sqrt(length_ * length_ - depth * depth);
    bed(depth, rubs);
    ends({0.0, 0.0, -depth}, across * uniform(least, most) * plan());
  }

  void mooring() {
    begin("mooring on a level bed");
    if (chance(0.3)) sections(0.3);
    if (chance(0.3)) bends(1e-9, 1e-4);
    from_the_bed(0.75, 1.02, chance(0.5));
    if (chance(0.3)) flow(0.0, -length_, chance(0.5));
  }

  void slack_mooring() {
    begin("slack line to the bed");
    if (chance(0.5)) bends(1e-9, 1e-4);
    from_the_bed(0.0, 0.75, chance(0.3));
    trial_.degenerate = type().EI == 0.0;
  }

  void laid() {
    begin("line on the bed");
    if (chance(0.3)) bends(1e-9, 1e-4);
    bed(100.0, chance(0.6));
    const bool slack = chance(0.4);
    ends({0.0, 0.0, -100.0}, Vec3(0.0, 0.0, -100.0) + length_ * (slack ? uniform(0.7, 0.999) : 1.0 + std::pow(10.0, uniform(-5.0, -1.0))) * plan());
    trial_.degenerate = slack;
    if (chance(0.3) && type().EI > 0.0) flow(-90.0, -100.0, false);
  }

  void laid_pipe() {
    begin("pipe to the bed");
    bends(1e-5, 1e-2);
    const bool rubs = chance(0.5);
    from_the_bed(0.8, 0.99, rubs);
    if (chance(0.3)) flow(0.0, -length_, false);
  }

  void bathymetry() {
    begin("slopes and bumps");
    if (chance(0.6)) bends(1e-9, 1e-4);
    const double depth = length_ * uniform(0.15, 0.6);
    bed(depth, chance(0.5));
    const double across = std::sqrt(length_ * length_ - depth * depth) * uniform(0.7, 0.97);
    ends({0.0, 0.0, -depth}, across * plan());
    bumps(depth, length_);
    if (chance(0.2)) flow(0.0, -length_, false);
  }

  /// Hung off at the surface, buoyant in the middle, lying at the far end.
  void lazy_wave() {
    begin("lazy wave");
    sections(1.0);
    auto& types = trial_.scene.line_types;
    types.resize(3, types.back());
    types[2].name = "cable2";
    types[1].wet_weight = -weight_ * uniform(0.3, 1.5);
    types[2].wet_weight = weight_;
    share({uniform(0.3, 0.5), uniform(0.15, 0.3), uniform(0.3, 0.5)}, 3);
    may_bend();
    from_the_bed(0.6, 0.95, chance(0.3));
    if (chance(0.4)) flow(0.0, -length_, false);
  }

  void let_down() {
    begin("free end on the bed");
    if (chance(0.5)) bends(1e-9, 1e-4);
    bed(length_ * uniform(0.2, 0.9), false);
    free_end();
    free_point().position = {0.5 * length_, 0.0, 0.0};
    trial_.degenerate = true;
  }

  void bar_or_cable() { line().model = chance(0.2) ? ModelChoice::bar : ModelChoice::automatic; }
};

}  // namespace

Trial draw_trial(std::uint64_t seed, std::uint64_t number) { return TrialScenes(seed, number).draw(number); }

}  // namespace hawser::bench
