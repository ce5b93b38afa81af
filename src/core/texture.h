#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/math.h"

namespace photopic {

/// An image's texels as its file holds them, rows from the top: grey, grey and alpha, RGB or RGBA, of 8 or 16
/// bits. Alpha is not multiplied into the colour.
struct TextureImage {
  std::string name;  ///< of its file, or as the glTF calls it
  int width = 0, height = 0, channels = 0;
  std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>> texels;

  bool has_alpha() const { return channels == 2 || channels == 4; }
  bool is_black() const;  ///< all over, whatever its alpha
};

/// A PNG or JPEG in memory whose header has been read and found sensible. At most 2^28 texels, and no more
/// than its bytes can stand for: what is absurd is refused before anything is allocated.
class TextureFile {
 public:
  /// @param bytes must live as long @param where names it in messages: "file#pointer"
  /// @throws InputError
  TextureFile(std::span<const std::byte> bytes, const std::string& where);
  ~TextureFile();
  TextureFile(TextureFile&&) noexcept;
  TextureFile& operator=(TextureFile&&) noexcept;

  std::size_t decoded_bytes() const;
  /// To be called once. @throws InputError when the file is damaged
  TextureImage decode(const std::string& name);

 private:
  struct Input;
  std::unique_ptr<Input> input_;
};

/// How coordinates outside [0, 1] come back into it.
enum class Wrap : std::uint8_t { repeat, mirror, clamp };

/// u' = u.x·u + u.y·v + u.z, v' the same: KHR_texture_transform.
struct UvTransform {
  Vec3f u{1, 0, 0}, v{0, 1, 0};

  Vec2f operator()(Vec2f t) const { return {u.x * t.x + u.y * t.y + u.z, v.x * t.x + v.y * t.y + v.z}; }
};

/// A material's use of an image. Texels are read as they are, or mixed bilinearly; smaller versions for
/// distant surfaces (mip maps) are not needed where many samples average over a pixel.
struct Texture {
  std::shared_ptr<const TextureImage> image;  ///< none: there is no texture
  std::uint8_t uv_set = 0;                    ///< TEXCOORD_n
  UvTransform transform{};
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  bool nearest = false;
  bool srgb = false;  ///< its colours (not alpha) are sRGB-encoded

  explicit operator bool() const { return image != nullptr; }

  /// Linear red, green, blue and alpha, each in [0, 1]; what the image does not hold is a copy of its grey,
  /// or an alpha of 1. (0, 0) is the upper left corner. Coordinates that are not finite read as 0.
  Vec4f operator()(Vec2f uv) const;

  /// Asks memory for what a look-up there will read. Texels are far away: a look-up that has not asked waits
  /// longer than it works.
  void prefetch(Vec2f uv) const;
};

}  // namespace photopic
