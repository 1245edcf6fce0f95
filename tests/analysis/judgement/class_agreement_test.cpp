#include "made_play.h"
#include "strategies/named.h"

#include <folk/analysis/judgement/agreement.h>
#include <folk/analysis/judgement/class_agreement.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace folk {
namespace {

/// Every member asked one by one.
struct BruteForce {
  BruteForce(const MemoryClass& members, const std::vector<RecordedMatch>& matches, Seat seat) {
    for (std::uint64_t i = 0; i < std::uint64_t{1} << members.genes(); ++i) {
      Strategy one;
      one.machine = std::make_shared<MemoryMachine>(members.member(i));
      const auto agreement = agreement_with(one, matches, seat, {});
      const std::uint64_t slips = agreement.impossible();
      if (slips == 0) ++consistent;
      if (slips < fewest) nearest = 0;
      fewest = std::min(fewest, slips);
      if (slips == fewest) ++nearest;
      likelihood += std::exp(agreement.log_likelihood(0.05)) / static_cast<double>(std::uint64_t{1} << members.genes());
    }
  }

  std::uint64_t consistent = 0;
  std::uint64_t fewest = ~std::uint64_t{0};
  std::uint64_t nearest = 0;
  double likelihood = 0;
};

TEST(ClassAgreement, IsWhatListingAllMembersSays) {
  for (const auto& [own, theirs] : {std::pair{1U, 2U}, std::pair{2U, 1U}, std::pair{0U, 1U}, std::pair{1U, 1U}}) {
    const MemoryClass members(own, theirs);
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      std::vector<RecordedMatch> matches;
      const auto player = test::named(seed % 3 == 0 ? "gradual" : seed % 3 == 1 ? "tf2t" : "tit_for_tat");
      for (std::uint64_t m = 0; m < 1 + seed % 3; ++m)
        matches.push_back(
            test::played(player, test::named("random(0.6)"), 3 + 4 * seed, seed % 2 == 0 ? 0 : 0.1, seed * 8 + m));
      for (const Seat seat : both_seats) {
        const BruteForce listed(members, matches, seat);
        const ClassAgreement agreement(members, matches, seat);
        EXPECT_EQ(agreement.consistent(), Integer(listed.consistent));
        EXPECT_EQ(agreement.fewest_slips(), listed.fewest);
        EXPECT_EQ(agreement.nearest(), Integer(listed.nearest));
        EXPECT_NEAR(agreement.log_likelihood(0.05), std::log(listed.likelihood), 1e-9);
      }
    }
  }
}

TEST(ClassAgreement, CountsTheLargestClassesExactly) {
  // One round asks for one opening of three.
  const std::vector one{test::match_of("C", "D")};
  const ClassAgreement agreement(MemoryClass(3, 3), one, Seat::first);
  EXPECT_EQ(agreement.asked(), 1U);
  EXPECT_EQ(agreement.consistent(), pow(Integer(2), 66));
  EXPECT_EQ(agreement.consistent().str(), "73786976294838206464");
  // The same memory is met twice with both moves: nobody agrees, all are as near.
  const std::vector two{test::match_of("C", "D"), test::match_of("D", "D")};
  const ClassAgreement torn(MemoryClass(3, 3), two, Seat::first);
  EXPECT_EQ(torn.consistent(), 0);
  EXPECT_EQ(torn.fewest_slips(), 1U);
  EXPECT_EQ(torn.nearest(), pow(Integer(2), 67));
  EXPECT_EQ(torn.log_likelihood(0), -INFINITY);
  EXPECT_NEAR(torn.log_likelihood(0.1), std::log(0.09), 1e-12);
}

TEST(ClassAgreement, WritesTheMembersAsOneGenotype) {
  // tit_for_tat: the opening C, then C after C, D after D; DC and DD were never met by it.
  const std::vector matches{test::match_of("CCD", "CDC")};
  EXPECT_EQ(ClassAgreement(MemoryClass(1, 1), matches, Seat::first).nearest_text(), "mem11_cCD??");
  EXPECT_EQ(ClassAgreement(MemoryClass(1, 2), matches, Seat::first).nearest_text(), "mem12_cc?D??????");
}

}  // namespace
}  // namespace folk
