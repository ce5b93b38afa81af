#include "optimize_run.h"

#include <cmath>

#include "core/image_io.h"
#include "core/progress.h"
#include "messages.h"
#include "optimize/color_bar.h"

namespace photopic {

OptimizeResult optimize_with_progress(std::span<const TabulatedSpectrum> lamps, const std::string& name,
                                      const OptimizeOptions& options, bool quiet) {
  constexpr std::uint64_t kUnits = 1000;
  Progress progress("optimising", kUnits, "", quiet);
  std::uint64_t done = 0;
  OptimizeResult result = optimize_distribution(lamps, options, [&](double fraction) {
    const auto now = static_cast<std::uint64_t>(std::lround(fraction * static_cast<double>(kUnits)));
    if (now <= done) return;
    progress.advance(now - done);
    done = now;
  });
  result.distribution.spectrum = name;
  result.distribution.optimize_seconds = result.seconds;
  if (result.solver_failed)
    print_warning("optimising " + name + ": the solver gave up (" + result.solver_note +
                  "); its best point is kept");
  return result;
}

void write_color_bar(const std::filesystem::path& file, std::span<const WavelengthSampler> samplers,
                     const TabulatedSpectrum& emission) {
  const ColorBar bar = color_bar(samplers, emission);
  Image image(bar.width, bar.height);
  for (std::size_t i = 0; i < bar.pixels.size(); ++i)
    image.set(i, bar.pixels[i].r, bar.pixels[i].g, bar.pixels[i].b);
  write_image(file, image);
}

}  // namespace photopic
