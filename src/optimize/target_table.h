#pragma once

#include <array>
#include <span>
#include <vector>

#include "optimize/color_metric.h"
#include "spectral/piecewise_density.h"
#include "spectral/spectrum.h"

namespace photopic {

/// Numbers that the estimator computes side by side: X, Y, Z of one target, or a basis of what all targets
/// need.
inline constexpr int kChannels = 16;
using Channels [[gnu::vector_size(kChannels * sizeof(double))]] = double;

/// A vector-valued integrand on t in [0, 1], piecewise linear on equal cells, and so continuous: a jump would
/// have no pathwise gradient.
struct TargetTable {
  std::vector<Channels> node;  ///< r(i/cells)
  Channels integral{};         ///< ∫ r dt: what the estimator estimates
  int cells() const { return static_cast<int>(node.size()) - 1; }
};

/// A lamp under which a reflectance is seen.
struct Emitter {
  TabulatedSpectrum emission;
  double scale;  ///< makes Y = 1 for R = 1: XYZ = scale·∫ h I R dλ
};

/// @throws std::invalid_argument when the emission has no luminance
Emitter make_emitter(const TabulatedSpectrum& emission);

/// X, Y, Z for R = 1: r_l = scale·h_l·I/b at λ = B⁻¹(t), averaged over each node's hat function.
TargetTable xyz_table(const PiecewiseLinearDensity& base, const Emitter& emitter);

/// All (emitter, reflectance) pairs at once. Their integrands, measured in ΔE by each target's colour metric,
/// are linear combinations of at most kChannels orthonormal functions (smooth spectra have few degrees of
/// freedom; a pivoted Gram–Schmidt process finds them), so that no cost depends on the number of targets.
struct TargetBasis {
  TargetTable table;  ///< of the orthonormal functions
  std::vector<std::array<Channels, 3>>
      coordinates;  ///< for each target: U·XYZ = these rows times the channels
};
/// @param white of CIELAB, on the scale where R = 1 has Y = 1
TargetBasis target_basis(const PiecewiseLinearDensity& base, std::span<const Emitter> emitters,
                         std::span<const Spectrum> reflectances, Xyz white);

}  // namespace photopic
