// Arguments of the functions that compute the tangent of a superelement; only their sources use them.
#pragma once

#include "mechanism/elements/superelement/superelement_body_tangent.hpp"

namespace bielle::mechanism {

struct SuperelementTangent::View {
  const SuperelementMatrices& body;
  const MatrixX& damping;
  const SuperelementMotion& motion;
  const VectorX& eps;
  const MatrixX& excess;  // nonzero rows of J - I
  const CorotatedGeometry& geometry;
  const LocalState& state;
  Eigen::Index n;
  Vector3 v_0, Om, Om_rate;
  Matrix6 ad;  // e = pi' + ad pi
};

}  // namespace bielle::mechanism
