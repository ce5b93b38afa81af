#pragma once

#include <span>
#include <string>
#include <vector>

#include "spectral/lamp_description.h"
#include "spectral/spectrum.h"
#include "svg_plot.h"

namespace photopic {

/// An emission's mean over each nm of 360 … 830 nm, largest 1: what a plot can show of lines narrower than a
/// pixel. Points (nm, relative power).
std::vector<PlotPoint> plotted_spectrum(const TabulatedSpectrum& emission);

/// Draws the spectrum as an area coloured as its wavelengths look; the frame's x axis is 360 … 830 nm.
/// @param height of the largest value, in the frame's units
void draw_spectrum_area(SvgDrawing& svg, const PlotFrame& frame, std::span<const PlotPoint> spectrum,
                        double height, double opacity);

/// The plot of one lamp, an SVG file's text: relative power over wavelength, the strongest lines named.
std::string spectrum_plot(const TabulatedSpectrum& emission, const LampDescription& lamp,
                          const std::string& title, const std::string& subtitle);

}  // namespace photopic
