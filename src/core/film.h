#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/image_io.h"
#include "spectral/color.h"

namespace photopic {

/// A rectangle of an image's pixels; the upper bounds lie outside.
struct PixelWindow {
  int x0, y0, x1, y1;

  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  int pixel_count() const { return width() * height(); }
  /// The window's i-th pixel in the whole image. @param image_width its
  std::size_t pixel_of_image(std::size_t i, int image_width) const {
    const auto w = static_cast<std::size_t>(width());
    return (static_cast<std::size_t>(y0) + i / w) * static_cast<std::size_t>(image_width) +
           static_cast<std::size_t>(x0) + i % w;
  }
};

/// Sums of XYZ samples in double, a pixel each with its own count; box filter. A pixel's samples are to be
/// added in order of their index, by one thread at a time: then the bits do not depend on threads or batches.
class Film {
 public:
  Film(int width, int height);

  void add(std::size_t pixel, const Xyz& sample) {
    Pixel& p = pixels_[pixel];
    p.sum += sample;
    p.sum_of_squares += Xyz{sample.x * sample.x, sample.y * sample.y, sample.z * sample.z};
    ++p.count;
  }

  /// Adds another film's samples pixel by pixel. @param other of the same size
  Film& operator+=(const Film& other);

  /// A part of it. @param window inside it
  Film cropped(const PixelWindow& window) const;

  int width() const { return width_; }
  int height() const { return height_; }

  std::uint64_t count(std::size_t pixel) const { return pixels_[pixel].count; }  ///< of samples
  Xyz mean(std::size_t pixel) const;
  /// Variance of the pixel's mean, from its samples as if they were independent (an upper estimate for
  /// stratified ones).
  Xyz variance_of_mean(std::size_t pixel) const;

  /// The mean over all pixels, and its variance as above.
  Xyz image_mean() const;
  Xyz image_variance_of_mean() const;

  /// Unclipped linear sRGB, after an adaptation to its white.
  Image to_linear_srgb(const ChromaticAdaptation& adaptation = {}) const;
  /// CIE XYZ as observed.
  Image to_xyz() const;

 private:
  struct Pixel {
    Xyz sum, sum_of_squares;
    std::uint64_t count = 0;
  };
  int width_, height_;
  std::vector<Pixel> pixels_;
};

}  // namespace photopic
