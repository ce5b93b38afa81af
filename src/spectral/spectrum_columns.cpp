// Spectra as lines of text: two columns, and CGATS.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>
#include <utility>

#include "error.h"
#include "spectral/spectrum_readers.h"

namespace photopic {
namespace {

struct Line {
  std::string_view text;  ///< without comment and blanks around it; never empty
  std::size_t number;
};

/// Lines that hold something, whatever ends them (LF, CR LF or CR).
std::vector<Line> split_lines(std::string_view text) {
  std::vector<Line> lines;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find_first_of("\r\n");
    std::string_view line = text.substr(0, end);
    const bool crlf = end != std::string_view::npos && text.substr(end, 2) == "\r\n";
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + (crlf ? 2 : 1));
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t") == std::string_view::npos) continue;
    lines.push_back({line, number});
  }
  return lines;
}

char separator_of(std::string_view line) {
  for (char c : {';', '\t', ','})
    if (line.find(c) != std::string_view::npos) return c;
  return ' ';
}

/// The line's fields, trimmed; an empty one at the end is dropped.
std::vector<std::string> split_fields(std::string_view line) {
  const char separator = separator_of(trimmed(line));
  std::vector<std::string> fields;
  while (true) {
    if (separator == ' ' || separator == '\t')  // a run of blanks is one
      line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const std::size_t end = line.find(separator);
    fields.emplace_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) break;
    line.remove_prefix(end + 1);
  }
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  // Where something else separates, a comma is decimal.
  if (separator == ';' || separator == '\t')
    for (std::string& field : fields)
      if (std::count(field.begin(), field.end(), ',') == 1 && field.find('.') == std::string::npos)
        std::replace(field.begin(), field.end(), ',', '.');
  return fields;
}

bool is_wavelength_header(const std::vector<std::string>& fields) {
  constexpr std::string_view kWord = "wavelength";
  return fields.size() >= 2 && fields[0].size() >= kWord.size() &&
         std::equal(kWord.begin(), kWord.end(), fields[0].begin(),
                    [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

bool holds_number(const std::vector<std::string>& fields) {
  return std::any_of(fields.begin(), fields.end(),
                     [](const std::string& f) { return parse_number(f).has_value(); });
}

/// The index of the first row of numbers. A row that is half a number is not taken for a header.
std::size_t first_row(const std::vector<Line>& lines) {
  for (std::size_t i = lines.size(); i > 0; --i)
    if (is_wavelength_header(split_fields(lines[i - 1].text))) return i;
  return !lines.empty() && !holds_number(split_fields(lines[0].text)) ? 1 : 0;
}

double number_at(const std::string& name, std::size_t line, std::string_view field) {
  if (const auto number = parse_number(field)) return *number;
  throw InputError(place(name, line), fmt::format("'{}' is not a number", field.substr(0, 40)),
                   "correct the row");
}

/// The line's numbers, of which there must be as many as expected; 0: two or more.
std::vector<double> parse_row(const std::string& name, const Line& line, std::size_t expected,
                              const char* remedy) {
  const auto fields = split_fields(line.text);
  if (fields.size() < 2 || (expected > 0 && fields.size() != expected))
    throw InputError(place(name, line.number),
                     fmt::format("{} column(s) where {} are expected", fields.size(),
                                 expected > 0 ? fmt::format("{}", expected) : "two or more"),
                     remedy);
  std::vector<double> numbers;
  for (const std::string& field : fields) numbers.push_back(number_at(name, line.number, field));
  return numbers;
}

struct Token {
  std::string text;
  std::size_t line;
  bool in_quotes;  ///< a value, never a keyword
};

/// Words between blanks; what stands in double quotes is one word.
std::vector<Token> split_tokens(std::string_view text) {
  std::vector<Token> tokens;
  for (const Line& line : split_lines(text)) {
    std::string_view rest = line.text;
    while (true) {
      rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
      if (rest.empty()) break;
      const bool in_quotes = rest[0] == '"';
      const std::size_t end =
          std::min(in_quotes ? rest.find('"', 1) : rest.find_first_of(" \t"), rest.size());
      tokens.push_back({std::string(trimmed(rest.substr(0, end))), line.number, in_quotes});
      rest.remove_prefix(std::min(in_quotes ? end + 1 : end, rest.size()));
    }
  }
  return tokens;
}

/// What follows a keyword; nothing when the keyword is missing.
const Token* value_of(const std::vector<Token>& tokens, std::string_view keyword) {
  const auto found = std::find_if(tokens.begin(), tokens.end(),
                                  [&](const Token& t) { return !t.in_quotes && t.text == keyword; });
  return found == tokens.end() || found + 1 == tokens.end() ? nullptr : &*(found + 1);
}

double required_number(const std::string& name, const std::vector<Token>& tokens, std::string_view keyword) {
  if (const Token* token = value_of(tokens, keyword)) return number_at(name, token->line, token->text);
  throw InputError(name, fmt::format("{} is missing", keyword), "give a CGATS file of one spectrum");
}

std::span<const Token> section(const std::string& name, const std::vector<Token>& tokens,
                               const std::string& keyword) {
  const auto is = [](std::string word) {
    return [word](const Token& t) { return !t.in_quotes && t.text == word; };
  };
  const auto begin = std::find_if(tokens.begin(), tokens.end(), is("BEGIN_" + keyword));
  const auto end = std::find_if(begin, tokens.end(), is("END_" + keyword));
  if (end == tokens.end())
    throw InputError(name, fmt::format("BEGIN_{0} … END_{0} is missing", keyword),
                     "give a CGATS file of one spectrum");
  return {begin + 1, end};
}

/// A CGATS file's wavelengths [nm], equally spaced, and what its values are to be divided by.
struct SpectralRange {
  double start, stop, bands, norm;
};

SpectralRange spectral_range(const std::string& name, const std::vector<Token>& tokens) {
  const SpectralRange range{
      required_number(name, tokens, "SPECTRAL_START_NM"), required_number(name, tokens, "SPECTRAL_END_NM"),
      required_number(name, tokens, "SPECTRAL_BANDS"),
      value_of(tokens, "SPECTRAL_NORM") ? required_number(name, tokens, "SPECTRAL_NORM") : 1.0};
  if (!(range.stop > range.start) || !(range.bands >= 2.0 && range.bands <= 1e6) ||
      range.bands != std::floor(range.bands) || !(range.norm > 0.0))
    throw InputError(name, "the spectral range, bands or norm make no sense",
                     "correct the SPECTRAL_… keywords");
  return range;
}

/// One data set's fields that begin with SPEC.
std::vector<SpectrumRow> spectral_values(const std::string& name, std::span<const Token> fields,
                                         std::span<const Token> data, const SpectralRange& range) {
  std::vector<SpectrumRow> rows;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (!fields[i].text.starts_with("SPEC")) continue;
    const double lambda =
        range.start + (range.stop - range.start) * static_cast<double>(rows.size()) / (range.bands - 1.0);
    rows.push_back({lambda, number_at(name, data[i].line, data[i].text) / range.norm, data[i].line});
  }
  if (static_cast<double>(rows.size()) != range.bands)
    throw InputError(name, fmt::format("{} spectral fields, but SPECTRAL_BANDS {}", rows.size(), range.bands),
                     "make them agree");
  return rows;
}

}  // namespace

std::vector<SpectrumRow> read_columns(const std::string& name, std::string_view text) {
  const auto lines = split_lines(text);
  std::vector<SpectrumRow> rows;
  for (std::size_t i = first_row(lines); i < lines.size(); ++i) {
    const auto numbers = parse_row(name, lines[i], 2, "give wavelength [nm] and one value");
    rows.push_back({numbers[0], numbers[1], lines[i].number});
  }
  return rows;
}

std::vector<std::vector<SpectrumRow>> read_many_columns(const std::string& name, std::string_view text) {
  const auto lines = split_lines(text);
  std::vector<std::vector<SpectrumRow>> spectra;
  for (std::size_t i = first_row(lines); i < lines.size(); ++i) {
    const auto numbers = parse_row(name, lines[i], spectra.empty() ? 0 : spectra.size() + 1,
                                   "give wavelength [nm] and as many values in every row");
    spectra.resize(numbers.size() - 1);
    for (std::size_t c = 0; c < spectra.size(); ++c)
      spectra[c].push_back({numbers[0], numbers[c + 1], lines[i].number});
  }
  return spectra;
}

std::vector<std::vector<SpectrumRow>> read_cgats_sets(const std::string& name, std::string_view text) {
  const auto tokens = split_tokens(text);
  const SpectralRange range = spectral_range(name, tokens);
  const auto fields = section(name, tokens, "DATA_FORMAT"), data = section(name, tokens, "DATA");
  if (fields.empty() || data.empty() || data.size() % fields.size() != 0)
    throw InputError(name, fmt::format("{} values for {} fields", data.size(), fields.size()),
                     "give every data set a value for every field");
  std::vector<std::vector<SpectrumRow>> sets;
  for (std::size_t first = 0; first < data.size(); first += fields.size())
    sets.push_back(spectral_values(name, fields, data.subspan(first, fields.size()), range));
  return sets;
}

std::vector<SpectrumRow> read_cgats(const std::string& name, std::string_view text) {
  auto sets = read_cgats_sets(name, text);
  if (sets.size() > 1)
    throw InputError(name, fmt::format("{} data sets where one is expected", sets.size()),
                     "keep the set of one spectrum");
  return std::move(sets[0]);
}

}  // namespace photopic
