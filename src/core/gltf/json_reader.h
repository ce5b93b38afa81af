#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/gltf/file.h"

namespace photopic {

/// Parses the file's JSON. Nesting too deep for recursive readers is refused, and so are keys that stand
/// twice in one object: glTF's are unique (section 2.7), and parsers keep one of them without a word.
/// @throws InputError
nlohmann::json parse_gltf_json(const GltfFile& file);

/// A parser's message without its own tag, "[json.exception…] ", fit for one line.
std::string parser_message(const std::string& text);

}  // namespace photopic
