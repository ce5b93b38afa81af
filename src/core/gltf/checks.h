#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace photopic {

/// Checks the parsed JSON before anything in it is used: versions, required extensions, types and ranges of
/// what the loader reads, every index into another list, views inside their buffers and accessors inside
/// their views, attributes that belong together. Whole numbers written as 2.0 or 2e0, which glTF allows,
/// become integers.
/// @throws InputError at the first fault, with its JSON pointer
void check_gltf(nlohmann::json& document, const std::filesystem::path& file);

}  // namespace photopic
