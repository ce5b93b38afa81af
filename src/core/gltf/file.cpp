#include "core/gltf/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <system_error>

#include "error.h"
#include "input_file.h"

namespace photopic {
namespace {

constexpr std::uintmax_t kMaxFile = 0xFFFFFFFF;  // what a .glb's header can announce
constexpr std::uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;
constexpr const char *kReexport = "export the file again", *kCheckDisk = "check the disk it is on";
constexpr std::size_t kLongestName = 200;

/// @tparam Byte char or std::byte
/// @param where names the file in messages
template <typename Byte>
std::vector<Byte> read_bytes(const std::filesystem::path& path, const std::string& where,
                             std::size_t at_least, std::size_t at_most) {
  check_readable_file(path, where);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw InputError(where, "cannot be read: " + error.message(), kCheckDisk);
  if (size < at_least) {
    throw InputError(where, fmt::format("the file holds {} bytes where {} are needed", size, at_least),
                     "it is cut short: copy or export it again");
  }
  if (size > kMaxFile && at_most > kMaxFile)
    throw InputError(where, "the file is larger than 4 GiB", "split the scene");
  std::vector<Byte> bytes(std::min<std::uintmax_t>(size, at_most));
  std::ifstream stream(path, std::ios::binary);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()))) {
    throw InputError(where, "cannot be read: " + std::generic_category().message(errno), kCheckDisk);
  }
  return bytes;
}

std::uint32_t word_at(const GltfFile& file, std::size_t offset) {
  std::uint32_t word;
  std::memcpy(&word, file.bytes.data() + offset, sizeof word);
  return word;
}

/// The content tells, not the name. A byte order mark and blanks may come first.
bool looks_like_json(std::span<const char> bytes) {
  const std::string_view text(bytes.data(), bytes.size());
  const std::size_t first = text.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  return first != text.npos && text[first] == '{';
}

/// Bytes beyond the length in the header do no harm; anything short of it does.
void split_glb(GltfFile& file) {
  const std::string where = file.path.string();
  if (file.bytes.size() < 20) throw InputError(where, "the file is too short for a .glb", kReexport);
  if (word_at(file, 4) != 2)
    throw InputError(where, fmt::format(".glb version {} is not 2", word_at(file, 4)), "export glTF 2.0");
  const std::uint64_t length = word_at(file, 8);
  if (length > file.bytes.size()) {
    throw InputError(
        where, fmt::format("the header announces {} bytes, the file holds {}", length, file.bytes.size()),
        "the file is cut short: copy or export it again");
  }
  file.json = {};
  for (std::uint64_t at = 12; at + 8 <= length;) {
    const std::uint64_t size = word_at(file, at);
    const std::uint32_t type = word_at(file, at + 4);
    const bool first = at == 12;
    if (at + 8 + size > length) {
      throw InputError(where, fmt::format("the chunk at byte {} reaches beyond the end of the file", at),
                       kReexport);
    }
    if (first != (type == kJsonChunk)) {
      throw InputError(where, fmt::format("the chunk at byte {} is of the wrong type", at), kReexport);
    }
    if (first) file.json = {file.bytes.data() + at + 8, size};
    if (type == kBinChunk && file.bin.empty())
      file.bin = std::as_bytes(std::span(file.bytes).subspan(at + 8, size));
    at += 8 + (size + 3) / 4 * 4;
  }
  if (file.json.empty()) throw InputError(where, "the .glb holds no JSON chunk", kReexport);
  // Chunks are padded with blanks; some exporters pad with zeros.
  while (file.json.ends_with('\0')) file.json.remove_suffix(1);
}

constexpr std::array<std::int8_t, 256> base64_values() {
  std::array<std::int8_t, 256> values{};
  values.fill(-1);
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < digits.size(); ++i)
    values[static_cast<unsigned char>(digits[i])] = static_cast<std::int8_t>(i);
  return values;
}

std::vector<std::byte> decode_base64(std::string_view text, const std::string& where) {
  static constexpr auto kValues = base64_values();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() * 3 / 4);
  std::uint32_t word = 0;
  int bits = 0;
  for (const char c : text) {
    const int value = kValues[static_cast<unsigned char>(c)];
    if (value < 0) throw InputError(where, "the data URI holds a character that is not base64", kReexport);
    word = word << 6 | static_cast<std::uint32_t>(value);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<std::byte>(word >> bits & 0xFF));
  }
  return bytes;
}

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string decode_percent(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool coded =
        text[i] == '%' && i + 2 < text.size() && hex_value(text[i + 1]) >= 0 && hex_value(text[i + 2]) >= 0;
    decoded += coded ? static_cast<char>(hex_value(text[i + 1]) * 16 + hex_value(text[i + 2])) : text[i];
    if (coded) i += 2;
  }
  return decoded;
}

}  // namespace

std::vector<char> read_gltf_bytes(const std::filesystem::path& path) {
  return read_bytes<char>(path, path.string(), 1, SIZE_MAX);
}

GltfFile split_gltf(std::vector<char> bytes, const std::filesystem::path& path) {
  GltfFile file{.path = path, .bytes = std::move(bytes), .json = {}, .bin = {}};
  const bool glb = file.bytes.size() >= 4 && word_at(file, 0) == kMagic;
  if (!glb && !looks_like_json(file.bytes))
    throw InputError(path.string(), "this is not a glTF file", "export the scene as .gltf or .glb");
  file.json = {file.bytes.data(), file.bytes.size()};
  if (glb) split_glb(file);
  return file;
}

std::filesystem::path gltf_uri_file(const std::string& uri, const std::filesystem::path& folder) {
  const auto is_control = [](unsigned char c) { return c < 32 || c == 127; };
  const std::string decoded_uri = decode_percent(uri);
  if (uri.starts_with("data:") || uri.find("://") != std::string::npos) return {};
  if (std::ranges::any_of(decoded_uri, is_control)) return {};
  // A name may hold a literal per cent sign that its exporter forgot to encode.
  const std::filesystem::path decoded = folder / decoded_uri, literal = folder / uri;
  std::error_code error;
  const bool as_written = !std::filesystem::exists(decoded, error) && std::filesystem::exists(literal, error);
  return as_written ? literal : decoded;
}

std::vector<std::byte> read_gltf_uri(const std::string& uri, std::optional<std::size_t> byte_length,
                                     const std::filesystem::path& folder, const std::string& where) {
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos || !uri.substr(0, comma).ends_with(";base64")) {
      throw InputError(where, "the data URI is not in base64", kReexport);
    }
    std::vector<std::byte> bytes = decode_base64(std::string_view(uri).substr(comma + 1), where);
    if (bytes.size() >= byte_length.value_or(1)) return bytes;
    throw InputError(
        where,
        fmt::format("the data URI holds {} bytes, byteLength is {}", bytes.size(), byte_length.value_or(1)),
        kReexport);
  }
  const std::filesystem::path file = gltf_uri_file(uri, folder);
  if (file.empty())
    throw InputError(where, "the uri is not a local file", "download it beside the glTF file");
  const std::string named = fmt::format("{}: \"{}\"", where, file.string().substr(0, kLongestName));
  return read_bytes<std::byte>(file, named, byte_length.value_or(1), byte_length.value_or(SIZE_MAX));
}

}  // namespace photopic
