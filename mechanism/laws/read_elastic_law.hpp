// Readers of the keys of an ElasticLaw in input files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/laws/elastic_law.hpp"
#include "reduce/common/input/yaml_file.hpp"

namespace bielle::mechanism {

/// Returns the key `file` of a matrix.
const KeyTable& matrix_keys();
/// Returns the forms of a matrix: by rows, or `{file: k.csv}`.
KeyForms forms_of_matrix(std::size_t rows, const std::string& unit);
/// Reads `rows` x `rows` numbers, by rows, or `{file: k.csv}` with as many columns. @throws InputError
MatrixX read_square_matrix(const YamlValue& value, Eigen::Index rows);

/// Rejects a matrix that is not symmetric, to 1e-6 of its entries, and makes it exactly symmetric.
void make_symmetric(const YamlValue& value, MatrixX& A);

/// Rejects a symmetric matrix with a negative eigenvalue (of the matrix scaled to a unit diagonal, beyond 1e-6).
/// @param what  a clause for the message: "a spring that gives energy away"
void check_semidefinite(const YamlValue& value, const MatrixX& A, const char* what);

/// Returns the keys `stiffness`, `damping`, `preload`, `curves`, `film`, `maxwell` of a law of the measures x, y, z,
/// rx, ry, rz.
std::vector<Key> keys_of_elastic_law();

/// A formula of q, v, t and the state in `curves`: for a measure, by its number.
struct CurveFormula {
  std::size_t measure;
  YamlValue formula;
};

/// The formulas of a law, which are read after the model.
struct ElasticFormulas {
  std::vector<CurveFormula> curves;
  std::optional<YamlValue> film_speed;  ///< formula of t and the state; the film of the law lacks it
};

/// Reads the keys into a law of six measures. @returns the formulas, for the caller @throws InputError
ElasticFormulas read_elastic_law(const YamlValue& entry, ElasticLaw& law);

}  // namespace bielle::mechanism
