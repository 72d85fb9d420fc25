#include "mechanism/analyses/linear_response.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "mechanism/measures/input_measure.hpp"
#include "reduce/common/error.hpp"

namespace bielle::mechanism {
namespace {

template <class Kind>
void check_named(const Model& model, const std::string& name, const char* what) {
  std::vector<std::string> names;
  for (const Member& member : model.members())
    if (dynamic_cast<const Kind*>(member.component.get())) names.push_back(member.entry.name);
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw InputError(fmt::format("there is no {} '{}'{}", what, name, did_you_mean(name, names)));
}

}  // namespace

std::vector<VectorX> LinearResponse::right_sides(const std::vector<ResponseInput>& inputs,
                                                 const std::vector<ResponseOutput>& outputs) const {
  std::vector<VectorX> rights;
  for (const ResponseInput& input : inputs) {
    rights.push_back(right_side(input));
    if (!rights.back().isZero(0) || input.delay) continue;
    if (input.node >= 0)
      throw InputError(fmt::format("the input '{}' acts on nothing: the node is held in that direction", input.name));
    if (std::all_of(outputs.begin(), outputs.end(),
                    [&](const ResponseOutput& output) { return direct(output, input) == 0; }))
      throw InputError(fmt::format(
          "the input '{}' acts on nothing: in this state no force, motion or output depends on it", input.name));
  }
  return rights;
}

LinearMotion LinearResponse::answer(const ShiftedOperator& D, const VectorX& right) const {
  return motion(D.shift(), D.solve(-right.cast<Complex>()));
}

LinearMotion LinearResponse::motion(Complex s, const Eigen::VectorXcd& solution) const {
  const LinearisedEquations& e = equations();
  LinearMotion motion{solution.head(e.unknowns()), {}, solution.tail(e.constraints())};
  motion.rate = s * motion.u + e.W * motion.u;
  return motion;
}

Eigen::MatrixXcd LinearResponse::at(const ShiftedOperator& D, const std::vector<ResponseInput>& inputs,
                                    const std::vector<ResponseOutput>& outputs,
                                    const std::vector<VectorX>& rights) const {
  Eigen::MatrixXcd H(outputs.size(), inputs.size());
  for (std::size_t j = 0; j < inputs.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    H.col(column) = values(outputs, answer(D, rights[j]));
    for (std::size_t i = 0; i < outputs.size(); ++i)
      H(static_cast<Eigen::Index>(i), column) += direct(outputs[i], inputs[j]);
  }
  return H;
}

void check_response_names(const Model& model, const std::vector<ResponseInput>& inputs,
                          const std::vector<ResponseOutput>& outputs) {
  for (const ResponseInput& input : inputs)
    if (input.node < 0 && !input.delay) check_named<InputMeasure>(model, input.name, "input");
  for (const ResponseOutput& output : outputs)
    if (output.node < 0 && !output.measure) check_named<Measure>(model, output.name, "measure");
}

}  // namespace bielle::mechanism
