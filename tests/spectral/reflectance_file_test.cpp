#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "error.h"
#include "spectral/spectrum_file.h"

namespace photopic {
namespace {

namespace fs = std::filesystem;

class ReflectanceFile : public testing::Test {
 protected:
  ReflectanceFile() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / (std::string("photopic_reflectance_file_") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~ReflectanceFile() override { fs::remove_all(folder_); }

  std::vector<TabulatedSpectrum> read(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return read_reflectance_file(folder_ / name);
  }

  /// The message, on one line, must hold `part`.
  void expect_error(const std::string& name, const std::string& text, const std::string& part) {
    try {
      read(name, text);
      ADD_FAILURE() << "accepted, where '" << part << "' was expected";
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(part), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }

  fs::path folder_;
};

const std::string kCgats =
    "SPECT\nSPECTRAL_START_NM 400\nSPECTRAL_END_NM 600\nSPECTRAL_BANDS 3\nSPECTRAL_NORM 100\n"
    "BEGIN_DATA_FORMAT\nSAMPLE_ID SPEC_400 SPEC_500 SPEC_600\nEND_DATA_FORMAT\nBEGIN_DATA\n"
    "\"light red\" 20 30 80\nblack 1 2 3\nEND_DATA\n";

TEST_F(ReflectanceFile, ReadsColumns) {
  for (const char* text : {"wavelength_nm,dark skin,white 9.5 (.05 D)\n400,0.1,0.9\n500,0.3,1\n",
                           "# two paints\n400 0.1 0.9\n500 0.3 1.0\n", "nm;a;b\n400;0,1;0,9\n500;0,3;1\n"}) {
    const auto found = read("paints.csv", text);
    ASSERT_EQ(found.size(), 2u) << text;
    EXPECT_DOUBLE_EQ(found[0](450.0), 0.2) << text;
    EXPECT_DOUBLE_EQ(found[1](300.0), 0.9) << "end values go on";
    EXPECT_DOUBLE_EQ(found[1](800.0), 1.0);
  }
  EXPECT_EQ(read("one.txt", "400 0.5\n700 0.25\n").size(), 1u);
}

TEST_F(ReflectanceFile, ReadsCgatsSets) {
  const auto found = read("paints.sp", kCgats);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_DOUBLE_EQ(found[0](500.0), 0.3);
  EXPECT_DOUBLE_EQ(found[0](550.0), 0.55);
  EXPECT_DOUBLE_EQ(found[1](600.0), 0.03);
}

TEST_F(ReflectanceFile, NamesTheBadRow) {
  expect_error("p.csv", "nm,a\n400,10\n500,45.2\n",
               "p.csv:2: a reflectance of 10 is above 1; divide percentages");
  expect_error("p.csv", "400,0.1,0.2\n500,0.3\n", "p.csv:2: 2 column(s) where 3");
  expect_error("p.csv", "400,0.1\n500,0.3,0.4\n", "p.csv:2");
  expect_error(
      "p.csv", "400,0.1\n500,0.3,0.2\n",
      "p.csv:2: 3 column(s) where 2 are expected; give wavelength [nm] and as many values in every row");
  expect_error("p.csv", "400\n500\n", "p.csv:1: 1 column(s) where two or more");
  expect_error("p.csv", "400,0.1,0.2\n500,0.3,x\n", "p.csv:2: 'x' is not a number");
  expect_error("p.csv", "400,0.1,0.2\n500,0.3,-0.1\n", "p.csv:2: the value -0.1 is negative");
  expect_error("p.csv", "400,0.1,0.2\n500,0.3,nan\n", "p.csv:2");
  expect_error("p.csv", "500,0.1,0.2\n400,0.3,0.1\n", "sort the rows");
  expect_error("p.csv", "0.4,0.1\n0.7,0.2\n", "micrometres");
  expect_error("p.csv", "nm,a,b\n", "no reflectances");
  expect_error("p.csv", "", "no reflectances");
  expect_error("p.json", "{}", "not read from this format");
  std::string wide = "400", row = "\n500";
  for (int i = 0; i < 1001; ++i) wide += " 0.5", row += " 0.5";
  expect_error("p.txt", wide + row, "1001 reflectances");
}

TEST_F(ReflectanceFile, NamesWhatIsWrongInCgats) {
  const auto with = [](std::string part, const std::string& replacement) {
    std::string text = kCgats;
    return text.replace(text.find(part), part.size(), replacement);
  };
  expect_error("p.sp", with("black 1 2 3", "black 1 2"), "7 values for 4 fields");
  expect_error("p.sp", with("BEGIN_DATA\n", "BEGIN_DATA\nEND_DATA\n"), "0 values");
  expect_error("p.sp", with("SPECTRAL_NORM 100", ""), "a reflectance of 20 is above 1");
  expect_error("p.sp", with("1 2 3", "1 x 3"), "'x' is not a number");
  // One spectrum is still all that a lamp's file may hold.
  std::ofstream(folder_ / "two.sp") << kCgats;
  EXPECT_THROW(read_spectrum_file(folder_ / "two.sp", Beyond::zero), InputError);
}

}  // namespace
}  // namespace photopic
