#include "text_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "error.h"

namespace photopic {
namespace {

/// Characters of UTF-8 text: bytes that do not continue another.
std::size_t character_count(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::vector<std::size_t> column_widths(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], character_count(row[i]));
  }
  return widths;
}

/// A line's end or an escape in a name would break the table.
std::vector<std::vector<std::string>> cleaned(std::vector<std::vector<std::string>> rows) {
  for (auto& row : rows)
    for (std::string& cell : row) cell = without_controls(std::move(cell));
  return rows;
}

}  // namespace

std::string format_table(const std::vector<std::vector<std::string>>& cells) {
  const auto rows = cleaned(cells);
  const std::vector<std::size_t> widths = column_widths(rows);
  std::string table;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - character_count(row[i]), ' ');
      table += i == 0 ? row[i] + padding : "  " + padding + row[i];
    }
    table += '\n';
  }
  return table;
}

std::string format_columns(const std::vector<std::vector<std::string>>& cells) {
  const auto rows = cleaned(cells);
  const std::vector<std::size_t> widths = column_widths(rows);
  std::string table;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      table += (i == 0 ? "" : "  ") + row[i];
      if (i + 1 < row.size()) table.append(widths[i] - character_count(row[i]), ' ');
    }
    while (table.ends_with(' ')) table.pop_back();
    table += '\n';
  }
  return table;
}

}  // namespace photopic
