#include <array>

#include "core/texture.h"
#include "spectral/color.h"

namespace photopic {
namespace {

using Texel = std::array<float, 4>;

const std::array<float, 256>& srgb_decoded() {
  static const auto table = [] {
    std::array<float, 256> t;
    for (std::size_t i = 0; i < t.size(); ++i)
      t[i] = static_cast<float>(srgb_decode(static_cast<double>(i) / 255.0));
    return t;
  }();
  return table;
}

float decode(std::uint8_t code, bool srgb) {
  return srgb ? srgb_decoded()[code] : static_cast<float>(code) * (1.0f / 255.0f);
}
float decode(std::uint16_t code, bool srgb) {
  const float value = static_cast<float>(code) * (1.0f / 65535.0f);
  return srgb ? static_cast<float>(srgb_decode(value)) : value;
}

template <typename T>
Texel fetch(const TextureImage& image, const std::vector<T>& texels, int x, int y, bool srgb) {
  const auto channels = static_cast<std::size_t>(image.channels);
  const T* t = &texels[(static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                        static_cast<std::size_t>(x)) *
                       channels];
  if (channels < 3) {
    const float grey = decode(t[0], srgb);
    return {grey, grey, grey, channels == 2 ? decode(t[1], false) : 1.0f};
  }
  return {decode(t[0], srgb), decode(t[1], srgb), decode(t[2], srgb),
          channels == 4 ? decode(t[3], false) : 1.0f};
}

Texel fetch(const TextureImage& image, int x, int y, bool srgb) {
  if (const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&image.texels))
    return fetch(image, *bytes, x, y, srgb);
  return fetch(image, std::get<std::vector<std::uint16_t>>(image.texels), x, y, srgb);
}

/// Into [0, 1].
float wrapped(float x, Wrap wrap) {
  if (!std::isfinite(x)) return 0.0f;
  if (wrap == Wrap::clamp) return std::clamp(x, 0.0f, 1.0f);
  if (wrap == Wrap::repeat) return x - std::floor(x);
  const float period = x - 2.0f * std::floor(0.5f * x);
  return period > 1.0f ? 2.0f - period : period;
}

/// The two texels of an axis that a coordinate lies between, and how far it is towards the second.
struct Neighbours {
  int first, second;
  float fraction;
};

Neighbours neighbours(float x, Wrap wrap, int size) {
  const float texel = wrapped(x, wrap) * static_cast<float>(size) - 0.5f, below = std::floor(texel);
  const int i = static_cast<int>(below);
  if (wrap == Wrap::repeat) return {i < 0 ? size - 1 : i, i + 1 < size ? i + 1 : 0, texel - below};
  return {std::max(i, 0), std::min(i + 1, size - 1), texel - below};  // a mirror repeats the border too
}

int nearest_texel(float x, Wrap wrap, int size) {
  return std::min(static_cast<int>(wrapped(x, wrap) * static_cast<float>(size)), size - 1);
}

Texel mix(const Texel& a, const Texel& b, float f) {
  Texel t;
  for (std::size_t c = 0; c < 4; ++c) t[c] = a[c] + (b[c] - a[c]) * f;
  return t;
}

Vec4f to_vector(const Texel& t) {
  return {t[0], t[1], t[2], t[3]};
}

}  // namespace

bool TextureImage::is_black() const {
  const auto all = static_cast<std::size_t>(channels), colors = all - (has_alpha() ? 1 : 0);
  return std::visit(
      [&](const auto& t) {
        for (std::size_t i = 0; i < t.size(); ++i)
          if (t[i] != 0 && i % all < colors) return false;
        return true;
      },
      texels);
}

Vec4f Texture::operator()(Vec2f uv) const {
  const Vec2f at = transform(uv);
  const TextureImage& i = *image;
  if (nearest) {
    return to_vector(
        fetch(i, nearest_texel(at.x, wrap_u, i.width), nearest_texel(at.y, wrap_v, i.height), srgb));
  }
  const Neighbours x = neighbours(at.x, wrap_u, i.width), y = neighbours(at.y, wrap_v, i.height);
  const auto row = [&](int line) {
    return mix(fetch(i, x.first, line, srgb), fetch(i, x.second, line, srgb), x.fraction);
  };
  return to_vector(mix(row(y.first), row(y.second), y.fraction));
}

}  // namespace photopic
