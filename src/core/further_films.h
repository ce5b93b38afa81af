#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/film.h"
#include "spectral/sampled_spectrum.h"

namespace photopic {

/// Sums over a pixel's samples that few renders ask for, besides a Film's and to be fed as it is: in order of
/// the samples, by one thread at a time.

/// What a Film lacks for the covariances of X, Y and Z.
class CovarianceFilm {
 public:
  CovarianceFilm(int width, int height)
      : products_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  void add(std::size_t pixel, const Xyz& s) { products_[pixel] += Xyz{s.y * s.z, s.z * s.x, s.x * s.y}; }

  /// The variance of the mean of w.x·X + w.y·Y + w.z·Z, from a pixel's samples as if they were independent
  /// (an upper estimate for stratified ones); 0 where there are fewer than two.
  /// @param film that got the same samples
  double variance_of_mean(const Film& film, std::size_t pixel, const Xyz& w) const;

 private:
  std::vector<Xyz> products_;  ///< Σ YZ, Σ ZX, Σ XY
};

/// Spectral radiance in equal bins over [360, 830] nm.
class SpectralFilm {
 public:
  SpectralFilm(int width, int height, int bins)
      : bins_(bins),
        sums_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
              static_cast<std::size_t>(bins)) {}

  /// The balance-heuristic estimate: Σ_j L(λ_j) / S(λ_j), each in the bin of its wavelength.
  /// @param lambda λ_j [nm] @param radiance_over_density L(λ_j) / S(λ_j)
  template <int N>
  void add(std::size_t pixel, SampledSpectrum<N> lambda, SampledSpectrum<N> radiance_over_density) {
    double* sums = &sums_[pixel * static_cast<std::size_t>(bins_)];
    for (int j = 0; j < N; ++j) sums[bin_of(lambda[j])] += radiance_over_density[j];
  }

  int bins() const { return bins_; }
  double bin_width() const { return (kLambdaMax - kLambdaMin) / bins_; }           ///< [nm]
  double centre(int bin) const { return kLambdaMin + (bin + 0.5) * bin_width(); }  ///< [nm]

  /// A bin's mean spectral radiance [Film's Y per nm of ∫ȳ dλ: Y = ∫ȳ·L dλ / ∫ȳ dλ].
  /// @param film that got the same samples
  double mean(const Film& film, std::size_t pixel, int bin) const;

 private:
  int bin_of(double lambda) const {
    return std::clamp(static_cast<int>((lambda - kLambdaMin) / bin_width()), 0, bins_ - 1);
  }

  int bins_;
  std::vector<double> sums_;  ///< the bins of a pixel side by side
};

/// Those that a render feeds; null: not asked for.
struct FurtherFilms {
  CovarianceFilm* covariance = nullptr;
  SpectralFilm* spectrum = nullptr;

  template <int N>
  void add(std::size_t pixel, const Xyz& xyz, SampledSpectrum<N> lambda,
           SampledSpectrum<N> radiance_over_density) const {
    if (covariance != nullptr) covariance->add(pixel, xyz);
    if (spectrum != nullptr) spectrum->add(pixel, lambda, radiance_over_density);
  }
};

}  // namespace photopic
