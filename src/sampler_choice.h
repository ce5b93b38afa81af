#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "commands.h"
#include "core/prepared_scene.h"
#include "optimize/solver.h"
#include "spectral/wavelength_sampler.h"

namespace photopic {

/// The names of the command line as the optimiser's options; the first SIGINT stops the search.
OptimizeOptions optimize_options(int wavelengths, std::string_view objective, std::string_view effort,
                                 std::string_view white, std::uint32_t seed);

/// How a render's optimised sampler comes by its distribution.
struct DistributionRequest {
  std::string lamps;           ///< the scene's, as `photopic optimize` would take them
  std::filesystem::path file;  ///< empty: from the cache, or optimised on the spot and cached
  OptimizeOptions optimize;    ///< its number of wavelengths is that of all samplers
  bool use_cache = true;
  bool quiet = false;
};
DistributionRequest distribution_request(const SceneArguments& arguments, const PreparedScene& scene,
                                         int wavelengths, std::string_view white);

/// The number of wavelengths a render carries: `asked`, or if that is 0 the distribution file's, or 4.
/// @throws InputError when the file cannot be read or holds another number than asked for
int choose_wavelength_count(int asked, const std::filesystem::path& distribution);

struct ChosenSampler {
  WavelengthSampler sampler;
  double optimize_seconds = 0;  ///< paid when its distribution was made, now or before; 0: it has none
};

/// The sampler called `name`, one of kSamplers, for a scene's lamps. Warns of a distribution file that was
/// made for others.
/// @throws InputError when the file cannot be read or its densities leave a gap
ChosenSampler choose_sampler(std::string_view name, const PreparedScene& scene,
                             const DistributionRequest& request);

}  // namespace photopic
