/// Run by the build: integrates the table of ggx_albedo.h and writes it as C++ source.
#include <cstdio>
#include <fstream>

#include "core/bsdf/albedo_axes.h"
#include "core/bsdf/fresnel.h"
#include "core/bsdf/ggx_albedo.h"
#include "core/bsdf/visible_normals.h"

namespace photopic {
namespace {

using Factors = GgxAlbedo::Factors;
constexpr int kCosines = GgxAlbedo::kCosines, kRoughnesses = GgxAlbedo::kRoughnesses;

Factors integrate(const VisibleNormals& normals, float cos_theta, float roughness) {
  const VisibleNormals::Bounces bounces =
      normals.bounces({sqr(roughness), sqr(roughness)}, {safe_sqrt(1.0f - sqr(cos_theta)), 0.0f, cos_theta});
  Factors sum{bounces.missing, 0.0f};
  bounces.for_each([&](float cosine, float kept) { sum.bias += kept * schlick_weight(cosine); });
  return sum;
}

void write(std::ostream& out, Factors f) {
  char text[64];
  std::snprintf(text, sizeof text, "{%af,%af},\n", double{f.missing}, double{f.bias});
  out << text;
}

/// A roughness in each row, its average last.
void write(std::ostream& out) {
  const VisibleNormals normals(4096);
  const auto share = cosine_average_weights([](float c) { return locate_cosine(c, kCosines); }, kCosines);
  out << "#include \"core/bsdf/ggx_albedo.h\"\n"
         "namespace photopic {\n"
         "const GgxAlbedo::Factors GgxAlbedo::kTable[GgxAlbedo::kRoughnesses][GgxAlbedo::kCosines + 1] = {\n";
  for (int r = 0; r < kRoughnesses; ++r) {
    out << "{";
    Factors sum{0.0f, 0.0f};
    for (int c = 0; c < kCosines; ++c) {
      const Factors f = integrate(normals, albedo_cosine(c, kCosines), albedo_roughness(r, kRoughnesses));
      write(out, f);
      sum.missing += share[static_cast<std::size_t>(c)] * f.missing;
      sum.bias += share[static_cast<std::size_t>(c)] * f.bias;
    }
    write(out, sum);
    out << "},\n";
  }
  out << "};\n}  // namespace photopic\n";
}

}  // namespace
}  // namespace photopic

int main(int argument_count, char** arguments) {
  if (argument_count != 2) return std::fputs("usage: ggx_albedo_generator OUTPUT.cpp\n", stderr), 2;
  std::ofstream file(arguments[1]);
  photopic::write(file);
  return file.flush() ? 0 : 1;
}
