#include "core/rough_glass.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "core/bsdf/albedo_axes.h"
#include "core/bsdf/microfacet.h"
#include "core/framing.h"

namespace photopic {
namespace {

constexpr float kLeastStep = 0.01f;  // between two ratios of the table: finer makes no difference
constexpr float kBeside = 1e-5f;     // of coordinates: more than solids that count as touching are apart

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

/// Around all that is of each solid, in the world; empty for other surfaces.
std::vector<Boxf> boxes_of_solids(const Geometry& geometry, std::span<const Surface> surfaces) {
  std::vector<Boxf> of_shape(geometry.shapes.size()), boxes(surfaces.size());
  for (std::size_t s = 0; s < of_shape.size(); ++s)
    if (surfaces[geometry.shapes[s].material].encloses) of_shape[s] = box_of(geometry, geometry.shapes[s]);
  for (std::size_t s = 0; s < geometry.baked_shape_count(); ++s)
    boxes[geometry.shapes[s].material].add(of_shape[s]);
  for (const Instance& instance : geometry.instances) {
    const Prototype& p = geometry.prototypes[instance.prototype];
    for (std::size_t s = p.first_shape; s < p.first_shape + p.shape_count; ++s)
      boxes[geometry.shapes[s].material].add(image_of(of_shape[s], instance.to_world));
  }
  for (Boxf& box : boxes)
    if (!box.is_empty()) box.grow(kBeside * std::max(max_abs(box.low), max_abs(box.high)));
  return boxes;
}

/// Makes tables, each once.
class Tables {
 public:
  /// @param ratios rising, at least one
  std::shared_ptr<const GlassAlbedo> find(const Surface& glass, const std::vector<float>& ratios) {
    const bool varies = glass.textures && glass.textures->metallic_roughness;
    const bool has_film = glass.extensions && glass.extensions->iridescence > 0.0f;
    const float high = glass.roughness, low = varies ? std::min(kSmoothRoughness, high) : high;
    auto& table = made_[{ratios, low, high, has_film}];
    if (!table) table = std::make_shared<const GlassAlbedo>(ratios, GlassAlbedo::Range{low, high}, has_film);
    return table;
  }

 private:
  std::map<std::tuple<std::vector<float>, float, float, bool>, std::shared_ptr<const GlassAlbedo>> made_;
};

}  // namespace

void prepare_rough_glass(const std::vector<bool>& used, std::span<Surface> surfaces,
                         const Geometry& geometry) {
  if (std::ranges::none_of(surfaces, is_rough_glass)) return;
  const std::vector<Boxf> boxes = boxes_of_solids(geometry, surfaces);
  Tables tables;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    Surface& glass = surfaces[i];
    if (!used[i] || !is_rough_glass(glass)) continue;
    std::vector<float> ratios;
    add_ratios(ratios, glass, nullptr);
    for (std::size_t k = 0; k < surfaces.size(); ++k)
      if (may_surround(surfaces[k], glass) && boxes[k].overlaps(boxes[i]))
        add_ratios(ratios, glass, &surfaces[k]);
    thin_out(ratios);
    if (!ratios.empty()) glass.glass_albedo = tables.find(glass, ratios);  // else there is nothing to refract
  }
}

}  // namespace photopic
