#include "core/bsdf/bounce_cosines.h"

#include <bit>

#include "core/bsdf/fresnel.h"

namespace photopic {
namespace {

/// Light and its mean cosine by the square root of the cosine, summed from 0.
class CosineSums {
 public:
  explicit CosineSums(const VisibleNormals::Bounces& bounces) {
    bounces.for_each([&](float cosine, float kept) {
      const auto bin = static_cast<std::size_t>(kBins * safe_sqrt(cosine));
      Sum& sum = sums_[std::min<std::size_t>(bin, kBins - 1) + 1];
      sum.kept += kept, sum.moment += double{kept} * cosine;
    });
    for (std::size_t i = 1; i <= kBins; ++i)
      sums_[i].kept += sums_[i - 1].kept, sums_[i].moment += sums_[i - 1].moment;
  }

  double kept() const { return sums_[kBins].kept; }
  double moment() const { return sums_[kBins].moment; }

  struct Quantile {
    double cosine, moment;  ///< the latter of all below
  };
  Quantile quantile(double level) const {
    const double target = level * kept();
    const auto above = std::ranges::lower_bound(sums_.begin() + 1, sums_.end() - 1, target, {}, &Sum::kept);
    const Sum &low = above[-1], &high = *above;
    const double t = (target - low.kept) / (high.kept - low.kept);
    const double root = (static_cast<double>(above - sums_.begin()) - 1.0 + t) / kBins;
    return {root * root, low.moment + t * (high.moment - low.moment)};
  }

 private:
  static constexpr std::size_t kBins = 1024;
  struct Sum {
    double kept = 0.0, moment = 0.0;
  };
  std::array<Sum, kBins + 1> sums_{};
};

using Numbers = std::array<float, kLanes>;

// Between quantiles cosines are spread evenly. A hat's share is the second difference, at its node and both
// neighbours, of the twofold integral of their density.
void add_rest(Lanes quantiles, float kept, FresnelAlbedo::Weights& weights) {
  constexpr int kNodes = FresnelAlbedo::kNodes, kParts = BounceCosines::kParts;
  static_assert(kNodes + 2 <= kLanes);
  constexpr auto kShare = [] {
    std::array<float, kParts> share{};
    for (int k = 0; k < kParts; ++k)
      share[static_cast<std::size_t>(k)] = BounceCosines::level(k + 1) - BounceCosines::level(k);
    return share;
  }();
  constexpr Lanes kIndex{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  const Lanes next =
      __builtin_shufflevector(quantiles, quantiles, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 15);
  const Lanes widths = max(next - quantiles, Lanes{} + 1e-5f);
  const auto low = std::bit_cast<Numbers>(quantiles), width = std::bit_cast<Numbers>(widths),
             half = std::bit_cast<Numbers>(0.5f / widths);
  const Lanes node = kIndex / static_cast<float>(kNodes + 1);
  Lanes below{};
  for (std::size_t k = 0; k < kParts; ++k) {
    const Lanes x = max(node - low[k], Lanes{}), within = min(x, Lanes{} + width[k]);
    below += kShare[k] * (within * within * half[k] + (x - within));
  }
  const auto integral = std::bit_cast<Numbers>(below);
  for (std::size_t k = 0; k < kNodes; ++k)
    weights.rest[k] = kept * (kNodes + 1) * (integral[k] - 2.0f * integral[k + 1] + integral[k + 2]);
}

}  // namespace

// The outermost are such that the outer parts' means are right.
BounceCosines BounceCosines::of(const VisibleNormals::Bounces& bounces) {
  BounceCosines result;
  const CosineSums sums(bounces);
  const auto put = [&](int k, double cosine) {
    result.values[k] = static_cast<float>(std::clamp(cosine, 0.0, 1.0));
  };
  for (int k = 1; k < kParts; ++k) put(k, sums.quantile(level(k)).cosine);
  const auto first = sums.quantile(level(1)), last = sums.quantile(level(kParts - 1));
  const double tail = level(1) * sums.kept();
  put(0, 2.0 * first.moment / tail - first.cosine);
  put(kParts, 2.0 * (sums.moment() - last.moment) / tail - last.cosine);

  double schlick = 0.0;
  bounces.for_each([&](float cosine, float kept) { schlick += double{kept} * schlick_weight(cosine); });
  put(kSchlick, 1.0 - std::pow(schlick / sums.kept(), 0.2));
  result.values[kMissing] = std::sqrt(bounces.missing);
  return result;
}

FresnelAlbedo::Weights BounceCosines::weights(bool rest) const {
  FresnelAlbedo::Weights weights;
  weights.missing = sqr(values[kMissing]);
  const float kept = 1.0f - weights.missing;
  weights.f90 = kept * schlick_weight(values[kSchlick]);
  weights.f0 = kept - weights.f90;
  if (rest) add_rest(values, kept, weights);
  return weights;
}

}  // namespace photopic
