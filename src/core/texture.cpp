#include "core/texture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "error.h"

namespace photopic {
namespace {

constexpr std::uint64_t kMaxTexels = std::uint64_t{1} << 28;

/// What a byte can stand for at most: deflate packs 1032 bytes into one (RFC 1951: a symbol of a bit or less
/// for 258), and a byte holds 8 texels of a bitmap.
constexpr std::uint64_t kMaxTexelsPerByte = 1032 * 8;

/// Whether the chunks reach to the last, IEND (ISO/IEC 15948, section 5.3).
bool png_is_whole(std::span<const std::byte> bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    std::uint64_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | std::to_integer<std::uint64_t>(bytes[at + i]);
    if (length > bytes.size() - at - 12) return false;
    if (std::memcmp(bytes.data() + at + 4, "IEND", 4) == 0) return true;
    at += length + 12;
  }
  return false;
}

/// OpenImageIO's name of the format, by the file's first bytes.
const char* format_of(std::span<const std::byte> bytes, const std::string& where) {
  const auto starts = [&](std::string_view magic, std::size_t at = 0) {
    return bytes.size() >= at + magic.size() &&
           std::memcmp(bytes.data() + at, magic.data(), magic.size()) == 0;
  };
  if (starts("\x89PNG\r\n\x1a\n")) {
    if (!png_is_whole(bytes)) throw InputError(where, "the PNG is cut short", "copy or export it again");
    return "png";
  }
  if (starts("\xff\xd8\xff")) return "jpeg";
  const char* found = starts("RIFF") && starts("WEBP", 8) ? "a WebP image"
                      : starts("\xabKTX 20\xbb")          ? "a KTX2 image"
                                                          : "neither a PNG nor a JPEG";
  throw InputError(where, fmt::format("the file is {}", found), "convert it to PNG or JPEG");
}

}  // namespace

struct TextureFile::Input {
  std::string where;
  OIIO::Filesystem::IOMemReader memory;
  std::unique_ptr<OIIO::ImageInput> image;
  OIIO::ImageSpec spec;

  Input(std::span<const std::byte> bytes, std::string name)
      : where(std::move(name)), memory(const_cast<std::byte*>(bytes.data()), bytes.size()) {}

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw InputError(where, problem, remedy);
  }

  bool wide() const { return spec.format.basesize() > 1; }
  std::uint64_t texels() const {
    return static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height);
  }

  template <typename T>
  std::vector<T> read(OIIO::TypeDesc type) {
    std::vector<T> texels(this->texels() * static_cast<std::size_t>(spec.nchannels));
    if (!image->read_image(0, 0, 0, spec.nchannels, type, texels.data()))
      fail("the image is damaged: " + without_controls(image->geterror()), "export it again");
    return texels;
  }
};

TextureFile::TextureFile(std::span<const std::byte> bytes, const std::string& where)
    : input_(std::make_unique<Input>(bytes, where)) {
  Input& in = *input_;
  const char* format = format_of(bytes, where);
  in.image = OIIO::ImageInput::create(format);
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;
  if (!in.image || !in.image->set_ioproxy(&in.memory))
    in.fail(fmt::format("OpenImageIO cannot read {} from memory", format), "install another version of it");
  if (!in.image->open(format, in.spec, config))
    in.fail("the image cannot be read: " + without_controls(in.image->geterror()), "export it again");

  if (in.spec.width < 1 || in.spec.height < 1 || in.texels() > kMaxTexels)
    in.fail(fmt::format("{} x {} texels cannot be read", in.spec.width, in.spec.height),
            "give a smaller image");
  if (in.texels() > kMaxTexelsPerByte * bytes.size())
    in.fail(fmt::format("{} bytes cannot hold {} x {} texels", bytes.size(), in.spec.width, in.spec.height),
            "export it again");
  if (in.spec.nchannels < 1 || in.spec.nchannels > 4)
    in.fail(fmt::format("an image of {} channels cannot be read", in.spec.nchannels), "convert it to RGB");
}

TextureFile::~TextureFile() = default;
TextureFile::TextureFile(TextureFile&&) noexcept = default;
TextureFile& TextureFile::operator=(TextureFile&&) noexcept = default;

std::size_t TextureFile::decoded_bytes() const {
  return input_->texels() * static_cast<std::size_t>(input_->spec.nchannels) * (input_->wide() ? 2 : 1);
}

TextureImage TextureFile::decode(const std::string& name) {
  Input& in = *input_;
  TextureImage image{name, in.spec.width, in.spec.height, in.spec.nchannels, {}};
  if (in.wide())
    image.texels = in.read<std::uint16_t>(OIIO::TypeDesc::UINT16);
  else
    image.texels = in.read<std::uint8_t>(OIIO::TypeDesc::UINT8);
  in.image->close();
  return image;
}

}  // namespace photopic
