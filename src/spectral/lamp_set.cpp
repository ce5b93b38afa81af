#include "spectral/lamp_set.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <stdexcept>
#include <utility>

#include "spectral/content_hash.h"
#include "spectral/observer.h"

namespace photopic {
namespace {

constexpr double kStepsPerDecade = 100.0;

/// Each lamp is a set of targets of its own, and costs an optimisation as much.
constexpr std::size_t kMostLamps = 12;

/// How far a power lies below the strongest, in steps.
std::int64_t steps_below(double power, double strongest) {
  return std::llround(kStepsPerDecade * std::log10(strongest / power));
}

/// A lamp and the power of all that are equal to it.
struct Lamp {
  const TabulatedSpectrum* emission;
  double power;
};

/// The strongest stay, the others become one.
void merge_weakest(std::vector<TabulatedSpectrum>& lamps) {
  if (lamps.size() <= kMostLamps) return;
  std::ranges::stable_sort(lamps, std::ranges::greater{}, luminance);
  const auto others = std::span(lamps).subspan(kMostLamps - 1);
  TabulatedSpectrum rest = mix_emissions(others, std::vector<double>(others.size(), 1.0));
  lamps.erase(lamps.begin() + kMostLamps - 1, lamps.end());
  lamps.push_back(std::move(rest));
  std::ranges::sort(lamps, {}, [](const TabulatedSpectrum& lamp) { return digest(lamp); });
}

}  // namespace

std::vector<TabulatedSpectrum> lamp_set(std::span<const TabulatedSpectrum> emissions,
                                        std::span<const double> powers) {
  if (emissions.size() != powers.size()) throw std::invalid_argument("as many powers as lamps are needed");
  std::map<std::string, Lamp> lamps;
  double strongest = 0.0;
  for (std::size_t i = 0; i < emissions.size(); ++i) {
    if (!(powers[i] >= 0.0) || !std::isfinite(powers[i]))
      throw std::invalid_argument("a lamp's power is negative or not finite");
    if (powers[i] == 0.0 || !(luminance(emissions[i]) > 0.0)) continue;
    Lamp& lamp = lamps.try_emplace(digest(emissions[i]), Lamp{&emissions[i], 0.0}).first->second;
    lamp.power += powers[i];
    strongest = std::max(strongest, lamp.power);
  }

  if (lamps.size() == 1) return {*lamps.begin()->second.emission};
  std::vector<TabulatedSpectrum> set;
  for (const auto& [key, lamp] : lamps) {
    const double steps = static_cast<double>(steps_below(lamp.power, strongest));
    set.push_back(
        lamp.emission->scaled(std::pow(10.0, -steps / kStepsPerDecade) / luminance(*lamp.emission)));
  }
  merge_weakest(set);
  return set;
}

TabulatedSpectrum mixed_light(std::span<const TabulatedSpectrum> lamps) {
  return lamps.size() == 1 ? lamps[0] : mix_emissions(lamps, std::vector<double>(lamps.size(), 1.0));
}

std::vector<double> luminance_shares(std::span<const TabulatedSpectrum> lamps) {
  if (lamps.size() == 1) return {1.0};
  std::vector<double> shares;
  double total = 0.0;
  for (const TabulatedSpectrum& lamp : lamps) total += shares.emplace_back(luminance(lamp));
  for (double& share : shares) share /= total;
  return shares;
}

std::string digest(std::span<const TabulatedSpectrum> lamps) {
  if (lamps.size() == 1) return digest(lamps[0]);
  const std::vector<double> shares = luminance_shares(lamps);
  const auto strongest = std::max_element(shares.begin(), shares.end());

  ContentHash hash;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    for (const char digit : digest(lamps[i])) hash.add_byte(static_cast<unsigned char>(digit));
    hash.add(static_cast<std::uint64_t>(steps_below(shares[i], *strongest)));
  }
  return hash.text();
}

}  // namespace photopic
