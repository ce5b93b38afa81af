#include <fmt/format.h>

#include "commands.h"
#include "core/image_metrics.h"
#include "error.h"
#include "messages.h"
#include "output_file.h"
#include "run_report.h"
#include "spectral/observer.h"
#include "spectral/spectrum_file.h"
#include "text_table.h"
#include "visible_lamp.h"

namespace photopic {
namespace {

/// As `compare` has it of a scene's lamps: at Y = 1.
Xyz white_of(const std::string& spectrum) {
  if (spectrum == "D65") return d65_white();
  const auto lamp = visible_lamp(parse_spectrum(spectrum, {}, Beyond::zero), "--white " + spectrum);
  const Xyz white = emission_xyz(lamp, Observer::cie1931());
  return white * (1.0 / white.y);
}

}  // namespace

int run_diff(const DiffArguments& arguments) {
  if (!arguments.json.empty()) check_writable_file(arguments.json);
  std::vector<std::filesystem::path> inputs = arguments.images;
  inputs.push_back(arguments.reference);
  inputs.emplace_back(arguments.white);
  check_no_overwriting({arguments.json}, inputs);
  const Xyz white = white_of(arguments.white);
  const Image reference = read_image(arguments.reference);
  warn_of_8_bit_reference(arguments.reference);
  const Metadata metadata = read_metadata(arguments.reference);

  nlohmann::ordered_json runs = nlohmann::ordered_json::array();
  std::vector<std::vector<std::string>> rows{{"image", "mean ΔE", "median", "p95", "max", "MSE", "relMSE"}};
  for (const auto& file : arguments.images) {
    const Image image = read_image(file);
    check_same_size(reference, image, file.string());
    const ImageDifference m = compare_images(reference, image, white);
    warn_of_shared_noise(metadata, file.string(), read_metadata(file));
    if (m.non_finite > 0)
      print_warning(fmt::format("{}: {} pixels are not finite, here or in the reference, and are left out",
                                file.string(), m.non_finite));
    rows.push_back({file.string(), fmt::format("{:.4f}", m.mean_delta_e),
                    fmt::format("{:.4f}", m.median_delta_e), fmt::format("{:.4f}", m.p95_delta_e),
                    fmt::format("{:.4f}", m.max_delta_e), fmt::format("{:.4g}", m.mse),
                    fmt::format("{:.4g}", m.relmse)});
    runs.push_back({{"image", file.string()}});
    add_metrics(runs.back(), m);
  }

  OutputAttempts attempt;
  if (!arguments.json.empty()) {
    const nlohmann::ordered_json json = {{"version", PHOTOPIC_VERSION},
                                         {"white", arguments.white},
                                         {"reference", {{"image", arguments.reference.string()}}},
                                         {"runs", runs}};
    attempt(arguments.json, [&] { write_json_file(arguments.json, json); });
  }
  if (!arguments.quiet) print_out(format_table(rows));
  return attempt.exit_code(kExitDone);
}

}  // namespace photopic
