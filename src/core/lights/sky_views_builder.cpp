#include "core/lights/sky_views_builder.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace photopic {
namespace {

constexpr double kGlimpses = 64;  ///< of each place, on average

/// A branch has places enough to tell what others near them see; a split sets this share of the light apart.
constexpr std::size_t kLeastPlaces = 16;
constexpr std::int32_t kMostLevels = 8;
constexpr double kLeastGain = 0.02;

/// What the branch above sees counts as much as these places; and what is seen where no place is known.
constexpr double kPriorPlaces = 3.0, kMeanSquareCosine = 1.0 / 3.0;

/// The share of directions that is drawn as if all were seen, since places are but samples.
constexpr double kUnlearned = 0.05;

/// Steps by this share of the whole are spread evenly, however many there are.
constexpr double kGoldenRatio = 0.6180339887498949;

/// The factor on weights that makes them, at most 1 each, add up to `count`; no fewer are above 0.
double common_factor(std::vector<double> weights, double count) {
  std::ranges::sort(weights, std::greater());
  double rest = std::accumulate(weights.begin(), weights.end(), 0.0), factor = 0.0;
  for (const double w : weights) {
    if (w * count < rest) return std::max(factor, count / rest);
    rest -= w, count -= 1.0;  // this one is sure
    if (w > 0.0) factor = 1.0 / w;
  }
  return factor;
}

/// Running sums of the probabilities with which a place looks at each part of the sky.
std::vector<double> inclusion_probabilities(std::span<const double> fluxes) {
  std::vector<double> weights;
  for (const double flux : fluxes) weights.push_back(std::sqrt(flux));
  const auto lit = std::ranges::count_if(fluxes, [](double flux) { return flux > 0.0; });
  const double factor = common_factor(weights, std::min(static_cast<double>(lit), kGlimpses));
  double sum = 0.0;
  for (double& w : weights) w = sum += std::min(w * factor, 1.0);
  return weights;
}

}  // namespace

SkyViews::SkyViews(const Sky& sky, std::span<const LightReference> places, const Survey& survey) {
  Builder(*this, sky, places, survey);
}

SkyViews::Builder::Builder(SkyViews& views, const Sky& sky, std::span<const LightReference> places,
                           const Survey& survey)
    : views_(views), sky_(sky), fluxes_(sky.fluxes()), glimpses_(places.size()) {
  for (const LightReference& place : places) keys_.push_back(key_of(place));
  const std::vector<double> ends = inclusion_probabilities(fluxes_);
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t i) { look_around(i, ends, survey); });
  std::vector<std::uint32_t> all(places.size());
  std::iota(all.begin(), all.end(), 0u);
  build(all, Squares(fluxes_.size(), places.empty() ? kMeanSquareCosine : 0.0), 0);
}

/// Each place looks at some parts of the sky, the bright ones more often: systematic sampling.
void SkyViews::Builder::look_around(std::size_t place, std::span<const double> ends, const Survey& survey) {
  std::vector<Glimpse>& glimpses = glimpses_[place];
  double wanted = std::fmod(kGoldenRatio * static_cast<double>(place), 1.0);
  for (std::uint32_t source = 0; source < ends.size(); ++source)
    if (ends[source] > wanted) glimpses.push_back({source, 0.0f}), wanted += 1.0;
  survey(place, glimpses);
}

/// @param prior what is to be expected: what the places of the branch above see
/// @return the number of the branch
std::int32_t SkyViews::Builder::build(std::span<std::uint32_t> places, const Squares& prior,
                                      std::int32_t level) {
  const auto node = static_cast<std::int32_t>(views_.axis_.size());
  const auto i = static_cast<std::size_t>(node);
  views_.axis_.push_back(0), views_.split_.push_back(0.0f), views_.view_.push_back(0);
  views_.below_.push_back(node), views_.above_.push_back(node);
  views_.levels_ = std::max(views_.levels_, level);

  const Sums sums = sums_of(places);
  const Squares squares = sums.means(prior);
  double total = 0.0;
  for (std::size_t k = 0; k < fluxes_.size(); ++k) total += light(squares, k);
  const Split split = level < kMostLevels ? best_split(places, sums, squares) : Split{};
  if (!(split.gain > kLeastGain * total)) {
    views_.view_[i] = add_view(places, squares);
    return node;
  }
  const auto above = std::ranges::partition(
      places, [&](std::uint32_t place) { return keys_[place][split.axis] < split.at; });
  const std::size_t count = places.size() - above.size();
  views_.axis_[i] = static_cast<std::int32_t>(split.axis), views_.split_[i] = split.at;
  views_.below_[i] = build(places.first(count), squares, level + 1);
  views_.above_[i] = build(places.subspan(count), squares, level + 1);
  return node;
}

void SkyViews::Builder::Sums::add(std::span<const Glimpse> glimpses) {
  for (const Glimpse& g : glimpses) of[g.source].square += g.seen * g.seen, of[g.source].count += 1.0f;
}

SkyViews::Builder::Squares SkyViews::Builder::Sums::means(const Squares& prior) const {
  Squares result(of.size());
  for (std::size_t k = 0; k < of.size(); ++k)
    result[k] = (double{std::max(of[k].square, 0.0f)} + kPriorPlaces * prior[k]) /
                (double{of[k].count} + kPriorPlaces);
  return result;
}

SkyViews::Builder::Sums SkyViews::Builder::sums_of(std::span<const std::uint32_t> places) const {
  Sums sums{std::vector<Sums::Sum>(fluxes_.size())};
  for (const std::uint32_t place : places) sums.add(glimpses_[place]);
  return sums;
}

/// What arrives from a part of the sky as the root mean square, by which it is chosen best where one
/// probability must serve all places [lx].
double SkyViews::Builder::light(const Squares& squares, std::size_t source) const {
  return fluxes_[source] * std::sqrt(squares[source]);
}

/// The plane through the middle that sets most light apart. @param sums, prior of these places
SkyViews::Builder::Split SkyViews::Builder::best_split(std::span<const std::uint32_t> places,
                                                       const Sums& sums, const Squares& prior) const {
  if (places.size() < 2 * kLeastPlaces) return {};
  std::array<Split, 6> splits;
  tbb::parallel_for(std::size_t{0}, splits.size(), [&](std::size_t axis) {
    Split& split = splits[axis];
    split = {axis, middle(places, axis)};
    Sums below{std::vector<Sums::Sum>(fluxes_.size())}, above = sums;
    std::size_t count = 0;
    for (const std::uint32_t place : places)
      if (keys_[place][axis] < split.at) below.add(glimpses_[place]), ++count;
    if (std::min(count, places.size() - count) < kLeastPlaces) return;
    for (std::size_t k = 0; k < fluxes_.size(); ++k)
      above.of[k].square -= below.of[k].square, above.of[k].count -= below.of[k].count;
    const Squares a = below.means(prior), b = above.means(prior);
    for (std::size_t k = 0; k < fluxes_.size(); ++k) split.gain += std::abs(light(a, k) - light(b, k));
  });
  return std::ranges::max(splits, {}, &Split::gain);
}

/// Where about half of the places lie below, none upon it.
float SkyViews::Builder::middle(std::span<const std::uint32_t> places, std::size_t axis) const {
  std::vector<float> values;
  for (const std::uint32_t place : places) values.push_back(keys_[place][axis]);
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, half);
  // Many may have the same, as normals have: then beside all of these, where more lie.
  const float value = *half;
  const auto below = std::ranges::count_if(values, [=](float v) { return v < value; }),
             above = std::ranges::count_if(values, [=](float v) { return v > value; });
  float neighbour = value;
  for (const float v : values)
    if (below >= above ? v < value && (neighbour == value || v > neighbour)
                       : v > value && (neighbour == value || v < neighbour))
      neighbour = v;
  return std::midpoint(std::min(value, neighbour), std::max(value, neighbour));
}

std::int32_t SkyViews::Builder::add_view(std::span<const std::uint32_t> places, const Squares& squares) {
  Light result;
  for (const std::uint32_t place : places)
    for (const Glimpse& g : glimpses_[place]) result.any |= g.seen > 0.0f;
  result.any |= places.empty();
  const std::size_t tiles = sky_.tiles();
  for (std::size_t k = 0; k < fluxes_.size(); ++k)
    (k < tiles ? result.environment : result.directional) += light(squares, k);
  views_.lights_.push_back(result);
  if (sky_.environment) {
    const double flux = sky_.environment->flux_density();
    const double learned = result.environment > 0.0 ? (1.0 - kUnlearned) / result.environment : 0.0,
                 unlearned = flux > 0.0 ? kUnlearned / flux : 0.0;
    std::vector<double> weights(tiles);
    for (std::size_t k = 0; k < tiles; ++k) weights[k] = learned * light(squares, k) + unlearned * fluxes_[k];
    views_.tiles_.add(weights, Environment::kTileColumns);
  }
  return static_cast<std::int32_t>(views_.lights_.size() - 1);
}

}  // namespace photopic
