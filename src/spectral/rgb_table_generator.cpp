/// Run by the build: writes the table of rgb_table.h as C++ source.
#include <cmath>
#include <cstdio>
#include <fstream>

#include "spectral/rgb_table.h"

namespace photopic::rgb_table {
namespace {

/// A node as it is stored. Dark ones differ in scale alone, which the storage takes out: at z = 0, where
/// there is no colour, the next stands in.
SigmoidPolynomial stored(int largest, int i, int j, int k) {
  const double z = node(i == 0 ? 1 : i);
  double rgb[3];
  rgb[largest] = z;
  rgb[(largest + 1) % 3] = z * node(j);
  rgb[(largest + 2) % 3] = z * node(k);
  const SigmoidPolynomial s = upsample_reflectance({rgb[0], rgb[1], rgb[2]});
  const float grey = constant_sigmoid((rgb[0] + rgb[1] + rgb[2]) / 3.0).c2,
              scale = static_cast<float>(std::sqrt(z));
  return {s.c0 * scale, s.c1 * scale, (s.c2 - grey) * scale};
}

void write(std::ostream& out) {
  out << "namespace photopic::rgb_table {\nextern const float kNodes[];\nconst float kNodes[] = {\n";
  char line[96];
  for (int largest = 0; largest < 3; ++largest)
    for (int i = 0; i < kSize; ++i)
      for (int j = 0; j < kSize; ++j)
        for (int k = 0; k < kSize; ++k) {
          const SigmoidPolynomial s = stored(largest, i, j, k);
          std::snprintf(line, sizeof line, "%af,%af,%af,\n", double{s.c0}, double{s.c1}, double{s.c2});
          out << line;
        }
  out << "0.0f, 0.0f};\n}  // namespace photopic::rgb_table\n";  // the last pair is read as eight numbers
}

}  // namespace
}  // namespace photopic::rgb_table

int main(int argument_count, char** arguments) {
  if (argument_count != 2) return std::fputs("usage: rgb_table_generator OUTPUT.cpp\n", stderr), 2;
  std::ofstream file(arguments[1]);
  photopic::rgb_table::write(file);
  return file.flush() ? 0 : 1;
}
