#include "tests/support/model_text.hpp"

#include <map>

#include "mechanism/elements/beam.hpp"
#include "mechanism/elements/load.hpp"
#include "mechanism/elements/rigid_body.hpp"
#include "mechanism/elements/spring_damper.hpp"
#include "mechanism/elements/superelement_body.hpp"

namespace bielle::test {

using namespace mechanism;

namespace {

const std::map<std::string, ComponentReader> element_readers = {{"rigid_body", read_rigid_body},
                                                                {"point_mass", read_point_mass},
                                                                {"beam", read_beam},
                                                                {"superelement", read_superelement_body},
                                                                {"spring_damper", read_spring_damper}};

void read_node(const std::string& name, const YamlValue& entry, Model& model) {
  entry.check_keys({"position", "rotation_vector", "velocity", "angular_velocity"}, "a node");
  Node node;
  node.name = name;
  node.frame.x = entry.at("position").vector3();
  if (const auto psi = entry.find("rotation_vector")) node.frame.R = exp_so3(psi->vector3());
  if (const auto v = entry.find("velocity")) node.velocity = v->vector3();
  if (const auto omega = entry.find("angular_velocity")) node.angular_velocity = omega->vector3();
  model.add_node(std::move(node));
}

}  // namespace

std::unique_ptr<Model> model_from_text(const std::string& text) {
  const YamlValue file = YamlValue::parse(text, "model.yaml");
  file.check_keys({"gravity", "nodes", "elements", "loads"}, "the model");
  auto model = std::make_unique<Model>();
  if (const auto gravity = file.find("gravity")) model->environment.gravity = gravity->vector3();
  if (const auto nodes = file.find("nodes"))
    for (const auto& [name, entry] : nodes->entries()) read_node(name, entry, *model);
  if (const auto elements = file.find("elements"))
    for (const auto& [name, entry] : elements->entries())
      element_readers.at(entry.at("type").text())(name, entry, *model);
  if (const auto loads = file.find("loads"))
    for (const auto& [name, entry] : loads->entries()) read_load(name, entry, *model);
  return model;
}

}  // namespace bielle::test
