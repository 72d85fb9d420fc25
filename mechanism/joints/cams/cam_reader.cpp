// Reader of `cam`, and of the frames of cam and follower.
#include <fmt/format.h>

#include "mechanism/joints/cams/cam.hpp"
#include "mechanism/joints/cams/cam_contour.hpp"
#include "mechanism/joints/friction/friction_reader.hpp"
#include "mechanism/joints/pairs/point_on_curve.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/reading/names.hpp"
#include "mechanism/reading/read_file.hpp"
#include "reduce/common/files/table_file.hpp"

namespace bielle::mechanism {
namespace {

using Kind = JointCoordinate::Kind;

/// @throws InputError if cam and follower are the same
void check_two(const NamedCoordinate& angle, const NamedCoordinate& lifted, const YamlValue& joints) {
  if (angle.joint == lifted.joint)
    joints.at(1).fail("is coupled with itself: name the camshaft and the follower's joint");
  if (angle.joint->frames().second == lifted.joint->frames().second)
    joints.at(1).fail("moves the cam itself: both joints have the same second node");
}

/// @param on_follower  the follower's frame, in its node's axes
JointFrames frames_of(const Joint& camshaft, const Joint& follower, const Frame& on_follower) {
  JointFrames frames;
  frames.first = camshaft.frames().second;
  frames.second = follower.frames().second;
  frames.on_first = camshaft.frames().on_second;
  frames.on_second = on_follower;
  return frames;
}

void add_lift(const std::string& name, const YamlValue& entry, Model& model) {
  Interpolation lift = read_named_file(entry.at("lift"), [](const std::string& path) {
    return Interpolation::from_file(path, Interpolation::Kind::periodic);
  });
  const YamlValue joints = entry.at("joints");
  const NamedCoordinate angle = coordinate_named_by(joints.at(0), model, Kind::angle),
                        lifted = coordinate_named_by(joints.at(1), model);
  check_two(angle, lifted, joints);
  model.add(std::make_unique<LiftedCoordinate>(name, angle, lifted, std::move(lift)), Entry{Section::joints, name});
}

/// Returns the frame of a roller in the axes of the follower's node: z along the camshaft as drawn.
Frame roller_frame(const JointFrames& frames, const Model& model) {
  const Matrix3 cam = model.node(frames.first).frame.R * frames.on_first.R;
  return {frames.on_second.x, model.node(frames.second).frame.R.transpose() * cam};
}

/// Draws the cam by its contour.
void add_drawn_cam(const std::string& name, const CamContour& contour, const Joint& camshaft, Model& model) {
  std::vector<std::vector<double>> line;
  for (const Vector3& point : contour.points()) line.push_back({point.x(), point.y()});
  model.add_shape({Section::joints, name}, {.shape = "cam",
                                            .places = {{camshaft.frames().second, camshaft.frames().on_second}},
                                            .values = {{"contour", std::move(line)}}});
}

CamContour read_contour(const YamlValue& entry) {
  return read_named_file(entry.at("profile"),
                         [](const std::string& path) { return CamContour(read_table(path, 2), path); });
}

/// Adds cam and follower, and the friction between them.
void add_contact(std::unique_ptr<Joint> made, const YamlValue& entry, Model& model) {
  const Joint& joint = *made;
  model.add(std::move(made), Entry{Section::joints, joint.name()});
  if (const auto friction = entry.find("friction")) read_joint_friction(*friction, joint, model);
}

void add_roller(const std::string& name, const YamlValue& entry, Model& model) {
  const double radius = entry.at("radius").number();
  const YamlValue joints = entry.at("joints");
  const NamedCoordinate angle = coordinate_named_by(joints.at(0), model, Kind::angle),
                        moved = coordinate_named_by(joints.at(1), model);
  check_two(angle, moved, joints);
  const Joint &camshaft = *angle.joint, &follower = *moved.joint;
  Frame middle;
  middle.x = entry.at("at").vector3();
  JointFrames frames = frames_of(camshaft, follower, middle);
  const CamContour contour = read_contour(entry);
  Curve pitch = read_named_file(entry.at("profile"), [&](const std::string&) { return contour.pitch_curve(radius); });
  const Frame cam = model.node(frames.first).frame * frames.on_first;
  const Frame& node = model.node(frames.second).frame;
  Vector3 drawn = cam.R.transpose() * (node.x + node.R * middle.x - cam.x);
  drawn.z() = 0;
  const double start = pitch.nearest(drawn);
  add_drawn_cam(name, contour, camshaft, model);
  if (radius > 0)
    model.add_shape(
        {Section::joints, name},
        {.shape = "pulley", .places = {{frames.second, roller_frame(frames, model)}}, .values = {{"radius", radius}}});
  add_contact(std::make_unique<PointOnCurve>("cam", name, std::move(frames), std::move(pitch), start,
                                             PointOnCurve::Guide::plane, model, radius),
              entry, model);
}

void add_flat(const std::string& name, const YamlValue& entry, Model& model) {
  const YamlValue joints = entry.at("joints");
  const NamedCoordinate angle = coordinate_named_by(joints.at(0), model, Kind::angle),
                        moved = coordinate_named_by(joints.at(1), model);
  check_two(angle, moved, joints);
  const Joint &camshaft = *angle.joint, &follower = *moved.joint;
  const Frame& node = model.node(follower.frames().second).frame;
  const Vector3 normal = entry.at("normal").direction();
  Frame face;
  face.x = entry.at("at").vector3();
  const Frame cam = model.node(camshaft.frames().second).frame * camshaft.frames().on_second;
  const Vector3 axis = cam.R.col(2);
  if (std::abs(normal.dot(axis)) > 1e-6) entry.at("normal").fail("is not at right angles to the camshaft's axis");
  const Vector3 across = axis.cross(normal).normalized();
  face.R.col(0) = node.R.transpose() * across;
  face.R.col(1) = node.R.transpose() * normal.cross(across);
  face.R.col(2) = node.R.transpose() * normal;
  JointFrames frames = frames_of(camshaft, follower, face);
  const CamContour contour = read_contour(entry);
  Interpolation support = read_named_file(entry.at("profile"), [&](const std::string&) { return contour.support(); });
  add_drawn_cam(name, contour, camshaft, model);
  add_contact(std::make_unique<FlatFollower>(name, std::move(frames), std::move(support), model), entry, model);
}

}  // namespace

const KeyTable& cam_keys() {
  using namespace keys;
  static const KeyTable table{
      "a cam",
      "A disk cam and its follower, by the contour of the cam or by the lift.",
      {type_key(),
       {"joints", list_of(2, coordinate_forms()), required, "Angle of the camshaft and coordinate of the follower."},
       {"lift", file("table of two columns"), optional,
        "Angles of the camshaft and coordinates of the follower; the last row is a period after the first."},
       {"profile", file("table of two columns"), optional,
        "Angles [rad] and radii [m] of the contour, which a periodic cubic spline joins, in place of `lift`."},
       {"follower", word({"roller", "flat"}, "a follower"), optional, "Follower, which a `profile` needs."},
       {"radius", number("m").non_negative(), otherwise("0"), "Radius of a roller; 0 is a knife edge."},
       {"at", vector3("m").as_point(), otherwise("[0, 0, 0]"),
        "Middle of the roller, or point of the flat face, in the axes of the follower's node."},
       {"normal", direction().as_vector().in_inertial_axes(), optional,
        "Normal of a flat face, away from the cam, as drawn; it needs one."},
       {"friction", joint_friction_forms(), optional, "Friction of the contact, or of a roller on its pin."}}};
  return table;
}

void read_cam(const std::string& name, const YamlValue& entry, Model& model) {
  const YamlValue joints = entry.at("joints");
  if (!joints.is_sequence() || joints.size() != 2) joints.fail("expected two joints: [camshaft, follower]");
  if (entry.has("lift") == entry.has("profile"))
    entry.fail(
        "a cam takes either `profile`, its contour, or `lift`, the follower's coordinate over the camshaft's angle");
  const bool lift = entry.has("lift");
  bool flat = false;
  if (lift) {
    for (const char* key : {"follower", "radius", "at", "normal", "friction"})
      if (const auto too_much = entry.find(key)) too_much->fail("belongs to a cam with `profile`");
  } else {
    flat = entry.at("follower").word() == "flat";
    const char* other = flat ? "radius" : "normal";
    if (const auto too_much = entry.find(other))
      too_much->fail(flat ? "belongs to a roller" : "belongs to a flat follower");
  }
  model.when_read(Model::Stage::connections, [name, entry, lift, flat, &model] {
    if (lift)
      add_lift(name, entry, model);
    else if (flat)
      add_flat(name, entry, model);
    else
      add_roller(name, entry, model);
  });
}

}  // namespace bielle::mechanism
