#include "genu/sweep/npz_file.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "genu/sweep/statistics.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

TEST(NpzFile, IsWhatNumpyLoads) {
  if (std::system("/usr/bin/python3 -c 'import numpy' 2>/dev/null") != 0) GTEST_SKIP() << "needs python3-numpy";
  const test::TemporaryFolder folder;
  const std::vector<double> a = {1, -2.5, 1e300}, b = {4, 5, kNoNumber};
  const std::vector<std::string> words = {"solved", "\xc3\xbc", ""}, broken = {"\xff", "x", "\xe2\x82"};
  NpzFile file(folder / "a.npz");
  file.add_numbers("knee.x_mm@30", {&a, &b}, false);
  file.add_numbers("MCL*.stiffness:together", {&a}, true);
  file.add_words("class", {&words, &broken}, false);
  file.add_numbers("none", {}, true);
  ASSERT_EQ(file.commit(), "");
  const std::string script = folder.write("check.py", R"(
import sys, zipfile, numpy as np
assert zipfile.ZipFile(sys.argv[1]).testzip() is None
d = np.load(sys.argv[1])
assert d.files == ["knee.x_mm@30", "MCL*.stiffness:together", "class", "none"], d.files
k = d["knee.x_mm@30"]
assert k.shape == (2, 3) and k.dtype == np.float64, k
assert k[0].tolist() == [1, -2.5, 1e300] and k[1, :2].tolist() == [4, 5] and np.isnan(k[1, 2])
assert d["MCL*.stiffness:together"].shape == (3,)
assert d["class"].tolist() == [["solved", "\u00fc", ""], ["\ufffd", "x", "\ufffd"]], d["class"].tolist()
assert d["none"].shape == (0,)
)");
  EXPECT_EQ(std::system(("/usr/bin/python3 " + script + " " + (folder / "a.npz")).c_str()), 0);
}

}  // namespace
}  // namespace genu
