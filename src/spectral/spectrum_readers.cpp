#include "spectral/spectrum_readers.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "error.h"

namespace photopic {
namespace {

void check_row(const std::string& name, const SpectrumRow& row) {
  const auto fail = [&](const std::string& problem, const std::string& remedy) {
    throw InputError(place(name, row.line), problem, remedy);
  };
  if (!std::isfinite(row.lambda) || !std::isfinite(row.value))
    fail("a number is not finite", "correct the row");
  if (row.lambda <= 0.0)
    fail(fmt::format("the wavelength {} is not positive", row.lambda), "give wavelengths in nm");
  if (row.value < 0.0)
    fail(fmt::format("the value {} is negative", row.value),
         "correct it, or write 0 where it is an instrument's noise");
}

void check_order(const std::string& name, const std::vector<SpectrumRow>& rows, std::size_t i) {
  if (i >= 1 && rows[i].lambda < rows[i - 1].lambda)
    throw InputError(place(name, rows[i].line),
                     fmt::format("the wavelength {} follows {}", rows[i].lambda, rows[i - 1].lambda),
                     "sort the rows by wavelength");
  if (i >= 2 && rows[i].lambda == rows[i - 2].lambda)
    throw InputError(place(name, rows[i].line), fmt::format("a third row for {} nm", rows[i].lambda),
                     "keep one, or two for a jump");
}

/// What the wavelengths' unit is where they are hardly in nm; else empty.
std::string other_unit(double shortest, double longest) {
  if (longest < 1e-4) return "metres (multiply by 1e9)";
  if (longest < 10.0) return "micrometres (multiply by 1000) or electronvolts (divide 1239.84 by them)";
  const bool visible_as_angstrom = shortest < 10.0 * kLambdaMax && longest > 10.0 * kLambdaMin;
  return shortest > kLambdaMax && visible_as_angstrom ? "ångström (divide by 10)" : "";
}

/// Told before the order, which turns round from electronvolts to nm.
void check_unit(const std::string& name, const std::vector<SpectrumRow>& rows) {
  const auto [shortest, longest] = std::ranges::minmax(rows, {}, &SpectrumRow::lambda);
  const std::string problem = unit_problem(shortest.lambda, longest.lambda);
  if (!problem.empty()) throw InputError(name, problem, "give them in nm");
}

}  // namespace

std::string unit_problem(double shortest, double longest) {
  const std::string unit = shortest > 0.0 ? other_unit(shortest, longest) : "";
  return unit.empty() ? "" : fmt::format("the wavelengths, {} to {}, look like {}", shortest, longest, unit);
}

TabulatedSpectrum table_from_rows(const std::string& name, const std::vector<SpectrumRow>& rows,
                                  Beyond beyond) {
  if (rows.empty()) throw InputError(name, "holds no rows", "give rows of wavelength [nm] and value");
  if (rows.size() == 1)
    throw InputError(name, "holds a single row", "give at least two (line:NM is a spectral line)");
  check_unit(name, rows);
  std::vector<double> lambda, value;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    check_row(name, rows[i]);
    check_order(name, rows, i);
    lambda.push_back(rows[i].lambda);
    value.push_back(rows[i].value);
  }
  return {std::move(lambda), std::move(value), beyond};
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kAround = " \t\r\n\"'";
  const std::size_t first = text.find_first_not_of(kAround);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kAround) - first + 1);
}

std::optional<double> parse_number(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string place(const std::string& name, std::size_t line) {
  return fmt::format("{}:{}", name, line);
}

}  // namespace photopic
