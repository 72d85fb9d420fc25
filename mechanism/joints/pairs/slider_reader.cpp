// Reader of `slider`, and of the beam that it slides on.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "mechanism/joints/pairs/read_pair.hpp"
#include "mechanism/joints/pairs/slider.hpp"
#include "mechanism/math/axes_along.hpp"
#include "mechanism/reading/names.hpp"

namespace bielle::mechanism {
namespace {

const Chain& chain_of_beam(const YamlValue& beam, const Model& model) {
  component_named_by(Section::elements, beam, model);  // checks that the name exists
  for (const Chain& chain : model.chains())
    if (chain.entry == Entry{Section::elements, beam.text()}) return chain;
  beam.fail("is no beam: a slider needs one to slide on");
}

/// Returns the line through the beam's nodes: tangents are those of the circle through three neighbours.
SliderLine line_through(const std::vector<int>& nodes, const Model& model) {
  const std::size_t n = nodes.size();
  const auto x = [&](std::size_t k) -> const Vector3& { return model.node(nodes[k]).frame.x; };
  SliderLine line{nodes, std::vector<Vector3>(n), std::vector<double>(n, 0)};
  std::vector<Vector3> chord(n - 1);
  for (std::size_t k = 0; k + 1 < n; ++k) chord[k] = x(k + 1) - x(k);
  for (std::size_t k = 0; k < n; ++k) {
    Vector3 tangent;
    if (n == 2) {
      tangent = chord[0];
    } else {
      // The tangent of the circle through three points: chords weighted by the inverse squares of their lengths; at an
      // end the tangent of the neighbour mirrored in the chord.
      const std::size_t middle = std::clamp<std::size_t>(k, 1, n - 2);
      const Vector3 before = chord[middle - 1], after = chord[middle];
      tangent = before / before.squaredNorm() + after / after.squaredNorm();
      tangent.normalize();
      if (k != middle) {
        const Vector3 c = (k < middle ? before : after).normalized();
        tangent = 2 * c * c.dot(tangent) - tangent;
      }
    }
    line.tangent[k] = model.node(nodes[k]).frame.R.transpose() * tangent.normalized();
    if (k == 0) continue;
    // Ratio of arc length to chord: from the angle between the tangents at its ends.
    const Vector3 first = model.node(nodes[k - 1]).frame.R * line.tangent[k - 1];
    const double half = 0.5 * std::acos(std::clamp(first.dot(tangent.normalized()), -1.0, 1.0));
    const double stretch = half > 1e-6 ? half / std::sin(half) : 1;
    line.place[k] = line.place[k - 1] + chord[k - 1].norm() * stretch;
  }
  return line;
}

/// The place on the line closest to a point, and the tangent there.
struct Foot {
  double u = 0;
  Vector3 tangent, point;
};

Foot foot_of(const Vector3& point, const SliderLine& line, const Model& model) {
  Foot best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < line.nodes.size(); ++k) {
    const Frame &first = model.node(line.nodes[k]).frame, &second = model.node(line.nodes[k + 1]).frame;
    const Vector3 way = second.x - first.x;
    const double xi = std::clamp((point - first.x).dot(way) / way.squaredNorm(), 0.0, 1.0);
    const Vector3 foot = first.x + xi * way;
    if (const double far = (point - foot).norm(); far < least) {
      least = far;
      const Vector3 tangent = (1 - xi) * (first.R * line.tangent[k]) + xi * (second.R * line.tangent[k + 1]);
      best = {line.place[k] + xi * (line.place[k + 1] - line.place[k]), tangent.normalized(), foot};
    }
  }
  return best;
}

}  // namespace

const KeyTable& slider_keys() {
  using namespace keys;
  static const KeyTable table{
      "a slider", "A joint that holds a node on a beam that deforms, along which it slides.",
      joined({{type_key(),
               {"node", name_of("node"), required, "Node that slides."},
               {"beam", name_of("element"), required, "Beam along which it slides."},
               {"at", vector3("m").as_point(), otherwise("[0, 0, 0]"), "Point that slides, in the axes of the node."},
               {"start", number().between(0, 1), computed("the place next to the point as drawn"),
                "Place at the start, as a share of the beam's length."},
               {"ends", word({"error", "stop"}, "what happens at the ends"), otherwise("error"),
                "Behaviour at the ends of the beam."},
               {"orientation", word({"free", "tangent"}, "an orientation of a slider"), otherwise("free"),
                "Freedom of turning; `tangent` leaves turning about the beam alone."}},
              joint_action_keys(Moves::slides, {"start"})})};
  return table;
}

void read_slider(const std::string& name, const YamlValue& entry, Model& model) {
  const int node = node_named_by(entry.at("node"), model);
  const Chain& chain = chain_of_beam(entry.at("beam"), model);
  if (std::find(chain.nodes.begin(), chain.nodes.end(), node) != chain.nodes.end())
    entry.at("node").fail("is a node of that beam: it cannot slide on itself");
  SliderLine line = line_through(chain.nodes, model);
  const bool error = entry.at("ends").word() == "error", tangent = entry.at("orientation").word() == "tangent";
  const Frame& sliding = model.node(node).frame;
  const Vector3 attachment = entry.at("at").vector3();
  const Foot foot = foot_of(sliding.x + sliding.R * attachment, line, model);
  double start = foot.u;
  if (const auto share = entry.find("start")) start = share->number() * line.place.back();
  Frame joint;
  joint.x = model.node(chain.nodes.front()).frame.x;
  const Matrix3& R = model.node(chain.nodes.front()).frame.R;
  const Matrix3 axes = R * axes_along(R.transpose() * foot.tangent);  // these axes rotate with a placed part
  joint.R << axes.col(2), axes.col(0), axes.col(1);                   // x along the line
  JointFrames frames;
  frames.first = chain.nodes.front();
  frames.second = node;
  frames.on_first = inverse(model.node(frames.first).frame) * joint;
  frames.on_second.x = attachment;
  frames.on_second.R = sliding.R.transpose() * joint.R;
  add_pair(std::make_unique<SliderJoint>(name, std::move(frames), std::move(line), start, tangent,
                                         error ? SliderJoint::Ends::error : SliderJoint::Ends::stop, model),
           entry, model, {"start"});
}

}  // namespace bielle::mechanism
