#include "core/gltf/name_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <utility>
#include <vector>

namespace photopic {
namespace {

constexpr std::size_t kShown = 5, kFew = 12, kLongest = 60;

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  a = a.substr(0, kLongest), b = b.substr(0, kLongest);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (const char c : a) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 1; j <= b.size(); ++j)
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, diagonal + (c != b[j - 1])}));
  }
  return row.back();
}

int parse_index(std::string_view text) {
  constexpr std::string_view kPrefix = "index:";
  if (text.starts_with(kPrefix)) text.remove_prefix(kPrefix.size());
  int index = -1;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, index);
  return error == std::errc() && rest == end ? index : -1;
}

std::string namesake_warning(std::string_view kind, const std::string& name, int other) {
  return fmt::format(
      "--{0} {1}: several {0}s have that name; the first is taken, others by their index, as index:{2}", kind,
      name, other);
}

std::string choose_one_of(std::span<const std::string> names, const std::string& wanted) {
  if (names.size() <= kFew) return fmt::format("choose one of \"{}\"", fmt::join(names, "\", \""));
  std::vector<std::pair<std::size_t, std::string_view>> nearest;
  for (const std::string& name : names) nearest.emplace_back(edit_distance(name, wanted), name);
  std::ranges::stable_sort(nearest, {}, &std::pair<std::size_t, std::string_view>::first);
  std::vector<std::string_view> shown;
  for (std::size_t i = 0; i < kShown; ++i) shown.push_back(nearest[i].second);
  return fmt::format("choose one of {}, as \"{}\" (photopic info lists them)", names.size(),
                     fmt::join(shown, "\", \""));
}

}  // namespace photopic
