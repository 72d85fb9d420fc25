// The laws of sampled blocks: outputs y of inputs u at an instant, and the state x that is carried to the next one.
#pragma once

#include <limits>

#include "mechanism/elements/control/linear_block.hpp"
#include "mechanism/reading/pid_gains.hpp"

namespace bielle::mechanism {

/// The last stage of a sampled block: steps of a converter, then limits.
struct OutputStage {
  double quantum = 0;  ///< outputs are rounded to whole multiples of this; 0: no rounding
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  double operator()(double y) const;
};

class SampledLaw {
 public:
  virtual ~SampledLaw() = default;
  virtual Eigen::Index states() const = 0;  ///< number of states; all are zero before the first instant
  virtual Eigen::Index outputs() const = 0;
  /// Computes the outputs of an instant and the state after it.
  /// @param x  the state before the instant, replaced by the one after it
  virtual VectorX step(const VectorX& u, const OutputStage& stage, Eigen::Ref<VectorX> x) const = 0;
  virtual std::string about() const = 0;  ///< "PID controller"
};

/// y_k = C x_k + D u_k,  x_(k+1) = A x_k + B u_k. A block without states returns its input.
class SampledLinear final : public SampledLaw {
 public:
  SampledLinear(LinearBlock block, std::string about) : block_(std::move(block)), about_(std::move(about)) {}
  Eigen::Index states() const override { return block_.A.rows(); }
  Eigen::Index outputs() const override { return block_.D.rows(); }
  VectorX step(const VectorX& u, const OutputStage& stage, Eigen::Ref<VectorX> x) const override;
  std::string about() const override { return about_; }

 private:
  LinearBlock block_;
  std::string about_;
};

/// A PID controller with the period h of the samples e_k of its input, its gains P, I, D and the filter's T:
///     y_k = P e_k + S_k + d_k,   S_k = S_(k-1) + I h (e_k + e_(k-1))/2,   (T + h) d_k = T d_(k-1) + D (e_k - e_(k-1))
/// At the first sample, e_(k-1) is set to e_k. While the output is beyond a limit, S keeps its value if its change
/// would move the output further beyond it (anti-windup by conditional integration). Reference: K. J. Astrom, T.
/// Hagglund, Advanced PID Control, 2006, ch. 3 and 13.
class SampledPid final : public SampledLaw {
 public:
  SampledPid(const PidGains& gains, double period) : gains_(gains), h_(period) {}
  Eigen::Index states() const override { return 4; }
  Eigen::Index outputs() const override { return 1; }
  VectorX step(const VectorX& u, const OutputStage& stage, Eigen::Ref<VectorX> x) const override;
  std::string about() const override;

 private:
  PidGains gains_;
  double h_;
};

}  // namespace bielle::mechanism
