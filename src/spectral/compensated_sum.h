#pragma once

#include <cmath>

namespace photopic {

/// A sum that carries its rounding error along: Neumaier 1974. Exact enough to add 1e6 and 1e-6 a hundred
/// thousand times.
class CompensatedSum {
 public:
  CompensatedSum& operator+=(double term) {
    const double next = sum_ + term;
    lost_ += std::abs(sum_) >= std::abs(term) ? (sum_ - next) + term : (term - next) + sum_;
    sum_ = next;
    return *this;
  }
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0.0, lost_ = 0.0;
};

}  // namespace photopic
