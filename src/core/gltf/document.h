#pragma once

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/gltf/file.h"

namespace photopic {

/// An element of "images".
struct GltfImage {
  std::string uri;       ///< empty where a bufferView holds the file
  int buffer_view = -1;  ///< or −1
  std::string name;
};

/// A glTF file whose structure has been checked: every index in `model` is valid, every accessor lies inside
/// its view and every view inside its buffer. (`model.buffers`, `model.images` and animations are left
/// empty.)
struct GltfDocument {
  GltfFile file;
  tinygltf::Model model;
  std::vector<std::vector<std::byte>> storage;
  std::vector<std::span<const std::byte>>
      buffers;  ///< at least byteLength long, or empty where the file gives no bytes
  std::vector<std::filesystem::path>
      named_files;  ///< by buffers, images and extras' spectra; some may not exist

  std::set<std::string> extensions;  ///< those declared and those that objects have
  std::size_t animation_count = 0;
  std::size_t double_transforms = 0;  ///< nodes with a matrix, which `model` has, beside other members

  std::vector<GltfImage> images;

  std::filesystem::path folder() const { return file.path.parent_path(); }

  /// @throws InputError "file#pointer: problem; remedy"
  [[noreturn]] void fail(const std::string& pointer, const std::string& problem,
                         const std::string& remedy = "correct it or export the file again") const;
};

/// Checks and parses a .gltf or .glb and reads its buffers.
/// @param bytes the file's
/// @throws InputError
GltfDocument read_gltf_document(std::vector<char> bytes, const std::filesystem::path& path);

}  // namespace photopic
