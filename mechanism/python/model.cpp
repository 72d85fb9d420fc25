// Models are read and described here, but never changed.
#include <algorithm>

#include <pybind11/stl.h>

#include "mechanism/io/describe_model.hpp"
#include "mechanism/measures/input_measure.hpp"
#include "mechanism/python/bind.hpp"
#include "mechanism/python/held_model.hpp"
#include "mechanism/python/single_blas_thread.hpp"
#include "mechanism/python/texts.hpp"
#include "mechanism/python/without_lock.hpp"
#include "reduce/common/error.hpp"

namespace bielle::python {
namespace {

using namespace mechanism;
using Overrides = std::map<std::string, std::string>;

template <class Read>
std::shared_ptr<MechanismFile> read_model(const Read& read) {
  const SingleBlasThread one;
  try {
    return std::make_shared<MechanismFile>(read());
  } catch (const InputError& error) {
    throw InputError(of_parameters(error.what()));
  }
}

std::vector<std::string> node_names(const Model& model) {
  std::vector<std::string> names;
  for (const Node& node : model.nodes()) names.push_back(node.name);
  return names;
}

std::vector<std::string> input_names(const Model& model) {
  std::vector<std::string> names;
  for (const Member& member : model.members())
    if (dynamic_cast<const InputMeasure*>(member.component.get())) names.push_back(member.entry.name);
  return names;
}

std::map<std::string, std::vector<std::string>> entry_names(const Model& model) {
  std::map<std::string, std::vector<std::string>> names;
  for (const Section section : {Section::elements, Section::joints, Section::drives, Section::loads, Section::states,
                                Section::measures, Section::hydraulics})
    names[section_name(section)] = model.names_in(section);
  // (Formulas create measures as well: "main.angle".)
  std::erase_if(names[section_name(Section::measures)], [&](const std::string& name) {
    const std::vector<std::size_t>& members = model.members_of({Section::measures, name});
    return std::all_of(members.begin(), members.end(),
                       [&](std::size_t m) { return model.members()[m].recorded == Recorded::no; });
  });
  return names;
}

std::vector<std::string> analysis_types(const MechanismFile& file) {
  std::vector<std::string> types;
  for (const auto& analysis : file.analyses) types.push_back(analysis->type());
  return types;
}

std::vector<std::string> warnings_of(const MechanismFile& file) {
  std::vector<std::string> warnings;
  for (const std::string& warning : file.warnings) warnings.push_back(without_unseen_lines(warning));
  return warnings;
}

std::string describe(const MechanismFile& file) {
  const SingleBlasThread one;
  const WithoutLock free;
  return without_unseen_lines(describe_model(file));
}

}  // namespace

void bind_model(pybind11::module_& module) {
  // (The holder is not const, as pybind11 requires; nothing here changes a model.)
  pybind11::class_<MechanismFile, std::shared_ptr<MechanismFile>>(module, "Model")
      .def_static("read_file",
                  [](const std::string& path, const Overrides& parameters) {
                    return read_model([&] { return read_mechanism_file(path, parameters); });
                  })
      .def_static(
          "read_text",
          [](const std::string& text, const std::string& name, bool seen, const Overrides& parameters) {
            return read_model([&] { return read_mechanism_text(text, seen ? name : name + unseen, parameters); });
          })
      .def_property_readonly("title", [](const MechanismFile& file) { return file.model.title; })
      .def_readonly("text", &MechanismFile::text)
      .def_readonly("path", &MechanismFile::path)
      .def_property_readonly("parameters", [](const MechanismFile& file) { return file.model.parameters; })
      .def_property_readonly("warnings", warnings_of)
      .def_property_readonly("nodes", [](const MechanismFile& file) { return node_names(file.model); })
      .def_property_readonly("inputs", [](const MechanismFile& file) { return input_names(file.model); })
      .def_property_readonly("entries", [](const MechanismFile& file) { return entry_names(file.model); })
      .def_property_readonly("analyses", analysis_types)
      .def("describe", describe);
}

}  // namespace bielle::python
