#include "spectral/illuminants.h"

#include <algorithm>
#include <string>
#include <utility>

namespace photopic {
namespace {

constexpr double kStep = 5.0;  ///< [nm]

struct Illuminant {
  std::string_view name;
  double first;  ///< [nm]
  std::vector<double> value;
};

const std::vector<Illuminant>& tables() {
  static const std::vector<Illuminant> all = {
#include "spectral/tables/illuminants.inc"
  };
  return all;
}

TabulatedSpectrum tabulate(const Illuminant& illuminant) {
  std::vector<double> lambda(illuminant.value.size());
  for (std::size_t i = 0; i < lambda.size(); ++i)
    lambda[i] = illuminant.first + kStep * static_cast<double>(i);
  return {std::move(lambda), illuminant.value, Beyond::zero};
}

/// The older "F1" … "F12" stand for "FL1" … "FL12" of today's standard.
std::string today_name(std::string_view name) {
  const bool older = name.size() > 1 && name[0] == 'F' && name[1] >= '0' && name[1] <= '9';
  return older ? "FL" + std::string(name.substr(1)) : std::string(name);
}

}  // namespace

std::optional<TabulatedSpectrum> cie_illuminant(std::string_view name) {
  if (name == "E") return TabulatedSpectrum({300.0, kLambdaMax}, {100.0, 100.0}, Beyond::zero);
  const auto& all = tables();
  const auto found = std::find_if(
      all.begin(), all.end(), [wanted = today_name(name)](const Illuminant& i) { return i.name == wanted; });
  if (found == all.end()) return std::nullopt;
  return tabulate(*found);
}

std::vector<std::string_view> cie_illuminant_names() {
  std::vector<std::string_view> names;
  for (const Illuminant& illuminant : tables()) {
    names.push_back(illuminant.name);
    if (illuminant.name == "D75") names.push_back("E");
  }
  return names;
}

}  // namespace photopic
