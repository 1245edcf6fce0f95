#pragma once
// A learner's state as a checkpoint's record keeps it, and back.

#include <folk/mpe/offline/offline_learner.h>
#include <folk/sct/files/record_bytes.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace folk::mpe::test {

inline constexpr sct::RecordKind learner_record{"TESTLEAR", 1, "a test"};

inline std::string saved(const OfflineLearner& learner) {
  sct::RecordWriter writer(learner_record);
  learner.save(writer);
  return std::move(writer).sealed();
}

/// Messages call the record "run".
inline void load(OfflineLearner& learner, const std::string& bytes) {
  static const std::string source = "run";
  sct::RecordReader reader(bytes, source, learner_record);
  learner.load(reader);
  EXPECT_TRUE(reader.done());
}

}  // namespace folk::mpe::test
