#include <gtest/gtest.h>

#include <filesystem>

#include "core/gltf_loader.h"
#include "support/render_checks.h"

namespace photopic {
namespace {

using namespace test;
namespace fs = std::filesystem;

/// A scene as the oracle can render it. Scattered light alone finds lamps, so small ones take it for ever:
/// those are put out. (Punctual lights, which it can never find, none of the scenes has.)
struct SceneCase {
  std::string folder;
  int spp, oracle_spp;
  std::vector<std::string> dark_lamps = {};  ///< materials

  friend void PrintTo(const SceneCase& c, std::ostream* out) { *out << c.folder; }
};

/// What scenes that are not named here get.
SceneCase usual(const std::string& folder) {
  return {folder, 2000, 4000};
}

const std::vector<SceneCase>& special_cases() {
  static const std::vector<SceneCase> cases = {
      {"scenes/cornell-box", 3000, 6000},
      {"scenes/veach-mis", 2000, 6000, {"lamp cie:FL11", "lamp cie:FL12"}},
      {"shared/cornell-box", 3000, 6000},
      {"shared/veach-mis", 2000, 6000, {"emitter_2"}},
  };
  return cases;
}

/// Every folder of scenes here and of the shared ones, where they are.
std::vector<SceneCase> all_scenes() {
  std::vector<SceneCase> all;
  const auto add = [&](const std::string& name, const fs::path& root) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(root, none)) {
      if (!entry.is_directory()) continue;
      SceneCase c = usual(name + "/" + entry.path().filename().string());
      for (const SceneCase& special : special_cases())
        if (special.folder == c.folder) c = special;
      all.push_back(c);
    }
  };
  add("scenes", PHOTOPIC_SCENES);
  add("shared", fs::path(PHOTOPIC_SHARED) / "scenes");
  std::ranges::sort(all, {}, &SceneCase::folder);
  return all;
}

fs::path file_of(const SceneCase& c) {
  const fs::path name = fs::path(c.folder).filename();
  const fs::path folder =
      (c.folder.starts_with("shared") ? fs::path(PHOTOPIC_SHARED) / "scenes" : fs::path(PHOTOPIC_SCENES)) /
      name;
  return fs::exists(folder / "scene.glb") ? folder / "scene.glb" : folder / "scene.gltf";
}

class SceneOracle : public ::testing::TestWithParam<SceneCase> {};

/// The path tracer and the oracle see the same image, whole and by quarters.
TEST_P(SceneOracle, Agrees) {
  const SceneCase& c = GetParam();
  Scene source = load_gltf(file_of(c), {.width = 12, .height = 9});
  for (Material& m : source.materials)
    if (std::ranges::count(c.dark_lamps, m.name) > 0) m.emission_luminance = 0.0f;
  const PreparedScene scene(std::move(source));
  const IlluminantWavelengths sampler{4, base_density(scene_emission(scene))};
  RenderOptions o{.spp = c.spp, .sequence = Sequence::independent, .seed = 1, .max_depth = 5};
  const RenderResult clever = render(scene, sampler, o);
  o.spp = c.oracle_spp, o.seed = 2;
  const RenderResult simple = render_naive(scene, sampler, o);

  const std::vector<Estimate> a = quarter_estimates(clever.film), b = quarter_estimates(simple.film);
  for (const Estimate& e : {a[1], b[1]}) EXPECT_LT(e.error, 0.025 * e.mean);
  const auto percent = [](const Estimate& e) { return std::to_string(100 * e.error / e.mean); };
  RecordProperty("percent", percent(a[1]) + " " + percent(b[1]));
  RecordProperty("largest_z", std::to_string(largest_z(a, b)));
  EXPECT_LT(largest_z(a, b), normal_threshold(sidak_significance(0.01, all_scenes().size() * a.size())))
      << "Y " << a[1].mean << " ± " << a[1].error << ", oracle " << b[1].mean << " ± " << b[1].error;
  EXPECT_EQ(clever.stats.non_finite + simple.stats.non_finite, 0u);
}

std::string identifier(const ::testing::TestParamInfo<SceneCase>& info) {
  std::string name;
  for (const char c : info.param.folder) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, SceneOracle, ::testing::ValuesIn(all_scenes()), identifier);

}  // namespace
}  // namespace photopic
