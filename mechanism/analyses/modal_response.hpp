// Harmonic answers as a sum over modes.
//
//     H(s) = sum_j c(v_j) (y_j^T r) / (s_j - s) + R(s),      s = 2 pi i f,
// over modes and their conjugates (modal_poles.hpp), with c(v) the outputs of a motion. R is what slower answers of the
// modes that are left out, constraints and direct parts add: their static correction and its change with the frequency.
// It is the polynomial through R at a few frequencies, at which H is found directly; these are Chebyshev points, so
// that its error is about (x + sqrt(x^2 - 1))^-8 of R, x the ratio of the slowest mode that is left out to the highest
// frequency. Between them, answers that are found directly say how large the error is.
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
  /// H at s, by the equations themselves.
  using Direct = std::function<MatrixXc(Complex s)>;

  /// @param most  the highest frequency, |s| > 0 [1/s]
  ModalResponse(const LinearResponse& response, const std::vector<ModalPole>& poles,
                const FrequencyResponseOptions& options, double most, Direct direct);

  MatrixXc at(Complex s) const;
  /// The largest deviation from direct answers at frequencies between those that it was made from, relative to these
  /// where they are more than rounding. @param least  the lowest frequency [1/s]
  ModalAccuracy accuracy(double least) const;

 private:
  MatrixXc of_modes(Complex s) const;
  MatrixX rounding(Complex s) const;
  void add_nodes(double most);

  Eigen::Index outputs_, inputs_;
  std::vector<Complex> poles_;                   ///< conjugates included
  std::vector<VectorX> outputs_of_, inputs_of_;  ///< sizes of what modes do to outputs, and inputs to modes
  std::vector<MatrixXc> residues_;               ///< (outputs, inputs)
  std::vector<Complex> nodes_;                   ///< of the polynomial, conjugates included
  std::vector<Complex> weights_;                 ///< barycentric
  std::vector<MatrixXc> rest_;                   ///< R there
  double most_;
  Direct direct_;
};

}  // namespace bielle::mechanism
