#include "mechanism/laws/elastic_law.hpp"

#include <fmt/format.h>

#include "mechanism/measures/nested.hpp"

namespace bielle::mechanism {
namespace {

/// Returns "[1, 2, 3] N/m, [..] N m/rad" for a diagonal matrix, "a full matrix" for another.
std::string in_words(const Matrix6& A, const std::vector<bool>& turning, const char* per_length,
                     const char* per_angle) {
  const auto n = static_cast<Eigen::Index>(turning.size());
  if (!A.isDiagonal(0))
    return fmt::format("a full matrix, diagonal ") +
           in_words(A.diagonal().asDiagonal(), turning, per_length, per_angle);
  std::string lengths, angles;
  for (Eigen::Index k = 0; k < n; ++k) {
    std::string& list = turning[static_cast<std::size_t>(k)] ? angles : lengths;
    list += fmt::format("{}{:.6g}", list.empty() ? "" : ", ", A(k, k));
  }
  if (lengths.empty() || angles.empty())
    return fmt::format("[{}] {}", lengths + angles, angles.empty() ? per_length : per_angle);
  return fmt::format("[{}] {}, [{}] {}", lengths, per_length, angles, per_angle);
}

}  // namespace

double SpeedFilm::speed_at(const LocalState& state) const {
  const double t = state.time();
  return speed.value(state, {&t, 1});
}

ElasticLaw::ElasticLaw(std::vector<std::string> names, std::vector<bool> turning)
    : names_(std::move(names)), turning_(std::move(turning)) {}

void ElasticLaw::add(MaxwellBranch branch) {
  for (Eigen::Index k = 0; k < branch.K.rows(); ++k)
    if (!branch.K.col(k).isZero(0)) unknowns_.push_back({branches_.size(), k});
  branches_.push_back(std::move(branch));
}

void ElasticLaw::declare(Declaration& declaration) const {
  declaration.stiffness = true;
  declaration.damping = has_damping() || !unknowns_.empty();
  for (const auto& curve : curves) declaration.kinks |= curve.has_value();
  declaration.kinks |= film.has_value();
  declaration.reads_reactions |= film && film->speed.reads_reactions();
  for (const Unknown& unknown : unknowns_) {
    const auto k = static_cast<std::size_t>(unknown.direction);
    Declaration::Scalar scalar{fmt::format("{} of branch {}", names_[k], unknown.branch + 1),
                               turning_[k] ? "rad" : "m"};
    scalar.equation_units = turning_[k] ? "rad/s" : "m/s";
    // Accuracies are relative to a deflection of 1 mm or 1 mrad, or to larger ones.
    scalar.scale = 1e-3;
    declaration.first_order.push_back(std::move(scalar));
  }
}

Vector6 ElasticLaw::values(const Measures& m) const {
  Vector6 e = Vector6::Zero();
  for (std::size_t k = 0; k < size(); ++k) e[static_cast<Eigen::Index>(k)] = m[k].value;
  return e;
}

Vector6 ElasticLaw::rates(const LocalState& state, const Measures& m) const {
  const Vector12 v = pair_rate(state.node(0), state.node(1));
  Vector6 rates = Vector6::Zero();
  for (std::size_t k = 0; k < size(); ++k) rates[static_cast<Eigen::Index>(k)] = m[k].rate(v);
  return rates;
}

Vector6 ElasticLaw::stretch(std::size_t branch, const LocalState& state, const Vector6& e) const {
  Vector6 s = Vector6::Zero();
  for (std::size_t i = 0; i < unknowns_.size(); ++i)
    if (const auto [of, k] = unknowns_[i]; of == branch)
      s[k] = e[k] - state.first_order()[static_cast<Eigen::Index>(i)];
  return s;
}

Vector6 ElasticLaw::force(const LocalState& state, const Measures& m) const {
  const Vector6 e = values(m);
  Vector6 N = preload + K * e;
  if (film) {
    const FilmCoefficients::At at = film->coefficients(film->speed_at(state));
    N += at.K * e + (D + at.D) * rates(state, m);
  } else if (has_damping()) {
    N += D * rates(state, m);
  }
  for (std::size_t k = 0; k < size(); ++k)
    if (const auto i = static_cast<Eigen::Index>(k); curves[k]) N[i] += (*curves[k])(e[i]).force;
  for (std::size_t b = 0; b < branches_.size(); ++b) N += branches_[b].K * stretch(b, state, e);
  return N;
}

void ElasticLaw::add_residual(const LocalState& state, const Measures& m, Eigen::Ref<VectorX> r) const {
  const Vector6 N = force(state, m);
  for (std::size_t k = 0; k < size(); ++k) r.head<12>() += N[static_cast<Eigen::Index>(k)] * m[k].gradient;
  const int row = state.slots().first_order_row();
  for (std::size_t i = 0; i < unknowns_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double stretch = m[static_cast<std::size_t>(unknowns_[i].direction)].value - state.first_order()[at];
    r[row + at] += state.first_order_rate()[at] - stretch / branches_[unknowns_[i].branch].time;
  }
}

ElasticLaw::Slopes ElasticLaw::slopes(const LocalState& state, const Measures& m) const {
  const Vector6 e = values(m);
  Matrix6 N_e = K;
  for (std::size_t k = 0; k < size(); ++k)
    if (const auto i = static_cast<Eigen::Index>(k); curves[k]) N_e(i, i) += (*curves[k])(e[i]).slope;
  for (const MaxwellBranch& branch : branches_) N_e += branch.K;
  Matrix6 N_v = D;
  Vector6 by_speed = Vector6::Zero();
  if (film) {
    const FilmCoefficients::At at = film->coefficients(film->speed_at(state));
    N_e += at.K;
    N_v += at.D;
    by_speed = at.K_slope * e + at.D_slope * rates(state, m);
  }
  const Eigen::Matrix<double, 6, 12> G = gradients(m);
  Slopes slopes{force(state, m), N_e * G, N_v * G, MatrixX::Zero(6, static_cast<Eigen::Index>(unknowns_.size())),
                by_speed};
  if (has_damping()) {
    const Vector12 u = pair_rate(state.node(0), state.node(1));
    Eigen::Matrix<double, 6, 12> turned = Eigen::Matrix<double, 6, 12>::Zero();
    for (std::size_t k = 0; k < size(); ++k) turned.row(static_cast<Eigen::Index>(k)) = u.transpose() * m[k].second;
    slopes.by_position += N_v * turned;
  }
  for (std::size_t i = 0; i < unknowns_.size(); ++i)
    slopes.by_unknown.col(static_cast<Eigen::Index>(i)) = -branches_[unknowns_[i].branch].K.col(unknowns_[i].direction);
  return slopes;
}

Eigen::Matrix<double, 6, 12> ElasticLaw::gradients(const Measures& m) const {
  Eigen::Matrix<double, 6, 12> G = Eigen::Matrix<double, 6, 12>::Zero();
  for (std::size_t k = 0; k < size(); ++k) G.row(static_cast<Eigen::Index>(k)) = m[k].gradient.transpose();
  return G;
}

void ElasticLaw::add_tangent(const LocalState& state, const Measures& m, LocalTangent& tangent) const {
  if (!tangent.wants_K && !tangent.wants_C) return;
  const Eigen::Matrix<double, 6, 12> G = gradients(m);
  const Slopes slope = slopes(state, m);
  const int row = state.slots().first_order_row();
  if (tangent.wants_K) {
    auto local = tangent.K.dense();
    Matrix12 whole = G.transpose() * slope.by_position;
    for (std::size_t k = 0; k < size(); ++k) whole += slope.N[static_cast<Eigen::Index>(k)] * m[k].second;
    local.topLeftCorner<12, 12>() += whole;
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      const auto at = row + static_cast<Eigen::Index>(i);
      const MaxwellBranch& branch = branches_[unknowns_[i].branch];
      const Vector6 column = slope.by_unknown.col(static_cast<Eigen::Index>(i));
      local.col(at).head<12>() += G.transpose() * column;
      local.row(at).head<12>() -= G.row(unknowns_[i].direction) / branch.time;
      local(at, at) += 1 / branch.time;
    }
  }
  if (tangent.wants_C && (has_damping() || !unknowns_.empty())) {
    auto local = tangent.C.dense();
    if (has_damping()) local.topLeftCorner<12, 12>() += G.transpose() * slope.by_rate;
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      const auto at = row + static_cast<Eigen::Index>(i);
      local(at, at) += 1;
    }
  }
  if (film && film->speed.reads_state()) add_speed_tangent(state, G.transpose() * slope.by_speed, tangent);
}

void ElasticLaw::add_by_speed(const LocalState& state, double factor, MeasureGradient& gradient) const {
  if (!film || !film->speed.reads_state()) return;
  const double t = state.time();
  Nested<FormulaGradient> speed;
  film->speed.calc(state, {&t, 1}, *speed);
  gradient.position() += factor * speed->by_state.position();
  gradient.rate() += factor * speed->by_state.rate();
}

void ElasticLaw::add_speed_tangent(const LocalState& state, const Vector12& column, LocalTangent& tangent) const {
  const double t = state.time();
  Nested<FormulaGradient> speed;
  film->speed.calc(state, {&t, 1}, *speed);
  if (tangent.wants_K) tangent.K.dense().topRows<12>() += column * speed->by_state.position().transpose();
  if (tangent.wants_C) tangent.C.dense().topRows<12>() += column * speed->by_state.rate().transpose();
}

void ElasticLaw::add_energy(const LocalState& state, const Measures& m, Energy& energy) const {
  const Vector6 e = values(m);
  energy.elastic += preload.dot(e) + 0.5 * e.dot(K * e);
  if (const Matrix6 cross = 0.5 * (K - K.transpose()); !cross.isZero(0)) energy.input -= rates(state, m).dot(cross * e);
  if (has_damping()) {
    const Vector6 v = rates(state, m);
    energy.dissipation += v.dot(D * v);
    if (film) {
      const FilmCoefficients::At at = film->coefficients(film->speed_at(state));
      energy.input -= v.dot(at.K * e);
      energy.dissipation += v.dot(at.D * v);
    }
  }
  for (std::size_t k = 0; k < size(); ++k)
    if (curves[k]) energy.elastic += curves[k]->energy(e[static_cast<Eigen::Index>(k)]);
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    const Vector6 s = stretch(b, state, e);
    const double twice = s.dot(branches_[b].K * s);
    energy.elastic += 0.5 * twice;
    energy.dissipation += twice / branches_[b].time;
  }
}

std::vector<std::string> ElasticLaw::describe() const {
  std::vector<std::string> facts;
  if (!K.isZero(0)) facts.push_back(fmt::format("stiffness {}", in_words(K, turning_, "N/m", "N m/rad")));
  if (!D.isZero(0)) facts.push_back(fmt::format("damping {}", in_words(D, turning_, "N s/m", "N m s/rad")));
  if (!preload.isZero(0))
    facts.push_back(fmt::format("preload {}", in_words(preload.asDiagonal(), turning_, "N", "N m")));
  for (std::size_t k = 0; k < size(); ++k) {
    const char* units = turning_[k] ? "rad" : "m";
    if (curves[k])
      facts.push_back(fmt::format("curve along {} from {:.6g} to {:.6g} {}, straight on beyond", names_[k],
                                  curves[k]->first(), curves[k]->last(), units));
  }
  if (film) facts.push_back(fmt::format("{} of {}", film->coefficients.describe(), film->speed.text()));
  for (const MaxwellBranch& branch : branches_)
    facts.push_back(fmt::format("branch of {:.6g} s: {}", branch.time, in_words(branch.K, turning_, "N/m", "N m/rad")));
  return facts;
}

}  // namespace bielle::mechanism
