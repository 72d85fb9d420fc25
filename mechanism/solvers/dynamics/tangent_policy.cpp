#include "mechanism/solvers/dynamics/tangent_policy.hpp"

#include <algorithm>
#include <cmath>

namespace bielle::mechanism {

bool TangentPolicy::worthwhile(double before, double now) const {
  constexpr double slowest = 0.5;
  if (!(now < slowest * before)) return false;
  if (now <= 1) return true;
  const double left = std::ceil(std::log(now) / std::log(before / now));
  return cost(1, 1, 0) * (left - 1) <= cost(0, 0, 1);
}

bool TangentPolicy::judge(double wasted, double cost, int factorisations) {
  ++renewed_age_;
  if (factorisations > 0) {
    if (wasted > 0) {
      end_cycle((spent_ + wasted) / std::max(served_, 1));
    } else {
      constexpr double weight = 0.25;  // weight in the mean: some steps take an iteration more than others
      renewed_cost_ = is_renewed_cost_known() ? renewed_cost_ + weight * (cost - renewed_cost_) : cost;
      renewed_age_ = 0;
      if (renewals_left_ > 0) --renewals_left_;
    }
    spent_ = cost - wasted;
    served_ = 1;
    return true;
  }
  const bool dearer = cost * served_ > spent_;
  spent_ += cost;
  ++served_;
  if (!dearer) return true;
  end_cycle(spent_ / served_);
  return false;
}

void TangentPolicy::end_cycle(double average) {
  if (wanted_ != Tangent::automatic) return;
  // A cost that is not known is replaced by the least possible one; if that is less, the next step measures the cost.
  const double renewed = is_renewed_cost_known() ? renewed_cost_ : cost(1, 1, 1);
  renewals_ = average < renewed ? 0 : std::clamp(2 * renewals_, 1, most_renewals);
  renewals_left_ = renewals_;
}

}  // namespace bielle::mechanism
