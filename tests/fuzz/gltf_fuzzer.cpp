#include <cstddef>
#include <cstdint>
#include <span>

#include "core/gltf_loader.h"
#include "error.h"

/// Loads the input as a .gltf or .glb. It is refused or loaded; anything else is a fault. Files that it names
/// are sought in a folder that does not exist.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  try {
    photopic::load_gltf({bytes.begin(), bytes.end()}, "/nonexistent/input", {.allow_incomplete = true});
  } catch (const photopic::InputError&) {
  }
  return 0;
}
