#include <folk/sct/files/checksum.h>
#include <gtest/gtest.h>

#include <cstdint>

namespace folk::sct {
namespace {

// By the lines of docs/policy-files.md, run in Python. Whoever changes these numbers can read no file that is out
// there.
TEST(Checksum, IsTheDocumentedOne) {
  Checksum sum;
  EXPECT_EQ(sum.value(), 0x8570e250fe4c2473U);
  sum.add("tit_for_tat");
  sum.add(-1.5);
  sum.add(-0.0);
  sum.add(std::uint64_t{0xFEDCBA9876543210U});
  EXPECT_EQ(sum.value(), 0xf8ce9af69f10c064U);
}

}  // namespace
}  // namespace folk::sct
