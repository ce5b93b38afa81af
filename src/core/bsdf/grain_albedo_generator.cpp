/// Run by the build: integrates the tables of grain_albedo.h and writes them as C++ source.
#include <tbb/parallel_for.h>

#include <cstdio>
#include <fstream>

#include "core/bsdf/grain_albedo.h"

namespace photopic {
namespace {

using Weights = GrainAlbedo::Weights;

std::u16string integrate() {
  const VisibleNormals normals(2048);
  std::u16string numbers(static_cast<std::size_t>(GrainTable::kNodes) * kLanes, u'\0');
  tbb::parallel_for(0, GrainTable::kNodes, [&](int node) {
    std::ranges::copy(GrainTable::integrate(node, normals), numbers.begin() + std::ptrdiff_t{node} * kLanes);
  });
  return numbers;
}

/// Over a quarter of all azimuths, and cosines by their fourth roots: μ = x⁴, 2μ dμ = 8x⁷ dx.
Weights average(const GrainTable& table, const AnisotropicGgx& ggx) {
  constexpr int kTurns = 64, kHeights = 256;
  const GrainTable::SurfacePlace place(ggx);
  Weights sum;
  for (int i = 0; i < kTurns; ++i)
    for (int j = 0; j < kHeights; ++j) {
      const SinCos phi = sin_cos_two_pi(0.25f * (static_cast<float>(i) + 0.5f) / kTurns);
      const float x = (static_cast<float>(j) + 0.5f) / kHeights, z = sqr(sqr(x)),
                  r = safe_sqrt(1.0f - sqr(z));
      sum.add(table.look_up(place, {r * phi.cos, r * phi.sin, z}).weights(),
              8.0f * z * x * x * x / (kTurns * kHeights));
    }
  return sum;
}

/// A string: compilers read it ten times as fast as they do numbers.
void write_directional(std::ostream& out, const std::u16string& numbers) {
  out << "alignas(32) const char16_t GrainAlbedo::kDirectional[] =\n";
  char text[8];
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::snprintf(text, sizeof text, "\\x%x", unsigned{numbers[i]});
    out << (i % kLanes == 0 ? "u\"" : "") << text << (i % kLanes == kLanes - 1 ? "\"\n" : "");
  }
  out << ";\n";
}

void write(std::ostream& out, Weights w) {
  char text[32];
  const auto put = [&](float x) {
    std::snprintf(text, sizeof text, "%af,", double{x});
    out << text;
  };
  out << "{";
  put(w.f0), put(w.f90), put(std::log(std::max(w.missing, 1e-7f)));
  out << "{";
  for (const float x : w.rest) put(x);
  out << "}},\n";
}

void write_averages(std::ostream& out, const GrainTable& table) {
  constexpr int kRoughnesses = GrainAlbedo::kRoughnesses, kGrains = GrainAlbedo::kGrains;
  std::vector<Weights> averages(static_cast<std::size_t>(kRoughnesses * kGrains));
  tbb::parallel_for(0, kRoughnesses * kGrains, [&](int i) {
    averages[static_cast<std::size_t>(i)] =
        average(table, GrainTable::ggx_at(i / kGrains, kRoughnesses, i % kGrains, kGrains));
  });
  out << "const GrainAlbedo::Weights GrainAlbedo::kAverage[GrainAlbedo::kRoughnesses][GrainAlbedo::kGrains] "
         "= {\n";
  for (std::size_t i = 0; i < averages.size(); ++i) {
    if (i % kGrains == 0) out << "{";
    write(out, averages[i]);
    if (i % kGrains == kGrains - 1) out << "},\n";
  }
  out << "};\n";
}

}  // namespace
}  // namespace photopic

int main(int argument_count, char** arguments) {
  using namespace photopic;
  if (argument_count != 2) return std::fputs("usage: grain_albedo_generator OUTPUT.cpp\n", stderr), 2;
  std::ofstream file(arguments[1]);
  const std::u16string numbers = integrate();
  file << "#include \"core/bsdf/grain_albedo.h\"\nnamespace photopic {\n";
  write_directional(file, numbers);
  write_averages(file, GrainTable(numbers.data()));
  file << "}  // namespace photopic\n";
  return file.flush() ? 0 : 1;
}
