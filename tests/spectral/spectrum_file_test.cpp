#include "spectral/spectrum_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "error.h"

namespace photopic {
namespace {

namespace fs = std::filesystem;

class SpectrumFile : public testing::Test {
 protected:
  SpectrumFile() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / (std::string("photopic_spectrum_file_") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~SpectrumFile() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  void expect_three_rows(const std::string& name, const std::string& text) {
    try {
      const auto table = read_spectrum_file(write(name, text), Beyond::zero);
      ASSERT_EQ(table.lambda().size(), 3u) << text;
      const double lambda[] = {400, 410, 420.5}, value[] = {0.25, 1, 0.5};
      for (int i = 0; i < 3; ++i) {
        EXPECT_DOUBLE_EQ(table.lambda()[i], lambda[i]) << text;
        EXPECT_DOUBLE_EQ(table.value()[i], value[i]) << text;
      }
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what() << " for\n" << text;
    }
  }

  /// The message, on one line, must hold `part`.
  void expect_error(const std::string& name, const std::string& text, const std::string& part) {
    const fs::path file = write(name, text);
    expect_message([&] { read_spectrum_file(file, Beyond::zero); }, part);
  }

  template <typename Action>
  void expect_message(Action action, const std::string& part) {
    try {
      action();
      ADD_FAILURE() << "accepted, where '" << part << "' was expected";
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(part), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }

  fs::path folder_;
};

TEST_F(SpectrumFile, TwoColumnsInTheirVariants) {
  expect_three_rows("a.spd", "400 0.25\n410 1\n420.5 0.5\n");
  expect_three_rows("a.txt", "# a lamp\n\n  400\t0.25\n 410 \t 1  # peak\n420.5\t\t5e-1");
  expect_three_rows("a.csv", "nm,value\n400,0.25\n410,1,\n420.5,.5\n");
  expect_three_rows("b.csv", "\xEF\xBB\xBF\"nm\";\"power\"\r\n400;0,25\r\n410;1\r\n420,5;0,5\r\n");
  expect_three_rows("c.csv", "400, +0.25\r410, 1e0\r420.5, 0.5\r");
  expect_three_rows("noending", "wavelength power\n400 0.25\n410 1\n420.5 0.5");
}

TEST_F(SpectrumFile, LspddCsv) {
  expect_three_rows(
      "l.csv",
      "Lamp Spectral Power Distribution Database\nbrand,Made Up\nCCT,3000\nWavelength range,400-420\n\n"
      "wavelength,relativeIntensity\n400,0.25\n410,1\n420.5,0.5\n");
  expect_error("l.csv", "brand,Made Up\nCCT,3000\nwavelength,relativeIntensity\n400,0.25\n410,x\n",
               "l.csv:5");
  expect_error("l.csv", "brand,Made Up\nCCT,3000\nwavelength,relativeIntensity\n", "no rows");
}

TEST_F(SpectrumFile, LspddJson) {
  expect_three_rows("l.json", R"({"id": 1, "spectraldata": "400,0.25\n410,1\n420.5,0.5\n"})");
  expect_three_rows(
      "l.json", R"([{"spectraldata": "wavelength,relativeIntensity\r\n400,0.25\r\n410,1\r\n420.5,0.5"}])");
  expect_three_rows("l.json", R"({"spectraldata": "400,0.25;410,1;420.5,0.5"})");
  expect_three_rows("l.json", R"({"spectraldata": "400 0.25, 410 1, 420.5 0.5"})");
  expect_three_rows("l.json", R"({"spectraldata": [[400, 0.25], [410, 1], ["420.5", "0.5"]]})");
  expect_three_rows("l.json", R"({"spectraldata": "[{\"wavelength\": 400, \"relativeIntensity\": 0.25},)"
                              R"({\"wavelength\": 410, \"relativeIntensity\": 1},)"
                              R"({\"wavelength\": 420.5, \"relativeIntensity\": 0.5}]"})");
  expect_three_rows("l.json", R"({"nm": [400, 410, 420.5], "value": [0.25, 1, 0.5]})");
  expect_error("l.json", "{\n\"spectraldata\": ", "l.json:2");
  expect_error("l.json", R"({"spectraldata": [[400, 1e999], [500, 1]]})", "too large");
  expect_error("l.json", R"({"spectraldata": "400,0.25\n410,x\n"})", "#spectraldata:2: 'x' is not a number");
  expect_error("l.json", R"({"spectraldata": "400,0.25,410"})", "without its value");
  expect_error("l.json", R"({"spectraldata": [[400, 0.25], [410]]})", ":2");
  expect_error("l.json", R"({"spectraldata": 5})", "neither text nor a list");
  expect_error("l.json", R"({"spectral_data": ""})", "holds no spectraldata");
  expect_error("l.json", R"({"spectraldata": ""})", "no rows");
  expect_error("l.json", R"({"nm": [400], "value": [1, 2]})", "same length");
  expect_error("l.json", std::string(200000, '['), "not valid JSON");
}

std::string cgats(const std::string& bands, const std::string& data) {
  return "SPECT\n\nORIGINATOR \"made # up\"\nKEYWORD \"SPECTRAL_BANDS\"\nSPECTRAL_BANDS \"" + bands +
         "\"\nSPECTRAL_START_NM \"400.0\"\nSPECTRAL_END_NM \"420.0\"\nSPECTRAL_NORM "
         "\"2.0\"\nNUMBER_OF_FIELDS 4\n"
         "BEGIN_DATA_FORMAT\nSAMPLE_ID SPEC_400 SPEC_410 SPEC_420\nEND_DATA_FORMAT\nNUMBER_OF_SETS "
         "1\nBEGIN_DATA\n" +
         data + "\nEND_DATA\n";
}

TEST_F(SpectrumFile, Cgats) {
  const auto table = read_spectrum_file(write("a.sp", cgats("3", "\"a lamp\" 0.5 2.0\n1.0")), Beyond::zero);
  ASSERT_EQ(table.lambda().size(), 3u);
  EXPECT_EQ(table.lambda()[1], 410);
  EXPECT_EQ(table.value()[0], 0.25);
  EXPECT_EQ(table.value()[1], 1.0);
  EXPECT_EQ(table.value()[2], 0.5);
  expect_error("a.sp", cgats("4", "x 1 2 3"), "SPECTRAL_BANDS 4");
  expect_error("a.sp", cgats("0", "x 1 2 3"), "make no sense");
  expect_error("a.sp", cgats("nan", "x 1 2 3"), "make no sense");
  expect_error("a.sp", cgats("3", "x 1 2"), "3 values for 4 fields");
  expect_error("a.sp", cgats("3", "x 1 2 3\ny 4 5 6"), "2 data sets");
  expect_error("a.sp", cgats("3", "x 1\ntwo 3"), "a.sp:16: 'two'");
  expect_error("a.sp", cgats("3", "x 1 -2 3"), "negative");
  expect_error("a.sp", "", "SPECTRAL_START_NM is missing");
  expect_error("a.sp", "SPECTRAL_START_NM", "SPECTRAL_START_NM is missing");
  expect_error("a.sp", "SPECTRAL_START_NM 400\nSPECTRAL_END_NM 500\nSPECTRAL_BANDS 3\nBEGIN_DATA_FORMAT\n",
               "BEGIN_DATA_FORMAT");
}

TEST_F(SpectrumFile, Tm27) {
  const std::string head =
      "<?xml version=\"1.0\"?>\n<IESTM2714 xmlns=\"iestm2714\" version=\"1.0\">\n<Header/>\n";
  const std::string row = "<SpectralData wavelength=\"400\"> 0.25 </SpectralData>\n";
  expect_three_rows("a.spdx", head + "<SpectralDistribution><SpectralQuantity>relative</SpectralQuantity>\n" +
                                  row +
                                  "<SpectralData wavelength=\"410\">1</SpectralData>"
                                  "<SpectralData wavelength=\"420.5\">5e-1</SpectralData>"
                                  "</SpectralDistribution></IESTM2714>");
  expect_error("a.spdx",
               head + "<SpectralDistribution>\n" + row +
                   "<SpectralData>3</SpectralData>\n</SpectralDistribution></IESTM2714>",
               "a.spdx:6");
  expect_error("a.spdx", head + "<SpectralDistribution>\n" + row, "a.spdx:");
  expect_error("a.spdx", head + "</IESTM2714>", "no SpectralDistribution");
  expect_error("a.spdx", head + "<SpectralDistribution/></IESTM2714>", "no rows");
  expect_error("a.spdx", "not xml", "a.spdx");
  expect_error("a.spdx", "", "a.spdx");
}

TEST_F(SpectrumFile, BadRowsAreNamed) {
  expect_error("a.txt", "400 1\n410 one\n", "a.txt:2: 'one' is not a number");
  expect_error("a.txt", "38o 1\n410 1\n", "a.txt:1: '38o'");
  expect_error("a.txt", "nm value\nmore text\n410 1\n", "a.txt:2");
  expect_error("a.txt", "400 1\n\n# c\n410\n", "a.txt:4: 1 column(s)");
  expect_error("a.txt", "400 1 2\n410 1 2\n", "a.txt:1: 3 column(s)");
  expect_error("a.csv", "400,1\n410,\n", "a.csv:2: 1 column(s)");
  expect_error("a.csv", "400,1\n,1\n", "a.csv:2");
  expect_error("a.txt", "400 1\n420 1\n410 1\n", "a.txt:3: the wavelength 410 follows 420");
  expect_error("a.txt", "400 1\n400 2\n400 3\n", "a.txt:3: a third row for 400 nm");
  expect_error("a.txt", "400 1\n410 nan\n", "a.txt:2: a number is not finite");
  expect_error("a.txt", "400 1\n410 inf\n", "a.txt:2: a number is not finite");
  expect_error("a.txt", "400 1\n410 1e999\n", "a.txt:2");
  expect_error("a.txt", "400 1\n410 -0.5\n", "a.txt:2: the value -0.5 is negative");
  expect_error("a.txt", "-400 1\n410 1\n", "a.txt:1: the wavelength -400 is not positive");
  expect_error("a.txt", "0.40 1\n0.70 1\n",
               "look like micrometres (multiply by 1000) or electronvolts (divide 1239.84 by them)");
  expect_error("a.txt", "3.1 1\n1.6 1\n", "the wavelengths, 1.6 to 3.1, look like micrometres");
  expect_error("a.txt", "3.8e-7 1\n7.8e-7 1\n", "3.8e-07 to 7.8e-07, look like metres (multiply by 1e9)");
  expect_error("a.txt", "3800 1\n7800 1\n", "3800 to 7800, look like ångström (divide by 10)");
  expect_error("a.txt", "1000 1\n12000 1\n", "ångström");
  expect_error("a.txt", "400 1\n", "single row");
  for (const char* empty : {"", "\n\n", "# only a comment\n", "nm value\n"})
    expect_error("a.txt", empty, "no rows");
}

TEST_F(SpectrumFile, GarbageIsRefused) {
  expect_error("a.spd", std::string("400 1\n\0\x01\x02", 9), "not a text file");
  expect_error("a.spd",
               std::string("\xFF\xFE"
                           "4\0"
                           "0\0",
                           6),
               "not a text file");
  expect_error("a.spd", "\x89PNG\r\n\x1a\n", "a.spd");
  expect_message([&] { read_spectrum_file(folder_, Beyond::zero); }, "is a folder");
  expect_message([&] { read_spectrum_file("box.glb", Beyond::zero); }, "box.glb: is a scene, not a spectrum");
  expect_message([&] { read_spectrum_file(folder_ / "nothing.spd", Beyond::zero); }, "no such spectrum file");
  const fs::path large = write("large.spd", "400 1\n");
  fs::resize_file(large, (std::uintmax_t{64} << 20) + 1);
  expect_message([&] { read_spectrum_file(large, Beyond::zero); }, "larger than 64 MB");
}

TEST_F(SpectrumFile, JumpsAndRoles) {
  const fs::path file = write("a.txt", "400 1\n500 1\n500 2\n600 2\n");
  EXPECT_EQ(read_spectrum_file(file, Beyond::zero)(500), 2);
  EXPECT_EQ(read_spectrum_file(file, Beyond::zero)(700), 0);
  EXPECT_EQ(read_spectrum_file(file, Beyond::end_value)(700), 2);
}

TEST_F(SpectrumFile, ParseSpectrum) {
  const auto parse = [&](std::string_view text) { return parse_spectrum(text, folder_, Beyond::zero); };
  EXPECT_TRUE(std::holds_alternative<TabulatedSpectrum>(parse("cie:FL11")));
  EXPECT_EQ(std::get<BlackbodySpectrum>(parse("blackbody:3200")).kelvin, 3200);
  EXPECT_EQ(std::get<LineSpectrum>(parse("line:532")).centre, 532);
  EXPECT_EQ(std::get<LineSpectrum>(parse("line:532")).fwhm, 1);
  EXPECT_EQ(std::get<LineSpectrum>(parse("line:532.5:0.5")).fwhm, 0.5);
  EXPECT_EQ(std::get<ConstantSpectrum>(parse("constant")).value, 1);
  write("lamp.spd", "400 1\n500 2\n");
  EXPECT_EQ(std::get<TabulatedSpectrum>(parse("lamp.spd"))(450), 1.5);
  EXPECT_EQ(std::get<TabulatedSpectrum>(parse((folder_ / "lamp.spd").string()))(450), 1.5);
}

TEST_F(SpectrumFile, ParseSpectrumErrors) {
  const auto refuse = [&](std::string_view text, const std::string& part) {
    expect_message([&] { parse_spectrum(text, folder_, Beyond::zero); }, part);
  };
  refuse("cie:FL99", "LED-RGB1");
  refuse("cie:", "no such CIE illuminant");
  for (const char* text : {"blackbody:", "blackbody:hot", "blackbody:-5", "blackbody:0", "blackbody:nan",
                           "blackbody:inf", "blackbody:3200K"})
    refuse(text, "as in blackbody:3200");
  for (const char* text : {"line:", "line:green", "line:1064", "line:nan", "line:532nm"})
    refuse(text, "as in line:532");
  for (const char* text : {"line:532:", "line:532:0", "line:532:-1", "line:532:nan", "line:532:1:2"})
    refuse(text, "as in line:532:0.5");
  refuse("", "is empty");
  refuse("constant:5", "no such spectrum file");
  refuse("missing.spd", "missing.spd: no such spectrum file");
  refuse(std::string(10000, 'a'), "no such spectrum file");
}

}  // namespace
}  // namespace photopic
