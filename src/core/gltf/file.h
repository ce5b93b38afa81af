#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace photopic {

/// A .gltf or .glb file in memory, taken apart but not yet parsed.
struct GltfFile {
  std::filesystem::path path;
  std::vector<char> bytes;
  std::string_view json;           ///< in `bytes`; gone once it has been parsed
  std::span<const std::byte> bin;  ///< in `bytes`; the .glb's binary chunk, empty when there is none
};

/// Reads a file whole.
/// @throws InputError
std::vector<char> read_gltf_bytes(const std::filesystem::path& path);

/// Finds the parts of a file (glTF 2.0, section 4.4).
/// @throws InputError
GltfFile split_gltf(std::vector<char> bytes, const std::filesystem::path& path);

/// The file that a `uri` names, its name percent-encoded (RFC 3986), beside the glTF file; empty for data
/// URIs and what is not local.
std::filesystem::path gltf_uri_file(const std::string& uri, const std::filesystem::path& folder);

/// The bytes of a buffer's or an image's `uri`: a base64 data URI (RFC 2397) or a file as gltf_uri_file finds
/// it.
/// @param byte_length at least so many; nothing: all there are
/// @param where names the buffer or the image in messages
/// @throws InputError
std::vector<std::byte> read_gltf_uri(const std::string& uri, std::optional<std::size_t> byte_length,
                                     const std::filesystem::path& folder, const std::string& where);

}  // namespace photopic
