#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/gltf_contents.h"
#include "core/scene.h"

namespace photopic {

/// One part of what `photopic info` tells: a heading with a table under it, and the same for machines.
struct ReportSection {
  std::string key;                             ///< in the JSON
  std::string title;                           ///< a line of its own
  std::vector<std::vector<std::string>> rows;  ///< the first holds the headings; may be empty
  nlohmann::ordered_json json;
};

/// As tables show it.
std::string name_text(const std::string& name);
std::string size_text(double bytes);

/// Geometry: counts, bounds in the world [m], memory.
ReportSection report_geometry(const Scene& scene);

/// The file's scenes, and which of them renders; no rows where there is no choice.
ReportSection report_scenes(const Scene& scene, const GltfContents& contents);
/// All cameras of the file, and the one that renders.
ReportSection report_cameras(const Scene& scene, const GltfContents& contents);
/// All materials: kind of scattering, colour under D65, parameters that are not their defaults.
ReportSection report_materials(const Scene& scene);
/// Images that materials read, each once.
ReportSection report_textures(const Scene& scene);
/// What lights the scene: glowing materials (their mean luminance), punctual lights, the environment; with
/// their spectra. The flux of what is far away is that which meets the scene's bounding sphere.
ReportSection report_lamps(const Scene& scene, const GltfContents& contents);

}  // namespace photopic
