// Spectra in JSON and XML.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "error.h"
#include "spectral/spectrum_readers.h"

namespace photopic {
namespace {

using Json = nlohmann::json;

constexpr const char* kRemedy = "give LSPDD's JSON, with its spectraldata";

std::size_t line_of(std::string_view text, std::size_t offset) {
  return 1 + static_cast<std::size_t>(
                 std::count(text.begin(), text.begin() + std::min(offset, text.size()), '\n'));
}

Json parse_json(const std::string& name, std::string_view text) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw InputError(place(name, line_of(text, error.byte)), "not valid JSON", "mend it or export it anew");
  } catch (const Json::out_of_range&) {
    throw InputError(name, "holds a number too large for a double", "mend it or export it anew");
  }
}

double json_number(const std::string& name, std::size_t line, const Json& json) {
  if (json.is_number()) return json.get<double>();
  if (json.is_string())
    if (const auto number = parse_number(json.get_ref<const std::string&>())) return *number;
  throw InputError(place(name, line), "holds something that is not a number", "correct the row");
}

/// A row is [nm, value] or an object with a wavelength and one other number.
SpectrumRow json_row(const std::string& name, std::size_t line, const Json& row) {
  if (row.is_array() && row.size() == 2)
    return {json_number(name, line, row[0]), json_number(name, line, row[1]), line};
  if (row.is_object() && row.size() == 2 && row.contains("wavelength"))
    for (const auto& [key, value] : row.items())
      if (key != "wavelength")
        return {json_number(name, line, row["wavelength"]), json_number(name, line, value), line};
  throw InputError(place(name, line), "not a pair of wavelength and value", kRemedy);
}

std::vector<SpectrumRow> json_rows(const std::string& name, const Json& rows) {
  std::vector<SpectrumRow> out;
  for (const Json& row : rows) out.push_back(json_row(name, out.size() + 1, row));
  return out;
}

/// Text without line ends: "400,0.1;401,0.2" or the numbers one after another.
std::vector<SpectrumRow> rows_on_one_line(const std::string& name, std::string text) {
  if (text.find(';') != std::string::npos) {
    std::replace(text.begin(), text.end(), ';', '\n');
    return read_columns(name, text);
  }
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == '\t'; }, ' ');
  std::vector<double> numbers;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (end > 0) numbers.push_back(json_number(name, numbers.size() / 2 + 1, Json(rest.substr(0, end))));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (numbers.size() % 2 != 0) throw InputError(name, "a wavelength is without its value", kRemedy);
  std::vector<SpectrumRow> rows;
  for (std::size_t i = 0; i < numbers.size(); i += 2) rows.push_back({numbers[i], numbers[i + 1], i / 2 + 1});
  return rows;
}

std::vector<SpectrumRow> spectraldata_rows(const std::string& name, const Json& data) {
  if (data.is_array()) return json_rows(name, data);
  if (!data.is_string()) throw InputError(name, "is neither text nor a list", kRemedy);
  const std::string& text = data.get_ref<const std::string&>();
  if (text.find_first_not_of(" \t\r\n") != std::string::npos &&
      text[text.find_first_not_of(" \t\r\n")] == '[')
    return json_rows(name, parse_json(name, text));
  return text.find_first_of("\r\n") == std::string::npos ? rows_on_one_line(name, text)
                                                         : read_columns(name, text);
}

std::vector<SpectrumRow> paired_lists(const std::string& name, const Json& nm, const Json& value) {
  if (!nm.is_array() || !value.is_array() || nm.size() != value.size())
    throw InputError(name, "nm and value are not lists of the same length",
                     "give a value for every wavelength");
  std::vector<SpectrumRow> rows;
  for (std::size_t i = 0; i < nm.size(); ++i)
    rows.push_back({json_number(name, i + 1, nm[i]), json_number(name, i + 1, value[i]), i + 1});
  return rows;
}

/// The element's name without a namespace prefix.
std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view full = node.name();
  const std::size_t colon = full.find(':');
  return colon == std::string_view::npos ? full : full.substr(colon + 1);
}

}  // namespace

std::vector<SpectrumRow> read_spectrum_json(const std::string& name, std::string_view text) {
  Json json = parse_json(name, text);
  if (json.is_array() && json.size() == 1) json = Json(json[0]);
  if (json.is_object() && json.contains("spectraldata"))
    return spectraldata_rows(name + "#spectraldata", json["spectraldata"]);
  if (json.is_object() && json.contains("nm") && json.contains("value"))
    return paired_lists(name, json["nm"], json["value"]);
  throw InputError(name, "holds no spectraldata", kRemedy);
}

std::vector<SpectrumRow> read_spdx(const std::string& name, std::string_view text) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
  if (!result)
    throw InputError(place(name, line_of(text, static_cast<std::size_t>(result.offset))),
                     fmt::format("not valid XML ({})", result.description()), "mend it or export it anew");

  std::vector<SpectrumRow> rows;
  std::size_t distributions = 0, line = 1, counted = 0;
  for (const pugi::xml_node& distribution : document.document_element().children()) {
    if (local_name(distribution) != "SpectralDistribution") continue;
    if (++distributions > 1) throw InputError(name, "holds several spectral distributions", "keep one");
    for (const pugi::xml_node& node : distribution.children()) {
      if (local_name(node) != "SpectralData") continue;
      const std::size_t offset = std::min(static_cast<std::size_t>(node.offset_debug()), text.size());
      line += static_cast<std::size_t>(std::count(text.begin() + counted, text.begin() + offset, '\n'));
      counted = offset;
      const auto lambda = parse_number(node.attribute("wavelength").value()),
                 value = parse_number(node.child_value());
      if (!lambda || !value)
        throw InputError(place(name, line), "SpectralData without a wavelength and a number",
                         "correct the row");
      rows.push_back({*lambda, *value, line});
    }
  }
  if (distributions == 0) throw InputError(name, "holds no SpectralDistribution", "give an IES TM-27 file");
  return rows;
}

}  // namespace photopic
