#include "spectral/sampled_spectrum.h"

#include <gtest/gtest.h>

namespace photopic {
namespace {

template <int N>
void check_arithmetic() {
  SampledSpectrum<N> a(2.0f), b(0.5f);
  a.set(N - 1, 3.0f);
  const SampledSpectrum<N> c =
      (a * b + a / b - b) * 2.0f;  // of 2: 2(1 + 4 − 0.5) = 9; of 3: 2(1.5 + 6 − 0.5) = 14
  for (int i = 0; i < N; ++i) EXPECT_EQ(c[i], i == N - 1 ? 14.0f : 9.0f);
  EXPECT_EQ(c.sum(), 9.0f * (N - 1) + 14.0f);
  EXPECT_EQ(sizeof(c), N * sizeof(float));
}

TEST(SampledSpectrum, Arithmetic) {
  check_arithmetic<1>();
  check_arithmetic<4>();
  check_arithmetic<8>();
  check_arithmetic<16>();
}

}  // namespace
}  // namespace photopic
