#include "messages.h"

#include <fmt/format.h>
#include <sys/poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <iostream>
#include <system_error>

#include "error.h"

namespace photopic {

namespace {

/// fmt::print would throw where stderr takes nothing: nobody is left to be told, but the work goes on.
void print_line(const char* kind, const std::string& text) {
  std::fputs(fmt::format("{}: {}\n", kind, without_controls(text)).c_str(), stderr);
}

/// Whether standard output is a pipe whose reader has ended, as `| head -1` does.
bool reader_has_ended() {
  pollfd out{.fd = STDOUT_FILENO, .events = POLLOUT, .revents = 0};
  return ::poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0;
}

}  // namespace

void print_error(const std::string& text) {
  print_line("photopic", text);
}

void print_warning(const std::string& text) {
  print_line("warning", text);
}

void print_note(const std::string& text) {
  print_line("note", text);
}

void print_out(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = text.find('\n');
    const std::string line = without_controls(std::string(text.substr(0, length)));
    std::fwrite(line.data(), 1, line.size(), stdout);
    if (length == text.npos) return;
    std::fputc('\n', stdout);
    text.remove_prefix(length + 1);
  }
}

bool check_stdout() {
  errno = 0;
  const bool good = (std::cout.flush().good() & (std::fflush(stdout) == 0)) && std::ferror(stdout) == 0;
  if (good) return true;
  if (reader_has_ended()) return false;
  const std::string why = errno != 0 ? ": " + std::generic_category().message(errno) : "";
  print_error("standard output cannot be written to" + why + "; check where it leads");
  return false;
}

}  // namespace photopic
