#pragma once

#include <string>

#include "commands.h"
#include "core/gltf_loader.h"
#include "integrator/integrator.h"
#include "messages.h"
#include "run_report.h"

namespace photopic {

/// What the arguments name to be read: the scene, the distribution, spectra, the environment. Some may be
/// empty or no files.
std::vector<std::filesystem::path> input_files(const SceneArguments& arguments);

/// What the arguments ask of the loader.
/// @throws InputError when --resolution is no size
GltfOptions gltf_options(const SceneArguments& arguments);

/// Loads the scene with the arguments' camera, resolution and emitters, and prints the loader's warnings.
/// @param outputs what will be written; none may be a file that the scene names
/// @throws InputError
Scene load_scene(const SceneArguments& arguments, const std::vector<std::filesystem::path>& outputs);

const Observer& standard_observer(const SceneArguments& arguments);

Sequence sequence_of(const SceneArguments& arguments);

/// The options of one render of `spp` samples; it stops at the first SIGINT.
RenderOptions render_options(const SceneArguments& arguments, int spp, std::uint32_t seed,
                             Progress* progress);

/// Renders with a progress line and warns of samples that were not finite.
/// @param further films to feed @param window what alone is rendered
RenderResult render_with_progress(const std::string& label, const PreparedScene& scene,
                                  const WavelengthSampler& sampler, const SceneArguments& arguments, int spp,
                                  std::uint32_t seed, const FurtherFilms& further = {},
                                  const std::optional<PixelWindow>& window = {});

/// The camera as --camera would choose it: as it was given, else by its name, else as "index:N". Empty where
/// the scene has none and is framed.
std::string camera_handle(const SceneArguments& arguments, const Scene& scene);

/// What JSON files tell of what was rendered: the file, which scene of it and which camera; null: it has
/// none.
nlohmann::ordered_json scene_json(const SceneArguments& arguments, const Scene& scene);

/// What decides a picture beside its scene and samples, under the names that files know them by: texts and
/// numbers, null where there is none. @param white_balance as --white-balance has it
nlohmann::ordered_json settings_json(const SceneArguments& arguments, const std::string& white_balance);

/// The same as metadata, and the lamps' spectra.
Metadata settings_metadata(const SceneArguments& arguments, const Scene& scene,
                           const std::string& white_balance);

/// Writes a render; EXR and PNG say how it was made. The render's time is in the EXR alone: other files are
/// the same bits for the same seed.
/// @param white_balance as --white-balance has it; of XYZ there is none
/// @throws InputError
void write_render(const std::filesystem::path& file, const Image& image, const SceneArguments& arguments,
                  const Scene& scene, const Run& run, const std::string& white_balance,
                  const std::vector<ImageLayer>& layers = {});

}  // namespace photopic
