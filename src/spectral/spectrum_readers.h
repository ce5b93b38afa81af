#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spectral/spectrum.h"

namespace photopic {

/// The readers behind read_spectrum_file, one a format. Each takes the whole text and a name to begin
/// messages with, and throws InputError("name:line", …) at the first bad row.

struct SpectrumRow {
  double lambda;     ///< [nm]
  double value;      ///< in the file's own unit
  std::size_t line;  ///< where it stands, from 1
};

/// Two columns: wavelength [nm], value. `#` begins a comment. Comma, semicolon, tab or blanks separate;
/// beside a semicolon or tab a comma is decimal. One header line may come first, or any number of lines that
/// end with one that begins with "wavelength" (LSPDD's CSV).
std::vector<SpectrumRow> read_columns(const std::string& name, std::string_view text);

/// The same with one or more columns of values. @return the rows of each
std::vector<std::vector<SpectrumRow>> read_many_columns(const std::string& name, std::string_view text);

/// CGATS.17 as Argyll and colord write it: SPECTRAL_START_NM, SPECTRAL_END_NM, SPECTRAL_BANDS, one data set.
std::vector<SpectrumRow> read_cgats(const std::string& name, std::string_view text);

/// The same with one or more data sets. @return the rows of each
std::vector<std::vector<SpectrumRow>> read_cgats_sets(const std::string& name, std::string_view text);

/// LSPDD's JSON: an object (or an array of one) whose `spectraldata` holds the rows, as text or as JSON
/// pairs. Lines are counted within it. {"nm": [...], "value": [...]} is read too.
std::vector<SpectrumRow> read_spectrum_json(const std::string& name, std::string_view text);

/// IES TM-27: SpectralDistribution with SpectralData elements, each with its wavelength.
std::vector<SpectrumRow> read_spdx(const std::string& name, std::string_view text);

/// What is wrong with wavelengths that are hardly in nm; else empty.
std::string unit_problem(double shortest, double longest);

/// Checks the rows (finite, not negative, wavelengths in nm and ascending, at most two at one place, at least
/// two in all) and makes them a table.
TabulatedSpectrum table_from_rows(const std::string& name, const std::vector<SpectrumRow>& rows,
                                  Beyond beyond);

/// A number that fills the text, blanks and quotes around it aside; whatever the locale.
std::optional<double> parse_number(std::string_view text);

/// The text without blanks and quotes around it.
std::string_view trimmed(std::string_view text);

/// "name:line", as messages begin.
std::string place(const std::string& name, std::size_t line);

}  // namespace photopic
