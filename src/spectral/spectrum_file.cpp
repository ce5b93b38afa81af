#include "spectral/spectrum_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <optional>

#include "error.h"
#include "file_ending.h"
#include "input_file.h"
#include "spectral/illuminants.h"
#include "spectral/spectrum_readers.h"

namespace photopic {
namespace {

constexpr std::uintmax_t kLargestFile = std::uintmax_t{64} << 20;

std::string quoted(std::string_view text) {
  return fmt::format("spectrum '{}'", text);
}

/// What follows the prefix, if the text begins with it.
std::optional<std::string_view> after(std::string_view text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return std::nullopt;
  return text.substr(prefix.size());
}

Spectrum parse_illuminant(std::string_view text, std::string_view name) {
  if (auto illuminant = cie_illuminant(name)) return *std::move(illuminant);
  throw InputError(quoted(text), "no such CIE illuminant",
                   fmt::format("name one of {}", fmt::join(cie_illuminant_names(), ", ")));
}

Spectrum parse_blackbody(std::string_view text, std::string_view kelvin) {
  const auto value = parse_number(kelvin);
  if (value && *value >= 100.0 && *value <= 1e7) return BlackbodySpectrum{*value};
  throw InputError(quoted(text), "the temperature must be a number from 100 to 1e7",
                   "give it in kelvin, as in blackbody:3200");
}

Spectrum parse_line(std::string_view text, std::string_view numbers) {
  const std::size_t colon = numbers.find(':');
  const auto centre = parse_number(numbers.substr(0, colon));
  if (!centre || !(*centre >= kLambdaMin && *centre <= kLambdaMax))
    throw InputError(quoted(text), "the line's centre must be a number from 360 to 830",
                     "give it in nm, as in line:532");
  LineSpectrum line{*centre};
  if (colon == std::string_view::npos) return line;
  const auto fwhm = parse_number(numbers.substr(colon + 1));
  if (!fwhm || !(*fwhm >= 1e-6 && *fwhm <= 1000.0))
    throw InputError(quoted(text), "the full width at half maximum must be a number from 1e-6 to 1000",
                     "give it in nm, as in line:532:0.5");
  line.fwhm = *fwhm;
  return line;
}

/// The whole file, if it is a text of sensible size.
std::string read_text(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw InputError(name, "no such spectrum file",
                     "give a file, cie:NAME, blackbody:KELVIN, line:NM[:FWHM] or constant");
  check_readable_file(file);
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error || size > kLargestFile)
    throw InputError(name, "larger than 64 MB", "give a file that holds one spectrum");

  std::ifstream stream(file, std::ios::binary);
  std::string text(size, '\0');
  if (!stream.read(text.data(), static_cast<std::streamsize>(size)))
    throw InputError(name, "cannot be read", "check the disk it is on");
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  const auto is_control = [](unsigned char c) { return c < 9 || (c > 13 && c < 32) || c == 127; };
  const bool binary = std::any_of(text.begin(), text.end(), is_control);
  if (binary) throw InputError(name, "not a text file", "give the spectrum as UTF-8 text");
  return text;
}

void check_reflectance(const std::string& name, const std::vector<SpectrumRow>& rows) {
  for (const SpectrumRow& row : rows)
    if (row.value > 1.0)
      throw InputError(place(name, row.line), fmt::format("a reflectance of {} is above 1", row.value),
                       "divide percentages by 100");
}

}  // namespace

Spectrum parse_spectrum(std::string_view text, const std::filesystem::path& folder, Beyond beyond) {
  if (text.empty())
    throw InputError(quoted(text), "is empty", "give a file, cie:NAME, blackbody:KELVIN or line:NM");
  if (text == "constant") return ConstantSpectrum{};
  if (const auto name = after(text, "cie:")) return parse_illuminant(text, *name);
  if (const auto kelvin = after(text, "blackbody:")) return parse_blackbody(text, *kelvin);
  if (const auto numbers = after(text, "line:")) return parse_line(text, *numbers);
  const std::filesystem::path file = folder / std::filesystem::path(text);
  std::error_code error;
  if (!std::filesystem::exists(file, error) && cie_illuminant(text))
    throw InputError(quoted(text), "there is no such file",
                     fmt::format("write cie:{} for the illuminant", text));
  return read_spectrum_file(file, beyond);
}

TabulatedSpectrum read_spectrum_file(const std::filesystem::path& file, Beyond beyond) {
  const std::string name = file.string(), extension = lower_case_ending(file);
  if (extension == ".gltf" || extension == ".glb")
    throw InputError(name, "is a scene, not a spectrum",
                     "`photopic render` optimises for a scene's own lamps, `photopic info` lists them");
  const std::string text = read_text(file);
  const auto read = extension == ".sp"     ? read_cgats
                    : extension == ".json" ? read_spectrum_json
                    : extension == ".spdx" ? read_spdx
                                           : read_columns;
  return table_from_rows(name, read(name, text), beyond);
}

std::vector<TabulatedSpectrum> read_reflectance_file(const std::filesystem::path& file) {
  constexpr std::size_t kMost = 1000;
  check_readable_file(file);
  const std::string text = read_text(file), name = file.string(), extension = lower_case_ending(file);
  if (extension == ".json" || extension == ".spdx")
    throw InputError(name, "reflectances are not read from this format",
                     "give columns of text (nm, then one reflectance a column) or a CGATS .sp");
  const auto columns = extension == ".sp" ? read_cgats_sets(name, text) : read_many_columns(name, text);
  if (columns.empty())
    throw InputError(name, "holds no reflectances", "give nm and one reflectance a column");
  if (columns.size() > kMost)
    throw InputError(name, fmt::format("holds {} reflectances", columns.size()),
                     fmt::format("give {} at the most", kMost));
  std::vector<TabulatedSpectrum> reflectances;
  for (const auto& rows : columns) {
    check_reflectance(name, rows);
    reflectances.push_back(table_from_rows(name, rows, Beyond::end_value));
  }
  return reflectances;
}

}  // namespace photopic
