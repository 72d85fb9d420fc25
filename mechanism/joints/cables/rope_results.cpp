// Results of a rope section: recorded quantities, description and measures.
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mechanism/joints/cables/rope_section.hpp"
#include "mechanism/model/description.hpp"
#include "mechanism/model/measure.hpp"

namespace bielle::mechanism {

std::vector<OutputField> RopeSection::output_fields() const {
  return {{"tension", {}, "N", "of the rope"},
          {"elongation", {}, "m", "by which the section is longer than its rope without load"},
          {"length", {}, "m", "of the section, arcs on pulleys between its ends included"}};
}

void RopeSection::write_output(const LocalState& state, double* values) const {
  thread_local Stretch s;
  calc_stretch(state, s);
  values[0] = s.tension;
  values[1] = s.E;
  values[2] = s.L;
}

void RopeSection::describe(const LocalState& state, Description& description) const {
  thread_local Stretch s;
  calc_stretch(state, s);
  description.add(fmt::format("from '{}' to '{}': length {:.6g} m, stiffness {:.6g} N/m, tension {:.6g} N",
                              path_.names.front(), path_.names.back(), s.L, material_.EA / (s.L - s.E), s.tension));
  std::vector<std::string> slides, clear;
  for (std::size_t k = 1; k + 1 < path_.names.size(); ++k)
    (RopeCourses::touches(s.places[k]) ? slides : clear).push_back(path_.names[k]);
  if (!slides.empty()) description.add(fmt::format("slides on {}", fmt::join(slides, ", ")));
  if (!clear.empty()) description.add(fmt::format("clear of {}", fmt::join(clear, ", ")));
}

std::string RopeSection::remark() const {
  std::vector<Frame> at;
  for (std::size_t k = 0; k < path_.pulleys.size(); ++k) at.push_back(path_.drawn[k] * path_.pulleys[k].on_node);
  std::vector<std::string> clear;
  for (const int place : watched_) {
    const auto k = static_cast<std::size_t>(place);
    if (RopeCourses::touches(drawn_places_[k])) continue;
    clear.push_back(
        fmt::format("drawn {:.3g} m clear of pulley '{}', past which it runs straight until it bends round it (a "
                    "radius of {:.6g} m "
                    "would turn round it as drawn)",
                    courses_.clearance(at, drawn_places_, place), path_.names[k], -path_.pulleys[k].radius));
  }
  return fmt::format("{}", fmt::join(clear, "; "));
}

namespace {

class TensionMeasure final : public Measure {
 public:
  TensionMeasure(std::string name, const RopeSection& rope) : Measure(std::move(name)), rope_(rope) {}
  std::string units() const override { return "N"; }
  double value(const LocalState& state) const override {
    thread_local RopeSection::Stretch s;
    rope_.calc_stretch(state.of(0), s);
    return s.tension;
  }
  double calc(const LocalState& state, MeasureGradient& gradient) const override {
    gradient.prepare(state.slots().size());
    thread_local RopeSection::Stretch s;
    const LocalState of_rope = state.of(0);
    rope_.calc_stretch(of_rope, s, 2);
    if (!s.taut) return s.tension;
    thread_local MeasureGradient pull;
    rope_.calc_pull_gradient(of_rope, s, pull);
    const int row = state.slots().reference_row(0), size = of_rope.slots().size();
    gradient.position().segment(row, size) = pull.position();
    gradient.rate().segment(row, size) = pull.rate();
    return s.tension;
  }

 private:
  void declare_subjects(Declaration& declaration) const override { declaration.references = {&rope_}; }
  const RopeSection& rope_;
};

}  // namespace

std::vector<std::string> RopeSection::measure_names() const { return {"tension"}; }

std::unique_ptr<Measure> RopeSection::make_measure(const std::string& name, const std::string& /*measure*/) const {
  return std::make_unique<TensionMeasure>(name, *this);
}

}  // namespace bielle::mechanism
