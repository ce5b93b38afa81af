#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "spectral/float_vectors.h"
#include "spectral/guide_table.h"
#include "spectral/observer.h"
#include "spectral/sampled_spectrum.h"
#include "spectral/spectrum.h"

namespace photopic {

/// An observer and the emissions of a scene's lamps, four columns side by side, so that one look-up gives
/// them all: they are linear on the cells between the knots of any of the four. Single precision, but for
/// the place in a cell: a line of 0.01 nm needs the digits.
class WavelengthTable {
 public:
  /// @param emissions zero outside [360, 830] nm (tabulate_emission)
  WavelengthTable(const Observer& observer, std::span<const TabulatedSpectrum> emissions);

  /// At a path's N wavelengths [nm], within [360, 830]: x̄, ȳ, z̄ over ∫ȳ dλ [1/nm], returned, and each
  /// emission.
  template <int N>
  std::array<SampledSpectrum<N>, 3> look_up(const std::array<double, N>& lambda,
                                            std::span<SampledSpectrum<N>> emissions) const {
    const auto first = fours_[0].template look_up<N>(lambda);
    if (!emissions.empty()) emissions[0] = first[3];
    if (emissions.size() > 1) look_up_more<N>(lambda, emissions);
    return {first[0], first[1], first[2]};
  }

 private:
  class Four {
   public:
    explicit Four(std::span<const TabulatedSpectrum* const> columns);  ///< at most four
    template <int N>
    std::array<SampledSpectrum<N>, 4> look_up(const std::array<double, N>& lambda) const {
      const auto columns = look_up<N>(lambda.data());
      return {columns[0], columns[1], columns[2], columns[3]};
    }

   private:
    struct Cell {
      double begin;  ///< [nm]
      float per_nm;  ///< 1/width
    };
    struct Values {
      Float4 at_begin;
      Float4 rise;  ///< from there to the cell's end
    };
    Float4 look_up(double lambda) const {
      const std::uint32_t i = cell_of_.find(lambda);
      const float f = std::min(static_cast<float>(lambda - cells_[i].begin) * cells_[i].per_nm, 1.0f);
      return values_[i].at_begin + values_[i].rise * f;
    }
    template <int N>
    std::array<typename FloatLanes<N>::Type, 4> look_up(const double* lambda) const {
      if constexpr (N == 1) {
        const Float4 at = look_up(lambda[0]);
        return {Float1{at[0]}, Float1{at[1]}, Float1{at[2]}, Float1{at[3]}};
      } else if constexpr (N == 4) {
        Float4 a = look_up(lambda[0]), b = look_up(lambda[1]), c = look_up(lambda[2]), d = look_up(lambda[3]);
        transpose(a, b, c, d);
        return {a, b, c, d};
      } else {
        const auto low = look_up<N / 2>(lambda), high = look_up<N / 2>(lambda + N / 2);
        return {join(low[0], high[0]), join(low[1], high[1]), join(low[2], high[2]), join(low[3], high[3])};
      }
    }

    GuideTable cell_of_;
    std::vector<Cell> cells_;
    std::vector<Values> values_;
  };
  template <int N>
  void look_up_more(const std::array<double, N>& lambda, std::span<SampledSpectrum<N>> emissions) const {
    for (std::size_t i = 1; i < emissions.size(); i += 4) {
      const auto next = fours_[(i + 3) / 4].template look_up<N>(lambda);
      std::copy_n(next.begin(), std::min<std::size_t>(4, emissions.size() - i), emissions.begin() + i);
    }
  }

  std::vector<Four> fours_;  ///< the first begins with the observer
};

}  // namespace photopic
