#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "spectral/spectrum.h"

namespace photopic {

/// What the user calls SPECTRUM: `cie:FL11`, `blackbody:3200`, `line:532[:0.5]`, `constant`, or a file's path
/// (taken relative to `folder`). `beyond` decides what a file's table means beyond its ends.
/// @throws InputError naming the text, or the file and line, and what to do
Spectrum parse_spectrum(std::string_view text, const std::filesystem::path& folder, Beyond beyond);

/// Reads a spectrum file by its ending: two columns of text (.spd .txt .csv, or none of the others; nm,
/// value; comments after `#`; comma, semicolon, tab or blanks; an optional header line), LSPDD's CSV
/// (metadata lines, then a `wavelength,…` header), LSPDD's JSON (`spectraldata`), CGATS .sp, IES TM-27 .spdx.
/// @throws InputError with the line of the first bad row
TabulatedSpectrum read_spectrum_file(const std::filesystem::path& file, Beyond beyond);

/// Reads measured reflectances, each a table from 0 to 1: columns of text (nm, then one reflectance a column;
/// otherwise as above), or a CGATS .sp with a data set for each.
/// @throws InputError with the line of the first bad row; percentages are refused, and more than 1000
std::vector<TabulatedSpectrum> read_reflectance_file(const std::filesystem::path& file);

}  // namespace photopic
