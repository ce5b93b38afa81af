#pragma once

#include <string>
#include <string_view>

namespace photopic {

/// All that a person reads on a terminal goes through here: names from files may hold control characters,
/// and the terminal shall not obey them. A stderr that takes nothing is borne with.

/// One line on stderr, `photopic: …`.
void print_error(const std::string& text);

/// One line on stderr, `warning: …`.
void print_warning(const std::string& text);

/// One line on stderr, `note: …`: nothing is wrong.
void print_note(const std::string& text);

/// Lines on stdout.
void print_out(std::string_view text);

/// Whether stdout took all that was printed: a full disk may be behind it. What is missing is told on stderr,
/// but for a reader that had enough.
bool check_stdout();

}  // namespace photopic
