#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "error.h"
#include "spectral/spectrum_readers.h"

namespace {

using Reader = std::vector<photopic::SpectrumRow> (*)(const std::string&, std::string_view);

/// A table, if there is one, is evaluated and made an emission.
void read(Reader reader, std::string_view text) {
  using namespace photopic;
  try {
    const TabulatedSpectrum table = table_from_rows("input", reader("input", text), Beyond::zero);
    const TabulatedSpectrum emission = tabulate_emission(table);
    if (!(emission(555.0) >= 0.0)) throw std::logic_error("an emission is negative or not a number");
  } catch (const InputError&) {
  } catch (const std::invalid_argument&) {
  }
}

}  // namespace

/// Reads the input by every reader of spectrum files.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const Reader reader :
       {photopic::read_columns, photopic::read_cgats, photopic::read_spectrum_json, photopic::read_spdx})
    read(reader, text);
  return 0;
}
