// The three forms of constraints, each with the scheme and the method by which its order is tested.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "mechanism/solvers/dynamics/time_integration.hpp"

namespace bielle::test {

struct FormCase {
  const char* name;
  mechanism::Scheme scheme;
  mechanism::ConstraintForm form;
};
/// With Newmark's rule velocities are corrected in every step.
inline const FormCase form_cases[] = {
    {"position", mechanism::Scheme::generalized_alpha(0.8), mechanism::ConstraintForm::position},
    {"corrected", mechanism::Scheme::newmark(), mechanism::ConstraintForm::corrected},
    {"stabilised", mechanism::Scheme::generalized_alpha(0.8), mechanism::ConstraintForm::stabilised}};

/// Checks order 2 over four halvings of h. @param errors  (form, h) -> the largest error of each kind over all steps
template <class Errors>
void check_forms_of_order_two(const std::vector<std::string>& kinds, double h, const Errors& errors,
                              double margin = 0.1) {
  for (const FormCase& form : form_cases) {
    double size = h;
    std::vector<double> coarse = errors(form, size);
    for (int halving = 0; halving < 4; ++halving) {
      size /= 2;
      const std::vector<double> fine = errors(form, size);
      for (std::size_t k = 0; k < kinds.size(); ++k) {
        INFO(form.name << ", " << kinds[k] << ", h = " << size << ": " << coarse[k] << " -> " << fine[k]);
        CHECK(std::log2(coarse[k] / fine[k]) == Approx(2).margin(margin));
      }
      coarse = fine;
    }
  }
}

}  // namespace bielle::test
