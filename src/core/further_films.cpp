#include "core/further_films.h"

namespace photopic {

double CovarianceFilm::variance_of_mean(const Film& film, std::size_t pixel, const Xyz& w) const {
  const double n = static_cast<double>(film.count(pixel));
  if (n < 2.0) return 0.0;
  const Xyz m = film.mean(pixel), v = film.variance_of_mean(pixel), &p = products_[pixel];
  const auto covariance = [n](double products, double a, double b) {
    return (products - n * a * b) / (n - 1.0) / n;
  };
  return std::max(0.0,
                  w.x * w.x * v.x + w.y * w.y * v.y + w.z * w.z * v.z +
                      2.0 * (w.y * w.z * covariance(p.x, m.y, m.z) + w.z * w.x * covariance(p.y, m.z, m.x) +
                             w.x * w.y * covariance(p.z, m.x, m.y)));
}

double SpectralFilm::mean(const Film& film, std::size_t pixel, int bin) const {
  const auto count = static_cast<double>(film.count(pixel));
  if (count == 0.0) return 0.0;
  const std::size_t i = pixel * static_cast<std::size_t>(bins_) + static_cast<std::size_t>(bin);
  return sums_[i] / (count * bin_width());
}

}  // namespace photopic
