#pragma once

#include <span>
#include <vector>

#include "core/film.h"

namespace photopic::test {

/// The chance of a chi-square this large or larger when the expectation holds. Cells that expect fewer than
/// five are pooled, the rarest first; a count where nothing is expected gives 0.
/// @param observed counts @param expected mean counts, as many; both have the same total
double chi_square_p_value(std::span<const double> observed, std::span<const double> expected);

/// Upper tail of the chi-square distribution: Q(dof/2, x/2), the regularised incomplete gamma function
/// (series and continued fraction; Abramowitz & Stegun 1964, 6.5.29 and 6.5.31).
double chi_square_tail(double x, double degrees_of_freedom);

/// The significance that each of n tests may have so that all of them together have `family`: Šidák 1967.
double sidak_significance(double family, std::size_t tests);

/// The |z| that a normal variable exceeds, either side, with this probability.
double normal_threshold(double significance);

/// A mean and the standard error of it.
struct Estimate {
  double mean = 0.0, error = 0.0;
};

/// (a − b) in standard errors; 0 where both are exactly equal.
double z_score(Estimate a, Estimate b);

/// X, Y and Z of the film's mean over the pixels [x0, x1)×[y0, y1), from the pixels' samples taken as
/// independent.
std::vector<Estimate> block_estimates(const Film& film, int x0, int y0, int x1, int y1);
/// The same for the whole image, and for the image and its four quarters (fifteen estimates).
std::vector<Estimate> image_estimates(const Film& film);
std::vector<Estimate> quarter_estimates(const Film& film);

/// The largest |z| between two lists of estimates.
double largest_z(std::span<const Estimate> a, std::span<const Estimate> b);

/// Mean and error of a running sum.
class RunningMean {
 public:
  void add(double x) { ++count_, sum_ += x, squares_ += x * x; }
  Estimate estimate() const;

 private:
  double count_ = 0.0, sum_ = 0.0, squares_ = 0.0;
};

}  // namespace photopic::test
