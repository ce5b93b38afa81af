#include "support/png.h"

namespace photopic::test {
namespace {

std::string big_endian(std::uint32_t x) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(x >> shift & 0xff);
  return bytes;
}

std::uint32_t crc(const std::string& bytes) {
  std::uint32_t c = ~0u;
  for (const char byte : bytes) {
    c ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) c = c & 1 ? 0xedb88320u ^ (c >> 1) : c >> 1;
  }
  return ~c;
}

std::string chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(crc(type + data));
}

/// RFC 1950 and 1951: one stored block after another.
std::string stored(const std::string& data) {
  std::string out = "\x78\x01";
  std::uint32_t a = 1, b = 0;
  for (const char byte : data) a = (a + static_cast<unsigned char>(byte)) % 65521, b = (b + a) % 65521;
  for (std::size_t at = 0; at < data.size() || at == 0; at += 65535) {
    const std::string block = data.substr(at, 65535);
    const auto size = static_cast<std::uint32_t>(block.size());
    out += at + 65535 >= data.size() ? '\x01' : '\x00';
    for (const std::uint32_t word : {size, ~size}) {
      out += static_cast<char>(word & 0xff);
      out += static_cast<char>(word >> 8 & 0xff);
    }
    out += block;
  }
  return out + big_endian(b << 16 | a);
}

}  // namespace

std::string make_png(int width, int height, PngColor color, const std::vector<int>& samples, int depth,
                     const std::vector<int>& palette) {
  std::string header =
      big_endian(static_cast<std::uint32_t>(width)) + big_endian(static_cast<std::uint32_t>(height));
  header += {static_cast<char>(depth), static_cast<char>(color), 0, 0, 0};
  std::string rows, colors;
  const std::size_t per_row = samples.size() / static_cast<std::size_t>(height);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i % per_row == 0) rows += '\0';  // no filter
    if (depth == 16) rows += static_cast<char>(samples[i] >> 8);
    rows += static_cast<char>(samples[i]);
  }
  for (const int c : palette) colors += static_cast<char>(c);
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + (palette.empty() ? "" : chunk("PLTE", colors)) +
         chunk("IDAT", stored(rows)) + chunk("IEND", "");
}

}  // namespace photopic::test
