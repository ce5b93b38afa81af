#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace photopic {

/// Checks the parsed JSON before anything in it is used: versions, required extensions, types and ranges of
/// what the loader reads, every index into another list, views inside their buffers and accessors inside
/// their views.
/// @throws InputError at the first fault, with its JSON pointer
void check_gltf(const nlohmann::json& document, const std::filesystem::path& file);

}  // namespace photopic
