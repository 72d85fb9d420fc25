#include "mechanism/elements/beam/beam.hpp"

#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "mechanism/elements/beam/airfoil_load.hpp"
#include "mechanism/elements/beam/beam_element.hpp"
#include "mechanism/elements/beam/beam_geometry.hpp"
#include "mechanism/elements/beam/distributed_load.hpp"
#include "mechanism/elements/beam/section_keys.hpp"
#include "mechanism/math/so3.hpp"
#include "mechanism/reading/names.hpp"
#include "mechanism/reading/start_motion.hpp"

namespace bielle::mechanism {
namespace {

/// Gives inner nodes start velocities that are interpolated between the rigid motions of both ends.
void follow_ends(const std::vector<int>& nodes, Model& model) {
  if (nodes.size() == 2) return;
  when_motion_is_known(model, [nodes, &model] {
    const StartMotion a = start_motion(model, nodes.front()), b = start_motion(model, nodes.back());
    for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
      if (model.node(nodes[k]).carrier) continue;
      const double s = static_cast<double>(k) / static_cast<double>(nodes.size() - 1);
      const Vector3 x = model.node(nodes[k]).frame.x;
      set_start_motion(model, nodes[k], {x, (1 - s) * a.at(x) + s * b.at(x), (1 - s) * a.omega + s * b.omega});
    }
  });
}

/// Returns the nodes of the beam from start to end; the inner ones are created here.
std::vector<int> make_nodes(const std::string& name, const YamlValue& entry, const std::vector<int>& ends,
                            const std::vector<Frame>& sections, Model& model) {
  std::vector<int> nodes{ends[0]};
  const std::size_t count = sections.size() - 1;
  for (std::size_t k = 1; k < count; ++k) {
    Node inner;
    inner.name = fmt::format("{}.{}", name, k);
    if (model.find_node(inner.name)) entry.fail(fmt::format("there is already a node '{}'", inner.name));
    inner.frame = sections[k];
    inner.internal = true;
    nodes.push_back(model.add_node(std::move(inner)));
  }
  nodes.push_back(ends[1]);
  follow_ends(nodes, model);
  return nodes;
}

}  // namespace

const KeyTable& beam_keys() {
  using namespace keys;
  static const KeyTable table{
      "a beam",
      "A straight or curved beam between two nodes, cut into elements of equal length.",
      {type_key(),
       {"nodes", list_of(2, name_of("node")), required, "The nodes at the start and at the end."},
       {"section", section_forms(), required, "Cross section, or `[start, end]` of a linear taper."},
       {"elements", integer().between(1, 100000), otherwise("8"), "Number of elements."},
       {"orientation", direction().as_axial().in_inertial_axes(), computed("the inertial axis most normal to the beam"),
        "Vector whose part normal to the beam is the section's y axis at the start."},
       {"twist", number("rad").as_pseudoscalar(), otherwise("0"),
        "Rotation of the section about the line, from start to end."},
       {"damping", number("s").non_negative(), otherwise("0"),
        "Kelvin-Voigt time, which multiplies the stiffness to give the damping."},
       {"bending", word({"residual", "constant"}, "a kind of `bending`"), otherwise("residual"),
        "Flexibility in bending: `residual` is exact for linear bending, `constant` has constant strains."},
       {"arc_centre", vector3("m").as_point().in_inertial_axes(), optional,
        "Centre of a circular arc from start to end."},
       {"arc_through", vector3("m").as_point().in_inertial_axes(), optional,
        "Point of a circular arc from start to end, in place of `arc_centre`."},
       {"distributed",
        {nested(line_load_keys), list_of(nested(line_load_keys)).items_at_least(1)},
        optional,
        "Load per length, or a list of such loads."},
       {"airfoil", nested(airfoil_keys), optional, "Aerodynamic forces along the beam."}}};
  return table;
}

void read_beam(const std::string& name, const YamlValue& entry, Model& model) {
  const std::vector<int> ends = nodes_named_by(entry.at("nodes"), 2, model);
  if (ends[0] == ends[1]) entry.at("nodes").fail("a beam joins two different nodes");
  const int count = entry.at("elements").integer();
  const BeamBending law = entry.at("bending").word() == "constant" ? BeamBending::constant : BeamBending::residual;
  const double damping_time = entry.at("damping").number(), total_twist = entry.at("twist").number();
  const SectionLaw section(entry.at("section"));
  std::optional<Airfoil> airfoil;
  if (const auto given = entry.find("airfoil")) airfoil = read_airfoil(*given);
  const BeamLine line = read_beam_line(entry, model.node(ends[0]).frame.x, model.node(ends[1]).frame.x);
  const Matrix6 stiffness = section.at(0.5).stiffness;
  if (const double thickness = 2 * std::sqrt(std::max(stiffness(4, 4), stiffness(5, 5)) / stiffness(0, 0));
      thickness > line.length())
    entry.at("section").warn(
        fmt::format("is it meant? It is as stiff as one of some {:.2g} m in size, and the beam is {:.2g} m long; "
                    "lengths are in metres",
                    thickness, line.length()));
  const Matrix3 R_start = read_start_axes(entry, line.start_tangent());
  std::vector<Frame> sections;
  for (int k = 0; k <= count; ++k) sections.push_back(line.frame(static_cast<double>(k) / count, R_start, total_twist));
  const double turn = std::hypot(line.angle(), total_twist) / count;
  if (turn > BeamElement::largest_turn)
    entry.fail(
        fmt::format("with its arc and twist {} would turn by {:.0f} degrees, and none follows more than {:.0f}: give "
                    "more `elements`",
                    count == 1 ? "its one element" : fmt::format("each of {} elements", count), degrees(turn),
                    degrees(BeamElement::largest_turn)));

  const std::vector<int> nodes = make_nodes(name, entry, ends, sections, model);
  const Entry own{Section::elements, name};
  std::vector<BeamElement*> elements;
  std::vector<BeamSpan> spans;
  for (int k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Vector6 d0 = log_se3(inverse(sections[i]) * sections[i + 1]);
    const Matrix3 R_A = model.node(nodes[i]).frame.R.transpose() * sections[i].R;
    const Matrix3 R_B = model.node(nodes[i + 1]).frame.R.transpose() * sections[i + 1].R;
    const double s_A = static_cast<double>(k) / count, s_B = static_cast<double>(k + 1) / count;
    BeamReference reference = d0;
    if (line.angle() != 0 && total_twist != 0)  // otherwise it is a helix
      reference = {d0, line.length() / count, line.rate(s_A, R_start, total_twist) / count,
                   line.rate(s_B, R_start, total_twist) / count, [&, back = inverse(sections[i + 1])](double z) {
                     return back * line.frame((1 - z) * s_A + z * s_B, R_start, total_twist);
                   }};
    auto element = std::make_unique<BeamElement>(name, BeamPlace{k + 1, count}, nodes[i], nodes[i + 1], R_A, R_B,
                                                 reference, section.over(s_A, s_B), damping_time, law);
    elements.push_back(element.get());
    model.add(std::move(element), own, Recorded::stacked);
    const BeamSpan span{nodes[i], nodes[i + 1], R_A, R_B, {line.length() / count, 0, 0}, s_A, s_B};
    spans.push_back(span);
    if (airfoil) model.add(std::make_unique<AirfoilLoad>(name, span, *airfoil), own, Recorded::no);
  }
  if (count > 1) elements.front()->set_beam({elements.begin(), elements.end()});
  if (const auto distributed = entry.find("distributed")) add_line_loads(name, *distributed, spans, own, model);
  model.add_chain(own, nodes);
  std::vector<std::vector<double>> turns;  // rotation from the axes of each end node to those of its section
  for (const auto& [node, at] :
       {std::pair{nodes.front(), sections.front()}, std::pair{nodes.back(), sections.back()}}) {
    const Eigen::Vector4d turn_there = quaternion_of(model.node(node).frame.R.transpose() * at.R);
    turns.emplace_back(turn_there.begin(), turn_there.end());
  }
  model.add_shape(own, {.shape = "beam",
                        .values = {{"element", results_path(own)}, {"turn", std::move(turns)}},
                        .sections = section.drawn()});
}

}  // namespace bielle::mechanism
