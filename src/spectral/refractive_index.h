#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "spectral/spectrum.h"

namespace photopic {

/// Sellmeier's formula, n² = 1 + Σ b_i λ²/(λ² − c_i).
struct SellmeierIndex {
  std::array<double, 4> b{};
  std::array<double, 4> c{};  ///< [µm²]
};

/// Cauchy's formula, n = max(a + b/λ², 1); with b = 0 a constant.
struct CauchyIndex {
  double a = 1.5;
  double b = 0.0;  ///< [nm²]
};

/// The refractive index of a transparent material as a function of wavelength.
using DielectricIndex = std::variant<CauchyIndex, SellmeierIndex>;

/// The d line of helium [nm], where glasses' indices are told.
inline constexpr double kLineD = 587.5618;

/// The index at a vacuum wavelength [nm].
double refractive_index(const DielectricIndex& index, double lambda);

/// Whether the index depends on the wavelength.
bool is_dispersive(const DielectricIndex& index);

/// KHR_materials_dispersion: Cauchy's formula through n_d and the Abbe number. @param dispersion 20/V_d, ≥ 0
CauchyIndex abbe_index(double n_d, double dispersion);

/// Abbe's number V_d = (n_d − 1)/(n_F − n_C), at kLineD, 486.13 and 656.27 nm; infinite without dispersion.
double abbe_number(const DielectricIndex& index);

/// A named transparent material; nothing when the name is not known. Sources stand beside the coefficients;
/// all are valid over the whole of [360, 830] nm, but for SF10 and SF11, which begin at 380 and 370 nm and
/// are continued by their formulas.
std::optional<DielectricIndex> glass_index(std::string_view name);
std::vector<std::string_view> glass_names();

/// n + ik of a metal, k ≥ 0 where it absorbs.
struct ConductorIndex {
  TabulatedSpectrum n, k;
};

/// A named metal (of conductor_names(): elements by their symbols, and "brass"); nothing when the name is not
/// known. Sources stand beside the tables, which are continued by their end values.
std::optional<ConductorIndex> conductor_index(std::string_view name);
std::vector<std::string_view> conductor_names();

}  // namespace photopic
