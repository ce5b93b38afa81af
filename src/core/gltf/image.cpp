#include "core/gltf/image.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <optional>

#include "core/quiet_stderr.h"
#include "error.h"

namespace photopic {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{4} << 30;

/// An image's file in memory, and its header read.
struct OpenImage {
  std::vector<std::byte> storage;
  std::optional<TextureFile> file;
  std::string name;
};

std::span<const std::byte> view_bytes(const GltfDocument& document, const GltfImage& image,
                                      const std::string& pointer) {
  const auto& view = document.model.bufferViews[static_cast<std::size_t>(image.buffer_view)];
  const auto bytes = document.buffers[static_cast<std::size_t>(view.buffer)];
  if (bytes.empty()) document.fail(pointer + "/bufferView", "its buffer has no bytes");
  return bytes.subspan(view.byteOffset, view.byteLength);
}

OpenImage open_image(const GltfDocument& document, int index) {
  const GltfImage& image = document.images[static_cast<std::size_t>(index)];
  const std::string pointer = fmt::format("/images/{}", index);
  const std::string where = document.file.path.string() + "#" + pointer;
  const bool is_data = image.uri.starts_with("data:");
  OpenImage open;
  if (image.buffer_view < 0 && image.uri.empty()) document.fail(pointer, "it has neither uri nor bufferView");
  if (image.buffer_view < 0)
    open.storage = read_gltf_uri(image.uri, std::nullopt, document.folder(), where + "/uri");
  const bool named = image.buffer_view < 0 && !is_data;
  open.name = named ? image.uri : image.name.empty() ? fmt::format("image {}", index) : image.name;
  open.file.emplace(
      image.buffer_view < 0 ? std::span<const std::byte>(open.storage) : view_bytes(document, image, pointer),
      named ? fmt::format("{}/uri: \"{}\"", where, image.uri.substr(0, 200)) : where);
  return open;
}

}  // namespace

std::vector<std::shared_ptr<const TextureImage>> decode_gltf_images(const GltfDocument& document,
                                                                    const std::set<int>& used) {
  if (used.empty()) return {};
  const QuietStderr quiet;
  std::vector<OpenImage> open;
  std::size_t bytes = 0;
  for (const int index : used) {
    open.push_back(open_image(document, index));
    bytes += open.back().file->decoded_bytes();
    if (bytes > kMaxBytes)
      document.fail(fmt::format("/images/{}", index), "the images before it and this take more than 4 GiB",
                    "give smaller images");
  }

  std::vector<TextureImage> decoded(open.size());
  tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t i) {
    decoded[i] = open[i].file->decode(open[i].name);
    open[i] = {};
  });
  std::vector<std::shared_ptr<const TextureImage>> images(document.images.size());
  std::size_t next = 0;
  for (const int index : used)
    images[static_cast<std::size_t>(index)] = std::make_shared<TextureImage>(std::move(decoded[next++]));
  return images;
}

}  // namespace photopic
