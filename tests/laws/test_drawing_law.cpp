// Every component type that can be seen must draw itself: at places on nodes of the model, with true axes.
#include <algorithm>
#include <array>

#include <catch2/catch.hpp>

#include "mechanism/results/model_drawing.hpp"
#include "tests/laws/subject.hpp"

using namespace bielle::laws;
using namespace bielle::mechanism;

namespace {

/// Returns whether a type has no geometry of its own: such types act in joints or hydraulic circuits, or are equations.
bool is_unseen(const Sample& sample) {
  constexpr std::array unseen = {"gear", "differential"};
  return sample.section == Section::drives || sample.section == Section::states ||
         sample.section == Section::hydraulics || std::count(unseen.begin(), unseen.end(), sample.type) > 0 ||
         (sample.type == "cam" && sample.model.find("lift:") != std::string::npos);
}

void check_place(const DrawnPlace& place, const Model& model) {
  CHECK(place.node >= 0);
  CHECK(place.node < static_cast<int>(model.nodes().size()));
  CHECK(place.frame.x.allFinite());
  CHECK((place.frame.R.transpose() * place.frame.R).isIdentity(1e-12));
  CHECK(place.frame.R.determinant() > 0);
}

}  // namespace

TEST_CASE("every component that can be seen draws itself") {
  for (const Sample& sample : samples()) {
    CAPTURE(title(sample));
    const auto file = read_sample(sample, sample.model);
    const Drawing drawing = draw_model(file->model);
    bool drawn = false;
    for (const DrawnItem& item : drawing.items()) {
      for (const DrawnPlace& place : item.places) check_place(place, file->model);
      if (item.entry != results_path({sample.section, "it"})) continue;
      drawn = true;
      CHECK(item.type == (sample.section == Section::loads ? "load" : sample.type));
    }
    CHECK(drawn == !is_unseen(sample));
  }
}
