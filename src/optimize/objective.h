#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "optimize/density_model.h"
#include "optimize/target_table.h"

namespace photopic {

/// What a set of densities is judged by.
enum class Objective {
  /// Weighted mean over targets of sqrt(mean_u |U (E(u) − c)|²) [ΔE]: what √n times the error tends to.
  asymptotic,
  /// ∫ ΔE00(E(u), c) du for R = 1 [ΔE], its kink at 0 rounded off by smooth_delta_e.
  mean_delta_e
};

/// The white of CIELAB, on the scale where R = 1 has Y = 1.
enum class White { d65, illuminant };

/// What is to be estimated well. For several lamps, see lamp_set.
struct Targets {
  Objective objective = Objective::asymptotic;
  White white = White::d65;
  TabulatedSpectrum mixed;  ///< the lamps together: what mean_delta_e sees, and White::illuminant
  std::vector<TabulatedSpectrum> emitters;  ///< the lamps one by one; each counts by its luminance
  std::vector<Spectrum> reflectances;       ///< seen under each of them
};

/// The white of CIELAB at Y = 1. @param light the lamps together
/// @throws std::invalid_argument when it is to be that of a light without luminance
Xyz white_of(White white, const TabulatedSpectrum& light);

/// An objective as a function of the estimates E(u) alone. Immutable; shared by all threads.
class EstimateLoss {
 public:
  /// @throws std::invalid_argument when a lamp has no luminance
  EstimateLoss(const Targets& targets, const PiecewiseLinearDensity& base);

  /// What the estimates are made of.
  const TargetTable& table() const { return table_; }

  /// The objective; `estimates` of equal strata of u become its derivatives by them.
  double operator()(std::span<Channels> estimates) const;

 private:
  /// A symmetric matrix by rows.
  using Matrix = std::array<Channels, kChannels>;

  double asymptotic(std::span<Channels> estimates) const;
  double mean_delta_e(std::span<Channels> estimates) const;

  Objective objective_;
  TargetTable table_;
  std::vector<Matrix> forms_;  ///< for each target A with |U (E − c)|² = (e − e₀)ᵀ A (e − e₀) in channels
  std::vector<double> weights_;  ///< of the targets; they add up to 1
  Lab reference_;                ///< of c, for mean_delta_e
  Xyz white_;
};

/// The objective as a function of v, the logarithms of the densities' node values; one for each thread.
class ObjectiveFunction {
 public:
  ObjectiveFunction(std::shared_ptr<const EstimateLoss> loss, std::vector<bool> backwards, int nodes,
                    int strata);

  int unknowns() const { return model_.unknowns(); }

  /// @param v node by node, density by density  @param gradient as many, or empty where it is not wanted
  double operator()(std::span<const double> v, std::span<double> gradient);

 private:
  void estimate();
  void pull_back();

  std::shared_ptr<const EstimateLoss> loss_;
  DensityModel model_;
  std::vector<Channels> estimates_;
};

}  // namespace photopic
