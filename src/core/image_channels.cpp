#include "core/image_channels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

namespace photopic {
namespace {

constexpr std::size_t kMostListed = 8;

using Names = std::vector<std::string>;

std::optional<std::size_t> find(const Names& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

/// Channels called by the prefix and one of three letters each.
std::optional<ColorChannels> find_three(const Names& names, const std::string& prefix,
                                        std::string_view letters, ColorSpace space) {
  ColorChannels channels{.index = {}, .space = space};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto index = find(names, prefix + letters[c]);
    if (!index) return std::nullopt;
    channels.index[c] = *index;
  }
  return channels;
}

std::optional<ColorChannels> find_rgb(const Names& names, const std::string& prefix) {
  const auto upper = find_three(names, prefix, "RGB", ColorSpace::linear_srgb);
  return upper ? upper : find_three(names, prefix, "rgb", ColorSpace::linear_srgb);
}

/// "view." of "view.R", for each that has R, G and B.
Names colored_layers(const Names& names) {
  Names layers;
  for (const std::string& name : names) {
    const std::string prefix = name.substr(0, name.size() - 1);
    if ((name.ends_with(".R") || name.ends_with(".r")) && find_rgb(names, prefix)) layers.push_back(prefix);
  }
  return layers;
}

std::optional<ColorChannels> find_layer(const Names& names) {
  const Names layers = colored_layers(names);
  Names combined;
  std::ranges::copy_if(layers, std::back_inserter(combined), [](const std::string& layer) {
    return layer == "Combined." || layer.ends_with(".Combined.");
  });
  if (combined.size() == 1) return find_rgb(names, combined[0]);
  if (layers.size() == 1) return find_rgb(names, layers[0]);
  return std::nullopt;
}

std::optional<ColorChannels> find_grey(const Names& names) {
  const auto y = find(names, "Y");
  const std::size_t others = find(names, "A") ? 1 : 0;
  if (!y || names.size() != 1 + others) return std::nullopt;
  return ColorChannels{.index = {*y, *y, *y}};
}

}  // namespace

std::optional<ColorChannels> find_color_channels(const std::vector<std::string>& names) {
  if (const auto rgb = find_rgb(names, "")) return rgb;
  if (const auto xyz = find_three(names, "", "XYZ", ColorSpace::xyz)) return xyz;
  if (const auto layer = find_layer(names)) return layer;
  return find_grey(names);
}

std::string list_channels(const std::vector<std::string>& names) {
  const std::size_t listed = std::min(names.size(), kMostListed);
  std::string text =
      fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(listed), ", "));
  if (names.size() > listed) text += fmt::format(" and {} more", names.size() - listed);
  return text;
}

}  // namespace photopic
