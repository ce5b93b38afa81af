#include "core/film.h"

#include <algorithm>

namespace photopic {

Film::Film(int width, int height)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

Film& Film::operator+=(const Film& other) {
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    pixels_[i].sum += other.pixels_[i].sum;
    pixels_[i].sum_of_squares += other.pixels_[i].sum_of_squares;
    pixels_[i].count += other.pixels_[i].count;
  }
  return *this;
}

Film Film::cropped(const PixelWindow& window) const {
  Film part(window.width(), window.height());
  for (std::size_t i = 0; i < part.pixels_.size(); ++i)
    part.pixels_[i] = pixels_[window.pixel_of_image(i, width_)];
  return part;
}

Xyz Film::mean(std::size_t pixel) const {
  const Pixel& p = pixels_[pixel];
  return p.count == 0 ? Xyz{} : p.sum * (1.0 / static_cast<double>(p.count));
}

Xyz Film::variance_of_mean(std::size_t pixel) const {
  const Pixel& p = pixels_[pixel];
  if (p.count < 2) return {};
  const double n = static_cast<double>(p.count);
  const auto variance = [n](double sum, double squares) {
    return std::max(0.0, (squares - sum * sum / n) / (n - 1.0)) / n;
  };
  return {variance(p.sum.x, p.sum_of_squares.x), variance(p.sum.y, p.sum_of_squares.y),
          variance(p.sum.z, p.sum_of_squares.z)};
}

Xyz Film::image_mean() const {
  Xyz sum;
  for (std::size_t i = 0; i < pixels_.size(); ++i) sum += mean(i);
  return sum * (1.0 / static_cast<double>(pixels_.size()));
}

Xyz Film::image_variance_of_mean() const {
  Xyz sum;
  for (std::size_t i = 0; i < pixels_.size(); ++i) sum += variance_of_mean(i);
  const double n = static_cast<double>(pixels_.size());
  return sum * (1.0 / (n * n));
}

Image Film::to_linear_srgb(const ChromaticAdaptation& adaptation) const {
  Image image(width_, height_);
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const Rgb rgb = xyz_to_linear_srgb(adaptation(mean(i)));
    image.set(i, rgb.r, rgb.g, rgb.b);
  }
  return image;
}

Image Film::to_xyz() const {
  Image image(width_, height_, ColorSpace::xyz);
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const Xyz xyz = mean(i);
    image.set(i, xyz.x, xyz.y, xyz.z);
  }
  return image;
}

}  // namespace photopic
