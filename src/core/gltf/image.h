#pragma once

#include <memory>
#include <set>
#include <vector>

#include "core/gltf/document.h"
#include "core/texture.h"

namespace photopic {

/// Decodes the images with these indices, several at a time; the others stay null and are not looked at.
/// Together they may take 4 GiB.
/// @throws InputError naming the image that is missing, damaged or too large
std::vector<std::shared_ptr<const TextureImage>> decode_gltf_images(const GltfDocument& document,
                                                                    const std::set<int>& used);

}  // namespace photopic
