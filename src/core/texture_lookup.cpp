#include <array>

#include "core/texture.h"
#include "spectral/color.h"
#include "spectral/float_vectors.h"

namespace photopic {
namespace {

using Texel = Float4;

using Decoded = std::array<float, 256>;

/// What 8 bits stand for: sRGB-encoded, or in proportion.
struct Codes {
  Decoded srgb, linear;
  Codes() {
    for (std::size_t i = 0; i < srgb.size(); ++i) {
      const double value = static_cast<double>(i) / 255.0;
      srgb[i] = static_cast<float>(srgb_decode(value)), linear[i] = static_cast<float>(value);
    }
  }
};
const Codes kCodes;

/// Texels of one type, how their colours are decoded once known.
class Texels8 {
 public:
  Texels8(const std::uint8_t* texels, bool srgb)
      : texels_(texels), colors_((srgb ? kCodes.srgb : kCodes.linear).data()) {}
  float color(std::size_t i) const { return colors_[texels_[i]]; }
  float alpha(std::size_t i) const { return kCodes.linear[texels_[i]]; }

 private:
  const std::uint8_t* texels_;
  const float* colors_;
};

class Texels16 {
 public:
  Texels16(const std::uint16_t* texels, bool srgb) : texels_(texels), srgb_(srgb) {}
  float color(std::size_t i) const { return srgb_ ? static_cast<float>(srgb_decode(alpha(i))) : alpha(i); }
  float alpha(std::size_t i) const { return static_cast<float>(texels_[i]) * (1.0f / 65535.0f); }

 private:
  const std::uint16_t* texels_;
  bool srgb_;
};

/// @param i first_number
template <typename Texels>
Texel fetch(const Texels& texels, std::size_t i, int channels) {
  if (channels < 3) {
    const float grey = texels.color(i);
    return Texel{grey, grey, grey, channels == 2 ? texels.alpha(i + 1) : 1.0f};
  }
  return Texel{texels.color(i), texels.color(i + 1), texels.color(i + 2),
               channels == 4 ? texels.alpha(i + 3) : 1.0f};
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

/// Index of a texel's first number.
std::size_t first_number(const TextureImage& image, int x, int y) {
  const auto place =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
  return place * static_cast<std::size_t>(image.channels);
}

Texel mix(Texel a, Texel b, float f) {
  return a + (b - a) * f;
}

template <typename Texels>
Texel look_up(const Texture& texture, const Texels& texels, Vec2f at) {
  const TextureImage& image = *texture.image;
  const auto texel = [&](int x, int y) { return fetch(texels, first_number(image, x, y), image.channels); };
  if (texture.nearest)
    return texel(nearest_texel(at.x, texture.wrap_u, image.width),
                 nearest_texel(at.y, texture.wrap_v, image.height));
  const Neighbours x = neighbours(at.x, texture.wrap_u, image.width),
                   y = neighbours(at.y, texture.wrap_v, image.height);
  return mix(mix(texel(x.first, y.first), texel(x.second, y.first), x.fraction),
             mix(texel(x.first, y.second), texel(x.second, y.second), x.fraction), y.fraction);
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
  const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&image->texels);
  const Texel t = bytes ? look_up(*this, Texels8(bytes->data(), srgb), at)
                        : look_up(*this, Texels16(std::get<1>(image->texels).data(), srgb), at);
  return {t[0], t[1], t[2], t[3]};
}

void Texture::prefetch(Vec2f uv) const {
  const Vec2f at = transform(uv);
  const int x = neighbours(at.x, wrap_u, image->width).first;
  const Neighbours y = neighbours(at.y, wrap_v, image->height);
  for (const int row : {y.first, y.second}) {
    const std::size_t i = first_number(*image, x, row);
    __builtin_prefetch(std::visit([i](const auto& t) -> const void* { return t.data() + i; }, image->texels));
  }
}

}  // namespace photopic
