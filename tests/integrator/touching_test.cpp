#include "core/touching.h"

#include <gtest/gtest.h>

#include "support/instances.h"
#include "support/render_checks.h"
#include "support/slabs.h"

namespace photopic {
namespace {

using namespace test;

/// From none to a thousandth of the scene, over all that rounding does.
constexpr double kGaps[] = {0, 1e-9, 1e-7, 3e-7, 8e-7, 1e-6, 1.5e-6, 2e-6, 3e-6, 1e-5, 1e-3};

/// A shining room of 3 cd/m², in which what loses nothing is not seen.
SceneBuilder shining_room() {
  SceneBuilder b;
  b.box({-2, -2, -2}, {2, 2, 2}, b.lamp(ConstantSpectrum{1.0}, 3.0), true);
  b.camera({0.6, -1.8, 0.9}, {0, 0, 0}, 45, 10, 10);
  return b;
}

/// Expects it unseen, no path ever in a solid that it did not enter, and the oracle's agreement.
void expect_unseen(SceneBuilder b, const std::string& what, int spp = 200) {
  const PreparedScene scene(b.turn({0.3, 0.2, 1}, 0.4).build());
  const UniformWavelengths sampler{4};
  const RenderOptions options{.spp = spp, .sequence = Sequence::independent, .seed = 1, .max_depth = 1000};
  const RenderResult r = render(scene, sampler, options);
  const Estimate e = luminance(r.film);
  EXPECT_NEAR(e.mean, 3.0, 3e-4 + 4.5 * e.error) << what;
  EXPECT_LT(e.error, 0.03) << what;
  EXPECT_EQ(r.stats.non_finite, 0u) << what;
  EXPECT_LE(r.stats.media_slips, r.stats.paths / 2000) << what;
  EXPECT_EQ(r.stats.media_overflows, 0u) << what;
  RenderOptions few = options;
  few.spp = spp / 5, few.seed = 2;
  const Estimate o = luminance(render_naive(scene, sampler, few).film);
  EXPECT_NEAR(o.mean, 3.0, 3e-4 + 4.5 * o.error) << what << ", oracle";
}

std::vector<Material> flint_crown_water_ice() {
  Material flint = solid_glass(1.7f, 0.0f);
  flint.extensions.dispersion = glass_index("SF11");
  return {flint, solid_glass(1.5f, 0.0f), solid_glass(1.33f, 0.0f), solid_glass(1.31f, 0.0f)};
}

/// Cubes in a row, of one size or of several, each of its own material.
SceneBuilder row(const std::vector<Material>& materials, double gap, bool equal_sizes) {
  SceneBuilder b = shining_room();
  const auto count = static_cast<double>(materials.size());
  double x = -0.3 * count;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const double half = equal_sizes ? 0.4 : 0.4 - 0.1 * static_cast<double>(i);
    b.box({x, -half, -half}, {x + 0.6, half, half}, b.material(materials[i]));
    x += 0.6 + gap;
  }
  return b;
}

TEST(TouchingSolids, CubesInARowKeepEnergy) {
  const Material crown = solid_glass(1.5f, 0.0f);
  const std::vector<Material> kinds = flint_crown_water_ice();
  for (const double gap : kGaps) {
    const std::string g = ", gap " + std::to_string(gap * 1e9) + "e-9";
    expect_unseen(row({crown, crown}, gap, true), "two alike" + g);
    expect_unseen(row({crown, solid_glass(2.4f, 0.0f)}, gap, false), "glass and diamond" + g);
    expect_unseen(row({crown, crown, crown}, gap, false), "three alike" + g);
    expect_unseen(row({kinds[0], kinds[1], kinds[2]}, gap, true), "flint, crown, water" + g);
  }
}

TEST(TouchingSolids, RoughFacesKeepEnergy) {
  const Material clear = solid_glass(1.5f, 0.0f), frosted = solid_glass(1.5f, 0.4f),
                 dense = solid_glass(2.0f, 0.3f);
  for (const double gap : {0.0, 1e-6, 1e-3}) {
    const SceneBuilder scenes[] = {row({clear, frosted}, gap, true), row({frosted, dense}, gap, false)};
    for (const SceneBuilder& b : scenes) {
      const Estimate e = luminance(render_finite(b, 300, 500));
      EXPECT_NEAR(e.mean, 3.0, 0.01 + 4.5 * e.error) << "gap " << gap;
      EXPECT_LT(e.error, 0.02);
    }
  }
}

/// Shells without room between them: glass, water in it and ice in that share a face, an edge or all faces.
TEST(TouchingSolids, NestedSolidsThatShareFaces) {
  const std::vector<Material> kinds = flint_crown_water_ice();
  for (const double inset : {0.0, 1e-7, 1e-6, 0.1})
    for (const bool all : {false, true}) {
      SceneBuilder b = shining_room();
      double low = -0.6, high = 0.6;
      for (const Material& m : kinds) {
        b.box({low, -0.6, low}, {high, high, high}, b.material(m));
        (all ? low : high) += all ? inset : -inset;
        high -= all ? inset : 0.0;
      }
      expect_unseen(b, "inset " + std::to_string(inset) + (all ? ", all faces" : ", one face"));
    }
}

/// Two meshes in one place are one solid: of one glass, and of two where the higher priority is there.
TEST(TouchingSolids, RepeatedMeshesCountOnce) {
  const auto room = [](const std::vector<Material>& materials, std::size_t levels) {
    SceneBuilder b = lamp_room(d65(), 12);
    for (const Material& m : materials) {
      const auto index = b.material(m);
      b.box({-0.7, -0.3, 0.2}, {0, 0.5, 1}, index);
      b.sphere({0.45, 0.1, 0.6}, 0.3, static_cast<int>(levels), index);
    }
    return b.turn({0.1, 0.2, 1}, 0.3);
  };
  const Film once = render_finite(room({tinted(1.5f, 0.2, 2)}, 2), 400, 12, 1);
  const Film twice = render_finite(room({tinted(1.5f, 0.2), tinted(1.5f, 0.2)}, 2), 400, 12, 2);
  const Film two = render_finite(room({tinted(1.5f, 0.2, 2), tinted(2.4f, 0.9, 1)}, 2), 400, 12, 3);
  expect_same_image(twice, once, 2, "of one glass");
  expect_same_image(two, once, 2, "of two");
}

/// Glass on water on ice on glass, touching in planes of one size and of several: each pair of neighbours is
/// one interface, and Beer's law holds in each.
TEST(TouchingSolids, SlabsRefractByTheirRelativeIndices) {
  const std::vector<Layer> layers{{1.5, 0.3, 0.5}, {1.33, 0.4, 0.7}, {1.31, 0.5, 0.4}, {1.7, 0.2, 0.6}};
  for (const bool equal_sizes : {true, false})
    for (const double gap : {0.0, 1e-8, 1e-6})
      for (const double sine : {0.0, 0.5, 0.9}) {
        SceneBuilder b;
        double z = 0.0, half = 20.0;
        for (const Layer& l : layers) {
          const auto m = b.material(tinted(static_cast<float>(l.ior), l.share));
          b.box({-half, -half, z}, {half, half, z + l.thickness}, m);
          z += l.thickness + gap;
          if (!equal_sizes) half -= 1.0;
        }
        const Refracted expected = refracted(layers, sine);
        const double slope = sine / std::sqrt(1.0 - sine * sine);
        b.ceiling({expected.offset + slope, 0, z + 1}, 0.01, 0.01, b.lamp(ConstantSpectrum{1.0}, 10.0));
        b.camera({-slope, 0, -1}, {0, 0, 0}, 1e-3, 4, 4);
        expect_luminance(render_finite(b, 4000, 6), 10.0 * expected.transmittance,
                         "sine " + std::to_string(sine) + ", gap " + std::to_string(gap * 1e9) + "e-9", 2e-4);
      }
}

/// A stack with all its reflections, incoherent: the slabs' boundaries of reflectance R₁, R₂, … combine as
/// T = 1/(1 + Σ Rᵢ/(1 − Rᵢ)) where nothing absorbs (Stokes 1862).
TEST(TouchingSolids, StacksTransmitAsTheirBoundariesDo) {
  const double indices[] = {1.0, 1.5, 2.4, 1.33, 1.33, 1.0};
  for (const double sine : {0.0, 0.8}) {
    double sum = 0.0;
    SceneBuilder b;
    for (std::size_t i = 0; i + 1 < std::size(indices); ++i) {
      const double cosine = std::sqrt(1.0 - sine * sine / (indices[i] * indices[i]));
      // The two polarisations are mixed anew at each boundary, as nothing here knows of them.
      const double r =
          fresnel_dielectric(static_cast<float>(cosine), static_cast<float>(indices[i + 1] / indices[i]));
      sum += r / (1.0 - r);
      const auto z = static_cast<double>(i);
      if (i > 0)
        b.box({-900, -900, 0.1 * z}, {900, 900, 0.1 * z + 0.1},
              b.material(solid_glass(static_cast<float>(indices[i]), 0.0f)));
    }
    b.ceiling({0, 0, 5}, 1e4, 1e4, b.lamp(ConstantSpectrum{1.0}, 10.0));
    const double slope = sine / std::sqrt(1.0 - sine * sine);
    b.camera({-slope, 0, -1}, {0, 0, 0}, 1e-3, 4, 4);
    expect_luminance(render_finite(b, 4000, 300), 10.0 / (1.0 + sum), "sine " + std::to_string(sine), 3e-4);
  }
}

/// The camera's ray finds all that is in one place, too.
TEST(TouchingSolids, CameraBelowTouchingSlabs) {
  SceneBuilder b;
  for (int i = 0; i < 3; ++i)
    b.box({-5, -5, 0.2 * i}, {5, 5, 0.2 * i + 0.2},
          b.material(tinted(1.2f + 0.2f * static_cast<float>(i), 0.5)));
  b.ceiling({0, 0, 3}, 1, 1, b.lamp(ConstantSpectrum{1.0}, 10.0));
  b.camera({0, 0, 0.1}, {0, 0, 1}, 1e-3, 4, 4);
  const auto passed = [](float eta) { return 1.0 - fresnel_dielectric(1.0f, eta); };
  const double expected =
      10.0 * 1.2 * 1.2 * passed(1.4f / 1.2f) * passed(1.6f / 1.4f) * passed(1 / 1.6f) * std::pow(0.5, 0.5);
  expect_luminance(render_finite(b, 4000, 4), expected, "from within", 1e-4);
}

/// Glass that stands on a white floor, a black one in the dark, or on a lamp, without a gap.
TEST(TouchingSolids, NoLightLeaksUnderGlassOnAFloor) {
  for (const double gap : kGaps) {
    SceneBuilder b = shining_room();
    b.floor({0, 0, -0.5}, 2, 2, b.material(diffuse(ConstantSpectrum{1.0})));
    const auto glass = b.material(solid_glass(1.5f, 0.0f));
    b.box({-0.5, -0.5, -0.5 + gap}, {0.5, 0.5, 0.3}, glass);
    b.box({-0.2, -0.3, 0.3 + gap}, {0.1, 0.2, 0.5}, glass);
    expect_unseen(b, "gap " + std::to_string(gap * 1e9) + "e-9");

    // Light from below reaches nobody.
    SceneBuilder dark;
    dark.ceiling({0, 0, 0}, 1, 1, dark.material(diffuse(ConstantSpectrum{0.5})));
    dark.floor({0, 0, 0}, 1, 1, dark.material(diffuse(ConstantSpectrum{0.5})));
    dark.box({-0.7, -0.7, gap}, {0.7, 0.7, 0.5}, dark.material(solid_glass(1.5f, 0.0f)));
    dark.floor({0, 0, -1}, 1, 1, dark.lamp(d65(), 1e6));
    dark.camera({0.3, 0.2, 2}, {0, 0, 0}, 30, 8, 8);
    const Film film = render_finite(dark.turn({1, 2, 0.5}, 0.5), 100, 20);
    EXPECT_EQ(luminance(film).mean, 0.0) << gap;
  }
}

std::vector<float> touching(const Scene& scene) {
  const std::vector<Surface> surfaces(scene.materials.begin(), scene.materials.end());
  return touching_triangles(scene.geometry, surfaces);
}

std::ptrdiff_t count_marked(const Scene& scene) {
  return std::ranges::count_if(touching(scene), [](float error) { return error > 0.0f; });
}

/// What touches is marked, what only shares an edge is not.
TEST(TouchingTriangles, AreThoseThatLieInOnePlace) {
  const auto marked = [](double gap, double shift, bool solid) {
    SceneBuilder b;
    const auto glass = b.material(solid_glass(1.5f, 0.0f)),
               paint = b.material(diffuse(ConstantSpectrum{0.5}));
    b.box({-1, 0, 0}, {0, 1, 1}, glass);
    b.box({gap, shift, 0}, {1, 1 + shift, 1}, solid ? glass : paint);
    b.sphere({9, 0, 0}, 1, 4, glass);
    return count_marked(b.turn({1, 1, 0}, 0.5).build());
  };
  for (const bool solid : {false, true}) {
    EXPECT_EQ(marked(0, 0, solid), 4);
    EXPECT_EQ(marked(1e-7, 0.3, solid), 4);
    EXPECT_EQ(marked(0, 0.99, solid), 4);
    EXPECT_EQ(marked(0, 1, solid), 0);
    EXPECT_EQ(marked(1e-4, 0, solid), 0);
  }
}

/// A pane in many places, on a glass cube or far from it: one place that touches is enough to mark it, as if
/// it stood there by itself.
TEST(TouchingTriangles, OfInstances) {
  const Affine on_top = placement({1, 1, 1}, {0, 0, 1}, 0, {0.5, 0.5, 1});
  const auto marked = [&](bool solid, const std::vector<Affine>& places, bool bake) {
    SceneBuilder b;
    const Material glass = solid_glass(1.5f, 0.0f), paint = diffuse(ConstantSpectrum{0.5});
    const auto alone = b.material(glass), shared = b.material(solid ? glass : paint);
    b.box({0, 0, 0}, {1, 1, 1}, alone);
    b.box({900, 900, 900}, {901, 901, 901}, alone);  // the box about all glass holds all panes
    b.floor({0, 0, 0}, 0.5, 0.5, shared);
    const Scene scene = with_instances(b.build(), places);
    return count_marked(bake ? baked(scene) : scene);
  };
  std::vector<Affine> places;
  for (int i = 0; i < 100; ++i)
    places.push_back(placement({1, 2, 3}, {1, 2, 3}, i, {7.0 * (i % 10) + 5, 70, 8.0 * (i / 10) + 9}));
  for (const bool solid : {false, true}) {
    EXPECT_EQ(marked(solid, places, false), 0);
    places.push_back(on_top);
    EXPECT_EQ(marked(solid, places, false), 4);
    EXPECT_EQ(marked(solid, places, true), 4);
    places.pop_back();
  }
}

}  // namespace
}  // namespace photopic
