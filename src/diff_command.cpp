#include <fmt/format.h>

#include <cmath>

#include "commands.h"
#include "core/image_metrics.h"
#include "error.h"
#include "error_map.h"
#include "image_pair.h"
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

void note_of_part(const ImageShape& part, const std::filesystem::path& whole) {
  print_note(fmt::format("{}: of it the window {} alone is compared, which the other image is",
                         whole.string(), window_text(part)));
}

struct Measures {
  ImageShape shape;
  ImageDifference difference;
  std::vector<double> map;  ///< of ΔE; empty where none is asked for
};

/// Where one of the two is a window of the other, of that window alone.
/// @param white of ΔE, with the exposure in it
Measures measure(const DiffArguments& arguments, const Image& reference, const std::filesystem::path& file,
                 Xyz white) {
  const Image image = read_image(file);
  const auto part_of_reference = matching_part(image, reference),
             part_of_image = matching_part(reference, image);
  const Image& a = part_of_reference ? *part_of_reference : reference;
  const Image& b = part_of_image ? *part_of_image : image;
  check_same_pixels(a, b, file.string());
  if (!arguments.quiet && part_of_reference) note_of_part(b, arguments.reference);
  if (!arguments.quiet && part_of_image) note_of_part(b, file);
  Measures measures{.shape = a.full_width > 0 ? a : b, .difference = compare_images(a, b, white), .map = {}};
  if (!arguments.map.empty()) measures.map = delta_e_map(a, b, white);
  return measures;
}

void warn_of_image(const Metadata& reference, const std::filesystem::path& file, std::size_t non_finite) {
  const Metadata metadata = read_metadata(file);
  warn_of_shared_noise(reference, file.string(), metadata);
  warn_of_other_light(reference, file.string(), metadata);
  if (non_finite > 0)
    print_warning(fmt::format("{}: {} pixels are not finite, here or in the reference, and are left out",
                              file.string(), non_finite));
}

std::vector<std::string> row_of(const std::filesystem::path& file, const ImageDifference& m) {
  return {file.string(),
          fmt::format("{:.4f}", m.mean_delta_e),
          fmt::format("{:.4f}", m.median_delta_e),
          fmt::format("{:.4f}", m.p95_delta_e),
          fmt::format("{:.4f}", m.max_delta_e),
          fmt::format("{:.4g}", m.mse),
          fmt::format("{:.4g}", m.relmse)};
}

/// The window as `render` has it; null: all of a picture, or not told.
nlohmann::ordered_json json_of(const std::filesystem::path& file, const Measures& measures) {
  const ImageShape& s = measures.shape;
  nlohmann::ordered_json json = {{"image", file.string()}, {"crop", nullptr}};
  if (!s.is_whole()) json["crop"] = {s.left, s.top, s.left + s.width, s.top + s.height};
  add_metrics(json, measures.difference);
  return json;
}

void check_outputs(const DiffArguments& arguments) {
  if (!arguments.json.empty()) check_writable_file(arguments.json);
  if (!arguments.map.empty()) check_writable_map(arguments.map);
  if (!arguments.map.empty() && arguments.images.size() > 1)
    throw InputError("--map " + arguments.map.string(),
                     fmt::format("is of one image, not of {}", arguments.images.size()),
                     "give a reference and one image");
  std::vector<std::filesystem::path> inputs = arguments.images;
  inputs.push_back(arguments.reference);
  inputs.emplace_back(arguments.white);
  check_no_overwriting({arguments.json, arguments.map}, inputs);
}

void write_map(const DiffArguments& arguments, const Measures& measures) {
  write_error_map(arguments.map, measures.shape, measures.map,
                  {{"reference", arguments.reference.string()},
                   {"image", arguments.images.front().string()},
                   {"white", arguments.white},
                   {"exposure", fmt::format("{:g} EV", arguments.exposure)},
                   {"version", "photopic " PHOTOPIC_VERSION}});
}

}  // namespace

int run_diff(const DiffArguments& arguments) {
  check_outputs(arguments);
  const Xyz white = white_of(arguments.white) * std::exp2(-arguments.exposure);
  const Image reference = read_image(arguments.reference);
  warn_of_8_bit_reference(arguments.reference);
  const Metadata metadata = read_metadata(arguments.reference);

  OutputAttempts attempt;
  nlohmann::ordered_json runs = nlohmann::ordered_json::array();
  std::vector<std::vector<std::string>> rows{{"image", "mean ΔE", "median", "p95", "max", "MSE", "relMSE"}};
  for (const auto& file : arguments.images) {
    const Measures measures = measure(arguments, reference, file, white);
    warn_of_image(metadata, file, measures.difference.non_finite);
    rows.push_back(row_of(file, measures.difference));
    runs.push_back(json_of(file, measures));
    if (!arguments.map.empty()) attempt(arguments.map, [&] { write_map(arguments, measures); });
  }

  if (!arguments.json.empty()) {
    const nlohmann::ordered_json json = {{"version", PHOTOPIC_VERSION},
                                         {"white", arguments.white},
                                         {"exposure", arguments.exposure},
                                         {"reference", {{"image", arguments.reference.string()}}},
                                         {"runs", runs}};
    attempt(arguments.json, [&] { write_json_file(arguments.json, json); });
  }
  if (prints_report(arguments.quiet, arguments.json)) print_out(format_table(rows));
  return attempt.exit_code(kExitDone);
}

}  // namespace photopic
