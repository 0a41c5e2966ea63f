// One array of numbers in every way VTK writes it down.
#include "genu/mesh_files/vtp_arrays.h"

#include <cstring>

#include <gtest/gtest.h>

#include "support/vtp_text.h"

namespace genu {
namespace {

const std::vector<double> kNumbers = {0, 1, -2, 3.5, 1000, 7};

TEST(VtpArrays, EveryEncodingGivesTheSameNumbers) {
  for (const bool compressed : {false, true})
    for (const bool wide : {false, true})
      for (const bool swap : {false, true})
        for (const char* type : {"Float32", "Float64"})
          for (const bool apart : {false, true}) {
            const test::VtpBytes bytes{type, wide, swap, compressed};
            VtpEncoding encoding;
            encoding.swap = swap;
            encoding.wide_header = wide;
            encoding.compressed = compressed;
            const std::string text = "\n  " + bytes.base64(kNumbers, apart) + "\n";
            std::vector<double> out;
            MeshNotes notes;
            EXPECT_EQ(read_vtp_array({type, "binary", 0, text}, encoding, out, notes), "");
            EXPECT_EQ(out, kNumbers) << type << wide << swap << compressed << apart;
            const std::string raw = "xx" + bytes.raw(kNumbers);
            encoding.appended = raw;
            out.clear();
            EXPECT_EQ(read_vtp_array({type, "appended", 2, {}}, encoding, out, notes), "");
            EXPECT_EQ(out, kNumbers);
          }
}

TEST(VtpArrays, TruncationsAndDamageAreRefused) {
  MeshNotes notes;
  for (const bool compressed : {false, true}) {
    const std::string raw = test::VtpBytes{"Float64", false, false, compressed}.raw(kNumbers);
    VtpEncoding encoding;
    encoding.compressed = compressed;
    for (std::size_t size = 0; size < raw.size(); ++size) {
      encoding.appended = std::string_view(raw).substr(0, size);
      std::vector<double> out;
      EXPECT_NE(read_vtp_array({"Float64", "appended", 0, {}}, encoding, out, notes), "") << size;
    }
    for (std::size_t i = 0; i < raw.size(); ++i) {  // whatever is damaged: an answer, and no crash
      std::string damaged = raw;
      damaged[i] = static_cast<char>(damaged[i] ^ 0xff);
      encoding.appended = damaged;
      std::vector<double> out;
      const std::string ignored = read_vtp_array({"Float64", "appended", 0, {}}, encoding, out, notes);
      EXPECT_LE(out.size(), kNumbers.size());
    }
  }
  std::vector<double> out;
  EXPECT_NE(read_vtp_array({"Float64", "binary", 0, "!!!!"}, {}, out, notes), "");
  EXPECT_NE(read_vtp_array({"Float64", "appended", 5, {}}, {}, out, notes), "");
  EXPECT_NE(read_vtp_array({"Float64", "ascii", 0, "1 2 x"}, {}, out, notes), "");
  EXPECT_NE(read_vtp_array({"Float64", "odd", 0, "1"}, {}, out, notes), "");
  EXPECT_NE(read_vtp_array({"String", "binary", 0, "BAAAAAAAAAA="}, {}, out, notes), "");
}

}  // namespace
}  // namespace genu
