// A sparse factorisation of one library, as factorisations.cpp measures it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reduce/spectral/symmetric_matrix.hpp"

namespace bielle {

class MeasuredFactor {
 public:
  MeasuredFactor() = default;
  MeasuredFactor(const MeasuredFactor&) = delete;
  MeasuredFactor& operator=(const MeasuredFactor&) = delete;
  virtual ~MeasuredFactor() = default;

  virtual void analyse() = 0;    ///< order and structure
  virtual void factorise() = 0;  ///< the numbers; anew where there are some
  virtual Eigen::MatrixXd solve(const Eigen::MatrixXd& b) = 0;
  virtual double flops() const = 0;   ///< of the numbers, by the library's own structure
  virtual double stored() const = 0;  ///< numbers that the factor keeps
};

struct FactorRequest {
  const SymmetricMatrix& matrix;         ///< outlives the factor
  std::span<const std::int64_t> blocks;  ///< first unknown of each point, then their number
  int threads;
};

std::unique_ptr<MeasuredFactor> measured_bielle(const FactorRequest& request);
std::unique_ptr<MeasuredFactor> measured_cholmod(const FactorRequest& request);  ///< supernodal, METIS
std::unique_ptr<MeasuredFactor> measured_eigen(const FactorRequest& request);  ///< simplicial, in CHOLMOD's METIS order
/// L D L^T without pivoting, best of nested dissection and multisection. Nothing where SPOOLES is not installed.
std::unique_ptr<MeasuredFactor> measured_spooles(const FactorRequest& request);

}  // namespace bielle
