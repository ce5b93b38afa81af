#include "spectral/refractive_index.h"

#include <algorithm>
#include <limits>

namespace photopic {
namespace {

struct Glass {
  std::string_view name;
  SellmeierIndex index;
};

constexpr double sqr(double x) {
  return x * x;
}

constexpr Glass kGlasses[] = {
    // Schott, optical glass data sheets.
    {"BK7", {{1.03961212, 0.231792344, 1.01046945}, {0.00600069867, 0.0200179144, 103.560653}}},
    {"SF10", {{1.61625977, 0.259229334, 1.07762317}, {0.0127534559, 0.0581983954, 116.60768}}},
    {"SF11", {{1.73848403, 0.311168974, 1.17490871}, {0.0136068604, 0.0615960463, 121.922711}}},
    {"F2", {{1.34533359, 0.209073176, 0.937357162}, {0.00997743871, 0.0470450767, 111.886764}}},
    // Malitson 1965, "Interspecimen Comparison of the Refractive Index of Fused Silica", 20 °C.
    {"fused silica", {{0.6961663, 0.4079426, 0.8974794}, {sqr(0.0684043), sqr(0.1162414), sqr(9.896161)}}},
    // Peter 1923, "Über Brechungsindizes und Absorptionskonstanten des Diamanten".
    {"diamond", {{0.3306, 4.3356}, {sqr(0.175), sqr(0.106)}}},
    // Daimon, Masumura 2007, "Measurement of the refractive index of distilled water from the near-infrared
    // region to the ultraviolet region", 20.0 °C.
    {"water",
     {{0.5684027565, 0.1726177391, 0.02086189578, 0.1130748688},
      {0.005101829712, 0.01821153936, 0.02620722293, 10.69792721}}},
};

struct Conductor {
  std::string_view name;
  std::vector<double> lambda, n, k;
};

const std::vector<Conductor>& conductors() {
  static const std::vector<Conductor> all = {
#include "spectral/tables/conductors.inc"
#include "spectral/tables/further_conductors.inc"
  };
  return all;
}

double evaluate(const CauchyIndex& index, double lambda) {
  return std::max(index.a + index.b / sqr(lambda), 1.0);
}

double evaluate(const SellmeierIndex& index, double lambda) {
  const double squared = sqr(1e-3 * lambda);
  double n2 = 1.0;
  for (std::size_t i = 0; i < index.b.size(); ++i) n2 += index.b[i] * squared / (squared - index.c[i]);
  return std::sqrt(n2);
}

}  // namespace

double refractive_index(const DielectricIndex& index, double lambda) {
  return std::visit([&](const auto& formula) { return evaluate(formula, lambda); }, index);
}

bool is_dispersive(const DielectricIndex& index) {
  const auto* cauchy = std::get_if<CauchyIndex>(&index);
  return cauchy == nullptr || cauchy->b != 0.0;
}

CauchyIndex abbe_index(double n_d, double dispersion) {
  const double slope = (n_d - 1.0) * dispersion / 20.0;
  return {n_d - 1.5168 * slope, 523655.0 * slope};
}

double abbe_number(const DielectricIndex& index) {
  const double spread = refractive_index(index, 486.1327) - refractive_index(index, 656.2725);
  if (spread == 0.0) return std::numeric_limits<double>::infinity();
  return (refractive_index(index, kLineD) - 1.0) / spread;
}

std::optional<DielectricIndex> glass_index(std::string_view name) {
  const auto* found = std::ranges::find(kGlasses, name, &Glass::name);
  if (found == std::end(kGlasses)) return std::nullopt;
  return found->index;
}

std::vector<std::string_view> glass_names() {
  std::vector<std::string_view> names;
  for (const Glass& glass : kGlasses) names.push_back(glass.name);
  return names;
}

std::optional<ConductorIndex> conductor_index(std::string_view name) {
  const auto found = std::ranges::find(conductors(), name, &Conductor::name);
  if (found == conductors().end()) return std::nullopt;
  return ConductorIndex{{found->lambda, found->n, Beyond::end_value},
                        {found->lambda, found->k, Beyond::end_value}};
}

std::vector<std::string_view> conductor_names() {
  std::vector<std::string_view> names;
  for (const Conductor& conductor : conductors()) names.push_back(conductor.name);
  return names;
}

}  // namespace photopic
