// Frequency responses as a sum over modes:
//
//     H(s) = sum_j c(v_j) (y_j^T r) / (s_j - s) + R(s),      s = 2 pi i f,
// The sum is over modes and their conjugates (modal_poles.hpp); c(v) are the outputs of a motion. R contains the
// contributions of omitted modes, constraints and direct terms: their static correction and its change with the
// frequency. R is interpolated by a polynomial through its values at a few frequencies, at which H is computed
// directly; these are Chebyshev points, so that the relative error of R is about (x + sqrt(x^2 - 1))^-8, where x is the
// ratio of the slowest omitted mode to the highest frequency. Direct solutions between these frequencies give the
// actual error.
#pragma once

#include <functional>
#include <vector>

#include "mechanism/analyses/linear_response.hpp"
#include "mechanism/solvers/linearised/modal_poles.hpp"

namespace bielle::mechanism {

class ModalResponse {
 public:
  using Complex = std::complex<double>;
  using MatrixXc = Eigen::MatrixXcd;
  /// H at s, from the equations themselves.
  using Direct = std::function<MatrixXc(Complex s)>;

  /// @param most  highest frequency, |s| > 0 [1/s]
  ModalResponse(const LinearResponse& response, const std::vector<ModalPole>& poles,
                const FrequencyResponseOptions& options, double most, Direct direct);

  MatrixXc at(Complex s) const;
  /// Computes the largest deviation from direct solutions at frequencies between the interpolation points, relative to
  /// these solutions if they exceed rounding errors. @param least  lowest frequency [1/s]
  ModalAccuracy accuracy(double least) const;

 private:
  MatrixXc of_modes(Complex s) const;
  MatrixX rounding(Complex s) const;
  void add_nodes(double most);

  Eigen::Index outputs_, inputs_;
  std::vector<Complex> poles_;                   ///< poles, conjugates included
  std::vector<VectorX> outputs_of_, inputs_of_;  ///< absolute effect of modes on outputs, and of inputs on modes
  std::vector<MatrixXc> residues_;               ///< residues (outputs, inputs)
  std::vector<Complex> nodes_;                   ///< interpolation points, conjugates included
  std::vector<Complex> weights_;                 ///< barycentric weights
  std::vector<MatrixXc> rest_;                   ///< R at these points
  double most_;
  Direct direct_;
};

}  // namespace bielle::mechanism
