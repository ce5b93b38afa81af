#include "core/rough_glass.h"

#include <algorithm>
#include <vector>

#include "core/microfacet.h"

namespace photopic {
namespace {

constexpr float kLeastStep = 0.01f;  // between two ratios of the table: finer makes no difference

/// Ratios of indices, each above 1, that the glass has to a medium around it (null: vacuum).
void add_ratios(std::vector<float>& ratios, const Surface& glass, const Surface* around) {
  const bool disperses = glass.disperses() || (around && around->disperses());
  const int last = disperses ? 4 : 0;
  for (int i = 0; i <= last; ++i) {
    const auto lambda = static_cast<float>(kLambdaMin + (kLambdaMax - kLambdaMin) * i / 4);
    const float ratio = glass.index(lambda) / (around ? around->index(lambda) : 1.0f);
    if (!is_index_matched(ratio))
      ratios.push_back(std::max(ratio, 1.0f / ratio));
    else if (disperses)
      ratios.push_back(kLeastRoughIor);
  }
}

/// Rising, without what is as good as repeated; the ends stay.
void thin_out(std::vector<float>& ratios) {
  if (ratios.empty()) return;
  std::ranges::sort(ratios);
  const float highest = ratios.back();
  std::size_t kept = 1;
  for (const float r : ratios)
    if (r >= ratios[kept - 1] + kLeastStep) ratios[kept++] = r;
  ratios.resize(kept);
  if (ratios.back() < highest) ratios.push_back(highest);
}

bool is_rough_glass(const Surface& s) {
  return s.encloses && sqr(s.roughness) >= kSmoothAlpha;
}

bool may_surround(const Surface& around, const Surface& glass) {
  return &around != &glass && around.encloses && around.priority <= glass.priority;
}

void prepare(Surface& glass, std::span<Surface* const> others) {
  std::vector<float> ratios;
  add_ratios(ratios, glass, nullptr);
  for (const Surface* around : others)
    if (may_surround(*around, glass)) add_ratios(ratios, glass, around);
  thin_out(ratios);
  if (ratios.empty()) return;  // where there is no change of index, nothing scatters
  const bool varies = glass.textures && glass.textures->metallic_roughness;
  const bool has_film = glass.extensions && glass.extensions->iridescence > 0.0f;
  const GlassAlbedo::Range roughness{varies ? 0.0f : glass.roughness, glass.roughness};
  glass.glass_albedo = std::make_shared<const GlassAlbedo>(std::move(ratios), roughness, has_film);
}

}  // namespace

void prepare_rough_glass(std::span<Surface* const> surfaces) {
  for (Surface* s : surfaces)
    if (is_rough_glass(*s)) prepare(*s, surfaces);
}

}  // namespace photopic
