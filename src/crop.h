#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/film.h"

namespace photopic {

/// --crop's "X0,Y0,X1,Y1"; nothing for an empty text.
/// @throws InputError when it is no window of a picture
std::optional<PixelWindow> parse_crop(const std::string& text);

/// @throws InputError when the window reaches beyond the camera's picture
void check_crop(const PixelWindow& window, const Camera& camera);

/// Null: no window.
nlohmann::ordered_json crop_json(const std::optional<PixelWindow>& window);

/// Layers of the whole picture become the window's.
void crop_layers(const PixelWindow& window, const Camera& camera, std::vector<ImageLayer>& layers);

/// Lets the window's image know where it lies.
void place_in(const PixelWindow& window, const Camera& camera, Image& image);

}  // namespace photopic
