#include <folk/analysis/crew/failure.h>
#include <folk/analysis/crew/piece_journal.h>
#include <folk/games/error.h>
#include <folk/games/progress.h>

#include <gtest/gtest.h>

#include <new>
#include <string>

namespace folk {
namespace {

std::string whole_journal() {
  return piece_journal_head(7) + piece_record(7, 3, "three\npiece ") + piece_record(8, 3, "") +
         piece_record(7, 12, std::string("a\0b", 3));
}

TEST(PieceJournal, ReadsWhatWasAdded) {
  const std::string text = whole_journal();
  const auto journal = read_piece_journal(text, "j", 7);
  EXPECT_EQ(journal.whole, text.size());
  ASSERT_EQ(journal.pieces.size(), 3U);
  EXPECT_EQ(journal.pieces.at({7, 3}), "three\npiece ");
  EXPECT_EQ(journal.pieces.at({8, 3}), "");
  EXPECT_EQ(journal.pieces.at({7, 12}), std::string("a\0b", 3));
}

// Wherever a kill cuts it off, what was whole before counts and nothing else.
TEST(PieceJournal, IsGoneOnWithWhereverItWasCutOff) {
  const std::string text = whole_journal();
  const std::size_t head = piece_journal_head(7).size();
  const std::size_t first = head + piece_record(7, 3, "three\npiece ").size();
  const std::size_t second = first + piece_record(8, 3, "").size();
  for (std::size_t size = head; size < text.size(); ++size) {
    const auto journal = read_piece_journal(std::string_view(text).substr(0, size), "j", 7);
    const std::size_t whole = size < first ? head : size < second ? first : second;
    EXPECT_EQ(journal.whole, whole) << size;
    EXPECT_EQ(journal.pieces.size(), whole == head ? 0U : whole == first ? 1U : 2U);
  }
  // A last record whose bytes never came to the disk.
  for (std::size_t from = second; from < text.size(); ++from) {
    const std::string zeros = text.substr(0, from) + std::string(text.size() - from, '\0');
    EXPECT_EQ(read_piece_journal(zeros, "j", 7).whole, second) << from;
  }
}

TEST(PieceJournal, RefusesWhatIsNotItsOwnAndWhatIsDamaged) {
  const std::string text = whole_journal();
  EXPECT_THROW(read_piece_journal(text, "j", 6), InputFileError);
  for (const std::string other : {"", "folk evolution journal 1\n", "folk piece journal 1\n"})
    EXPECT_THROW(read_piece_journal(other, "j", 7), InputFileError) << other;
  std::string damaged = text;
  damaged[text.find("three")] = 'T';
  EXPECT_THROW(read_piece_journal(damaged, "j", 7), InputFileError);
  const std::size_t last = text.size() - piece_record(7, 12, "a.b").size();
  for (std::size_t i = 0; i < last; ++i) {
    std::string bad = text;
    bad[i] = static_cast<char>(bad[i] ^ 1);
    try {
      // Damage may look as if the file ended there, but never gives a piece that was not kept.
      for (const auto& [key, bytes] : read_piece_journal(bad, "j", 7).pieces)
        EXPECT_EQ(bytes, read_piece_journal(text, "j", 7).pieces.at(key)) << i;
    } catch (const InputFileError&) {
    }
  }
}

TEST(Failure, KeepsItsKindAndItsMessage) {
  const auto again = [](const auto& error) {
    return failure_from(failure_bytes(std::make_exception_ptr(error), "rank 3: "));
  };
  const auto message = [](const std::exception_ptr& failure) {
    try {
      std::rethrow_exception(failure);
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
  };
  EXPECT_THROW(std::rethrow_exception(again(UsageError("x"))), UsageError);
  EXPECT_THROW(std::rethrow_exception(again(InputFileError("x"))), InputFileError);
  EXPECT_THROW(std::rethrow_exception(again(UndecidedError("x"))), UndecidedError);
  EXPECT_THROW(std::rethrow_exception(again(Cancelled("x"))), Cancelled);
  EXPECT_THROW(std::rethrow_exception(again(std::runtime_error("x"))), EnvironmentError);
  EXPECT_EQ(message(again(UsageError("why"))), "rank 3: why");
  EXPECT_EQ(message(again(std::bad_alloc())), "rank 3: not enough memory for this");
}

}  // namespace
}  // namespace folk
