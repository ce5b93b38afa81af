#include <cstddef>
#include <cstdint>

#include "core/gltf_loader.h"
#include "error.h"

/// Loads the input as a .gltf or .glb. It is refused or loaded; anything else is a fault. Files that it names
/// are sought in a folder that does not exist.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    photopic::load_gltf({data, data + size}, "/nonexistent/input");
  } catch (const photopic::InputError&) {
  }
  return 0;
}
