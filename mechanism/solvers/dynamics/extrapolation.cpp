#include "mechanism/solvers/dynamics/extrapolation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bielle::mechanism {
namespace {

// Number of steps for which a choice is valid: it is doubled each time that the choice is confirmed.
constexpr int shortest = 16, longest = 128;
// Growth of the residual since the order was chosen, beyond which the order is chosen again.
constexpr double grown = 4;

}  // namespace

Extrapolation::Extrapolation(int size, int allowed) : allowed_(std::clamp(allowed, 0, most_order)) {
  for (VectorX& values : values_) values.setZero(size);
}

void Extrapolation::forget() {
  count_ = order_ = chosen_among_ = age_ = 0;
  lasts_ = shortest;
  size_ = 0;
}

void Extrapolation::add(double time, const VectorX& values) {
  constexpr double hardly = 0.1;  // a step below this fraction of the previous one replaces its values
  const bool replaces = count_ > 1 && time - times_[place(0)] < hardly * (times_[place(0)] - times_[place(1)]);
  if (!replaces) {
    newest_ = (newest_ + 1) % (most_order + 1);
    count_ = std::min(count_ + 1, most_order + 1);
  }
  values_[place(0)] = values;
  times_[place(0)] = time;
}

Extrapolation::Weights Extrapolation::weights(int order, double time) const {
  Weights weights{};
  for (int k = 0; k <= order; ++k) {
    double& weight = weights[static_cast<std::size_t>(k)] = 1;
    for (int other = 0; other <= order; ++other)
      if (other != k) weight *= (time - times_[place(other)]) / (times_[place(k)] - times_[place(other)]);
  }
  return weights;
}

int Extrapolation::highest_order(double time) const {
  constexpr double most = 32;  // largest amplification of errors; it is 31 for steps of equal size and order 4
  int order = highest_order();
  const auto amplification = [&] {
    double sum = 0;
    for (const double weight : weights(order, time)) sum += std::abs(weight);
    return sum;
  };
  while (order > 0 && !(amplification() <= most)) --order;
  return order;
}

void Extrapolation::calc(int order, double time, VectorX& values) const {
  const Weights weight = weights(order, time);
  values = weight[0] * value(0);
  for (int k = 1; k <= order; ++k) values += weight[static_cast<std::size_t>(k)] * value(k);
}

bool Extrapolation::wants_choice(double size) const {
  if (highest_order() < 1) return false;
  return highest_order() > chosen_among_ || age_ >= lasts_ || size > grown * std::max(size_, 1.0);
}

void Extrapolation::choose(int order, double size) {
  const bool confirmed = order == order_ && highest_order() == chosen_among_;
  lasts_ = confirmed ? std::min(2 * lasts_, longest) : shortest;
  order_ = order;
  chosen_among_ = highest_order();
  size_ = size;
  age_ = 0;
}

void Extrapolation::note(double size) {
  ++age_;
  size_ = std::min(size_, size);
}

void Extrapolation::exchange(Archive& archive) {
  for (VectorX& values : values_) archive(values);
  for (double& time : times_) archive(time);
  archive.within(newest_, 0, most_order);
  archive.within(count_, 0, most_order + 1);
  archive.within(order_, 0, most_order);
  archive.within(chosen_among_, -1, most_order);
  archive.within(age_, 0, std::numeric_limits<int>::max() / 2);
  archive.within(lasts_, 1, longest);
  archive.size_or_infinite(size_);
}

}  // namespace bielle::mechanism
