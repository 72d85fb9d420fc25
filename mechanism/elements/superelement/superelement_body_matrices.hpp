// The constant matrices of a superelement in the layout of corotated_frame.hpp: three rows per interface displacement
// and (where rotations act) three per rotation, all in body axes, then the modes.
//
// With q_file = P q (P extracts the kept directions in the interface's axes), each matrix of the file becomes P^T (.)
// P:
//     K~, C~, M~,  U (rigid motions), MU = M~ U,
//     K_r: geometric stiffness per unit load along row r, summed over the kept directions by the load's components,
//     G_1 = S_32 - S_23, G_2 = S_13 - S_31, G_3 = S_21 - S_12                     (antisymmetric),
//     H_kl = sym(delta_kl sum_j S_jj - S_lk)                                      (symmetric),
// so that a body whose frame moves with nu_0 = (v_0, Om_0) (body components) has, with s = U nu_0 + epsdot,
//     T = s^T M~ s / 2 + s^T G(Om_0) eps + eps^T H(Om_0) eps / 2,   G(Om) = Om_k G_k,   H(Om) = Om_k Om_l H_kl:
// the exact kinetic energy of the reduced displacement field. The inertia of foreshortening, which that field lacks, is
//     - eps^T K_sigma(Om_m) eps / 2,   K_sigma(Om) = Om_k Om_l K_sigma,kl,   Om_m = Lambda s,
// subtracted from it: geometric stiffness of the free body under the centrifugal field of unit Om_k Om_l (the sum is
// over all nine pairs k, l). Lambda, the last three rows of (U^T M~ U)^-1 U^T M~, gives the mean angular velocity of
// the body; that of the frame would only be correct if fast motions of the interfaces did not rotate it: their small
// mass would become negative. These matrices do not depend on the position of the body: bodies of one file share them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/elements/superelement/corotated_frame.hpp"
#include "reduce/superelement/superelement.hpp"

namespace bielle::mechanism {

/// Index of the pair (k, l) in the order 11 22 33 23 13 12.
inline constexpr int pair_index(int k, int l) { return k == l ? k : 6 - k - l; }

/// Products K_r x for each interface row r, divided into the rows of the interfaces and those of the modes.
struct PrestressGradient {
  MatrixX interfaces;  ///< (rows, rows): column r
  MatrixX modes;       ///< (modes, rows): column r
};

struct SuperelementMatrices {
  /// A kept direction of the file: q_file = axis . q(row .. row + 2).
  struct Direction {
    int row;
    Vector3 axis;
  };
  /// Column l + 3 k: generalised force of component k of the pattern along body axis l.
  using Pattern = Eigen::Matrix<double, Eigen::Dynamic, 9>;

  /// @throws InputError if the superelement's arrays are inconsistent or its mass is not positive
  explicit SuperelementMatrices(const Superelement& superelement);

  int size() const { return static_cast<int>(K.rows()); }
  int modes = 0;
  double gyration = 0;                ///< radius of gyration [m]
  double mass = 0;                    ///< mass of the displacement field [kg]
  Vector3 centre = Vector3::Zero();   ///< centre of mass, body axes
  Matrix3 inertia = Matrix3::Zero();  ///< inertia about the centre
  /// Interfaces in the order of the file: X, and R_ref for nodes with the body's axes.
  std::vector<BodyPoint> points;
  std::vector<Direction> directions;  ///< directions of the file's interface coordinates
  MatrixX kept;                       ///< projector of the interface rows on the kept directions (rows, rows)
  VectorX interface_scale;            ///< by interface row: 1 for translations, radius of gyration [m] for rotations

  MatrixX K, C, M;
  MatrixX6 U, MU;
  std::array<MatrixX, 3> G;
  std::array<MatrixX6, 3> GU;  ///< G_k U
  std::array<MatrixX, 6> H;
  std::array<MatrixX, 6> spin;                            ///< K_sigma; empty if the file has none
  Eigen::Matrix<double, 3, Eigen::Dynamic> mean_turning;  ///< Lambda
  /// K, H_11 .. H_12, K_sigma,11 .. (if the file has them), G_1 .. G_3, one below the other: one product with this
  /// matrix takes less time than products with each of them.
  MatrixX stacked;
  MatrixX in_a_row;                   ///< M, G_1, G_2, G_3 side by side (n, 4 n)
  Eigen::Matrix<double, 6, 6> rigid;  ///< U^T M~ U
  /// M U, Lambda^T, G_1 U, G_2 U, G_3 U side by side (n, 27)
  MatrixX rigid_columns;
  /// Column j contains column j of every K_r: first the rows of the interfaces of all K_r, one below the other, then
  /// the rows of the modes; (n rows, n), empty if the file has no geometric stiffness.
  MatrixX load_stiffness;
  /// Column r contains the lower half of K_r by columns, with off-diagonal entries doubled; (n (n + 1)/2, rows)
  MatrixX load_stiffness_forms;
  MatrixX strains;  ///< (6 (q + 1), n) strain at places, then its mean, see Superelement; may be empty
  std::vector<std::string> pattern_names;
  std::vector<Pattern> patterns;

  bool stiffened_by_spin() const { return spin[0].size() > 0; }
  Eigen::Index interface_rows() const { return kept.rows(); }
  /// Returns the number of interface rows with a geometric stiffness: all rows, or 0.
  Eigen::Index prestress_rows() const { return load_stiffness.size() > 0 ? interface_rows() : 0; }
  Eigen::Index products() const { return stacked.rows() / size(); }  ///< number of matrices in `stacked`
  /// Computes K_r x. @param x  (n)
  void multiply_load_stiffness(const VectorX& x, PrestressGradient& product) const;
  /// Computes K_r x for an x that is zero in the rows of the interfaces. @param x  (modes)
  void multiply_load_stiffness_by_modes(const Eigen::Ref<const VectorX>& x, PrestressGradient& product) const;
  /// Adds to `interfaces` the rows of the interfaces of K_r x for an x that is zero in the modes. @param x  (rows)
  void add_load_stiffness_interfaces(const Eigen::Ref<const VectorX>& x, MatrixX& interfaces) const;
  /// Adds to `modes` the rows of the modes of K_r x for an x that is zero in the modes. @param x  (rows)
  void add_load_stiffness_modes(const Eigen::Ref<const VectorX>& x, MatrixX& modes) const;
  /// Adds x^T K_r x for each r to `forms` (rows). @param products  a buffer for the products of the entries of x
  void add_load_stiffness_forms(const VectorX& x, VectorX& products, Eigen::Ref<VectorX> forms) const;
  /// Adds the sum over r of weights_r K_r to X.
  void add_load_stiffness(const Eigen::Ref<const VectorX>& weights, MatrixX& X) const;
  /// Transforms a matrix with columns of the file's coordinates to the present layout.
  MatrixX columns_in_rows(const MatrixX& file_matrix) const;
  /// Transforms a symmetric matrix of the file's coordinates to the present layout.
  MatrixX in_rows(const MatrixX& file_matrix) const;
  /// Transforms a vector in the present layout to the file's coordinates.
  void to_file(const Eigen::Ref<const VectorX>& q, Eigen::Ref<VectorX> q_file) const;

 private:
  int add_points(const Superelement& body);  ///< creates points, directions. @returns the rows of all points
  void set_inertia(const Superelement& body, const MatrixX& P);         ///< G, GU, H from the inertia components
  void set_load_stiffness(const Superelement& body, const MatrixX& P);  ///< K_r from those of the kept directions
  void set_stacked();
  MatrixX file_rows(int n) const;  ///< P
};

}  // namespace bielle::mechanism
