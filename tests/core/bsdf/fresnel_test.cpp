#include "core/bsdf/fresnel.h"

#include <gtest/gtest.h>

#include <complex>

namespace photopic {
namespace {

constexpr double kDegree = 3.14159265358979 / 180.0;

TEST(Fresnel, DielectricAtNormalIncidenceBrewsterAndBeyondTheCriticalAngle) {
  for (float eta : {1.33f, 1.5f, 2.4f, 1 / 1.5f}) {
    EXPECT_NEAR(fresnel_dielectric(1.0f, eta), sqr((eta - 1) / (eta + 1)), 1e-6);
    // At Brewster's angle only the perpendicular part is left: ((1 − η²)/(1 + η²))².
    const float brewster = 1.0f / std::sqrt(1.0f + sqr(eta));
    EXPECT_NEAR(fresnel_dielectric(brewster, eta), 0.5 * std::pow((1 - eta * eta) / (1 + eta * eta), 2),
                1e-6);
    EXPECT_NEAR(fresnel_dielectric(1e-6f, eta), 1.0, 1e-4);
  }
  // Both sides of an interface reflect alike.
  const float cos_i = 0.6f, cos_t = std::sqrt(1.0f - (1.0f - sqr(cos_i)) / sqr(1.5f));
  EXPECT_NEAR(fresnel_dielectric(cos_i, 1.5f), fresnel_dielectric(cos_t, 1 / 1.5f), 1e-6f);
  EXPECT_NEAR(fresnel_dielectric(0.3f, 1.0f), 0.0f, 1e-12f);
  const float critical = std::sqrt(1.0f - 1.0f / sqr(1.5f));
  EXPECT_EQ(fresnel_dielectric(critical * 0.999f, 1 / 1.5f), 1.0f);
  EXPECT_LT(fresnel_dielectric(critical * 1.001f, 1 / 1.5f), 1.0f);
}

/// The amplitudes' textbook form, in double precision.
double conductor_by_amplitudes(double cos_i, std::complex<double> n) {
  const std::complex<double> cos_t = std::sqrt(1.0 - (1.0 - cos_i * cos_i) / (n * n));
  const std::complex<double> rs = (cos_i - n * cos_t) / (cos_i + n * cos_t),
                             rp = (n * cos_i - cos_t) / (n * cos_i + cos_t);
  return 0.5 * (std::norm(rs) + std::norm(rp));
}

TEST(Fresnel, ConductorAgreesWithAmplitudes) {
  for (const auto& [n, k] : {std::pair{0.2, 3.0}, {1.5, 7.0}, {1.5, 1.9}, {3.0, 3.3}, {0.05, 4.0}}) {
    const auto fn = static_cast<float>(n), fk = static_cast<float>(k);
    EXPECT_NEAR(fresnel_conductor(1.0f, fn, fk), ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k),
                1e-6);
    for (double theta = 0.0; theta < 90.0; theta += 5.0)
      EXPECT_NEAR(fresnel_conductor(static_cast<float>(std::cos(theta * kDegree)), fn, fk),
                  conductor_by_amplitudes(std::cos(theta * kDegree), {n, k}), 2e-6)
          << n << ' ' << k << ' ' << theta;
  }
}

TEST(Fresnel, ConductorWithoutAbsorptionIsADielectric) {
  for (float n : {1.2f, 1.5f, 2.4f})
    for (float cos_i : {0.05f, 0.3f, 0.7f, 1.0f})
      EXPECT_NEAR(fresnel_conductor(cos_i, n, 0.0f), fresnel_dielectric(cos_i, n), 2e-6);
}

/// No film: thickness zero, or an index equal to the base's or to the outside's.
TEST(ThinFilm, ThatIsNoFilmChangesNothing) {
  for (const Complex base : {Complex{1.5f}, Complex{0.2f, 3.0f}, Complex{2.7f, 3.0f}})
    for (float cos_i : {0.0f, 1e-4f, 1.5e-4f, 0.02f, 0.3f, 0.7f, 1.0f}) {
      const float bare = fresnel_conductor(std::max(cos_i, 1e-6f), base.re, base.im);
      EXPECT_NEAR((ThinFilm{1.0f, 1.8f, base, 0.0f}.reflectance(cos_i)), bare, 3e-6);
      EXPECT_NEAR((ThinFilm{1.0f, 1.0f, base, 5.0f}.reflectance(cos_i)), bare, 3e-6);
      if (base.im == 0.0f) {
        EXPECT_NEAR((ThinFilm{1.0f, base.re, base, 5.0f}.reflectance(cos_i)), bare, 3e-6);
      }
    }
}

/// The interfaces' amplitudes, summed up by Abelès' matrix of the film (Born & Wolf 1999, section 1.6.2), in
/// double precision.
double film_by_matrix(const ThinFilm& f, double cos_i) {
  using Number = std::complex<double>;
  const auto q_of = [&](Number n) {
    return std::sqrt(n * n - static_cast<double>(sqr(f.outside)) * (1.0 - cos_i * cos_i));
  };
  const Number n0 = f.outside, n1 = f.film, n2{f.base.re, f.base.im};
  const Number beta = q_of(n1) * static_cast<double>(f.phase), i{0.0, 1.0};
  double sum = 0.0;
  for (const bool parallel : {false, true}) {
    const auto admittance = [&](Number n) { return parallel ? n * n / q_of(n) : q_of(n); };
    const Number a0 = admittance(n0), a1 = admittance(n1), a2 = admittance(n2);
    const Number b = std::cos(beta) - i * a2 / a1 * std::sin(beta),
                 c = a2 * std::cos(beta) - i * a1 * std::sin(beta);
    sum += 0.5 * std::norm((a0 * b - c) / (a0 * b + c));
  }
  return sum;
}

/// Films thinner than what is outside them have a critical angle; about it, and as far as it goes, nothing
/// jumps.
TEST(ThinFilm, AgreesWithItsMatrixAboutTheCriticalAngle) {
  for (const float outside : {1.33f, 1.5f, 2.4f})
    for (const Complex base : {Complex{1.0f}, Complex{1.5f}, Complex{0.2f, 3.0f}})
      for (const float phase : {0.1f, 1.0f, 5.0f}) {
        const ThinFilm film{outside, 1.3f, base, phase};
        const float critical = std::sqrt(1.0f - sqr(1.3f / outside));
        for (const float aside : {0.0f, 1e-7f, 1e-6f, 1e-5f, 1e-4f, 1e-3f, 0.1f})
          for (const float cos_i : {critical - aside, critical + aside})
            EXPECT_NEAR(film.reflectance(cos_i), film_by_matrix(film, cos_i), 2e-4)
                << outside << ' ' << base.re << ' ' << phase << ' ' << cos_i;
      }
}

/// A quarter wave of index √n on glass reflects nothing at normal incidence; any other film of a quarter wave
/// ((n0·n2 − n1²)/(n0·n2 + n1²))²; half a wave is not seen.
TEST(ThinFilm, QuarterAndHalfWaves) {
  const float n = 1.52f;
  const auto phase = [](float index, float waves) { return 2.0f * kPi * waves / index; };
  const float root = std::sqrt(n);
  EXPECT_NEAR((ThinFilm{1.0f, root, {n}, phase(root, 0.25f)}.reflectance(1.0f)), 0.0, 1e-6);
  for (float film : {1.38f, 2.3f}) {  // magnesium fluoride, zinc sulphide
    EXPECT_NEAR((ThinFilm{1.0f, film, {n}, phase(film, 0.25f)}.reflectance(1.0f)),
                std::pow((n - film * film) / (n + film * film), 2), 1e-5);
    EXPECT_NEAR((ThinFilm{1.0f, film, {n}, phase(film, 0.5f)}.reflectance(1.0f)), sqr((n - 1) / (n + 1)),
                1e-5);
  }
}

/// Beyond the critical angle all is reflected, unless the gap is so thin that light tunnels through: then the
/// two sides agree, R(a → b) = R(b → a) for lossless media.
TEST(ThinFilm, TotalReflectionAndItsFrustration) {
  const float cos_60 = 0.5f;
  EXPECT_NEAR((ThinFilm{1.5f, 1.0f, {1.5f}, 50.0f}.reflectance(cos_60)), 1.0, 1e-6);
  EXPECT_LT((ThinFilm{1.5f, 1.0f, {1.5f}, 0.1f}.reflectance(cos_60)), 0.5);
  for (float cos_i : {0.9f, 0.6f, 0.2f}) {
    const float sin_t = std::sqrt(1 - sqr(cos_i)) / 1.5f, cos_t = std::sqrt(1 - sqr(sin_t));
    EXPECT_NEAR((ThinFilm{1.0f, 2.2f, {1.5f}, 1.7f}.reflectance(cos_i)),
                (ThinFilm{1.5f, 2.2f, {1.0f}, 1.7f}.reflectance(cos_t)), 1e-5);
  }
}

/// Averaged over all phases, the coherent sum is the incoherent one: 1 − (1−R1)(1−R2)/(1−R1·R2), each
/// polarisation alone (here normal incidence, where they are equal).
TEST(ThinFilm, AveragesToIncoherentBounces) {
  const float film = 1.9f, base = 1.5f;
  const double r1 = sqr((film - 1) / (film + 1)), r2 = sqr((film - base) / (film + base));
  double mean = 0.0;
  for (int i = 0; i < 256; ++i)
    mean += ThinFilm{1.0f, film, {base}, kPi * static_cast<float>(i) / 256 / film}.reflectance(1.0f) / 256;
  EXPECT_NEAR(mean, 1.0 - (1 - r1) * (1 - r2) / (1 - r1 * r2), 1e-5);
}

}  // namespace
}  // namespace photopic
