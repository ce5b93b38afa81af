#include "core/image_io.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "error.h"
#include "spectral/color.h"
#include "support/png.h"

namespace photopic {
namespace {

class ImageIo : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("photopic-image-" + std::to_string(::getpid()) + "-" +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::size_t file_count() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()));
  }
  std::filesystem::path folder_;
};

/// Values from far below zero to far above one, each pixel another.
Image test_image() {
  Image image(7, 5);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = std::sinh(0.1f * (static_cast<float>(i) - 40.0f));
  return image;
}

TEST_F(ImageIo, ExrKeepsEveryFloat) {
  Image image = test_image();
  image.at(3, 2)[1] = std::numeric_limits<float>::infinity();
  image.at(4, 2)[0] = std::numeric_limits<float>::quiet_NaN();
  write_image(folder_ / "a.exr", image, {{"photopic:sampler", "optimized"}});
  const Image read = read_image(folder_ / "a.exr");
  EXPECT_EQ(read.width, 7);
  EXPECT_EQ(read.height, 5);
  EXPECT_TRUE(std::isnan(read.at(4, 2)[0]));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (!std::isnan(image.pixels[i])) {
      EXPECT_EQ(read.pixels[i], image.pixels[i]) << i;
    }
  }
  EXPECT_EQ(file_count(), 1u);  // no temporary left
}

TEST_F(ImageIo, XyzIsReadBackAsTheSameColors) {
  const Image srgb = test_image();
  Image xyz(srgb.width, srgb.height, ColorSpace::xyz);
  for (std::size_t i = 0; i < srgb.pixels.size(); i += 3) {
    const Xyz c = linear_srgb_to_xyz({srgb.pixels[i], srgb.pixels[i + 1], srgb.pixels[i + 2]});
    xyz.pixels[i] = static_cast<float>(c.x);
    xyz.pixels[i + 1] = static_cast<float>(c.y);
    xyz.pixels[i + 2] = static_cast<float>(c.z);
  }
  write_image(folder_ / "xyz.exr", xyz);
  write_image(folder_ / "xyz.png", xyz);
  write_image(folder_ / "srgb.png", srgb);
  const Image read = read_image(folder_ / "xyz.exr");
  for (std::size_t i = 0; i < srgb.pixels.size(); ++i)
    EXPECT_NEAR(read.pixels[i], srgb.pixels[i], 1e-5f * std::abs(srgb.pixels[i]) + 1e-4f) << i;
  EXPECT_EQ(read_image(folder_ / "xyz.png").pixels, read_image(folder_ / "srgb.png").pixels);
}

TEST_F(ImageIo, ExrCarriesMetadata) {
  write_image(folder_ / "a.exr", test_image(), {{"photopic:spectra", "lamp=cie:FL11"}});
  std::ifstream stream(folder_ / "a.exr", std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  EXPECT_NE(bytes.find("photopic:spectra"), std::string::npos);
  EXPECT_NE(bytes.find("lamp=cie:FL11"), std::string::npos);
}

TEST_F(ImageIo, PngCarriesMetadataAndIsTheSameTwice) {
  const auto bytes = [&](const char* name) {
    write_image(folder_ / name, test_image(), {{"spectra", "lamp=cie:FL11"}, {"spp", "64"}});
    std::ifstream stream(folder_ / name, std::ios::binary);
    return std::string((std::istreambuf_iterator<char>(stream)), {});
  };
  const std::string png = bytes("a.png");
  // A text chunk: type, keyword, zero, text (PNG, 3rd edition, 11.3.3.2).
  EXPECT_NE(png.find(std::string("tEXtspectra\0lamp=cie:FL11", 25)), std::string::npos);
  EXPECT_NE(png.find(std::string("tEXtspp\00064", 10)), std::string::npos);
  EXPECT_EQ(png, bytes("b.PNG"));
}

TEST_F(ImageIo, LinksAreFollowedWhateverTheirTargetIsCalled) {
  std::ofstream(folder_ / "target.dat") << "old";
  std::filesystem::create_symlink("target.dat", folder_ / "a.exr");
  write_image(folder_ / "a.exr", test_image());
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "a.exr"));
  EXPECT_EQ(read_image(folder_ / "a.exr").width, 7);
  EXPECT_EQ(file_count(), 2u);
}

TEST_F(ImageIo, HdrIsCloseForPositiveValues) {
  Image image(16, 4);  // shared exponents: 8 bits of the brightest channel
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = 0.5f + 0.01f * static_cast<float>(i);
  write_image(folder_ / "a.hdr", image);
  const Image read = read_image(folder_ / "a.hdr");
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    EXPECT_NEAR(read.pixels[i], image.pixels[i], 0.01f * image.pixels[i]);
}

TEST_F(ImageIo, PngIsSrgbEncodedAfterExposure) {
  Image image(3, 1);
  const float values[9] = {0.0f, 0.05f, 0.1f, 0.25f, 0.4f, 0.5f, -1.0f, 2.0f, 0.2f};
  std::copy_n(values, 9, image.pixels.begin());
  write_image(folder_ / "a.png", image, {}, 1.0);
  const Image read = read_image(folder_ / "a.png");
  for (int i = 0; i < 9; ++i) {
    const double expected = std::clamp(2.0 * values[i], 0.0, 1.0);
    // Half a step of 255 in the encoded value.
    EXPECT_NEAR(srgb_encode(read.pixels[i]), srgb_encode(expected), 0.5 / 255 + 1e-6) << i;
  }
}

/// PNG's colours are not associated with its alpha, EXR's are: either is read as it stands there.
TEST_F(ImageIo, AlphaLeavesColorsAsTheyAre) {
  std::vector<int> rgb, rgba;
  for (const int alpha : {255, 128, 1, 0})
    for (const int value : {200, 100, 50, alpha}) {
      rgba.push_back(value);
      if (rgba.size() % 4 != 0) rgb.push_back(value);
    }
  for (const int depth : {8, 16}) {
    std::ofstream(folder_ / "rgb.png", std::ios::binary)
        << test::make_png(4, 1, test::PngColor::rgb, rgb, depth);
    std::ofstream(folder_ / "rgba.png", std::ios::binary)
        << test::make_png(4, 1, test::PngColor::rgba, rgba, depth);
    EXPECT_EQ(read_image(folder_ / "rgba.png").pixels, read_image(folder_ / "rgb.png").pixels) << depth;
  }
  const ImageLayer alpha{{"A"}, {}, [](std::size_t pixel, std::span<float> values) {
                           values[0] = static_cast<float>(pixel % 3) / 2;
                         }};
  write_image(folder_ / "a.exr", test_image(), {}, 0.0, {alpha});
  EXPECT_EQ(read_image(folder_ / "a.exr").pixels, test_image().pixels);
}

TEST_F(ImageIo, NansShowInPng) {
  Image image(2, 1);
  image.at(1, 0)[2] = std::numeric_limits<float>::quiet_NaN();
  write_image(folder_ / "a.png", image);
  const Image read = read_image(folder_ / "a.png");
  EXPECT_EQ(read.at(0, 0)[0], 0.0f);
  EXPECT_EQ(read.at(1, 0)[0], 1.0f);
  EXPECT_EQ(read.at(1, 0)[1], 0.0f);
}

TEST_F(ImageIo, JpegReadsBack) {
  Image image(16, 16);
  std::ranges::fill(image.pixels, 0.2f);
  write_image(folder_ / "a.jpg", image);
  EXPECT_NEAR(read_image(folder_ / "a.jpg").at(8, 8)[1], 0.2f, 0.01f);
}

TEST_F(ImageIo, OverwritesWhole) {
  write_image(folder_ / "a.exr", Image(64, 64));
  write_image(folder_ / "a.exr", test_image());
  EXPECT_EQ(read_image(folder_ / "a.exr").width, 7);
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(ImageIo, UnwritableNamesAreRefusedEarly) {
  EXPECT_THROW(check_writable_image(folder_ / "a.txt"), InputError);
  EXPECT_THROW(check_writable_image(folder_ / "a"), InputError);
  EXPECT_THROW(check_writable_image(folder_ / "none" / "a.exr"), InputError);
  std::filesystem::create_directory(folder_ / "folder.exr");
  EXPECT_THROW(check_writable_image(folder_ / "folder.exr"), InputError);
  EXPECT_NO_THROW(check_writable_image(folder_ / "a.PNG"));
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(ImageIo, WhatCannotTakeItsPlaceIsKept) {
  std::filesystem::create_directory(folder_ / "folder.exr");
  EXPECT_THROW(write_image(folder_ / "folder.exr", test_image()), InputError);
  EXPECT_EQ(file_count(), 2u);
}

/// While it lives, this process may have but so many bytes more than it has.
class MemoryLimit {
 public:
  explicit MemoryLimit(rlim_t more) {
    ::getrlimit(RLIMIT_AS, &before_);
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit limit = before_;
    limit.rlim_cur = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + more;
    ::setrlimit(RLIMIT_AS, &limit);
  }
  ~MemoryLimit() { ::setrlimit(RLIMIT_AS, &before_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  rlimit before_{};
};

TEST_F(ImageIo, WithoutMemoryForTheFileItSaysSo) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer's own memory would be limited, too";
#endif
  Image noise(3000, 3000);
  std::uint32_t bits = 1;
  for (float& value : noise.pixels) {
    bits = bits * 1664525u + 1013904223u;
    value = static_cast<float>(bits >> 8) * 0x1p-24f;
  }
  for (const char* name : {"a.exr", "a.hdr", "a.png", "a.jpg"}) {
    write_image(folder_ / "small.exr", test_image());  // its threads are there before the limit
    std::string told;
    try {
      const MemoryLimit limit(20'000'000);
      write_image(folder_ / name, noise);
    } catch (const InputError& error) {
      told = error.what();
    }
    EXPECT_NE(told.find(std::string(name) + ": cannot be written: out of memory"), std::string::npos) << told;
  }
  EXPECT_EQ(file_count(), 1u);
}

/// The library's threads stay until another number is asked for.
TEST_F(ImageIo, ThreadsAreLimited) {
  const auto count_with = [&](int threads) {
    limit_image_threads(threads);
    write_image(folder_ / "a.exr", Image(64, 64));
    read_image(folder_ / "a.exr");
    const std::filesystem::directory_iterator tasks("/proc/self/task");
    return std::distance(begin(tasks), end(tasks));
  };
  const auto alone = count_with(1);
  EXPECT_GE(count_with(3), alone + 3);
  EXPECT_LE(count_with(3), alone + 5);  // of OpenEXR 3, of OpenImageIO 2
  EXPECT_LE(count_with(1), alone + 2);  // whose two end in their own time
}

TEST_F(ImageIo, AJpegHasALargestSize) {
  EXPECT_THROW(check_image_size("a.JPG", 65501, 1), InputError);
  EXPECT_THROW(check_image_size("a.jpeg", 1, 65501), InputError);
  EXPECT_NO_THROW(check_image_size("a.jpg", 65500, 65500));
  EXPECT_NO_THROW(check_image_size("a.png", 65501, 1));
  EXPECT_THROW(write_image(folder_ / "a.jpg", Image(65501, 1)), InputError);
  EXPECT_EQ(file_count(), 0u);
}

TEST_F(ImageIo, MetadataAreReadBack) {
  for (const char* name : {"a.exr", "a.png"}) {
    write_image(folder_ / name, test_image(), {{"seed", "7"}, {"sampler", "uniform"}});
    const Metadata metadata = read_metadata(folder_ / name);
    EXPECT_EQ(metadata.at("seed"), "7") << name;
    EXPECT_EQ(metadata.at("sampler"), "uniform") << name;
  }
  EXPECT_TRUE(read_metadata(folder_ / "none.exr").empty());
}

TEST_F(ImageIo, AnExrTellsWhereItLies) {
  Image image = test_image();
  image.left = 4, image.top = 2, image.full_width = 20, image.full_height = 10;
  for (const ColorSpace space : {ColorSpace::linear_srgb, ColorSpace::xyz}) {
    image.space = space;
    write_image(folder_ / "a.exr", image);
    for (const ImageShape& read :
         {ImageShape(read_image(folder_ / "a.exr")), read_image_shape(folder_ / "a.exr")}) {
      EXPECT_EQ(read.width, 7);
      EXPECT_EQ(read.left, 4);
      EXPECT_EQ(read.top, 2);
      EXPECT_EQ(read.full_width, 20);
      EXPECT_EQ(read.full_height, 10);
      EXPECT_FALSE(read.is_whole());
    }
  }
  write_image(folder_ / "a.exr", test_image());
  write_image(folder_ / "a.png", image);
  EXPECT_EQ(read_image(folder_ / "a.exr").full_width, 7);
  EXPECT_EQ(read_image(folder_ / "a.png").full_width, 0);
  for (const char* name : {"a.exr", "a.png"}) EXPECT_TRUE(read_image_shape(folder_ / name).is_whole());
}

TEST_F(ImageIo, OneChannelIsGreyOrRefused) {
  const std::vector<float> values{0.5f, -1.0f, 0.0f, 4.0f, 1e9f, 0.25f};
  write_channel(folder_ / "grey.exr", "Y", {3, 2}, values, {{"white", "D65"}});
  const Image grey = read_image(folder_ / "grey.exr");
  for (std::size_t i = 0; i < grey.pixels.size(); ++i) EXPECT_EQ(grey.pixels[i], values[i / 3]) << i;
  EXPECT_EQ(read_metadata(folder_ / "grey.exr").at("white"), "D65");
  std::ofstream(folder_ / "grey.png", std::ios::binary)
      << test::make_png(2, 1, test::PngColor::grey, {0, 255}, 8);
  EXPECT_EQ(read_image(folder_ / "grey.png").pixels, (std::vector<float>{0, 0, 0, 1, 1, 1}));
  write_channel(folder_ / "dE.exr", "dE", {3, 2}, values, {});
  try {
    read_image(folder_ / "dE.exr");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("not those of one picture: dE; give"), std::string::npos);
  }
}

TEST_F(ImageIo, BadImagesAreRefused) {
  EXPECT_THROW(read_image(folder_ / "none.exr"), InputError);
  EXPECT_THROW(read_image(folder_), InputError);
  std::ofstream(folder_ / "text.exr") << "this is no image";
  EXPECT_THROW(read_image(folder_ / "text.exr"), InputError);
  write_image(folder_ / "whole.exr", test_image());
  std::filesystem::resize_file(folder_ / "whole.exr",
                               std::filesystem::file_size(folder_ / "whole.exr") - 100);
  EXPECT_THROW(read_image(folder_ / "whole.exr"), InputError);
}

/// A header alone, of 30,000 × 30,000 pixels: refused by its size, before anything is decoded.
TEST_F(ImageIo, WhatIsNotEvenCalledAnImageIsToldShortly) {
  std::ofstream(folder_ / "a.gltf") << "{}";
  try {
    read_image(folder_ / "a.gltf");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), (folder_ / "a.gltf").string() +
                                ": this is no image that can be read; give an .exr, .hdr, .png or .jpg");
  }
}

TEST_F(ImageIo, AbsurdSizesAreRefused) {
  std::ofstream stream(folder_ / "huge.hdr", std::ios::binary);
  stream << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 30000 +X 30000\n";
  stream.close();
  try {
    read_image(folder_ / "huge.hdr");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("30000"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace photopic
