#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "commands.h"
#include "comparison.h"
#include "core/film.h"
#include "sampler_choice.h"

namespace photopic {

/// One sampler under test.
struct Entry {
  std::string name;
  ChosenSampler chosen;
  std::uint32_t seed = 0;
  std::vector<double> seconds;  ///< of each round
  std::optional<RenderResult> result;
};

/// What all renders of a comparison share.
struct Setting {
  const CompareArguments& arguments;
  const PreparedScene& scene;
  int wavelengths;
  Xyz white;
  ChromaticAdaptation adaptation;  ///< from the observer's D65
  DistributionRequest request;
  std::optional<PixelWindow> window = {};  ///< what alone is rendered and measured

  /// @param film of the window alone
  Image develop(const Film& film) const;
};

/// Of the reference's first half; the second's is as far away again.
std::uint32_t reference_seed(const Setting& setting);

/// One for each of the arguments' samplers.
/// @throws InputError when one is named twice
std::vector<Entry> choose_samplers(const Setting& setting);

/// Renders or reads the reference, renders the entries and measures them.
Comparison compare(const Setting& setting, std::vector<Entry>& entries);

}  // namespace photopic
