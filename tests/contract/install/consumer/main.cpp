// Writes a superelement, reads it, and calls the mechanism's library for a rotation.
#include <cstdio>

#include "mechanism/math/so3.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/results/results_file.hpp"
#include "reduce/superelement/superelement.hpp"

int main() {
  bielle::Superelement body;
  body.name = "rigid";
  body.interfaces.resize(1);
  body.interfaces[0].name = "hub";
  body.stiffness = body.damping = Eigen::MatrixXd::Zero(6, 6);
  body.mass = Eigen::MatrixXd::Identity(6, 6);
  for (Eigen::MatrixXd& component : body.inertia_components) component = Eigen::MatrixXd::Zero(6, 6);
  body.effective_mass.resize(0, 6);
  body.total_mass = 1;
  bielle::write_superelement(body, "body.h5");
  bielle::mechanism::Model model;
  bielle::mechanism::ResultsFile("results.h5", model, "").complete();
  std::printf("%s %.3f\n", bielle::read_superelement("body.h5").name.c_str(),
              bielle::mechanism::exp_so3({0, 0, 0.1})(1, 0));
}
