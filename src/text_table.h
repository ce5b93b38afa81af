#pragma once

#include <string>
#include <vector>

namespace photopic {

/// Rows of cells set out in columns; the first row holds the headings, the first column stands left, the
/// others right. Control characters become blanks.
std::string format_table(const std::vector<std::vector<std::string>>& cells);

/// The same with all columns standing left, as words do; nothing trails.
std::string format_columns(const std::vector<std::vector<std::string>>& cells);

}  // namespace photopic
