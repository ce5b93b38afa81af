#include "core/image_channels.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace photopic {
namespace {

using Names = std::vector<std::string>;

/// The names of the colours, in whatever order the channels are.
Names found(Names names) {
  Names colors;
  std::ranges::sort(names);
  do {
    const auto channels = find_color_channels(names);
    Names these;
    if (channels)
      for (const std::size_t index : channels->index) these.push_back(names[index]);
    if (!colors.empty()) {
      EXPECT_EQ(these, colors);
    }
    colors = these;
  } while (names.size() < 6 && std::ranges::next_permutation(names).found);
  return colors;
}

TEST(ImageChannels, ThePicturesOwnComeFirst) {
  EXPECT_EQ(found({"A", "B", "G", "R"}), (Names{"R", "G", "B"}));
  EXPECT_EQ(found({"b", "g", "r"}), (Names{"r", "g", "b"}));
  EXPECT_EQ(found({"R", "G", "B", "X", "Y", "Z"}), (Names{"R", "G", "B"}));
  EXPECT_EQ(found({"X", "Y", "Z", "depth.Z"}), (Names{"X", "Y", "Z"}));
  EXPECT_EQ(found({"R", "G", "B", "view.Combined.R", "view.Combined.G", "view.Combined.B"}),
            (Names{"R", "G", "B"}));
  EXPECT_EQ(find_color_channels({"X", "Y", "Z"})->space, ColorSpace::xyz);
  EXPECT_EQ(find_color_channels({"B", "G", "R"})->space, ColorSpace::linear_srgb);
}

TEST(ImageChannels, ALayerServesWhereItIsClearWhich) {
  EXPECT_EQ(found({"view.R", "view.G", "view.B", "view.A"}), (Names{"view.R", "view.G", "view.B"}));
  const Names combined{"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B"};
  Names names{"ViewLayer.AO.R", "ViewLayer.AO.G", "ViewLayer.AO.B", "ViewLayer.Depth.Z"};
  names.insert(names.end(), combined.begin(), combined.end());
  EXPECT_EQ(found(names), combined);
  EXPECT_EQ(found({"Combined.R", "Combined.G", "Combined.B"}),
            (Names{"Combined.R", "Combined.G", "Combined.B"}));
  for (const char* channel : {"Two.Combined.R", "Two.Combined.G", "Two.Combined.B"}) names.push_back(channel);
  EXPECT_EQ(found(names), Names());
  EXPECT_EQ(found({"a.R", "a.G", "a.B", "b.R", "b.G", "b.B"}), Names());
}

TEST(ImageChannels, ALoneYIsGrey) {
  EXPECT_EQ(found({"Y"}), (Names{"Y", "Y", "Y"}));
  EXPECT_EQ(found({"A", "Y"}), (Names{"Y", "Y", "Y"}));
  EXPECT_EQ(found({"Y", "RY", "BY"}), Names());
}

TEST(ImageChannels, OthersAreNone) {
  for (const Names& names :
       {Names{}, Names{""}, Names{"R"}, Names{"R", "G"}, Names{"normal.X", "normal.Y", "normal.Z"},
        Names{"S0.400,000000nm", "S0.500,000000nm", "S0.600,000000nm"}, Names{"u", "v", "depth.Z"},
        Names{"a.R", "b.G", "a.B"}})
    EXPECT_EQ(found(names), Names());
}

TEST(ImageChannels, AreListedShortly) {
  EXPECT_EQ(list_channels({"u", "v"}), "u, v");
  EXPECT_EQ(list_channels(Names(81, "S")), "S, S, S, S, S, S, S, S and 73 more");
}

}  // namespace
}  // namespace photopic
