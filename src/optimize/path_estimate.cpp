#include "optimize/path_estimate.h"

#include <algorithm>
#include <cmath>

#include "spectral/observer.h"

namespace photopic {

PathEstimate::PathEstimate(const WavelengthSampler& sampler, const TabulatedSpectrum& emission)
    : sampler_(sampler),
      emitter_(make_emitter(emission)),
      lambda_(static_cast<std::size_t>(wavelength_count(sampler))),
      density_sum_(lambda_.size()),
      weight_(lambda_.size()) {}

void PathEstimate::draw(double u) {
  draw_wavelengths(sampler_, u, lambda_, density_sum_);
  for (std::size_t j = 0; j < lambda_.size(); ++j) {
    const double power = emitter_.scale * emitter_.emission(lambda_[j]);
    weight_[j] = power > 0.0 ? Observer::cie1931()(lambda_[j]) * (power / density_sum_[j]) : Xyz{};
  }
}

void PathEstimate::integrate_over_u(const std::function<void(double share)>& visit) {
  constexpr int kAtLeast = 1024;
  std::vector<double> ends = breakpoints(sampler_, emitter_.emission.lambda());
  for (int i = 0; i <= kAtLeast; ++i) ends.push_back(static_cast<double>(i) / kAtLeast);
  std::sort(ends.begin(), ends.end());

  const double offset = 0.5 / std::sqrt(3.0);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double width = ends[i + 1] - ends[i];
    if (width == 0.0) continue;
    for (const double side : {-offset, offset}) {
      draw(ends[i] + width * (0.5 + side));
      visit(0.5 * width);
    }
  }
}

Xyz PathEstimate::white() const {
  Xyz sum;
  for (const Xyz& weight : weight_) sum += weight;
  return sum;
}

Xyz PathEstimate::seen(const Spectrum& reflectance) const {
  Xyz sum;
  for (std::size_t j = 0; j < lambda_.size(); ++j) sum += weight_[j] * evaluate(reflectance, lambda_[j]);
  return sum;
}

Xyz PathEstimate::expected(const Spectrum& reflectance) const {
  const Observer& observer = Observer::cie1931();
  return emission_xyz(tabulate_product(emitter_.emission, reflectance), observer) *
         (emitter_.scale * observer.y_integral());
}

}  // namespace photopic
