#include "mechanism/analyses/modal_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bielle::mechanism {
namespace {

using Complex = ModalResponse::Complex;
using MatrixXc = ModalResponse::MatrixXc;

constexpr int reference_points = 4;

}  // namespace

ModalResponse::ModalResponse(const LinearResponse& response, const std::vector<ModalPole>& poles,
                             const FrequencyResponseOptions& options, double most, Direct direct)
    : outputs_(static_cast<Eigen::Index>(options.outputs.size())),
      inputs_(static_cast<Eigen::Index>(options.inputs.size())),
      most_(most),
      direct_(std::move(direct)) {
  const std::vector<VectorX> rights = response.right_sides(options.inputs, options.outputs);
  for (const ModalPole& pole : poles) {
    const Eigen::VectorXcd outputs = response.values(options.outputs, response.motion(pole.s, pole.right));
    MatrixXc residue(outputs.size(), static_cast<Eigen::Index>(rights.size()));
    VectorX shares(residue.cols());
    for (std::size_t k = 0; k < rights.size(); ++k) {
      const Complex share = (pole.left.transpose() * rights[k].cast<Complex>())(0);
      residue.col(static_cast<Eigen::Index>(k)) = outputs * -share;
      shares[static_cast<Eigen::Index>(k)] = std::abs(share);
    }
    outputs_of_.push_back(outputs.cwiseAbs());
    inputs_of_.push_back(shares);
    poles_.push_back(pole.s);
    residues_.push_back(residue);
    if (pole.s.imag() == 0) continue;
    poles_.push_back(std::conj(pole.s));
    residues_.push_back(residue.conjugate());
  }
  add_nodes(most);
}

void ModalResponse::add_nodes(double most) {
  for (int k = 0; k < reference_points; ++k) {
    double rate = most * std::cos((2 * k + 1) * std::numbers::pi / (4 * reference_points));
    // Close to a mode, the remainder is a small difference of two large numbers and therefore inaccurate.
    constexpr double too_near = 1e-2, aside = 1.03;
    for (int tries = 0; tries < 20; ++tries) {
      const bool near = std::any_of(poles_.begin(), poles_.end(),
                                    [&](Complex pole) { return std::abs(pole - Complex(0, rate)) < too_near * rate; });
      if (!near) break;
      rate /= aside;
    }
    const Complex s(0, rate);
    const MatrixXc rest = direct_(s) - of_modes(s);
    nodes_.insert(nodes_.end(), {s, std::conj(s)});
    rest_.push_back(rest);
    rest_.push_back(rest.conjugate());
  }
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    Complex product = 1;
    for (std::size_t j = 0; j < nodes_.size(); ++j)
      if (j != k) product *= (nodes_[k] - nodes_[j]) / most;
    weights_.push_back(1.0 / product);
  }
}

MatrixXc ModalResponse::of_modes(Complex s) const {
  MatrixXc H = MatrixXc::Zero(outputs_, inputs_);
  for (std::size_t j = 0; j < poles_.size(); ++j) H += residues_[j] / (s - poles_[j]);
  return H;
}

/// Returns the size below which a response counts as zero: a millionth of the response that would result if the mode
/// with the largest effect on the output were the mode with the largest excitation by the input. Symmetric models have
/// such responses, whose digits are rounding errors.
MatrixX ModalResponse::rounding(Complex s) const {
  constexpr double digits = 1e-6;
  VectorX outputs = VectorX::Zero(outputs_), inputs = VectorX::Zero(inputs_);
  for (std::size_t j = 0, pole = 0; j < outputs_of_.size(); ++j) {
    const double distance = std::sqrt(std::abs(s - poles_[pole]));
    outputs = outputs.cwiseMax(outputs_of_[j] / distance);
    inputs = inputs.cwiseMax(inputs_of_[j] / distance);
    pole += poles_[pole].imag() == 0 ? 1 : 2;
  }
  return digits * outputs * inputs.transpose();
}

MatrixXc ModalResponse::at(Complex s) const {
  MatrixXc sum = MatrixXc::Zero(rest_[0].rows(), rest_[0].cols());
  Complex weights = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (s == nodes_[k]) return of_modes(s) + rest_[k];
    const Complex weight = weights_[k] / (s - nodes_[k]);
    sum += weight * rest_[k];
    weights += weight;
  }
  return of_modes(s) + sum / weights;
}

ModalAccuracy ModalResponse::accuracy(double least) const {
  std::vector<double> rates = {most_, std::max(least, 1e-3 * most_)};
  for (int k = 1; k < reference_points; ++k)
    rates.push_back(most_ * std::cos(2 * k * std::numbers::pi / (4 * reference_points)));
  ModalAccuracy accuracy;
  for (const double rate : rates) {
    const Complex s(0, rate);
    const MatrixXc exact = direct_(s), ours = at(s);
    const MatrixX nothing = rounding(s);
    for (Eigen::Index i = 0; i < exact.rows(); ++i)
      for (Eigen::Index j = 0; j < exact.cols(); ++j) {
        const double size = std::abs(exact(i, j)), deviation = std::abs(ours(i, j) - exact(i, j));
        if (size <= nothing(i, j) || deviation <= accuracy.deviation * size) continue;
        accuracy.deviation = deviation / size;
        accuracy.frequency = rate / (2 * std::numbers::pi);
      }
  }
  accuracy.direct = static_cast<int>(rates.size()) + reference_points;
  return accuracy;
}

}  // namespace bielle::mechanism
