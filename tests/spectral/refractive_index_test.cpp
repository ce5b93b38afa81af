#include "spectral/refractive_index.h"

#include <gtest/gtest.h>

#include <cmath>

namespace photopic {
namespace {

double index_of(std::string_view glass, double lambda) {
  return refractive_index(glass_index(glass).value(), lambda);
}

/// n_d and V_d as the makers and papers print them.
TEST(GlassIndex, PublishedIndexAndAbbeNumber) {
  struct Published {
    const char* name;
    double n_d, v_d, n_error, v_error;
  };
  for (const Published& p :
       {Published{"BK7", 1.51680, 64.17, 1e-5, 0.01}, Published{"SF10", 1.72825, 28.41, 1e-5, 0.01},
        Published{"SF11", 1.78472, 25.76, 1e-5, 0.01}, Published{"F2", 1.62004, 36.37, 1e-5, 0.01},
        Published{"fused silica", 1.45846, 67.82, 1e-5, 0.03}, Published{"diamond", 2.4175, 55.3, 1e-3, 0.3},
        Published{"water", 1.33336, 55.8, 1e-4, 0.5}}) {
    const DielectricIndex index = glass_index(p.name).value();
    EXPECT_NEAR(refractive_index(index, 587.5618), p.n_d, p.n_error) << p.name;
    EXPECT_NEAR(abbe_number(index), p.v_d, p.v_error) << p.name;
    EXPECT_TRUE(is_dispersive(index));
  }
  EXPECT_EQ(glass_names().size(), 7u);
  EXPECT_FALSE(glass_index("BK8"));
}

/// Single lines: Schott's data sheets (F 486.1, C 656.3, g 435.8, r 706.5), Malitson's table 1 (435.8,
/// 656.3), water at the sodium line.
TEST(GlassIndex, PublishedLines) {
  EXPECT_NEAR(index_of("BK7", 486.1327), 1.52238, 1e-5);
  EXPECT_NEAR(index_of("BK7", 656.2725), 1.51432, 1e-5);
  EXPECT_NEAR(index_of("BK7", 435.8343), 1.52668, 1e-5);
  EXPECT_NEAR(index_of("BK7", 706.5188), 1.51289, 1e-5);
  EXPECT_NEAR(index_of("SF10", 486.1327), 1.74648, 2e-5);
  EXPECT_NEAR(index_of("F2", 486.1327), 1.63208, 2e-5);
  EXPECT_NEAR(index_of("SF11", 656.2725), 1.77599, 2e-5);
  EXPECT_NEAR(index_of("fused silica", 435.8343), 1.46669, 2e-5);
  EXPECT_NEAR(index_of("fused silica", 656.2725), 1.45637, 2e-5);
  EXPECT_NEAR(index_of("water", 589.29), 1.3334, 2e-4);
}

/// Glass that is clear has normal dispersion throughout the visible.
TEST(GlassIndex, FallsWithWavelength) {
  for (const std::string_view name : glass_names())
    for (double lambda = kLambdaMin; lambda < kLambdaMax; ++lambda)
      EXPECT_GT(index_of(name, lambda), index_of(name, lambda + 1.0)) << name << ' ' << lambda;
}

TEST(GlassIndex, KhronosDispersion) {
  // The extension's formula, written out, for V_d = 20.
  const double expected = 1.5 + 0.5 / 20.0 * (523655.0 / (400.0 * 400.0) - 1.5168);
  EXPECT_NEAR(refractive_index(abbe_index(1.5, 1.0), 400.0), expected, 1e-12);
  EXPECT_NEAR(abbe_number(abbe_index(1.7, 20.0 / 30.0)), 30.0, 0.05);
  EXPECT_NEAR(refractive_index(abbe_index(1.7, 20.0 / 30.0), 587.56), 1.7, 2e-5);
  EXPECT_FALSE(is_dispersive(abbe_index(1.5, 0.0)));
  EXPECT_EQ(refractive_index(abbe_index(1.5, 0.0), 400.0), 1.5);
  EXPECT_TRUE(std::isinf(abbe_number(CauchyIndex{1.5})));
  EXPECT_EQ(refractive_index(abbe_index(1.01, 1000.0), 830.0), 1.0);  // never below vacuum
}

TEST(ConductorIndex, CoversTheRangeAndMatchesTables) {
  EXPECT_EQ(conductor_names().size(), 11u);
  for (const std::string_view name : conductor_names()) {
    const ConductorIndex index = conductor_index(name).value();
    EXPECT_LE(index.n.lambda().front(), kLambdaMin) << name;
    EXPECT_GE(index.n.lambda().back(), kLambdaMax) << name;
    for (double lambda = kLambdaMin; lambda <= kLambdaMax; ++lambda) {
      EXPECT_GT(index.n(lambda), 0.0) << name;
      EXPECT_GT(index.k(lambda), 1.0) << name;  // all of them are opaque metals
    }
  }
  EXPECT_FALSE(conductor_index("Xx"));
}

/// Fresnel's at normal incidence.
double normal_reflectance(double n, double k) {
  return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
}
double normal_reflectance(std::string_view metal, double lambda) {
  const ConductorIndex index = conductor_index(metal).value();
  return normal_reflectance(index.n(lambda), index.k(lambda));
}

/// Against handbook reflectances of evaporated films (Hass 1965). Samples of
/// one metal differ; a wrong unit, a wrong column or another metal would be far off.
TEST(ConductorIndex, ReflectanceOfEvaporatedFilms) {
  EXPECT_NEAR(normal_reflectance("Al", 550), 0.915, 0.01);
  EXPECT_NEAR(normal_reflectance("Ag", 600), 0.979, 0.015);
  EXPECT_NEAR(normal_reflectance("Au", 500), 0.477, 0.04);
  EXPECT_NEAR(normal_reflectance("Au", 600), 0.919, 0.01);
  EXPECT_NEAR(normal_reflectance("Cu", 500), 0.600, 0.01);
  EXPECT_NEAR(normal_reflectance("Cu", 650), 0.966, 0.06);
}

/// Against other measurements of the same metals: Ni and W as Rakić et al. 1998 fit several sources, Fe by
/// Ordal et al. 1988.
TEST(ConductorIndex, ReflectanceOfFurtherMetals) {
  EXPECT_NEAR(normal_reflectance("Ni", 437), normal_reflectance(1.606, 2.609), 0.06);
  EXPECT_NEAR(normal_reflectance("Ni", 548), normal_reflectance(1.813, 3.263), 0.06);
  EXPECT_NEAR(normal_reflectance("Ni", 704), normal_reflectance(2.187, 3.990), 0.06);
  EXPECT_NEAR(normal_reflectance("W", 448), normal_reflectance(3.309, 2.601), 0.02);
  EXPECT_NEAR(normal_reflectance("W", 544), normal_reflectance(3.495, 2.753), 0.02);
  EXPECT_NEAR(normal_reflectance("W", 703), normal_reflectance(3.656, 2.790), 0.02);
  EXPECT_NEAR(normal_reflectance("Fe", 667), normal_reflectance(2.874, 3.359), 0.03);
  EXPECT_NEAR(normal_reflectance("Fe", 769), normal_reflectance(2.974, 3.547), 0.03);
}

/// Zinc moves copper's edge from the orange towards the green.
TEST(ConductorIndex, BrassIsYellowerThanCopper) {
  EXPECT_GT(normal_reflectance("brass", 550), normal_reflectance("Cu", 550) + 0.1);
  EXPECT_LT(normal_reflectance("brass", 440), 0.5);
  EXPECT_GT(normal_reflectance("brass", 620), 0.8);
}

}  // namespace
}  // namespace photopic
